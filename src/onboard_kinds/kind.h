// What every kind of on-board controller states about itself. An on-board controller runs on a robot inside
// the step: it reads that robot's own state and its latched commands, and drives its motors, pushes its links
// or moves their surfaces. The `<plugin>` elements of Gazebo become such controllers.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/parameter.h"

namespace roboss {

/// One value of a command: its name and unit.
struct ChannelValue {
    std::string name;  ///< e.g. "linear"
    std::string unit;  ///< e.g. "m/s"; "": none
    /// Of a text: what the numbers stand for, from 1; 0: no text. Empty: a number.
    std::vector<std::string> words{};
    /// Compares all members.
    friend bool operator==(const ChannelValue&, const ChannelValue&) = default;
};

/// A command that an on-board controller takes: a named list of values, latched until the next one.
/// Controllers of one robot that name the same channel share it.
struct Channel {
    std::string name;                  ///< unique in its robot, e.g. "cmd_vel", "joint/arm/cmd_pos"
    std::string topic;                 ///< Gazebo's topic; "{model}" stands for the robot's name
    std::vector<ChannelValue> values;  ///< in order; of a list: one row of it
    bool is_list = false;              ///< the command has any number of rows, e.g. points of a trajectory
    /// Compares all members.
    friend bool operator==(const Channel&, const Channel&) = default;
};

/// The channel that listens to Gazebo's topic `written`. Its name is the topic without its leading "/" and
/// "model/NAME/". Empty: the default topic "/model/{model}/" + `usual`.
Channel channel_of(std::string_view written, std::string_view usual, std::vector<ChannelValue> values);

/// What a kind of on-board controller states about itself.
struct OnboardKind {
    /// In Model hashes, on the wire and in saved runs: never changed, never used again.
    std::uint32_t number;
    const char* name;    ///< in `roboss check` and JSON: "velocity-control"
    const char* phrase;  ///< for messages: "a velocity control"
    /// Class names of Gazebo's plugin without their namespace, separated by |: "VelocityControl"
    const char* classes;
    /// File names of the plugin without "lib", ".so" and Gazebo's prefix, separated by |:
    /// "velocity-control-system"
    const char* files;
    std::span<const IgnoredElement> ignored{};  ///< elements that have no effect
    /// Where odometry begins in its memory, -1: it keeps none. Five numbers: x, y (m) and heading (rad) since
    /// the start, as of the start of the last tick; forward velocity (m/s) and turn rate (rad/s) of the tick
    /// before.
    int odometry = -1;
};

/// Why a controller cannot work with its parameters.
using OnboardProblem = ParameterProblem;

/// Largest value of a command, in size: more than any robot takes, and so little that sums and products of a
/// step stay numbers.
inline constexpr double kCommandMax = 1e9;

}  // namespace roboss
