// AckermannSteering in the step: steering angles and circles against the geometry of a car.
#include <gtest/gtest.h>

#include <cmath>

#include <support/drives.h>

namespace roboss::test {
namespace {

constexpr double kBase = 0.8, kKingpins = 0.4;  // m

/// Four wheels; the front ones on steering knuckles. The rear axle is driven, its middle is the origin.
ModelSpec steered_car() {
    ModelSpec m;
    m.name = "steered_car";
    m.canonical_link = "chassis";
    m.links.push_back(
        link("chassis", 20, box_inertia(20, {1.0, 0.4, 0.1}), {{kBase / 2, 0, kWheelRadius}, {}}));
    for (const double side : {1.0, -1.0}) {
        const std::string name = side > 0 ? "left" : "right";
        const Vec3 kingpin{kBase, side * kKingpins / 2, kWheelRadius};
        m.links.push_back(link(name + "_knuckle", 0.5, sphere_inertia(0.5, 0.1), {kingpin, {}}));
        m.joints.push_back(joint(JointSpecKind::kRevolute, name + "_steering", "chassis", name + "_knuckle",
                                 {kingpin, {}}, {0, 0, 1}));
        add_wheel(m, "front_" + name, name + "_knuckle", kingpin, kWheelRadius, surface(1));
        add_wheel(m, "rear_" + name, "chassis", {0, side * kSeparation / 2, kWheelRadius}, kWheelRadius,
                  surface(1));
    }
    return m;
}

AckermannSteeringSpec steering() {
    AckermannSteeringSpec spec;
    spec.left = {"rear_left_joint"}, spec.right = {"rear_right_joint"};
    spec.left_steering = {"left_steering"}, spec.right_steering = {"right_steering"};
    spec.wheel_base = kBase, spec.kingpin_width = kKingpins, spec.wheel_separation = kSeparation;
    spec.wheel_radius = kWheelRadius, spec.speed_gain = 10;
    return spec;
}

World car_world(const AckermannSteeringSpec& spec) {
    return on_plane(with_onboard(steered_car(), spec));
}

TEST(AckermannSteering, BothWheelsPointAtTheSameCentreAndTheCarDrivesAroundIt) {
    Simulation sim(car_world(steering()));
    const double v = 0.6, w = 0.3, radius = v / w;
    give(sim, "cmd_vel", {v, 0, 0, 0, 0, w});
    sim.run(3);
    EXPECT_NEAR(joint_position(sim, "left_steering"), std::atan(kBase / (radius - kKingpins / 2)), 1e-3);
    EXPECT_NEAR(joint_position(sim, "right_steering"), std::atan(kBase / (radius + kKingpins / 2)), 1e-3);
    const Stand from = stand(sim);
    const double t = 4;
    sim.run(t);
    const Stand at = stand(sim);
    const double turned = from.heading + w * t;
    tell("heading beyond the closed form, rad", std::remainder(at.heading - turned, 2 * kPi));
    EXPECT_NEAR(std::remainder(at.heading - turned, 2 * kPi), 0, 0.01);
    EXPECT_NEAR(at.x - from.x, radius * (std::sin(turned) - std::sin(from.heading)), 0.02);
    EXPECT_NEAR(at.y - from.y, -radius * (std::cos(turned) - std::cos(from.heading)), 0.02);
}

TEST(AckermannSteering, TheSteeringFollowsAsAFirstOrderLag) {
    AckermannSteeringSpec spec = steering();
    spec.speed_gain = 2;
    Simulation sim(car_world(spec));
    give(sim, "cmd_vel", {0.6, 0, 0, 0, 0, 0.3});
    sim.run(0.5 - sim.model->dt_s);
    const double end = std::atan(kBase / (2 - kKingpins / 2));
    EXPECT_NEAR(joint_position(sim, "left_steering"), end * (1 - std::exp(-2 * 0.5)), 1e-3);
}

TEST(AckermannSteering, TheLimitKeepsTheSpeedAndGivesUpTurning) {
    AckermannSteeringSpec spec = steering();
    spec.steering_limit = 0.4;
    Simulation sim(car_world(spec));
    give(sim, "cmd_vel", {0.4, 0, 0, 0, 0, 5});
    sim.run(3);
    const double least = kBase / std::sin(0.4);
    EXPECT_NEAR(joint_position(sim, "left_steering"), std::atan(kBase / (least - kKingpins / 2)), 1e-3);
    const auto& type = sim.type(0);
    const auto speed = [&](const char* name) {
        return sim.states[0].motors[type.motor_index(type.joints[type.find_joint(name)->index()], 0)].target *
               kWheelRadius;
    };
    EXPECT_NEAR(0.5 * (speed("rear_left_joint") + speed("rear_right_joint")), 0.4, 1e-12);
    EXPECT_NEAR((speed("rear_right_joint") - speed("rear_left_joint")) / kSeparation, 0.4 / least, 1e-12);
}

TEST(AckermannSteering, StandingItSteersAndBackwardItTurnsTheOtherWay) {
    Simulation sim(car_world(steering()));
    give(sim, "cmd_vel", {0, 0, 0, 0, 0, -1});
    sim.run(2);
    EXPECT_LT(joint_position(sim, "left_steering"), -0.3);
    EXPECT_NEAR(stand(sim).x, 0, 5e-3);
    give(sim, "cmd_vel", {-0.5, 0, 0, 0, 0, 0.2});
    sim.run(3);
    EXPECT_LT(joint_position(sim, "left_steering"), -0.1) << "backwards it steers right to turn left";
    const double heading = stand(sim).heading;
    sim.run(1);
    EXPECT_NEAR(std::remainder(stand(sim).heading - heading, 2 * kPi), 0.2, 0.01);
}

TEST(AckermannSteering, OdometryFollowsTheTruePose) {
    Simulation sim(car_world(steering()));
    sim.run(0.5);
    double far = 0;
    for (const double w : {0.2, -0.4, 0.0}) {
        give(sim, "cmd_vel", {0.5, 0, 0, 0, 0, w});
        for (int i = 0; i < 2000; ++i) {
            const Stand before = stand(sim);
            sim.step();
            far = std::fmax(far, std::hypot(memory(sim)[0] - before.x, memory(sim)[1] - before.y));
        }
    }
    tell("largest distance of odometry from the true place on 3 m, m", far);
    EXPECT_LT(far, 0.05);
    EXPECT_GT(memory(sim)[0], 1.5);
}

TEST(AckermannSteering, SteeringOnlyTakesAnAngle) {
    AckermannSteeringSpec spec = steering();
    spec.steering_only = true, spec.left.clear(), spec.right.clear();
    Simulation sim(car_world(spec));
    give(sim, "steer_angle", {0.3});
    sim.run(2);
    const double s = std::sin(0.3), c = std::cos(0.3);
    EXPECT_NEAR(joint_position(sim, "left_steering"),
                std::atan(2 * kBase * s / (2 * kBase * c - kSeparation * s)), 1e-3);
    EXPECT_NEAR(joint_position(sim, "right_steering"),
                std::atan(2 * kBase * s / (2 * kBase * c + kSeparation * s)), 1e-3);
    give(sim, "steer_angle", {2});
    sim.run(2);
    const double sl = std::sin(0.5), cl = std::cos(0.5);
    EXPECT_NEAR(joint_position(sim, "left_steering"),
                std::atan(2 * kBase * sl / (2 * kBase * cl - kSeparation * sl)), 1e-3)
        << "no further than steering_limit";
}

/// The car with the drive of classic Gazebo.
World classic_car_world() {
    RosAckermannSpec spec;
    spec.front_left = {"front_left_joint"}, spec.front_right = {"front_right_joint"};
    spec.rear_left = {"rear_left_joint"}, spec.rear_right = {"rear_right_joint"};
    spec.left_steering = {"left_steering"}, spec.right_steering = {"right_steering"};
    spec.left_gain = spec.right_gain = {20, 20, 0.5}, spec.speed_gain = {1, 2, 0};
    spec.left_range = spec.right_range = spec.speed_range = {-20, 20};
    spec.ros.update_rate = 0;
    return on_plane(with_onboard(steered_car(), spec));
}

TEST(RosAckermann, TheWheelsPointAtOneCentreAndTheRightRearWheelHasTheSpeed) {
    Simulation sim(classic_car_world());
    const double v = 0.6, angle = 0.3, radius = kBase / std::tan(angle);
    give(sim, "cmd_vel", {v, 0, 0, 0, 0, angle});
    sim.run(6);
    EXPECT_NEAR(joint_position(sim, "left_steering"), std::atan(kBase / (radius - kKingpins / 2)), 2e-3);
    EXPECT_NEAR(joint_position(sim, "right_steering"), std::atan(kBase / (radius + kKingpins / 2)), 2e-3);
    EXPECT_NEAR(joint_velocity(sim, "rear_right_joint"), v / kWheelRadius, 0.01);
    const double t = 3, w = v / (radius + kSeparation / 2);
    const Stand from = stand(sim);
    sim.run(t);
    const Stand at = stand(sim);
    const double turned = from.heading + w * t;
    tell("heading beyond the closed form, rad", std::remainder(at.heading - turned, 2 * kPi));
    EXPECT_NEAR(std::remainder(at.heading - turned, 2 * kPi), 0, 0.02);
    EXPECT_NEAR(at.x - from.x, radius * (std::sin(turned) - std::sin(from.heading)), 0.03);
    EXPECT_NEAR(at.y - from.y, -radius * (std::cos(turned) - std::cos(from.heading)), 0.03);
}

TEST(RosAckermann, KeepsItsLimitsAndTurnsTheSameWayBackwards) {
    Simulation sim(classic_car_world());
    give(sim, "cmd_vel", {-0.5, 0, 0, 0, 0, 2});
    sim.run(3);
    const double least = kBase / std::tan(0.6);
    EXPECT_NEAR(joint_position(sim, "left_steering"), -std::atan(kBase / (least + kKingpins / 2)), 5e-3)
        << "max_steer; the sign of the angle is that of the turn";
    EXPECT_NEAR(joint_velocity(sim, "rear_right_joint"), -0.5 / kWheelRadius, 0.05);
}

TEST(RosAckermann, LanesChangeNoBit) {
    Simulation lanes(classic_car_world()), alone(classic_car_world());
    alone.scratch.use_lanes(1);
    for (Simulation* sim : {&lanes, &alone}) give(*sim, "cmd_vel", {0.6, 0, 0, 0, 0, 0.3});
    expect_same_run(lanes, alone, 0.5);
}

TEST(AckermannSteering, LanesChangeNoBit) {
    Simulation lanes(car_world(steering())), alone(car_world(steering()));
    alone.scratch.use_lanes(1);
    give(lanes, "cmd_vel", {0.6, 0, 0, 0, 0, 0.3}), give(alone, "cmd_vel", {0.6, 0, 0, 0, 0, 0.3});
    expect_same_run(lanes, alone, 0.5);
}

}  // namespace
}  // namespace roboss::test
