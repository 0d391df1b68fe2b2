// Robots of every joint kind and random rows for the tests of this folder.
#pragma once

#include <support/mechanisms.h>
#include <support/robots.h>
#include <support/simulation.h>

#include "kinematics/robot_model.h"
#include "model/coordinates.h"

namespace roboss::test {

/// An arm on the ground with every kind of joint, a ball joint and a planar one at its end.
inline ModelSpec arm_of_all_joints() {
    ModelSpec m = ring_of_all_kinds(JointSpecKind::kBall);
    m.joints.back() = joint(JointSpecKind::kBall, "ball", "tip", "bob", {{0, 0.1, 0}, from_rpy(0.2, 0, 0.4)});
    m.links.push_back(link("bob", 0.5, Mat3::diagonal(0.02, 0.03, 0.025), {{0, 0.05, 0.02}, {}}));
    m.links.push_back(
        link("puck", 0.3, Mat3::diagonal(0.01, 0.02, 0.015), {{0.1, 0.2, 0}, from_rpy(0.3, 0, 0.1)}));
    m.joints.push_back(planar_joint("plane", "bob", "puck", {{0.1, 0.1, 0.1}, from_rpy(0, 0.2, 0.5)},
                                    normalized(Vec3{0.2, 0.3, 1})));
    m.joints.push_back(joint(JointSpecKind::kFixed, "ground", "world", "base", {}));
    return m;
}

/// A ball joint that the tree walks from the file's child to its parent.
inline ModelSpec reversed_ball() {
    ModelSpec m;
    m.name = "reversed";
    m.canonical_link = "root";
    m.links = {
        link("root", 1, Mat3::diagonal(0.1, 0.2, 0.3), {{0, 0, 1}, {}}),
        link("other", 0.5, Mat3::diagonal(0.03, 0.02, 0.04), {{0.2, 0.1, 1}, from_rpy(0.1, 0.2, 0.3)})};
    m.joints = {joint(JointSpecKind::kBall, "ball", "other", "root", {{0.1, 0, 1}, from_rpy(0.4, 0.1, 0)}),
                joint(JointSpecKind::kFixed, "ground", "world", "root", {})};
    return m;
}

/// The robots of the property tests: on free and on fixed bases, with every joint kind.
inline std::vector<ModelSpec> sample_robots() {
    return {arm(),          spider(), prismatic_chain(), ball_chain(), mixed_tree(), arm_of_all_joints(),
            reversed_ball()};
}

/// The robot at a pose that agrees with nothing, in a world of its own.
inline RobotModel robot_of(ModelSpec spec, const RobotModelOptions& options = {}) {
    World world = empty_world(1e-3, {0.3, -0.4, -9.81});
    const std::string name = spec.name;
    place(world, std::move(spec), name, {{0.4, -0.3, 0.2}, from_rpy(0.3, -0.2, 0.8)});
    return RobotModel::create(compiled(world), RobotId(0U), options).value();
}

inline std::vector<double> random_row(std::size_t columns, double size, Random& random) {
    std::vector<double> row(columns);
    for (double& x : row) x = random.uniform(-size, size);
    return row;
}

inline std::vector<double> random_configuration(const RobotModel& robot, Random& random) {
    std::vector<double> row = random_row(robot.q_columns(), 1.5, random);
    if (robot.base_q() == 0) return row;
    const Quat q = random.rotation();
    row[3] = q.x, row[4] = q.y, row[5] = q.z, row[6] = q.w;
    return row;
}

/// The configuration after moving with the velocities v for dt seconds.
inline std::vector<double> moved(const RobotModel& robot, const std::vector<double>& row,
                                 const std::vector<double>& v, double dt) {
    std::vector<double> q(static_cast<std::size_t>(robot.type().nq)), kernel(v.size()), result(row.size());
    robot.to_coordinates(row.data(), q);
    for (std::size_t c = 0; c < v.size(); ++c) kernel[robot.v_of(c)] = v[c];
    advance_coordinates<double>(robot.type(), kernel, dt, q);
    robot.to_row(q, result.data());
    return result;
}

/// The state of the simulation with this configuration and these velocities.
inline RobotState state_of(const RobotModel& robot, const std::vector<double>& row,
                           const std::vector<double>& v) {
    RobotState state = initial_state(robot.model(), RobotId(0U));
    robot.to_coordinates(row.data(), state.q);
    for (std::size_t c = 0; c < v.size(); ++c) state.v[robot.v_of(c)] = v[c];
    return state;
}

}  // namespace roboss::test
