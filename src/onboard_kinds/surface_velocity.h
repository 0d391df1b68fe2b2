// <roboss:surface_velocity> of a link or collision: its surface moves along itself, as a conveyor belt or a
// turntable does. What touches it is carried along by friction.
#pragma once

#include <string>
#include <vector>

#include "math/vec3.h"
#include "onboard_kinds/kind.h"

namespace roboss {

/// The surface moves with linear + angular x r at the place r from the link's origin, as far as that is along
/// the surface. A command replaces both.
struct SurfaceVelocitySpec {
    LinkNames link;      ///< whose collisions these are
    Vec3 linear,         ///< m/s, link axes, before the first command
        angular;         ///< rad/s, link axes, before the first command
    std::string topic;   ///< of the command; empty: /model/NAME/link/LINK/surface_velocity
    bool fixed = false;  ///< takes no command; then a static model stays scenery without a state

    /// What this kind states about itself. No plugin has its names: SDF has an element for it.
    static constexpr OnboardKind kKind{
        .number = 41, .name = "surface-velocity", .phrase = "a surface velocity", .classes = "", .files = ""};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"link", "link"}, s.link);
        visit({"linear", "linear", "m/s"}, s.linear);
        visit({"angular", "angular", "rad/s"}, s.angular);
        visit({"topic", "topic"}, s.topic);
        visit({"fixed", "fixed"}, s.fixed);
    }
    /// The commands that it takes.
    std::vector<Channel> channels() const {
        if (fixed) return {};
        const std::string place = "link/" + (link.empty() ? std::string() : link.front()) + "/";
        return {channel_of(topic, place + "surface_velocity",
                           {{"linear_x", "m/s"},
                            {"linear_y", "m/s"},
                            {"linear_z", "m/s"},
                            {"angular_x", "rad/s"},
                            {"angular_y", "rad/s"},
                            {"angular_z", "rad/s"}})};
    }
    /// Links whose surfaces it moves.
    const LinkNames& surfaces() const { return link; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        if (link.size() != 1)
            problems.push_back({"names " + std::to_string(link.size()) + " links", "Write it in one link."});
    }
    /// Compares all members.
    friend bool operator==(const SurfaceVelocitySpec&, const SurfaceVelocitySpec&) = default;
};

}  // namespace roboss
