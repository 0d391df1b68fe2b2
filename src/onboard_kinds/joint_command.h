// What the controllers of joints share: their commands, and the checks of their parameters.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "onboard_kinds/kind.h"

namespace roboss {

/// The first name; "" if there is none.
inline std::string first_of(const JointNames& joints) {
    return joints.empty() ? std::string() : joints.front();
}

/// The channel of a joint's command: `topic`, or /model/NAME/`sub_topic`, or the usual one.
inline Channel joint_channel(const std::string& topic, const std::string& sub_topic, const std::string& usual,
                             ChannelValue value) {
    return channel_of(topic, sub_topic.empty() ? usual : sub_topic, {std::move(value)});
}

/// The channel of an Actuators message: a list with one value for each actuator.
inline Channel actuators_channel(const std::string& topic, const std::string& sub_topic) {
    Channel channel = channel_of(topic.empty() && sub_topic.empty() ? "/actuators" : topic, sub_topic,
                                 {{"actuator", "unit of its controller"}});
    channel.is_list = true;
    return channel;
}

/// Adds what no controller of joints can do without.
inline void check_joint_command(const JointNames& joints, bool use_actuator_msg, int actuator_number,
                                std::vector<OnboardProblem>& problems) {
    if (joints.empty()) problems.push_back({"names no joint", "Add <joint_name>NAME</joint_name>."});
    if (use_actuator_msg && actuator_number < 0)
        problems.push_back({"takes commands of actuators, but has no <actuator_number>",
                            "Write its place in the message, from 0."});
}

}  // namespace roboss
