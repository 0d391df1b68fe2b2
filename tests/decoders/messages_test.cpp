// Messages of others, changed at random: those of ROS 2 (CDR) and frames of Foxglove's protocol. Each is
// read, or refused with a reason. Those that become orders: orders_test.cpp.
#include <gtest/gtest.h>

#include <support/ros2_transport.h>

#include "changes.h"
#include "foxglove/hub.h"
#include "ros2/node_parameters.h"
#include "ros2/trajectory.h"
#include "ros2_types/messages/control_messages.h"
#include "ros2_types/messages/parameter_services.h"
#include "ros2_types/messages/sensor_messages.h"
#include "ros2_types/messages/simulation_entity_services.h"
#include "ros2_types/messages/simulation_spawn_services.h"
#include "ros2_types/messages/standard_services.h"

namespace roboss::test {
namespace {

namespace si = ros2::simulation_interfaces;
namespace rcl = ros2::rcl_interfaces;

const std::string kCases = std::string(ROBOSS_SOURCE) + "/tests/decoders/cases";

ros2::JointTrajectory two_points() {
    ros2::JointTrajectory trajectory;
    trajectory.joint_names = {"a", "b"};
    trajectory.points = {{{0.1, 0.2}, {0.1, 0}, {0, 1}, {}, {1, 0}}, {{1, 2}, {0, 0}, {0, 0}, {}, {2, 500}}};
    return trajectory;
}

/// Messages with their readers.
struct Kinds {
    std::vector<std::string> good;
    std::vector<std::function<bool(const std::string&)>> readers;

    template <ros2::Message M>
    void add(const M& message) {
        good.push_back(ros2::to_cdr(message));
        readers.push_back([](const std::string& bytes) {
            const Result<M> read = ros2::from_cdr<M>(bytes);
            if (read) {
                EXPECT_LE(ros2::to_cdr(read.value()).size(), 20 * bytes.size() + 1'000);
            }
            return taken(read);
        });
    }
};

TEST(Decoders, TakeOrRefuseAnyMessageOfRos2) {
    Kinds kinds;
    kinds.add(ros2::TFMessage{{{{{1, 2}, "world"}, "car", {}}, {{{1, 2}, "car"}, "wheel", {}}}});
    kinds.add(ros2::Float64MultiArray{{{{"robot", 2, 4}, {"wheel", 2, 2}}, 0}, {1, 2, 3, 4}});
    kinds.add(two_points());
    ros2::FollowJointTrajectory::Goal goal;
    goal.trajectory = two_points(), goal.path_tolerance = {{"a", 0.1, 0.2, 0.3}};
    kinds.add(goal);
    rcl::ParameterValue values;
    values.string_array_value = {"x", "yy"}, values.bool_array_value = {true, false};
    kinds.add(rcl::SetParameters::Request{{{"scan.rate", values}, {"other", values}}});
    si::SpawnEntities::Request spawn;
    spawn.spawn_requests.resize(2);
    spawn.spawn_requests[0].name = "box", spawn.spawn_requests[1].entity_resource.uri = "model://box";
    kinds.add(spawn);
    si::EntityFilters filters;
    filters.filter = "^a", filters.tags.tags = {"red", "blue"}, filters.categories.resize(2);
    filters.bounds = {si::Bounds::kBox, {{1, 1, 1}, {0, 0, 0}}};
    kinds.add(si::GetEntities::Request{filters});
    Decoder decoder{"cdr", kinds.good, 20'000, {}};
    decoder.read = [&](const std::string& bytes, std::size_t which) { return kinds.readers[which](bytes); };
    expect_total(decoder, kCases);
}

TEST(Decoders, TakeOrRefuseAnyTrajectory) {
    Decoder decoder{"trajectory", {ros2::to_cdr(two_points())}, 10'000, {}};
    decoder.read = [](const std::string& bytes, std::size_t) {
        const auto message = ros2::from_cdr<ros2::JointTrajectory>(bytes);
        if (!message) return false;
        const std::vector<ros2::JointPoint> start(message.value().joint_names.size());
        const Result<ros2::Trajectory> trajectory = ros2::Trajectory::of(message.value(), start);
        if (!taken(trajectory)) return false;
        const double end = trajectory.value().duration_s();
        for (const double time : {-1e9, 0.0, 0.3 * end, 0.9 * end, end, 1e9})
            EXPECT_EQ(trajectory.value().at(time).size(), start.size());
        return true;
    };
    expect_total(decoder, kCases);
}

TEST(Decoders, TakeOrRefuseAnyCallAboutParameters) {
    TestTransport transport;
    ros2::NodeParameters parameters(transport, transport.add_node("/", "roboss"), "/roboss");
    parameters.put("use_sim_time", ros2::parameter_value(true), "times are simulated");
    parameters.put_settable("scan.rate", ros2::parameter_value(10.0), "Hz", [](const rcl::ParameterValue& v) {
        return v.double_value > 0 ? "" : "a rate is positive";
    });
    const std::vector<std::string> services{"get_parameters", "list_parameters", "set_parameters",
                                            "set_parameters_atomically"};
    const rcl::SetParameters::Request set{{{"scan.rate", ros2::parameter_value(20.0)}}};
    Decoder decoder{"parameters",
                    {ros2::to_cdr(rcl::GetParameters::Request{{"scan.rate", "use_sim_time"}}),
                     ros2::to_cdr(rcl::ListParameters::Request{{"scan", ""}, 2}), ros2::to_cdr(set),
                     ros2::to_cdr(rcl::SetParametersAtomically::Request{set.parameters})},
                    10'000,
                    {}};
    decoder.read = [&](const std::string& bytes, std::size_t which) {
        const std::int64_t call = transport.call("/roboss/" + services[which], bytes);
        for (const ros2::Incoming& incoming : transport.take(0)) EXPECT_TRUE(parameters.take(incoming));
        EXPECT_LE(parameters.take_notices().size(), 1u);
        transport.published.clear();
        const bool has_reply = transport.replies.contains(call);
        transport.replies.clear();
        return has_reply;
    };
    expect_total(decoder, kCases);
    EXPECT_GT(parameters.value("scan.rate").double_value, 0);
}

/// A server of Foxglove's protocol with a topic that it publishes, one that it subscribes to, and a service.
struct FoxgloveServer {
    foxglove::Hub hub{"session"};
    ros2::EntityId clock = 0, drive = 0, service = 0;
    std::uint64_t round = 0;

    FoxgloveServer() {
        const ros2::EntityId node = hub.add_node("/", "roboss");
        clock =
            hub.add_publisher(node, "/pose", ros2::type_of<ros2::TwistMessage>(), {true, true, 5}).value();
        drive = hub.add_subscription(node, "/cmd_vel", ros2::type_of<ros2::TwistMessage>(), {}).value();
        service = hub.add_service(node, "/get_entities", ros2::type_of_service<si::GetEntities>()).value();
        hub.announce();
        hub.publish(clock, ros2::to_cdr(ros2::TwistMessage{}));
    }
    /// Gives a frame of a new client to the server, behind a right one; all that waits then is read.
    void hear(const std::string& frame, bool is_text) {
        const foxglove::ClientNumber client = hub.enter("client", [] {});
        hub.take_text(client, advertise());
        is_text ? hub.take_text(client, frame) : hub.take_binary(client, frame);
        hub.publish(clock, ros2::to_cdr(ros2::TwistMessage{}));
        for (const ros2::Incoming& incoming : hub.take(0))
            if (incoming.entity == service) hub.reply(service, incoming.call, std::string(4, '\0'));
        for (int frames = 0; hub.next(client); ++frames) ASSERT_LT(frames, 10'000);
        hub.leave(client);
        EXPECT_EQ(hub.clients(), 0u);
        EXPECT_EQ(hub.subscribers(clock), 0u);
    }
    static std::string advertise() {
        return R"({"op":"advertise","channels":[{"id":7,"topic":"/cmd_vel","encoding":"cdr",)"
               R"("schemaName":"geometry_msgs/msg/Twist"}]})";
    }
};

TEST(Decoders, TakeOrRefuseAnyTextOfFoxglove) {
    FoxgloveServer server;
    const std::string id = std::to_string(server.clock);
    Decoder decoder{"foxglove-text",
                    {R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":)" + id + "}]}",
                     R"({"op":"unsubscribe","subscriptionIds":[1,2]})", FoxgloveServer::advertise(),
                     R"({"op":"unadvertise","channelIds":[7,8]})", R"({"op":"subscribeConnectionGraph"})"},
                    3'000,
                    {}};
    decoder.read = [&](const std::string& text, std::size_t) {
        server.hear(text, true);
        return taken(foxglove::read_text(text));
    };
    expect_total(decoder, kCases);
}

TEST(Decoders, TakeOrRefuseAnyBytesOfFoxglove) {
    FoxgloveServer server;
    const std::string message = std::string("\1\7\0\0\0", 5) + ros2::to_cdr(ros2::TwistMessage{});
    std::string call = std::string("\2", 1) + static_cast<char>(server.service);
    call += std::string("\0\0\0\1\0\0\0\3\0\0\0cdr", 14) + ros2::to_cdr(si::GetEntities::Request{});
    Decoder decoder{"foxglove-bytes", {message, call}, 10'000, {}};
    decoder.read = [&](const std::string& bytes, std::size_t) {
        server.hear(bytes, false);
        return taken(foxglove::read_binary(bytes));
    };
    expect_total(decoder, kCases);
}

}  // namespace
}  // namespace roboss::test
