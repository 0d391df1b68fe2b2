// BuoyancyEngine of Gazebo: a bladder that changes a vehicle's volume, so that it dives or rises.
#pragma once

#include <string>
#include <vector>

#include "onboard_kinds/kind.h"

namespace roboss {

/// Force at the link's origin: weight of the fluid that the bladder displaces, less that of the neutral
/// volume.
struct BuoyancyEngineSpec {
    static constexpr double kNone = 1e300;  ///< no surface: there is fluid everywhere

    LinkNames link;               ///< that is pushed
    std::string robot_namespace;  ///< part of the topic; empty: the topic has none
    double min_volume = 3e-5,     ///< m^3
        max_volume = 9.9e-4,      ///< m^3
        neutral_volume = 3e-4,    ///< m^3, at which it gives no force
        default_volume = -1,      ///< m^3 at the start; negative: `min_volume`
        max_rate = 3e-6,          ///< m^3/s
        density = 1000,           ///< kg/m^3, of the fluid
        surface = kNone;          ///< m, height above which there is no fluid

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 66,
                                       .name = "buoyancy-engine",
                                       .phrase = "a buoyancy engine",
                                       .classes = "BuoyancyEngine|BuoyancyEnginePlugin",
                                       .files = "buoyancy-engine-system"};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"link", "link_name"}, s.link);
        visit({"robot_namespace", "namespace"}, s.robot_namespace);
        visit({"min_volume", "min_volume", "m^3"}, s.min_volume);
        visit({"max_volume", "max_volume", "m^3"}, s.max_volume);
        visit({"neutral_volume", "neutral_volume", "m^3"}, s.neutral_volume);
        visit({"default_volume", "default_volume", "m^3"}, s.default_volume);
        visit({"max_rate", "max_inflation_rate", "m^3/s"}, s.max_rate);
        visit({"density", "fluid_density", "kg/m^3"}, s.density);
        visit({"surface", "surface", "m"}, s.surface);
    }
    /// The commands that it takes: the volume.
    std::vector<Channel> channels() const;
    /// Its memory: the volume, m^3.
    std::vector<double> memory() const { return {default_volume >= 0 ? default_volume : min_volume}; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const;
    /// Compares all members.
    friend bool operator==(const BuoyancyEngineSpec&, const BuoyancyEngineSpec&) = default;
};

}  // namespace roboss
