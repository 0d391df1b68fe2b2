// FollowActor of Gazebo: an actor walks after a model of the world. Where that model is, a control program
// tells it (client/triggers/board_watch.h), since a step of one robot knows nothing of another.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "onboard_kinds/kind.h"

namespace roboss {

/// In the plane, at its own height: it turns to the target and walks straight, unless it is near enough or
/// too far away. It replaces the actor's script.
struct FollowActorSpec {
    std::string target;      ///< model of the world
    double velocity = 0.8,   ///< m/s
        min_distance = 1.2,  ///< m: nearer it stands
        max_distance = 4;    ///< m: farther away it stands
    static constexpr IgnoredElement kIgnored[] = {
        {"animation", "", "the limbs of an actor do not move"},
        {"animation_x_vel", "", "the limbs of an actor do not move"},
    };
    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 36,
                                       .name = "follow-actor",
                                       .phrase = "an actor that follows",
                                       .classes = "FollowActor",
                                       .files = "follow-actor-system",
                                       .ignored = kIgnored};
    static constexpr const char* kTargetAt = "follow/target";  ///< its command: where the target is

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"target", "target"}, s.target);
        visit({"velocity", "velocity", "m/s"}, s.velocity);
        visit({"min_distance", "min_distance", "m"}, s.min_distance);
        visit({"max_distance", "max_distance", "m"}, s.max_distance);
    }
    /// The command that it takes.
    std::vector<Channel> channels() const { return {channel_of("", kTargetAt, {{"x", "m"}, {"y", "m"}})}; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        if (target.empty()) problems.push_back({"names no <target>", "Name a model of the world."});
    }
    /// Compares all members.
    friend bool operator==(const FollowActorSpec&, const FollowActorSpec&) = default;
};

}  // namespace roboss
