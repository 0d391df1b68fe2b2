// <roboss:gripper>: a suction cup or a magnet on a link. Switched on, it takes hold of what is nearest to it.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "math/pose.h"
#include "onboard_kinds/kind.h"

namespace roboss {

/// It holds one link of another robot, or the scenery, rigidly, until it is switched off or overloaded. What
/// it lost by overload it takes again after the next command only.
struct GripperSpec {
    LinkNames link;                ///< that carries it, one
    std::string name;              ///< of its commands; empty: that of the link
    std::string type = "suction";  ///< "suction" or "magnetic": for people, both obey the same law
    Pose X_LC;                     ///< m, the cup in the link's frame; only its position counts
    double reach = 0.01;           ///< m: how far from the cup a surface may be
    double max_force = std::numeric_limits<double>::infinity(),  ///< N: beyond, it lets go
        max_torque = std::numeric_limits<double>::infinity();    ///< N m about the cup: beyond, it lets go
    bool on = false;                                             ///< at the start

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{
        .number = 51, .name = "gripper", .phrase = "a gripper", .classes = "", .files = ""};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"link", "link"}, s.link);
        visit({"name", "name"}, s.name);
        visit({.name = "type", .element = "type", .choice = true}, s.type);
        visit({"pose", "pose"}, s.X_LC);
        visit({"reach", "reach", "m"}, s.reach);
        visit({"max_force", "max_force", "N", true}, s.max_force);
        visit({"max_torque", "max_torque", "N m", true}, s.max_torque);
        visit({"on", "on"}, s.on);
    }
    /// The command that it takes.
    std::vector<Channel> channels() const {
        const std::string called = !name.empty() ? name : link.empty() ? "gripper" : link.front();
        return {channel_of("", called + "/grip", {{"on", ""}})};
    }
    /// What it remembers.
    enum Memory : std::size_t {
        kPhase,  ///< one of the numbers below
        kHeard   ///< tick of the last command that it has obeyed, -1: none
    };
    /// The first number of its memory.
    static constexpr double kOff = 0;        ///< it is off
    static constexpr double kSearching = 1;  ///< it is on and holds nothing
    static constexpr double kHolding = 2;    ///< it is on and holds something
    static constexpr double kLost = 3;       ///< it is on and lost its hold: it waits for a command
    /// At the start.
    std::vector<double> memory() const { return {kOff, -1}; }
    /// One that searches may not sleep.
    bool rests(std::span<const double> memory) const { return memory[kPhase] != kSearching; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        if (type != "suction" && type != "magnetic")
            problems.push_back({"has the type '" + type + "'", "Write suction or magnetic."});
        if (!(reach > 0 && reach <= 10))
            problems.push_back(
                {"has a <reach> that is not in (0, 10] m", "Give the reach of the cup, in m."});
        if (!(max_force > 0) || !(max_torque > 0))
            problems.push_back({"holds with no force or no torque", "Give a maximum above 0, or none."});
    }
    /// Compares all members.
    friend bool operator==(const GripperSpec&, const GripperSpec&) = default;
};

}  // namespace roboss
