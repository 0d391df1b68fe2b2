// WheelSlip of Gazebo: wheels whose contacts slip in proportion to the force that they transmit. A property
// of their friction: contacts read it (physics/contact/wheel_slip.h), nothing is done once a tick.
#pragma once

#include <string>
#include <vector>

#include "onboard_kinds/kind.h"

namespace roboss {

/// A wheel. Its contacts slip by u = compliance * radius * |spin rate| / normal_force * f for a friction
/// force f below Coulomb's bound: along the axle by the lateral compliance, across it by the longitudinal
/// one.
struct SlipWheelSpec {
    LinkNames link;        ///< that touches the ground; its joint is the axle
    double lateral = 0,    ///< compliance along the axle
        longitudinal = 0,  ///< compliance across the axle
        normal_force = 0,  ///< N, that the compliances are relative to
        radius = 0;        ///< m

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"link", "@link_name"}, s.link);
        visit({"lateral", "slip_compliance_lateral"}, s.lateral);
        visit({"longitudinal", "slip_compliance_longitudinal"}, s.longitudinal);
        visit({"normal_force", "wheel_normal_force", "N"}, s.normal_force);
        visit({"radius", "wheel_radius", "m"}, s.radius);
    }
    /// Compares all members.
    friend bool operator==(const SlipWheelSpec&, const SlipWheelSpec&) = default;
};

/// A plugin becomes a controller for each wheel (parts).
struct WheelSlipSpec {
    std::vector<SlipWheelSpec> wheels;  ///< at least one

    /// Numbers of its commands.
    enum Command { kCompliances, kFriction };

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 69,
                                       .name = "wheel-slip",
                                       .phrase = "a wheel slip",
                                       .classes = "WheelSlip",
                                       .files = "wheel-slip-system"};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"wheels", "wheel"}, s.wheels);
    }
    /// The controllers that a plugin becomes.
    std::vector<WheelSlipSpec> parts() const {
        std::vector<WheelSlipSpec> found;
        for (const SlipWheelSpec& wheel : wheels) found.emplace_back().wheels.push_back(wheel);
        return found;
    }
    /// Name of the command that sets the compliances of a wheel, or the friction of its contacts.
    static std::string compliances_of(const std::string& link) { return "link/" + link + "/wheel_slip"; }
    static std::string friction_of(const std::string& link) { return "link/" + link + "/wheel_friction"; }
    /// The commands that it takes: the compliances; the coefficients of friction along the axle and across
    /// it, which replace those of both materials (negative: they do not).
    std::vector<Channel> channels() const;
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const;
    /// Compares all members.
    friend bool operator==(const WheelSlipSpec&, const WheelSlipSpec&) = default;
};

}  // namespace roboss
