// Buoyancy of Gazebo: the fluids of the world, and what they carry. The plugin belongs to the world; the
// dynamics evaluate it (physics/dynamics/fluid_forces.h).
#pragma once

#include <string>
#include <vector>

#include "onboard_kinds/kind.h"

namespace roboss {

/// From `above` on the fluid has this density, up to the next layer.
struct FluidLayer {
    double above = 0,  ///< m, height
        density = 1;   ///< kg/m^3

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"above", "above_depth", "m"}, s.above);
        visit({"density", "density", "kg/m^3"}, s.density);
    }
    /// Compares all members.
    friend bool operator==(const FluidLayer&, const FluidLayer&) = default;
};

/// Names of models and links, scoped by ::.
struct BuoyancySpec {
    double density = 1000,             ///< kg/m^3, where there are no layers
        lowest_density = 1000;         ///< kg/m^3, below the lowest layer
    std::vector<FluidLayer> layers;    ///< by ascending height
    bool graded = false;               ///< whether there are layers
    std::vector<std::string> enabled;  ///< what floats; empty: everything

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 65,
                                       .name = "buoyancy",
                                       .phrase = "buoyancy",
                                       .classes = "Buoyancy",
                                       .files = "buoyancy-system"};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"density", "uniform_fluid_density", "kg/m^3"}, s.density);
        visit({"lowest_density", "graded_buoyancy/default_density", "kg/m^3"}, s.lowest_density);
        visit({"layers", "graded_buoyancy/density_change"}, s.layers);
    }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const;
    /// Compares all members.
    friend bool operator==(const BuoyancySpec&, const BuoyancySpec&) = default;
};

/// The fluids in which robots float: densities from the ground up, layer by layer.
struct FluidLayers {
    std::vector<double> heights,  ///< m, ascending: where the density changes
        densities;                ///< kg/m^3: one more than heights; empty: there is no fluid
    bool everywhere = false;      ///< it carries robots that are added later, too

    /// Of the world's plugin.
    static FluidLayers of(const BuoyancySpec& spec);
    /// Compares all members.
    friend bool operator==(const FluidLayers&, const FluidLayers&) = default;
};

}  // namespace roboss
