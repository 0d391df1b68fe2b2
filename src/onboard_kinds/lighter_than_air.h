// LighterThanAirDynamics of Gazebo: what flowing air does to the hull of an airship. A force law: the
// dynamics evaluate it (physics/dynamics/fluid_forces.h), nothing is done once a tick.
#pragma once

#include <vector>

#include "onboard_kinds/kind.h"

namespace roboss {

/// Munk's inviscid flow up to a place `eps_v` behind the link's origin and cross flow behind it (Allen, NACA
/// RM A9I26, 1949; Li, Nahon and Sharf, Airship dynamics modeling, 2011). The hull's axis is x. The link's
/// added mass, of <fluid_added_mass>, has an effect of its own.
struct LighterThanAirSpec {
    LinkNames link;           ///< the hull
    double density = 1.225,   ///< kg/m^3, of the air
        force_inviscid = 0,   ///< m^2
        force_viscous = 0,    ///< m^2
        moment_inviscid = 0,  ///< m^3
        moment_viscous = 0,   ///< m^3
        eps_v = 0,            ///< m, behind the link's origin, where the flow ceases to be potential
        axial_drag = 0;       ///< m^2

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 70,
                                       .name = "lighter-than-air",
                                       .phrase = "an airship's hull",
                                       .classes = "LighterThanAirDynamics",
                                       .files = "lighter_than_air_dynamics-system"};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"link", "link_name"}, s.link);
        visit({"density", "air_density", "kg/m^3"}, s.density);
        visit({"force_inviscid", "force_inviscid_coeff"}, s.force_inviscid);
        visit({"force_viscous", "force_viscous_coeff"}, s.force_viscous);
        visit({"moment_inviscid", "moment_inviscid_coeff"}, s.moment_inviscid);
        visit({"moment_viscous", "moment_viscous_coeff"}, s.moment_viscous);
        visit({"eps_v", "eps_v", "m"}, s.eps_v);
        visit({"axial_drag", "axial_drag_coeff"}, s.axial_drag);
    }
    /// It takes no command.
    std::vector<Channel> channels() const { return {}; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const;
    /// Compares all members.
    friend bool operator==(const LighterThanAirSpec&, const LighterThanAirSpec&) = default;
};

}  // namespace roboss
