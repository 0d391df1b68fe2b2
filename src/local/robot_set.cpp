// See robot_set.h.
#include "local/robot_set.h"

#include <algorithm>

#include "physics/dynamics/kinematics.h"

namespace roboss {

namespace {

void put(double* out, const Vec3& v) {
    out[0] = v.x, out[1] = v.y, out[2] = v.z;
}

Vec3 vec3(const double* in) {
    return {in[0], in[1], in[2]};
}

std::vector<JointAxis> axes_of(const RobotType& type) {
    std::vector<JointAxis> axes;
    for (std::size_t j = 0; j < type.joints.size(); ++j) {
        const Joint& joint = type.joints[j];
        for (int axis = 0; axis < joint.nv; ++axis)
            axes.push_back(
                {JointId(j), axis, joint.nv == 1 ? joint.name : joint.name + ":" + std::to_string(axis)});
    }
    return axes;
}

/// One value of each axis of each robot, row by row.
void read_joints(const RobotSet& set, const LocalRun& run, double JointState::*value, std::span<double> out) {
    ROBOSS_CHECK(out.size() == set.size() * set.axes().size(), std::to_string(out.size()) + " numbers");
    double* to = out.data();
    for (const RobotId robot : set.robots())
        for (const JointAxis& axis : set.axes())
            *to++ = joint_state(*set.type(), run.state(robot), axis.joint, axis.axis).*value;
}

}  // namespace

RobotSet::RobotSet(std::shared_ptr<const Model> model, std::vector<RobotId> robots)
    : model_(std::move(model)), robots_(std::move(robots)) {
    for (const RobotId robot : robots_)
        ROBOSS_CHECK(robot.index() < model_->robots.size(), "robot " + std::to_string(robot.value));
    if (robots_.empty()) return;
    const TypeId first = model_->robots[robots_.front().index()].type;
    const auto is_same = [&](RobotId robot) { return model_->robots[robot.index()].type == first; };
    if (!std::ranges::all_of(robots_, is_same)) return;
    type_ = &model_->types[first.index()];
    axes_ = axes_of(*type_);
}

double* RobotSet::row(std::span<double> out, std::size_t robot, std::size_t columns) const {
    ROBOSS_CHECK(out.size() == size() * columns, std::to_string(out.size()) + " numbers");
    return out.data() + robot * columns;
}

void RobotSet::poses(const LocalRun& run, std::span<double> out) const {
    for (std::size_t i = 0; i < size(); ++i) {
        const RobotType& type = model_->type_of(robots_[i]);
        const Pose X_WR = base_pose(run.state(robots_[i])) * inverse(to_pose(type.X_RB));
        double* to = row(out, i, kPoseColumns);
        put(to, X_WR.p);
        to[3] = X_WR.q.x, to[4] = X_WR.q.y, to[5] = X_WR.q.z, to[6] = X_WR.q.w;
    }
}

void RobotSet::twists(const LocalRun& run, std::span<double> out) const {
    for (std::size_t i = 0; i < size(); ++i) {
        const std::vector<double>& v = run.state(robots_[i]).v;
        const bool free = model_->type_of(robots_[i]).free_base;
        double* to = row(out, i, kTwistColumns);
        put(to, free ? vec3(&v[3]) : Vec3{});
        put(to + 3, free ? vec3(v.data()) : Vec3{});
    }
}

void RobotSet::joint_positions(const LocalRun& run, std::span<double> out) const {
    read_joints(*this, run, &JointState::position, out);
}

void RobotSet::joint_velocities(const LocalRun& run, std::span<double> out) const {
    read_joints(*this, run, &JointState::velocity, out);
}

Result<> RobotSet::give(LocalRun& run, const std::function<Action(std::size_t row)>& action) const {
    for (std::size_t i = 0; i < size(); ++i)
        if (Result<> given = run.order(robots_[i], action(i)); !given)
            return Error{"robot '" + model_->robots[robots_[i].index()].name + "': " + given.error().message,
                         given.error().remedy, given.error().code};
    return Ok{};
}

Result<> RobotSet::set_poses(LocalRun& run, std::span<const double> poses) const {
    ROBOSS_CHECK(poses.size() == size() * kPoseColumns, std::to_string(poses.size()) + " numbers");
    return give(run, [&](std::size_t i) {
        const double* at = &poses[i * kPoseColumns];
        return SetPose{{vec3(at), normalized(Quat{at[6], at[3], at[4], at[5]})}};
    });
}

Result<> RobotSet::set_twists(LocalRun& run, std::span<const double> twists) const {
    ROBOSS_CHECK(twists.size() == size() * kTwistColumns, std::to_string(twists.size()) + " numbers");
    return give(run, [&](std::size_t i) {
        const double* at = &twists[i * kTwistColumns];
        return SetVelocity{vec3(at), vec3(at + 3)};
    });
}

Result<> RobotSet::set_joints(LocalRun& run, std::span<const std::size_t> columns, MotorMode mode,
                              std::span<const double> targets, double max_effort) const {
    ROBOSS_CHECK(targets.size() == size() * columns.size(), std::to_string(targets.size()) + " numbers");
    for (std::size_t k = 0; k < columns.size(); ++k) {
        const JointAxis& axis = axes_[columns[k]];
        Result<> given = give(run, [&](std::size_t i) {
            return SetJoint{axis.joint, axis.axis, mode, targets[i * columns.size() + k], max_effort};
        });
        if (!given) return given;
    }
    return Ok{};
}

Result<> RobotSet::apply_wrenches(LocalRun& run, LinkId link, std::span<const double> wrenches,
                                  Tick ticks) const {
    ROBOSS_CHECK(wrenches.size() == size() * 6, std::to_string(wrenches.size()) + " numbers");
    return give(run, [&](std::size_t i) {
        return ApplyWrench{link, vec3(&wrenches[i * 6]), vec3(&wrenches[i * 6 + 3]), ticks};
    });
}

Result<> RobotSet::command(LocalRun& run, std::size_t channel, std::size_t values,
                           std::span<const double> rows) const {
    ROBOSS_CHECK(rows.size() == size() * values, std::to_string(rows.size()) + " numbers");
    return give(run, [&](std::size_t i) {
        const std::span<const double> row = rows.subspan(i * values, values);
        return Command{static_cast<std::uint32_t>(channel), {row.begin(), row.end()}};
    });
}

}  // namespace roboss
