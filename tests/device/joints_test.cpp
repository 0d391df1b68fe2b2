// The protocol `joints`: packets that are lost, late, doubled, damaged, or of before a reboot.
#include "device/joints.h"

#include <nlohmann/json.hpp>

#include "devices.h"

namespace roboss::test {
namespace {

using nlohmann::json;

class JointsProtocol : public ::testing::Test {
  protected:
    void SetUp() override {
        model = world_file("soccer.sdf");
        robot = id_of(*model, "blue_1");
        ball = id_of(*model, "ball");
        adapter = std::make_unique<JointsAdapter>(*model, robot, 99);
        left = *model->type_of(robot).find_joint("left");
    }
    json readings(std::uint64_t number, double position, std::uint64_t boot = 7) const {
        return {{"roboss", 1},
                {"type", "readings"},
                {"boot", boot},
                {"seq", number},
                {"stamp_s", 0.01 * static_cast<double>(number)},
                {"joints", {{"left", {{"position", position}, {"velocity", 2.5}}}}}};
    }
    void hear(const json& packet) { adapter->receive(packet.dump(), now += 0.01); }
    json sent() {
        const auto packets = adapter->due(now += 0.03);
        return packets.empty() ? json() : json::parse(packets.front());
    }
    double position() const { return adapter->readings().joints.at(left).position; }

    std::shared_ptr<const Model> model;
    RobotId robot, ball;
    JointId left;
    std::unique_ptr<JointsAdapter> adapter;
    double now = 50;
};

TEST_F(JointsProtocol, LateAndDoubledPacketsAreDroppedAndLostOnesCounted) {
    hear(readings(1, 1));
    hear(readings(4, 4));
    hear(readings(3, 3));
    hear(readings(4, 4.5));
    EXPECT_EQ(position(), 4);
    EXPECT_EQ(adapter->count().lost, 2u);
    EXPECT_EQ(adapter->count().stale, 2u);
    EXPECT_EQ(adapter->count().taken, 2u);
}

TEST_F(JointsProtocol, ARebootStartsNumbersAnewAndPacketsOfBeforeItAreLate) {
    hear(readings(100, 1));
    hear(readings(1, 2, 8));
    hear(readings(101, 3));
    EXPECT_EQ(position(), 2);
    EXPECT_EQ(adapter->count().reboots, 1u);
    EXPECT_EQ(adapter->count().stale, 1u);
}

TEST_F(JointsProtocol, AStormOfRebootsIsReportedOnceASecond) {
    for (std::uint64_t boot = 1; boot <= 1000; ++boot) hear(readings(1, 1, boot));
    EXPECT_EQ(adapter->count().reboots, 999u);
    EXPECT_LT(adapter->take_notices().size(), 20u);
    hear(readings(2, 2, 950));
    EXPECT_EQ(position(), 1) << "it is of before a reboot";
}

TEST_F(JointsProtocol, ARebootWithTheSameBootNumberIsSeenAfterASecond) {
    hear(readings(1000, 1));
    for (std::uint64_t i = 1; i <= 90; ++i) hear(readings(i, 2));
    EXPECT_EQ(position(), 1);
    for (std::uint64_t i = 91; i <= 110; ++i) hear(readings(i, 3));
    EXPECT_EQ(position(), 3);
    EXPECT_EQ(adapter->count().reboots, 1u);
}

TEST_F(JointsProtocol, EachPacketCarriesAllSetpointsAndRestIsAcknowledged) {
    hear(readings(1, 0));
    ASSERT_TRUE(adapter->order(SetJoint{left, 0, MotorMode::kVelocity, 6, 0.02}).ok());
    EXPECT_EQ(sent().at("type"), "stop");
    adapter->rest(false);
    (void)sent();
    const json again = sent();
    EXPECT_EQ(again.at("joints").at("left"),
              (json{{"mode", "velocity"}, {"target", 6.0}, {"max_effort", 0.02}}));
    EXPECT_EQ(again.at("robot"), "blue_1");
    json obeyed = readings(2, 0);
    obeyed["ack"] = again.at("seq"), obeyed["session"] = again.at("session");
    hear(obeyed);
    adapter->rest(true);
    EXPECT_FALSE(adapter->at_rest());  // it has not been sent
    const json stop = sent();
    EXPECT_EQ(stop.at("type"), "stop");
    EXPECT_FALSE(stop.contains("joints"));
    EXPECT_FALSE(adapter->at_rest());
    json answer = readings(3, 0);
    answer["ack"] = stop.at("seq"), answer["session"] = 98;
    hear(answer);
    EXPECT_FALSE(adapter->at_rest());  // of another RoBOSS
    answer["seq"] = 4, answer["session"] = stop.at("session");
    hear(answer);
    EXPECT_TRUE(adapter->at_rest());
}

TEST_F(JointsProtocol, SetpointsAreSentAtOnceAndRepeatedSlowly) {
    hear(readings(1, 0));
    (void)sent();
    EXPECT_TRUE(adapter->due(now + 0.001).empty());
    ASSERT_TRUE(adapter->order(SetJoint{left, 0, MotorMode::kVelocity, 6, -1}).ok());
    EXPECT_TRUE(adapter->due(now + 0.001).empty());
    EXPECT_EQ(adapter->due(now + 0.003).size(), 1u);
    EXPECT_TRUE(adapter->due(now + 0.020).empty());
    EXPECT_EQ(adapter->due(now + 0.024).size(), 1u);
}

TEST_F(JointsProtocol, WhatIsNoPacketIsDroppedWithOneNotice) {
    for (const char* text : {"", "{", "[1]", "{\"roboss\": 2, \"type\": \"readings\"}", "\xff\xfe"})
        adapter->receive(text, now);
    json packet = readings(1, 0);
    packet["joints"]["middle"] = packet["joints"]["left"];
    hear(packet), hear(packet);
    packet = readings(1, 0);
    packet["joints"]["left"]["position"] = "far";
    hear(packet);
    packet = readings(1, 0);
    packet["poses"]["ball"] = {{"position", {0, 0, 0}}, {"quat_xyzw", {0, 0, 0, 9}}};
    hear(packet);
    EXPECT_EQ(adapter->count().damaged, 9u);
    EXPECT_EQ(adapter->count().taken, 0u);
    EXPECT_TRUE(adapter->readings().joints.empty());
    EXPECT_EQ(adapter->take_notices().size(), 8u);  // one kind came twice
}

TEST_F(JointsProtocol, DisturbedPacketsNeverGiveNumbersThatAreNone) {
    Random random(6);
    for (std::uint64_t i = 1; i <= 5000; ++i) {
        json packet = readings(i, random.uniform(-5, 5));
        packet["poses"]["ball"] = {{"position", {1, 2, 0}}, {"quat_xyzw", {0, 0, 0, 1}}};
        adapter->receive(disturbed(packet.dump(), random), now += 0.01);
    }
    EXPECT_GT(adapter->count().damaged, 1000u);
    EXPECT_GT(adapter->count().taken, 100u);
    for (const auto& [joint, reading] : adapter->readings().joints)
        EXPECT_TRUE(std::isfinite(reading.position) && std::isfinite(reading.velocity));
    for (const auto& [id, pose] : adapter->readings().poses)
        EXPECT_TRUE(std::isfinite(pose.X_WR.p.x + norm(pose.linear) + norm(pose.angular)));
}

TEST_F(JointsProtocol, VelocitiesAreMadeOfPosesThatHaveNone) {
    for (std::uint64_t i = 1; i <= 60; ++i) {
        json packet = readings(i, 0);
        const double t = 0.01 * static_cast<double>(i);
        packet["poses"]["ball"] = {{"position", {0.5 * t, 0, 0.02}},
                                   {"quat_xyzw", {0, 0, std::sin(0.5 * t), std::cos(0.5 * t)}}};
        hear(packet);
    }
    const PoseReading& pose = adapter->readings().poses.at(ball);
    EXPECT_NEAR(pose.linear.x, 0.5, 1e-3);
    EXPECT_NEAR(pose.angular.z, 1.0, 1e-3);
    EXPECT_FALSE(pose.estimated);
}

TEST_F(JointsProtocol, StampsThatHardlyDifferGiveNoEndlessVelocity) {
    for (std::uint64_t i = 1; i <= 3; ++i) {
        json packet = readings(i, 0);
        packet["stamp_s"] = 5e-324 * static_cast<double>(i);
        packet["poses"]["ball"] = {{"position", {1e9 * static_cast<double>(i), 0, 0}},
                                   {"quat_xyzw", {0, 0, 0, 1}}};
        hear(packet);
    }
    EXPECT_TRUE(std::isfinite(norm(adapter->readings().poses.at(ball).linear)));
}

TEST_F(JointsProtocol, OrdersForWhatTheDeviceLacksAreRefused) {
    EXPECT_EQ(adapter->order(SetJoint{left, 0, MotorMode::kVelocity, 1, -1}).error().code, "no-ability");
    hear(readings(1, 0));
    EXPECT_TRUE(adapter->order(SetJoint{left, 0, MotorMode::kVelocity, 1, -1}).ok());
    const JointId right = *model->type_of(robot).find_joint("right");
    EXPECT_EQ(adapter->order(SetJoint{right, 0, MotorMode::kVelocity, 1, -1}).error().code, "no-ability");
    EXPECT_EQ(adapter->order(ApplyWrench{}).error().code, "no-ability");
}

TEST(JointsSensors, ReadingsTakeTheNamesOfTheirKind) {
    const auto model = world_file("khepera.sdf");
    const RobotId robot = id_of(*model, "khepera");
    JointsAdapter adapter(*model, robot, 99);
    json packet = {{"roboss", 1}, {"type", "readings"}, {"boot", 1}, {"seq", 1}, {"stamp_s", 0}};
    packet["sensors"] = {{"left", {{"value", 512}, {"range", nullptr}}}};
    adapter.receive(packet.dump(), 1);
    const std::size_t sensor = *model->type_of(robot).find_sensor("left");
    ASSERT_TRUE(adapter.readings().sensors.contains(sensor));
    const auto& reading = std::get<InfraredReading>(adapter.readings().sensors.at(sensor));
    EXPECT_EQ(reading.value, 512);
    EXPECT_EQ(reading.range, std::numeric_limits<double>::infinity());
    packet["seq"] = 2, packet["sensors"] = {{"left", {{"colour", 512}}}};
    adapter.receive(packet.dump(), 1);
    EXPECT_EQ(adapter.count().damaged, 1u);
}

}  // namespace
}  // namespace roboss::test
