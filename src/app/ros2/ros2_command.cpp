// Joins a run as a Client that speaks for its robots in ROS 2.
#include "app/ros2/ros2_command.h"

#include "app/ros2/face_process.h"
#include "app/ros2/ros2_options.h"
#include "ros2_types/open_transport.h"

namespace roboss {
namespace {

const char* const kRos2Footer =
    R"(Nothing of ROS has to be installed here. Nodes see one node for each robot, its sensors as topics, and drive it by the
topics of its controllers, each below the robot's name: /car_3/scan, /car_3/cmd_vel. docs/ros2.md has all of it.

Examples:
  roboss run example:city --ros2                   a run and its nodes at once
  roboss ros2                                      beside a run on this computer (`roboss controller ...`)
  roboss ros2 --list                               the topics of that run
  roboss ros2 --bridge bridge.yaml                 topics have the names of a file of ros_gz_bridge
  roboss ros2 --reach subnet --domain 7            for nodes on other computers

Exit codes: 0 the run is over or Ctrl-C, 1 an option is wrong, no Controller was found, or Fast DDS is missing, 3 the run
has failed.)";

}  // namespace

void add_ros2_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("ros2", "show a running simulation to ROS 2 nodes");
    command->footer(kRos2Footer);
    const auto options = std::make_shared<FaceProcessOptions>();
    const auto ros2 = std::make_shared<Ros2Options>();
    add_ros2_options(*command, *ros2, "--");
    add_face_process_options(*command, *options, ros2->face);
    command->callback([options, ros2, &exit_code] {
        exit_code = show_run("ros2", *options, face_options(*ros2),
                             [&]() -> Result<std::unique_ptr<ros2::Transport>> {
                                 const Result<ros2::TransportOptions> transport = transport_options(*ros2);
                                 if (!transport) return transport.error();
                                 return ros2::open_transport(transport.value());
                             });
    });
}

}  // namespace roboss
