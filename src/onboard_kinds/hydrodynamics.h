// Hydrodynamics of Gazebo: damping and added mass of a vehicle in water, and the current. A force law: the
// dynamics evaluate it (physics/dynamics/fluid_forces.h), nothing is done once a tick.
#pragma once

#include <string>
#include <vector>

#include "math/vec3.h"
#include "onboard_kinds/kind.h"

namespace roboss {

/// Fossen's vectors (Handbook of Marine Craft Hydrodynamics and Motion Control, 2011): velocity through the
/// water (U V W P Q R) and force (x y z k m n) at the link's origin, link axes. Matrices row by row: a row
/// for each component of the force. Negative damping brakes, negative derivatives by the acceleration add
/// mass.
struct HydrodynamicsSpec {
    LinkNames link;               ///< that the water pushes
    std::string robot_namespace;  ///< part of the topic; empty: the topic has none
    std::vector<double> linear,   ///< N s/m
        absolute,                 ///< N s^2/m^2, times |velocity|
        square,                   ///< N s^2/m^2, times velocity
        added_mass;               ///< kg: derivatives by the acceleration
    bool no_coriolis = false,     ///< leaves out forces of turning with the added mass
        no_added_mass = false;    ///< leaves out its inertia
    Vec3 current;                 ///< m/s, world axes, before the first command

    /// Sizes of the matrices.
    HydrodynamicsSpec() : linear(36), absolute(216), square(216), added_mass(36) {}

    /// Elements that have no effect.
    static constexpr IgnoredElement kIgnored[] = {
        {"waterDensity", "", "Gazebo does not read it either: the coefficients contain it"},
        {"water_density", "", "Gazebo does not read it either: the coefficients contain it"},
        {"lookup_current_x", "", "there is no table of currents (EnvironmentPreload)",
         "Write <default_current>, or command the current."},
        {"lookup_current_y", "", "there is no table of currents (EnvironmentPreload)"},
        {"lookup_current_z", "", "there is no table of currents (EnvironmentPreload)"}};
    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 67,
                                       .name = "hydrodynamics",
                                       .phrase = "hydrodynamics",
                                       .classes = "Hydrodynamics",
                                       .files = "hydrodynamics-system",
                                       .ignored = kIgnored};

    /// Names of the elements: xU, xUabsU, xUU, xDotU and their like, by number.
    struct Names {
        std::vector<std::string> linear,  ///< of HydrodynamicsSpec::linear
            absolute,                     ///< of HydrodynamicsSpec::absolute
            square,                       ///< of HydrodynamicsSpec::square
            added_mass;                   ///< of HydrodynamicsSpec::added_mass
    };
    /// Of all elements.
    static const Names& names();

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"link", "link_name"}, s.link);
        visit({"robot_namespace", "namespace"}, s.robot_namespace);
        visit({"current", "default_current", "m/s"}, s.current);
        visit({"no_coriolis", "disable_coriolis"}, s.no_coriolis);
        visit({"no_added_mass", "disable_added_mass"}, s.no_added_mass);
        each(visit, names().linear, s.linear);
        each(visit, names().absolute, s.absolute);
        each(visit, names().square, s.square);
        each(visit, names().added_mass, s.added_mass);
    }
    /// The commands that it takes: the current.
    std::vector<Channel> channels() const;
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const;
    /// Compares all members.
    friend bool operator==(const HydrodynamicsSpec&, const HydrodynamicsSpec&) = default;

  private:
    template <class Visitor, class Values>
    static void each(Visitor&& visit, const std::vector<std::string>& names, Values& values) {
        for (std::size_t i = 0; i < names.size(); ++i) visit({names[i].c_str(), names[i].c_str()}, values[i]);
    }
};

/// Whether a symmetric 6x6 matrix, row by row, has no negative eigenvalue but for rounding.
bool is_positive_semidefinite(const double* matrix);

}  // namespace roboss
