// The options by which a run is shown to ROS 2, of `roboss ros2` and, with --ros2- in front, of `roboss run`.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"
#include "ros2/face.h"
#include "ros2_types/transport.h"

namespace roboss {

struct Ros2Options {
    bool wanted = false;  // of a run: --ros2
    ros2::FaceOptions face;
    std::string distro = "jazzy";
    std::string domain, reach, discovery_server;  // as ROS_DOMAIN_ID ... say it; empty: not given
    std::vector<std::string> peers;
};

/// Declares an option that takes the file of ros2_control, read at once.
void add_controllers_option(CLI::App& command, const std::string& name,
                            std::shared_ptr<const ros2::Controllers>& controllers);
/// Declares --period, --services and those of TopicOptions with this prefix.
void add_face_options(CLI::App& command, ros2::FaceOptions& face, const std::string& prefix);
/// Adds them to the arguments of a process.
void add_face_arguments(std::vector<std::string>& words, const ros2::FaceOptions& face);

/// `prefix`: "--" or "--ros2-".
void add_ros2_options(CLI::App& command, Ros2Options& options, const std::string& prefix);
/// `roboss ros2` with the same options.
std::vector<std::string> ros2_arguments(const Ros2Options& options);
/// For the Face: with the layouts of the distribution.
ros2::FaceOptions face_options(const Ros2Options& options);
/// For the transport; what is not given comes from the variables of the environment that ROS 2 reads.
Result<ros2::TransportOptions> transport_options(const Ros2Options& options);

}  // namespace roboss
