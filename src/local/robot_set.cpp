// See robot_set.h.
#include "local/robot_set.h"

#include <algorithm>
#include <cmath>

#include "math/array_rows.h"
#include "model/link_value.h"
#include "physics/dynamics/kinematics.h"
#include "physics/dynamics/motor_effort.h"
#include "world/joint_type.h"

namespace roboss {

namespace {

/// number(type, robot, axis) of each axis of each robot, row by row.
template <class Number>
void read_axes(const RobotSet& set, std::span<double> out, Number number) {
    ROBOSS_CHECK(out.size() == set.size() * set.axes().size(), std::to_string(out.size()) + " numbers");
    double* to = out.data();
    for (std::size_t i = 0; i < set.size(); ++i)
        for (const JointAxis& axis : set.axes_of_row(i))
            *to++ = number(set.type_of_row(i), set.robots()[i], axis);
}

/// number(type, robot, link) of each link that all robots have, row by row; not a number where it is none.
template <class Number>
void read_links(const RobotSet& set, std::span<double> out, Number number) {
    const SharedParts& shared = set.shared();
    ROBOSS_CHECK(out.size() == set.size() * shared.links.size(), std::to_string(out.size()) + " numbers");
    double* to = out.data();
    for (std::size_t i = 0; i < set.size(); ++i)
        for (const SharedPart& link : shared.links)
            *to++ = number(set.type_of_row(i), set.robots()[i], LinkId(link.of[shared.type_of_row[i]]))
                        .value_or(std::nan(""));
}

void read_joints(const RobotSet& set, const RunAccess& run, double JointState::*value,
                 std::span<double> out) {
    read_axes(set, out, [&](const RobotType& type, RobotId robot, const JointAxis& axis) {
        return joint_state(type, run.state(robot), axis.joint, axis.axis).*value;
    });
}

/// Adds the link's kinetic and potential energy, J.
void add_energy(const Model& model, const RobotType& type, const RobotState& state, LinkId id,
                double* energy) {
    const Link& link = type.links[id.index()];
    const Transform X_WL = link_pose(type, state, id);
    const Twist twist = link_twist(type, state, id);
    const Mat3 R_WB = X_WL.R * transpose(link.X_BL.R);
    const Vec3 p_LC_W = R_WB * (link.p_BC - link.X_BL.p);
    const Vec3 v_C = twist.linear + cross(twist.angular, p_LC_W), w_B = transpose(R_WB) * twist.angular;
    energy[0] += 0.5 * (link.mass * norm_squared(v_C) + dot(w_B, link.inertia_C * w_B));
    if (link.gravity) energy[1] -= link.mass * dot(gravity_of(model, type), X_WL.p + p_LC_W);
}

/// Limits are ordered together: of an order with one, the other as it is.
void add_other_limit(const RobotType& type, const RobotState& state, SetJointParameters& own) {
    const Dof& now = dof_of(type, state, type.joints[own.joint.index()], own.axis);
    const auto has = [&](JointParameter parameter) {
        return std::ranges::count(own.values, parameter, &JointParameterValue::parameter) > 0;
    };
    const bool lower = has(JointParameter::kLower), upper = has(JointParameter::kUpper);
    if (lower && !upper) own.values.push_back({JointParameter::kUpper, now.upper});
    if (upper && !lower) own.values.push_back({JointParameter::kLower, now.lower});
}

/// An inertia is ordered as a whole: of an order with a part of it, the rest as it is.
void add_other_inertias(const RobotType& type, const RobotState& state, SetLinkParameters& own) {
    if (std::ranges::none_of(own.values, is_inertia, &LinkParameterValue::parameter)) return;
    for (auto p = LinkParameter::kInertiaXx; p <= LinkParameter::kInertiaYz;
         p = static_cast<LinkParameter>(static_cast<int>(p) + 1)) {
        const std::optional<double> now = link_value(type, state, own.link, p);
        if (now && std::ranges::count(own.values, p, &LinkParameterValue::parameter) == 0)
            own.values.push_back({p, *now});
    }
}

/// Whether this is scenery that carries robot A: the normal is within 45 degrees of the vertical.
bool carries(const ContactReport& contact, const Vec3& gravity) {
    return !contact.robot_b.valid() && dot(contact.normal, gravity) < -std::sqrt(0.5) * norm(gravity);
}

}  // namespace

RobotSet::RobotSet(std::shared_ptr<const Model> model, std::vector<RobotId> robots)
    : model_(std::move(model)), robots_(std::move(robots)), shared_(*model_, robots_) {}

double* RobotSet::row(std::span<double> out, std::size_t robot, std::size_t columns) const {
    ROBOSS_CHECK(out.size() == size() * columns, std::to_string(out.size()) + " numbers");
    return out.data() + robot * columns;
}

void RobotSet::poses(const RunAccess& run, std::span<double> out) const {
    for (std::size_t i = 0; i < size(); ++i) {
        const RobotType& type = model_->type_of(robots_[i]);
        put_row(base_pose(run.state(robots_[i])) * inverse(to_pose(type.X_RB)), row(out, i, kPoseColumns));
    }
}

void RobotSet::twists(const RunAccess& run, std::span<double> out) const {
    for (std::size_t i = 0; i < size(); ++i) {
        const std::vector<double>& v = run.state(robots_[i]).v;
        const bool free = model_->type_of(robots_[i]).free_base;
        put_row(free ? vec3_at(&v[3]) : Vec3{}, free ? vec3_at(v.data()) : Vec3{},
                row(out, i, kTwistColumns));
    }
}

void RobotSet::link_poses(const RunAccess& run, std::size_t link, std::span<double> out) const {
    for (std::size_t i = 0; i < size(); ++i) {
        const LinkId id(part_of(shared_.links[link], i));
        put_row(to_pose(link_pose(type_of_row(i), run.state(robots_[i]), id)), row(out, i, kPoseColumns));
    }
}

void RobotSet::link_twists(const RunAccess& run, std::size_t link, std::span<double> out) const {
    for (std::size_t i = 0; i < size(); ++i) {
        const LinkId id(part_of(shared_.links[link], i));
        const Twist twist = link_twist(type_of_row(i), run.state(robots_[i]), id);
        put_row(twist.linear, twist.angular, row(out, i, kTwistColumns));
    }
}

void RobotSet::joint_positions(const RunAccess& run, std::span<double> out) const {
    read_joints(*this, run, &JointState::position, out);
}

void RobotSet::joint_velocities(const RunAccess& run, std::span<double> out) const {
    read_joints(*this, run, &JointState::velocity, out);
}

void RobotSet::joint_efforts(const RunAccess& run, std::span<double> out) const {
    read_axes(*this, out, [&](const RobotType& type, RobotId robot, const JointAxis& axis) {
        return motor_effort(*model_, type, run.state(robot), axis.joint, axis.axis);
    });
}

void RobotSet::joint_parameters(const RunAccess& run, JointParameter parameter, std::span<double> out) const {
    const auto member = info_of(parameter).member;
    read_axes(*this, out, [&](const RobotType& type, RobotId robot, const JointAxis& axis) {
        return dof_of(type, run.state(robot), type.joints[axis.joint.index()], axis.axis).*member;
    });
}

void RobotSet::file_parameters(JointParameter parameter, std::span<double> out) const {
    const auto member = info_of(parameter).member;
    read_axes(*this, out, [&](const RobotType& type, RobotId, const JointAxis& axis) {
        return type.dof(type.joints[axis.joint.index()], axis.axis).*member;
    });
}

void RobotSet::link_parameters(const RunAccess& run, LinkParameter parameter, std::span<double> out) const {
    read_links(*this, out, [&](const RobotType& type, RobotId robot, LinkId link) {
        return link_value(type, run.state(robot), link, parameter);
    });
}

void RobotSet::file_link_parameters(LinkParameter parameter, std::span<double> out) const {
    read_links(*this, out, [&](const RobotType& type, RobotId, LinkId link) {
        return link_number(type, link, parameter);
    });
}

void RobotSet::surroundings(const RunAccess& run, Surrounding which, std::span<double> out) const {
    for (std::size_t i = 0; i < size(); ++i)
        put_row(surrounding_of(*model_, run.state(robots_[i]), which), row(out, i, 3));
}

void RobotSet::file_surroundings(Surrounding which, std::span<double> out) const {
    for (std::size_t i = 0; i < size(); ++i) put_row(surrounding_of(*model_, which), row(out, i, 3));
}

void RobotSet::energies(const RunAccess& run, std::span<double> out) const {
    for (std::size_t i = 0; i < size(); ++i) {
        const RobotType& type = type_of(model_->type_of(robots_[i]), run.state(robots_[i]));
        double* energy = row(out, i, kEnergyColumns);
        energy[0] = energy[1] = 0;
        for (std::size_t l = 0; l < type.links.size(); ++l)
            add_energy(*model_, type, run.state(robots_[i]), LinkId(l), energy);
    }
}

void RobotSet::touching(RunAccess& run, std::span<bool> out) const {
    ROBOSS_CHECK(out.size() == size(), std::to_string(out.size()) + " flags");
    std::vector<char> touched(model_->robots.size());
    for (const ContactReport& contact : run.contacts()) {
        const RobotId a = contact.robot_a;
        if (carries(contact, gravity_of(*model_, type_of(model_->type_of(a), run.state(a))))) continue;
        touched[contact.robot_a.index()] = 1;
        if (contact.robot_b.valid()) touched[contact.robot_b.index()] = 1;
    }
    for (std::size_t i = 0; i < size(); ++i) out[i] = touched[robots_[i].index()] != 0;
}

Result<> RobotSet::give(RunAccess& run, std::size_t orders_per_row, const ActionOfRow& action) const {
    std::vector<Order> orders;
    orders.reserve(size() * orders_per_row);
    for (std::size_t i = 0; i < size(); ++i)
        for (std::size_t k = 0; k < orders_per_row; ++k)
            orders.push_back({0, ClientId(0U), 0, robots_[i], action(i, k)});
    return run.order(std::move(orders));
}

Result<> RobotSet::change(RunAccess& run, std::size_t orders_per_row, const ActionOfRow& action) const {
    std::vector<Order> orders;
    orders.reserve(size() * orders_per_row);
    for (std::size_t i = 0; i < size(); ++i)
        for (std::size_t k = 0; k < orders_per_row; ++k)
            orders.push_back({run.tick(), ClientId(0U), 0, robots_[i], action(i, k)});
    return change_all(run, orders);
}

Result<> RobotSet::set_poses(RunAccess& run, std::span<const double> poses) const {
    ROBOSS_CHECK(poses.size() == size() * kPoseColumns, std::to_string(poses.size()) + " numbers");
    return change(run, 1,
                  [&](std::size_t i, std::size_t) { return SetPose{pose_at(&poses[i * kPoseColumns])}; });
}

Result<> RobotSet::set_twists(RunAccess& run, std::span<const double> twists) const {
    ROBOSS_CHECK(twists.size() == size() * kTwistColumns, std::to_string(twists.size()) + " numbers");
    return change(run, 1, [&](std::size_t i, std::size_t) {
        const double* at = &twists[i * kTwistColumns];
        return SetVelocity{vec3_at(at), vec3_at(at + 3)};
    });
}

/// All, or, if one is refused, none.
Result<> RobotSet::change_all(RunAccess& run, const std::vector<Order>& orders) const {
    for (const Order& order : orders)
        if (Result<> fine = check_order(*model_, order); !fine) return fine;
    for (const Order& order : orders)
        if (Result<> done = run.change(order.robot, order.action); !done) return done;
    return Ok{};
}

/// One order for each joint of each robot.
Result<> RobotSet::change_joints(RunAccess& run, std::span<const double> values,
                                 std::vector<double> SetJointState::*kind) const {
    ROBOSS_CHECK(values.size() == size() * axes().size(), std::to_string(values.size()) + " numbers");
    std::vector<Order> orders;
    orders.reserve(values.size());
    const double* from = values.data();
    for (std::size_t i = 0; i < size(); ++i)
        for (const JointAxis& axis : axes_of_row(i)) {
            if (axis.axis == 0) {
                SetJointState state;
                state.joint = axis.joint;
                orders.push_back({run.tick(), ClientId(0U), 0, robots_[i], std::move(state)});
            }
            (std::get<SetJointState>(orders.back().action).*kind).push_back(*from++);
        }
    return change_all(run, orders);
}

Result<> RobotSet::set_joint_parameters(RunAccess& run, std::span<const std::size_t> columns,
                                        std::span<const JointParameter> parameters,
                                        std::span<const double> values) const {
    const std::size_t width = parameters.size() * columns.size();
    ROBOSS_CHECK(values.size() == size() * width, std::to_string(values.size()) + " numbers");
    return change(run, columns.size(), [&](std::size_t i, std::size_t k) {
        const JointAxis& axis = axes_of_row(i)[columns[k]];
        SetJointParameters own{axis.joint, axis.axis, false, {}};
        for (std::size_t p = 0; p < parameters.size(); ++p)
            own.values.push_back({parameters[p], values[i * width + p * columns.size() + k]});
        add_other_limit(type_of_row(i), run.state(robots_[i]), own);
        return own;
    });
}

Result<> RobotSet::reset_joint_parameters(RunAccess& run, std::span<const std::size_t> columns) const {
    return change(run, columns.size(), [&](std::size_t i, std::size_t k) {
        const JointAxis& axis = axes_of_row(i)[columns[k]];
        return SetJointParameters{axis.joint, axis.axis, true, {}};
    });
}

Result<> RobotSet::set_link_parameters(RunAccess& run, std::span<const std::size_t> links,
                                       std::span<const LinkParameter> parameters,
                                       std::span<const double> values) const {
    const std::size_t width = parameters.size() * links.size();
    ROBOSS_CHECK(values.size() == size() * width, std::to_string(values.size()) + " numbers");
    std::vector<Order> orders;
    for (std::size_t i = 0; i < size(); ++i)
        for (std::size_t k = 0; k < links.size(); ++k) {
            SetLinkParameters own{LinkId(part_of(shared_.links[links[k]], i)), false, {}};
            for (std::size_t p = 0; p < parameters.size(); ++p) {
                const double value = values[i * width + p * links.size() + k];
                if (!std::isnan(value)) own.values.push_back({parameters[p], value});
            }
            if (own.values.empty()) continue;
            add_other_inertias(type_of_row(i), run.state(robots_[i]), own);
            orders.push_back({run.tick(), ClientId(0U), 0, robots_[i], std::move(own)});
        }
    return change_all(run, orders);
}

Result<> RobotSet::reset_link_parameters(RunAccess& run, std::span<const std::size_t> links) const {
    return change(run, links.size(), [&](std::size_t i, std::size_t k) {
        return SetLinkParameters{LinkId(part_of(shared_.links[links[k]], i)), true, {}};
    });
}

Result<> RobotSet::set_surroundings(RunAccess& run, std::span<const std::size_t> components,
                                    std::span<const Surrounding> which,
                                    std::span<const double> values) const {
    const std::size_t width = which.size() * components.size();
    ROBOSS_CHECK(values.size() == size() * width, std::to_string(values.size()) + " numbers");
    return change(run, 1, [&](std::size_t i, std::size_t) {
        SetSurroundings own;
        for (std::size_t p = 0; p < which.size(); ++p) {
            Vec3 value = surrounding_of(*model_, run.state(robots_[i]), which[p]);
            for (std::size_t k = 0; k < components.size(); ++k)
                value[components[k]] = values[i * width + p * components.size() + k];
            own.values.*info_of(which[p]).own = value;
        }
        return own;
    });
}

Result<> RobotSet::reset_surroundings(RunAccess& run, std::span<const std::size_t> components) const {
    std::vector<Order> orders;
    for (const RobotId robot : robots_) {
        SetSurroundings own;
        own.reset = components.size() == 3;
        for (const Surrounding which : {Surrounding::kGravity, Surrounding::kWind}) {
            std::optional<Vec3> value = run.state(robot).own.around.*info_of(which).own;
            if (own.reset || !value) continue;
            for (const std::size_t k : components) (*value)[k] = surrounding_of(*model_, which)[k];
            own.values.*info_of(which).own = value;
        }
        if (own.reset || !own.values.empty()) orders.push_back({run.tick(), ClientId(0U), 0, robot, own});
    }
    return change_all(run, orders);
}

Result<> RobotSet::set_joint_positions(RunAccess& run, std::span<const double> positions) const {
    return change_joints(run, positions, &SetJointState::position);
}

Result<> RobotSet::set_joint_velocities(RunAccess& run, std::span<const double> velocities) const {
    return change_joints(run, velocities, &SetJointState::velocity);
}

Result<> RobotSet::set_joints(RunAccess& run, std::span<const std::size_t> columns, MotorMode mode,
                              std::span<const double> targets, double max_effort, const Gains& gains) const {
    ROBOSS_CHECK(targets.size() == size() * columns.size(), std::to_string(targets.size()) + " numbers");
    for (const std::span<const double> gain : {gains.position, gains.velocity})
        ROBOSS_CHECK(gain.empty() || gain.size() == targets.size(), std::to_string(gain.size()) + " gains");
    const bool has_gains = !gains.position.empty() || !gains.velocity.empty();
    const std::size_t each = has_gains ? 2 : 1;  // orders of an axis
    return give(run, each * columns.size(), [&](std::size_t i, std::size_t k) -> Action {
        const std::size_t column = k / each, at = i * columns.size() + column;
        const JointAxis& axis = axes_of_row(i)[columns[column]];
        if (k % each + 1 == each) return SetJoint{axis.joint, axis.axis, mode, targets[at], max_effort};
        SetJointParameters own{axis.joint, axis.axis, false, {}};
        if (!gains.position.empty())
            own.values.push_back({JointParameter::kPositionGain, gains.position[at]});
        if (!gains.velocity.empty())
            own.values.push_back({JointParameter::kVelocityGain, gains.velocity[at]});
        return own;
    });
}

Result<> RobotSet::apply_wrenches(RunAccess& run, std::optional<std::size_t> link,
                                  std::span<const double> wrenches, Tick ticks) const {
    ROBOSS_CHECK(wrenches.size() == size() * 6, std::to_string(wrenches.size()) + " numbers");
    return give(run, 1, [&](std::size_t i, std::size_t) {
        const LinkId id(link ? part_of(shared_.links[*link], i) : 0);
        return ApplyWrench{id, vec3_at(&wrenches[i * 6]), vec3_at(&wrenches[i * 6 + 3]), ticks};
    });
}

Result<> RobotSet::command(RunAccess& run, std::size_t channel, std::size_t values,
                           std::span<const double> rows) const {
    ROBOSS_CHECK(rows.size() == size() * values, std::to_string(rows.size()) + " numbers");
    return give(run, 1, [&](std::size_t i, std::size_t) {
        const std::span<const double> row = rows.subspan(i * values, values);
        const std::size_t number = part_of(shared_.commands[channel], i);
        return Command{static_cast<std::uint32_t>(number), {row.begin(), row.end()}};
    });
}

}  // namespace roboss
