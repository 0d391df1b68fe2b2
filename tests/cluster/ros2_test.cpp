// A run with nodes of ROS 2 beside it: the test plays the nodes.
#include <gtest/gtest.h>

#include <support/drives.h>
#include <support/ros2_transport.h>

#include "bus/in_process_bus.h"
#include "ros2/face.h"
#include "ros2_types/messages/command_messages.h"
#include "simulation/simulation.h"

namespace roboss::test {
namespace {

using ros2::Face;
using ros2::FaceOptions;

World cars() {
    World world = on_plane(with_onboard(two_wheeler(), diff_drive()), 2e-3);
    place(world, with_onboard(two_wheeler(), diff_drive()), "other", {{0, 3, 0}, {}});
    return world;
}

class RunWithNodes : public testing::Test {
  protected:
    void start(const FaceOptions& options, std::size_t simulators = 1) {
        auto bus = std::make_unique<InProcessBus>();
        bus_ = bus.get();
        SimulationOptions wanted;
        wanted.simulators = simulators;
        if (!options.lockstep.empty()) wanted.clients_awaited = {options.name};
        auto made = roboss::Simulation::create(model, wanted, {}, nullptr, std::move(bus));
        ASSERT_TRUE(made.ok()) << made.error().text();
        simulation = std::move(made).value();
        face.emplace(transport, options);
        const Result<> shown = face->show(model, Address{Role::kClient, 77});
        ASSERT_TRUE(shown.ok()) << shown.error().text();
    }
    /// Runs to this tick; `nodes` is called in each turn.
    void run(Tick until, const std::function<void()>& nodes = {}) {
        const std::int64_t end_ms = monotonic_ms() + 60'000;  // a test that waits for ever fails
        const Result<> ran = simulation->run_until(until, [&] {
            face->advance(*bus_);
            if (nodes) nodes();
            return monotonic_ms() < end_ms;
        });
        ASSERT_TRUE(ran.ok()) << ran.error().text();
        ASSERT_GE(simulation->tick(), until) << "it waits for ever";
        for (int turn = 0; turn < 3; ++turn) {
            face->advance(*bus_);
            simulation->serve();
        }
    }

    RunWithNodes() { transport.has_listeners = false; }
    std::shared_ptr<const Model> model = compiled(cars());
    TestTransport transport;
    Bus* bus_ = nullptr;
    std::unique_ptr<roboss::Simulation> simulation;
    std::optional<Face> face;
};

TEST_F(RunWithNodes, SeeRobotsAsNodesWithTheirTopics) {
    start({});
    EXPECT_NE(transport.find("/roboss"), 0u);
    EXPECT_NE(transport.find("/robot/robot"), 0u);
    EXPECT_NE(transport.find("/other/joint_states"), 0u);
    const ros2::EntityId drive = transport.find("/other/cmd_vel");
    ASSERT_NE(drive, 0u);
    EXPECT_EQ(transport.names.at(transport.node_of.at(drive)), "/other/robot");
}

TEST_F(RunWithNodes, OnlyWhatSomebodySubscribesToIsPublished) {
    transport.subscribed = {"/clock", "/robot/joint_states"};
    start({});
    run(100);
    EXPECT_GE(transport.take_published("/clock"), 5u);
    EXPECT_GE(transport.take_published("/robot/joint_states"), 5u);
    EXPECT_EQ(transport.take_published("/tf_static"), 1u) << "latched, for who comes later";
    EXPECT_EQ(transport.take_published("/robot/robot_description"), 1u);
    transport.take_published("/other/robot_description");
    for (const auto& [topic, messages] : transport.published)
        EXPECT_TRUE(messages.empty() || !topic.starts_with("/robot/")) << topic;
}

TEST_F(RunWithNodes, DriveRobotsAndAreToldWhatIsWrong) {
    start({});
    run(20);
    transport.send("/robot/cmd_vel", ros2::TwistMessage{{0.5, 0, 0}, {}});
    transport.send("/other/cmd_vel", ros2::Bool{true});
    transport.send_bytes("/other/cmd_vel", "");
    run(1000);
    const std::vector<RobotState>& states = simulation->states();
    EXPECT_GT(base_pose(states[0]).p.x, 0.5);
    EXPECT_NEAR(base_pose(states[1]).p.x, 0, 0.01);
    const std::vector<std::string> notices = face->take_notices();
    ASSERT_FALSE(notices.empty());
    EXPECT_NE(notices.front().find("/other/cmd_vel"), std::string::npos) << notices.front();
}

/// In lockstep, nodes that answer each clock give one hash, whatever they do in between.
TEST_F(RunWithNodes, InLockstepTheHashIsThatOfTheMessages) {
    transport.subscribed = {"/clock"};
    transport.driven = {"/robot/cmd_vel", "/other/cmd_vel"};
    FaceOptions options;
    options.lockstep = {"/*/cmd_vel"};
    std::set<std::uint64_t> hashes;
    for (const int delay : {0, 1, 7}) {
        face.reset();
        transport.published.clear();  // a clock of the run before would be answered in this one
        start(options, 1 + static_cast<std::size_t>(delay) % 3);
        int turn = 0, answers = 0, heard = 0;
        run(500, [&] {
            heard += static_cast<int>(transport.take_published("/clock"));
            if (++turn % (delay + 1) != 0 || answers >= heard) return;
            const double turn_rate = 0.1 * answers++;
            const char* first = delay == 1 ? "/other/cmd_vel" : "/robot/cmd_vel";
            const char* second = delay == 1 ? "/robot/cmd_vel" : "/other/cmd_vel";
            transport.send(first, ros2::TwistMessage{{0.5, 0, 0}, {0, 0, turn_rate}});
            transport.send(second, ros2::TwistMessage{{0.5, 0, 0}, {0, 0, turn_rate}});
        });
        EXPECT_GE(answers, 49) << "one in 10 ticks; the run ends before it needs the last";
        hashes.insert(simulation->hash());
        EXPECT_TRUE(face->take_notices().empty());
    }
    EXPECT_EQ(hashes.size(), 1u);
}

TEST_F(RunWithNodes, SeeThePausedWorldAtAnyTick) {
    start({});
    run(33);
    const std::int64_t end_ms = monotonic_ms() + 5'000;
    while (face->client().tick() != 33 && monotonic_ms() < end_ms) {
        simulation->serve();
        face->advance(*bus_);
    }
    EXPECT_EQ(face->client().tick(), 33) << "its period is 10 ticks";
    run(47);
    EXPECT_GE(face->client().tick(), 40);
}

TEST_F(RunWithNodes, PublishTheTypeOfVelocityThatTheyHave) {
    start({});
    run(20);
    transport.other_types["/robot/cmd_vel"] = ros2::TwistStamped::kName;
    const std::int64_t end_ms = monotonic_ms() + 10'000;
    while (transport.types["/robot/cmd_vel"] != ros2::TwistStamped::kName && monotonic_ms() < end_ms)
        face->advance(*bus_);
    EXPECT_EQ(transport.types["/robot/cmd_vel"], ros2::TwistStamped::kName);
    EXPECT_EQ(transport.types["/other/cmd_vel"], ros2::TwistMessage::kName);
    transport.send("/robot/cmd_vel", ros2::TwistStamped{{}, {{0.5, 0, 0}, {}}});
    run(1000);
    EXPECT_GT(base_pose(simulation->states()[0]).p.x, 0.5);
    const std::vector<std::string> notices = face->take_notices();
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_NE(notices.front().find("/robot/cmd_vel takes geometry_msgs/msg/TwistStamped"), std::string::npos);
}

TEST_F(RunWithNodes, NameARobotForTheRootThatIsThere) {
    FaceOptions options;
    options.topics.root = "other";
    start(options);
    EXPECT_NE(transport.find("/cmd_vel"), 0u);
    EXPECT_EQ(transport.names.at(transport.node_of.at(transport.find("/cmd_vel"))), "/robot");
    options.topics.root = "nobody";
    TestTransport second;
    Face wrong(second, options);
    const Result<> shown = wrong.show(model, Address{Role::kClient, 78});
    ASSERT_FALSE(shown.ok());
    EXPECT_NE(shown.error().text().find("nobody"), std::string::npos);
}

TEST_F(RunWithNodes, SeeTheNodesGoWithTheFace) {
    start({});
    face.reset();
    EXPECT_TRUE(transport.names.empty()) << transport.names.begin()->second;
}

TEST_F(RunWithNodes, AnotherWorldKeepsWhatItStillHas) {
    start({});
    const ros2::EntityId drive = transport.find("/robot/cmd_vel"), gone = transport.find("/other/cmd_vel");
    World smaller = on_plane(with_onboard(two_wheeler(), diff_drive()), 2e-3);
    ASSERT_TRUE(face->show(compiled(smaller), Address{Role::kClient, 78}).ok());
    EXPECT_EQ(transport.find("/robot/cmd_vel"), drive);
    EXPECT_FALSE(transport.names.contains(gone));
    EXPECT_EQ(transport.find("/other/robot"), 0u);
    EXPECT_NE(transport.find("/clock"), 0u);
}

}  // namespace
}  // namespace roboss::test
