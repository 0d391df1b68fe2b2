// The serial protocol of the Khepera, on clean and on bad lines.
#include <cmath>

#include "devices.h"

namespace roboss::test {
namespace {

class KheperaProtocol : public ::testing::Test {
  protected:
    void SetUp() override {
        model = world_file("khepera.sdf");
        robot = id_of(*model, "khepera");
        auto made = make_adapter("khepera", *model, robot);
        ASSERT_TRUE(made.ok());
        adapter = std::move(made).value();
        left = *type().find_joint("left");
        right = *type().find_joint("right");
    }
    const RobotType& type() const { return model->type_of(robot); }
    /// Talks for this long, in steps of 5 ms.
    void talk(double seconds) {
        for (const double end = now + seconds; now < end; now += 0.005) {
            for (const std::string& bytes : adapter->due(now)) device.hear(bytes);
            for (const std::string& bytes : device.say()) adapter->receive(bytes, now);
        }
    }
    Result<> drive(JointId joint, double speed) {
        return adapter->order(SetJoint{joint, 0, MotorMode::kVelocity, speed, -1});
    }
    double position(JointId joint) const { return adapter->readings().joints.at(joint).position; }

    std::shared_ptr<const Model> model;
    RobotId robot;
    std::unique_ptr<DeviceAdapter> adapter;
    JointId left, right;
    FakeKhepera device;
    double now = 100;
};

TEST_F(KheperaProtocol, SpeedsAreSentInUnitsOf8mmPerSecondOnlyWhileItDoesNotRest) {
    ASSERT_TRUE(drive(left, 10 * KheperaUnits::kSpeed).ok());
    ASSERT_TRUE(drive(right, -1000).ok());
    talk(0.2);
    EXPECT_EQ(device.speeds, (std::array<int, 2>{0, 0}));
    EXPECT_TRUE(adapter->at_rest());
    adapter->rest(false);
    talk(0.2);
    EXPECT_EQ(device.speeds, (std::array<int, 2>{10, -127}));
    EXPECT_FALSE(adapter->at_rest());
    adapter->rest(true);
    talk(0.2);
    EXPECT_EQ(device.speeds, (std::array<int, 2>{0, 0}));
    EXPECT_TRUE(adapter->at_rest());
    adapter->rest(false);  // the order still holds
    talk(0.2);
    EXPECT_EQ(device.speeds, (std::array<int, 2>{10, -127}));
}

TEST_F(KheperaProtocol, CountsBecomePositionsAndProximityBecomesReadings) {
    device.counts = {5, 5};
    device.eyes = {0, 100, 1023, 3, 4, 5, 6, 7};
    talk(0.1);
    device.counts = {605, 305};
    talk(0.1);
    EXPECT_NEAR(position(left), 2 * kPi, 1e-9);
    EXPECT_NEAR(position(right), kPi, 1e-9);
    const std::size_t first = *type().find_sensor("left"), second = *type().find_sensor("front_left");
    const auto& sensors = adapter->readings().sensors;
    EXPECT_EQ(std::get<InfraredReading>(sensors.at(first)).range, std::numeric_limits<double>::infinity());
    const InfraredReading& seen = std::get<InfraredReading>(sensors.at(second));
    EXPECT_EQ(seen.value, 100);
    EXPECT_NEAR(1100 * std::exp(-(seen.range - 0.01) / 0.025), 100, 1e-6);
    EXPECT_LT(now - adapter->readings().fresh_s, 0.05);
}

TEST_F(KheperaProtocol, OdometryFollowsAnArc) {
    talk(0.1);
    const Pose before = adapter->readings().poses.at(robot).X_WR;
    const double quarter =
        kPi / 2 * KheperaUnits::kAxle / KheperaUnits::kMetres;  // pulses, about the left wheel
    for (int i = 1; i <= 50; ++i) {
        device.counts = {0, std::lround(quarter * i / 50)};
        talk(0.03);
    }
    const PoseReading& after = adapter->readings().poses.at(robot);
    EXPECT_TRUE(after.estimated);
    const Pose moved = inverse(before) * after.X_WR;
    EXPECT_NEAR(moved.p.x, KheperaUnits::kAxle / 2, 3e-4);
    EXPECT_NEAR(moved.p.y, KheperaUnits::kAxle / 2, 3e-4);
    EXPECT_NEAR(2 * std::atan2(moved.q.z, moved.q.w), kPi / 2, 2e-3);
}

TEST_F(KheperaProtocol, DamagedAnswersAreDroppedAndTheNextOneIsAskedFor) {
    device.counts = {40, 40};
    talk(0.2);
    adapter->receive("n,1,2,3\r\nn,1,2,3,4,5,6,7,2000\r\nh,1\r\nh,1,x\r\nz,1\r\n,\r\n", now);
    EXPECT_EQ(adapter->count().damaged, 6u);
    adapter->receive("h,999999,40\r\n", now);  // a digit too many
    EXPECT_EQ(adapter->count().damaged, 7u);
    adapter->receive("h,-9223372036854775807,9223372036854775807\r\n", now);
    EXPECT_EQ(adapter->count().damaged, 8u);
    adapter->receive("h,-9223372036854775808,0\r\ne,9223372036854775807,0\r\ne,0,-255\r\n", now);
    EXPECT_EQ(adapter->count().damaged, 11u);
    const double was = position(left);
    talk(0.2);
    EXPECT_EQ(position(left), was);
    device.mute = true;
    const std::uint64_t lost = adapter->count().lost;
    talk(1);
    EXPECT_GE(adapter->count().lost, lost + 3);
    const double silent_s = now - adapter->readings().fresh_s;
    EXPECT_GT(silent_s, 0.9);
    device.mute = false;
    talk(0.4);
    EXPECT_LT(now - adapter->readings().fresh_s, 0.1);
}

/// After a pause wheels may have turned far, but not at the speed that they were ordered.
TEST_F(KheperaProtocol, ALostDigitAfterAPauseMovesNothing) {
    ASSERT_TRUE(drive(left, 10 * KheperaUnits::kSpeed).ok());
    adapter->rest(false);
    long count = 0;
    const auto roll = [&](double seconds) {
        for (const double end = now + seconds; now < end;) {
            device.counts = {count += 5, 0};  // in 5 ms
            talk(0.005);
        }
    };
    roll(2);
    const double was = position(left);
    now += 0.1;
    adapter->receive("h," + std::to_string((count += 100) % 1000) + ",0\r\n", now);
    EXPECT_EQ(position(left), was);
    roll(0.5);
    EXPECT_NEAR(position(left), static_cast<double>(count) * KheperaUnits::kRadians,
                40 * KheperaUnits::kRadians);
}

TEST_F(KheperaProtocol, ARebootKeepsPositionsAndGetsItsSpeedsAgain) {
    ASSERT_TRUE(drive(left, 5 * KheperaUnits::kSpeed).ok());
    adapter->rest(false);
    device.counts = {100, 0};
    talk(0.1);
    device.counts = {700, 0};
    talk(0.3);
    const double was = position(left);
    device.boot();
    talk(0.2);
    EXPECT_EQ(adapter->count().reboots, 1u);
    EXPECT_EQ(adapter->take_notices().size(), 1u);
    EXPECT_EQ(device.speeds[0], 5);
    EXPECT_EQ(position(left), was);
    device.counts = {60, 0};
    talk(0.2);
    EXPECT_NEAR(position(left) - was, 60 * KheperaUnits::kRadians, 1e-9);
}

TEST_F(KheperaProtocol, ARebootWhoseBannerIsLostIsSeenInTheCounts) {
    talk(0.1);
    for (int i = 1; i <= 400; ++i) {
        device.counts = {i * 200L, 0};  // 800 mm/s
        talk(0.02);
    }
    talk(0.2);
    const double was = position(left);
    EXPECT_NEAR(was, 80000 * KheperaUnits::kRadians, 1e-6);
    device.counts = {0, 0};
    talk(0.2);
    EXPECT_NEAR(position(left), was, 1e-9);
}

TEST_F(KheperaProtocol, AnyNoiseIsSurvivedAndAfterItTheRobotIsReadAgain) {
    Random random(5);
    for (int i = 0; i < 20000; ++i) {
        for (const std::string& bytes : adapter->due(now)) device.hear(bytes);
        for (const std::string& bytes : device.say()) adapter->receive(disturbed(bytes, random), now);
        now += 0.003;
    }
    EXPECT_GT(adapter->count().damaged, 1000u);
    device.counts = {0, 0};
    talk(0.6);
    EXPECT_LT(now - adapter->readings().fresh_s, 0.1);
    device.counts = {100, 50};
    const double was = position(left);
    talk(0.2);
    EXPECT_NEAR(position(left) - was, 100 * KheperaUnits::kRadians, 1e-9);
}

TEST_F(KheperaProtocol, WhatItCannotDoIsRefused) {
    EXPECT_EQ(adapter->order(SetJoint{left, 0, MotorMode::kPosition, 1, -1}).error().code, "no-ability");
    EXPECT_EQ(adapter->order(SetJoint{left, 0, MotorMode::kVelocity, 1, 0.1}).error().code, "no-ability");
    EXPECT_EQ(adapter->order(SetPose{}).error().code, "no-ability");
    EXPECT_EQ(make_adapter("khepera", *model, RobotId()).error().code, "no-robot");
    EXPECT_EQ(make_adapter("morse", *model, robot).error().code, "no-protocol");
    const auto soccer = world_file("soccer.sdf");
    EXPECT_EQ(make_adapter("khepera", *soccer, id_of(*soccer, "blue_0")).error().code, "not-this-robot");
}

}  // namespace
}  // namespace roboss::test
