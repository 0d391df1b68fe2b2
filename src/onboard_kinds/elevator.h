// Elevator of Gazebo: moves a cabin to the floors that are asked for, and opens their doors. It commands the
// position controllers of its joints.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "onboard_kinds/kind.h"

namespace roboss {

/// Its joints and floors are found by the prefixes of their names, numbered from 0 (use_model).
struct ElevatorSpec {
    double update_rate = 10;              ///< Hz, of its decisions; 0: at every tick
    std::string floor_prefix = "floor_",  ///< of links: their heights are those of the cabin's joint
        door_prefix = "door_",            ///< of joints, open at their upper limits, closed at 0
        cabin_joint = "lift",             ///< name of the joint
        cmd_topic,                        ///< of the command; empty: /model/NAME/cmd
        state_topic;                      ///< of the floor where it is; empty: /model/NAME/state
    double state_publish_rate = 5,        ///< Hz, of the telemetry
        open_door_wait_duration = 5;      ///< s, that a door stays open
    JointNames joints;                    ///< the cabin's, then the doors', by floor
    LinkNames floors;                     ///< links, by floor

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 35,
                                       .name = "elevator",
                                       .phrase = "an elevator",
                                       .classes = "Elevator",
                                       .files = "elevator-system"};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"update_rate", "update_rate", "Hz"}, s.update_rate);
        visit({"floor_link_prefix", "floor_link_prefix"}, s.floor_prefix);
        visit({"door_joint_prefix", "door_joint_prefix"}, s.door_prefix);
        visit({"cabin_joint", "cabin_joint"}, s.cabin_joint);
        visit({"cmd_topic", "cmd_topic"}, s.cmd_topic);
        visit({"state_topic", "state_topic"}, s.state_topic);
        visit({"state_publish_rate", "state_publish_rate", "Hz"}, s.state_publish_rate);
        visit({"open_door_wait_duration", "open_door_wait_duration", "s"}, s.open_door_wait_duration);
        visit({"joints", ""}, s.joints);
        visit({"floors", ""}, s.floors);
    }
    /// Finds its joints and floors among those of its model; `scope`: the prefix of their names.
    void use_parts(const std::string& scope, const std::vector<std::string>& model_joints,
                   const std::vector<std::string>& model_links) {
        const auto has = [](const std::vector<std::string>& names, const std::string& name) {
            return std::ranges::find(names, name) != names.end();
        };
        joints.clear(), floors.clear();
        if (has(model_joints, scope + cabin_joint)) joints.push_back(scope + cabin_joint);
        for (int i = 0;; ++i) {
            const std::string number = std::to_string(i);
            if (!has(model_links, scope + floor_prefix + number)) break;
            floors.push_back(scope + floor_prefix + number);
            if (has(model_joints, scope + door_prefix + number))
                joints.push_back(scope + door_prefix + number);
        }
    }
    /// The command that it takes: the number of a floor.
    std::vector<Channel> channels() const { return {channel_of(cmd_topic, "cmd", {{"data", ""}})}; }
    /// The commands that it gives, by joint.
    std::vector<std::string> commands() const {
        std::vector<std::string> names;
        for (const std::string& joint : joints) names.push_back("joint/" + joint + "/0/cmd_pos");
        return names;
    }
    /// What it does.
    enum State { kIdle, kMoves, kOpens, kWaits, kCloses };
    /// Its memory: State; floor at which it is; tick of the last command that it took; time in s since the
    /// door is open; number of floors in the queue, and that of commands that wait until the door is closed;
    /// then these floors, as many places for each as there are floors.
    enum Memory : std::size_t { kState, kFloor, kHeard, kOpenSince, kQueued, kDeferred, kLists };
    /// At the start.
    std::vector<double> memory() const {
        std::vector<double> start(kLists + 2 * floors.size(), 0.0);
        start[kHeard] = -1;
        return start;
    }
    /// Whether it would change nothing while its robot is at rest.
    bool rests(std::span<const double> memory) const {
        return static_cast<int>(memory[kState]) == kIdle && memory[kQueued] == 0;
    }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        if (!(update_rate >= 0) || !(open_door_wait_duration >= 0))
            problems.push_back({"has a negative rate or time", "Write numbers of at least 0."});
    }
    /// Why it cannot work in its model; empty: it can.
    std::string fault() const {
        if (floors.empty()) return "finds no link '" + floor_prefix + "0'";
        if (joints.size() != floors.size() + 1)
            return "does not find the joint '" + cabin_joint + "' and a joint '" + door_prefix +
                   "N' for each floor";
        return {};
    }
    /// Compares all members.
    friend bool operator==(const ElevatorSpec&, const ElevatorSpec&) = default;
};

}  // namespace roboss
