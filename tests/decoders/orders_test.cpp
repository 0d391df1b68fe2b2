// Messages and files of others that become orders, changed at random: commands of ROS 2, and files of
// ros_gz_bridge, which say what is a command.
#include <gtest/gtest.h>

#include <support/drives.h>

#include "changes.h"
#include "ros2/bridge.h"
#include "ros2/robot_commands.h"
#include "ros2_types/cdr.h"
#include "ros2_types/messages/command_messages.h"

namespace roboss::test {
namespace {

const std::string kCases = std::string(ROBOSS_SOURCE) + "/tests/decoders/cases";

TEST(Decoders, TakeOrRefuseAnyCommandOfRos2) {
    World world = on_plane(skid_car());
    place(world, two_wheeler(), "bare");
    const auto model = compiled(world);
    ros2::TopicOptions options;
    options.fleet = true;
    const ros2::RobotCommands commands(model, options);
    ros2::TwistMessage twist;
    twist.linear = {1, 2, 3}, twist.angular = {4, 5, 6};
    const std::string numbers = ros2::to_cdr(ros2::Float64MultiArray{{}, {1, 2, 3, 4}});
    Decoder decoder{"commands", {ros2::to_cdr(twist), numbers, ros2::to_cdr(ros2::Bool{true})}, 10'000, {}};
    decoder.read = [&](const std::string& bytes, std::size_t) {
        bool any = false;
        for (std::size_t topic = 0; topic < commands.topics().size(); ++topic) {
            const Result<std::vector<ros2::RobotOrder>> orders = commands.orders(topic, bytes);
            any |= taken(orders);
            if (!orders) continue;
            for (const ros2::RobotOrder& one : orders.value())
                (void)check_order(*model, {0, {}, 0, one.robot, one.action});
        }
        return any;
    };
    expect_total(decoder, kCases);
}

TEST(Decoders, TakeOrRefuseAnyBridgeFile) {
    const auto model = compiled(on_plane(skid_car()));
    const std::string types = "  ros_type_name: geometry_msgs/msg/Twist\n  gz_type_name: gz.msgs.Twist\n";
    Decoder decoder{
        "bridge",
        {"- topic_name: /robot/cmd_vel\n" + types + "  direction: ROS_TO_GZ\n  lazy: true\n",
         "- &a\n  ros_topic_name: a\n  gz_topic_name: /model/robot/cmd_vel\n" + types + "- *a\n",
         "- service_name: /world/w/control\n  ros_type_name: ros_gz_interfaces/srv/ControlWorld\n"},
        3'000,
        {}};
    decoder.read = [&](const std::string& text, std::size_t) {
        const Result<ros2::Bridge> bridge = ros2::parse_bridge("bridge.yaml", text);
        if (bridge) (void)ros2::match_bridge(bridge.value(), *model);
        return taken(bridge);
    };
    expect_total(decoder, kCases);
}

}  // namespace
}  // namespace roboss::test
