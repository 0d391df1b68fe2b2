// Robots on wheels with on-board drives, and how tests command them and read their pose.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <support/robots.h>
#include <support/simulation.h>

#include "core/fixed_math.h"

namespace roboss::test {

/// Adds a wheel on a hinge along +y: a sphere, which touches in one point. Positive speed drives forward.
inline void add_wheel(ModelSpec& m, const std::string& name, const std::string& parent, const Vec3& p_M,
                      double radius, const SurfaceSpec& s) {
    LinkSpec wheel = link(name, 0.5, sphere_inertia(0.5, radius), {p_M, {}});
    wheel.collisions.push_back(sphere_shape(radius, s));
    m.links.push_back(wheel);
    m.joints.push_back(
        joint(JointSpecKind::kContinuous, name + "_joint", parent, name, {p_M, {}}, {0, 1, 0}));
}

inline constexpr double kWheelRadius = 0.1, kSeparation = 0.5;  // m, of the robots below

/// A chassis of 10 kg between two wheels below the origin, on two sliders without friction.
inline ModelSpec two_wheeler() {
    ModelSpec m;
    m.name = "two_wheeler";
    m.canonical_link = "chassis";
    LinkSpec chassis = link("chassis", 10, box_inertia(10, {0.6, 0.4, 0.1}), {{0, 0, kWheelRadius}, {}});
    for (const double x : {0.25, -0.25})
        chassis.collisions.push_back(sphere_shape(0.05, surface(0), {{x, 0, 0.05 - kWheelRadius}, {}}));
    m.links.push_back(chassis);
    add_wheel(m, "left", "chassis", {0, kSeparation / 2, kWheelRadius}, kWheelRadius, surface(1));
    add_wheel(m, "right", "chassis", {0, -kSeparation / 2, kWheelRadius}, kWheelRadius, surface(1));
    return m;
}

/// The drive of two_wheeler().
inline DiffDriveSpec diff_drive() {
    DiffDriveSpec spec;
    spec.left = {"left_joint"}, spec.right = {"right_joint"};
    spec.wheel_separation = kSeparation, spec.wheel_radius = kWheelRadius;
    return spec;
}

/// The four-wheeled car() with an on-board drive.
inline ModelSpec skid_car() {
    ModelSpec m = car();
    DiffDriveSpec spec;
    spec.left = {"wheel_0", "wheel_2"}, spec.right = {"wheel_1", "wheel_3"};
    spec.wheel_separation = 0.26, spec.wheel_radius = 0.05;
    spec.linear.max_acceleration = 1, spec.linear.min_acceleration = -1;
    m.onboard.push_back({"drive", spec, {}});
    return m;
}

inline ModelSpec with_onboard(ModelSpec m, OnboardParameters parameters) {
    m.onboard.push_back({"controller", std::move(parameters), {}});
    return m;
}

/// The robot alone on a plane, at the origin.
inline World on_plane(ModelSpec m, double dt_s = 1e-3) {
    World world = empty_world(dt_s);
    place(world, ground(surface(1)), "ground");
    place(world, std::move(m), "robot");
    return world;
}

/// A command of robot `robot` at the present tick.
inline Order command(const Simulation& sim, std::size_t robot, const std::string& channel,
                     std::vector<double> values) {
    const auto found = sim.type(robot).find_channel(channel);
    EXPECT_TRUE(found.has_value()) << channel;
    Command action;
    action.channel = static_cast<std::uint32_t>(found.value_or(0));
    action.values = std::move(values);
    Order order{sim.tick, ClientId(std::size_t{0}), 0, RobotId(robot), action};
    const Result<> checked = check_order(*sim.model, order);
    EXPECT_TRUE(checked.ok()) << checked.error().text();
    return order;
}

/// Steps once with the command.
inline void give(Simulation& sim, const std::string& channel, std::vector<double> values,
                 std::size_t robot = 0) {
    const Order order = command(sim, robot, channel, std::move(values));
    sim.step({&order, 1});
}

/// x, y, heading of the robot's frame.
struct Stand {
    double x = 0, y = 0, heading = 0;  // m, rad
};
inline Stand stand(const Simulation& sim, std::size_t robot = 0) {
    const Transform X_WB = to_transform(base_pose(sim.states[robot]));
    const Transform& X_RB = sim.type(robot).X_RB;
    const Mat3 R = X_WB.R * transpose(X_RB.R);
    const Vec3 p = X_WB.p - R * X_RB.p;
    return {p.x, p.y, std::atan2(R.r1.x, R.r0.x)};
}

/// Memory of on-board controller number `k`.
inline std::span<const double> memory(const Simulation& sim, std::size_t robot = 0, std::size_t k = 0) {
    const OnboardInfo& info = sim.type(robot).onboard.at(k);
    return std::span(sim.states[robot].onboard)
        .subspan(static_cast<std::size_t>(info.memory_index), info.memory.size());
}

/// Coordinate and velocity of a joint.
inline double joint_position(const Simulation& sim, const std::string& name, std::size_t robot = 0) {
    const RobotType& type = sim.type(robot);
    return sim.states[robot].q[static_cast<std::size_t>(type.joints[type.find_joint(name)->index()].q_index)];
}
inline double joint_velocity(const Simulation& sim, const std::string& name, std::size_t robot = 0) {
    const RobotType& type = sim.type(robot);
    return sim.states[robot].v[static_cast<std::size_t>(type.joints[type.find_joint(name)->index()].v_index)];
}

/// Steps both `seconds` and expects the same hash at every tick.
inline void expect_same_run(Simulation& a, Simulation& b, double seconds) {
    const auto ticks = static_cast<int>(seconds / a.model->dt_s + 0.5);
    for (int i = 0; i < ticks; ++i) {
        a.step(), b.step();
        ASSERT_EQ(a.hash(), b.hash()) << "tick " << i;
    }
}

}  // namespace roboss::test
