// See robot_model.h.
#include "kinematics/robot_model.h"

#include "math/array_rows.h"
#include "model/joint_motion.h"
#include "model/robot_state.h"

namespace roboss {
namespace {

Error closed_loop(const RobotType& type) {
    std::string names;
    for (const LoopJoint& loop : type.loops)
        names += (names.empty() ? "'" : ", '") + type.joints[loop.joint.index()].name + "'";
    return {
        "robot '" + type.name + "' has kinematic loops, closed by " + names,
        "cut_loops leaves these joints out; the rest moves as a tree, which the loops do not hold together",
        "closed-loop"};
}

}  // namespace

Result<RobotModel> RobotModel::create(std::shared_ptr<const Model> model, RobotId robot,
                                      const RobotModelOptions& options) {
    ROBOSS_CHECK(robot.index() < model->robots.size(), "robot " + std::to_string(robot.value));
    const RobotType& type = model->type_of(robot);
    if (!type.loops.empty() && !options.cut_loops) return closed_loop(type);
    if (type.nv == 0)
        return Error{"robot '" + type.name + "' has no joints that move, and a fixed base",
                     "choose a robot that can move", "no-joints"};
    return RobotModel(std::move(model), robot, options);
}

RobotModel::RobotModel(std::shared_ptr<const Model> model, RobotId robot, const RobotModelOptions& options)
    : model_(std::move(model)), robot_(robot) {
    X_WB_ = options.X_WR.value_or(model_->robots[robot.index()].X_WR);
    X_WB_.q = normalized(X_WB_.q);
    for (const std::size_t v : {3, 4, 5, 0, 1, 2})  // rows: linear first; the kernel: angular first
        if (type().free_base) v_of_column_.push_back(v);
    add_axes(axes_of_joints(type()));
    column_of_v_.resize(v_of_column_.size());
    for (std::size_t c = 0; c < v_of_column_.size(); ++c) column_of_v_[v_of_column_[c]] = c;
    ROBOSS_CHECK(v_columns() == static_cast<std::size_t>(type().nv), std::to_string(v_columns()));
    add_followers();
}

void RobotModel::add_axes(const std::vector<JointAxis>& all) {
    for (const JointAxis& axis : all) {
        const Joint& joint = type().joints[axis.joint.index()];
        if (joint.loop >= 0) {
            if (axis.axis == 0) cut_joints_.push_back(joint.name);
            continue;
        }
        const int v = joint.v_index + joint.axis_offset(axis.axis);
        const Dof& info = type().dofs[static_cast<std::size_t>(v - type().base_nv())];
        const Body& body = type().bodies[static_cast<std::size_t>(info.body)];
        const JointTraits& traits = joint_traits(body.joint);
        Column column;
        column.q = body.q_index, column.v = v, column.offset = v - body.v_index;
        column.is_ball = traits.is_quaternion, column.turns = traits.turns;
        column.lower = info.lower, column.upper = info.upper;
        column.leader = static_cast<int>(columns_.size());
        columns_.push_back(column);
        axes_.push_back(axis);
        v_of_column_.push_back(static_cast<std::size_t>(v));
    }
}

namespace {

CoordinateCoupling proportional(const RobotModel::Column& column) {
    CoordinateCoupling coupling;
    coupling.multiplier = column.multiplier, coupling.offset = column.leader_offset;
    return coupling;
}

/// `leader` follows another one, too.
void follow_curved(RobotModel::Column& column, const RobotModel::Column& leader) {
    if (column.curved.empty() && leader.curved.empty()) return;
    if (column.curved.empty()) column.curved = {proportional(column)};
    if (leader.curved.empty()) return column.curved.push_back(proportional(leader));
    column.curved.insert(column.curved.end(), leader.curved.begin(), leader.curved.end());
}

}  // namespace

double RobotModel::Column::follow(double leader_at) const {
    if (curved.empty()) return multiplier * leader_at + leader_offset;
    for (std::size_t k = curved.size(); k-- > 0;) leader_at = curved[k].follow(leader_at);
    return leader_at;
}

double RobotModel::Column::slope(double leader_at) const {
    if (curved.empty()) return multiplier;
    double product = 1;
    for (std::size_t k = curved.size(); k-- > 0;) {
        product *= curved[k].slope(leader_at);
        leader_at = curved[k].follow(leader_at);
    }
    return product;
}

/// Followers of followers follow the first of them.
void RobotModel::add_followers() {
    const auto column_of_dof = [&](int index) -> Column& {
        return columns_[column_of_v_[static_cast<std::size_t>(index) + base_v()] - base_v()];
    };
    for (const CoordinateCoupling& c : type().couplings) {
        Column& follower = column_of_dof(c.follower);
        follower.leader = static_cast<int>(&column_of_dof(c.leader) - columns_.data());
        follower.multiplier = c.multiplier, follower.leader_offset = c.offset;
        if (c.is_curved()) follower.curved = {c};
    }
    for (Column& column : columns_) {
        for (std::size_t guard = 0; guard < columns_.size(); ++guard) {
            const Column& leader = columns_[static_cast<std::size_t>(column.leader)];
            if (&leader == &column || &columns_[static_cast<std::size_t>(leader.leader)] == &leader) break;
            follow_curved(column, leader);
            column.leader_offset += column.multiplier * leader.leader_offset;
            column.multiplier *= leader.multiplier;
            column.leader = leader.leader;
        }
    }
}

std::vector<double> RobotModel::start() const {
    std::vector<double> row(q_columns());
    to_row(initial_state(*model_, robot_).q, row.data());
    return row;
}

void RobotModel::to_coordinates(const double* row, std::span<double> q) const {
    Pose X_WB = X_WB_;
    if (type().free_base) {
        X_WB = pose_at(row) * to_pose(type().X_RB);
    }
    q[0] = X_WB.p.x, q[1] = X_WB.p.y, q[2] = X_WB.p.z;
    put_quat(&q[3], X_WB.q);
    const double* joints = row + base_q();
    for (std::size_t d = 0; d < columns_.size(); ++d) {
        const auto to = static_cast<std::size_t>(columns_[d].q);
        if (!columns_[d].is_ball)
            q[to] = joints[d];
        else if (columns_[d].offset == 0)
            put_quat(&q[to], exponential(Vec3{joints[d], joints[d + 1], joints[d + 2]}));
    }
}

void RobotModel::to_row(std::span<const double> q, double* row) const {
    if (type().free_base) {
        put_row(Pose{vec3_at(q.data()), get_quat(&q[3])} * inverse(to_pose(type().X_RB)), row);
    }
    double* joints = row + base_q();
    for (std::size_t d = 0; d < columns_.size(); ++d) {
        const auto from = static_cast<std::size_t>(columns_[d].q);
        joints[d] = columns_[d].is_ball
                        ? logarithm(get_quat(&q[from]))[static_cast<std::size_t>(columns_[d].offset)]
                        : q[from];
    }
}

std::size_t RobotModel::rows(std::size_t size, std::size_t columns) {
    ROBOSS_CHECK(columns > 0 && size % columns == 0,
                 std::to_string(size) + " numbers in rows of " + std::to_string(columns));
    return size / columns;
}

}  // namespace roboss
