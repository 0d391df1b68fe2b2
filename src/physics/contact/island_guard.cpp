// See island_guard.h.
#include "physics/contact/island_guard.h"

#include <algorithm>
#include <cmath>

namespace roboss {
namespace {

/// J, at most, that an impulse gives along a direction of the velocity before it: p u + p^2 / (2 m). The
/// mobility 1/m is that of the zero pose, so it counts several times.
double most_work(double impulse, double velocity, double mobility) {
    constexpr double kOtherPoses = 4;
    const double p = std::fabs(impulse);
    return p * (std::fabs(velocity) + 0.5 * kOtherPoses * p * mobility);
}

/// J, at most, that motors give in the tick.
double most_work_of_motors(const Model& model, std::span<RobotWork> robots,
                           const IslandGuard::Island& island) {
    const IslandRows& rows = island.rows;
    double work = 0;
    std::size_t row = 0;
    for (std::size_t m = 0; m < island.members.size(); ++m) {
        const RobotWork& robot = robots[island.members[m]];
        const RobotType& type = *robot.type;
        const int first = island.offsets[m] + type.base_nv(), last = island.offsets[m] + type.nv;
        const std::vector<MotorSetpoint>& motors = robot.state->motors;
        for (; row < rows.joints.size() && rows.joints[row].dof < last; ++row) {
            const JointRow& joint = rows.joints[row];
            // The row of a motor, hard or not, is the first of its axis.
            const bool is_first = row == 0 || rows.joints[row - 1].dof != joint.dof;
            if (!is_first || motors[static_cast<std::size_t>(joint.dof - first)].mode == MotorMode::kPassive)
                continue;
            const double mobility =
                robot.type->dofs[static_cast<std::size_t>(joint.dof - first)].inverse_inertia;
            work += most_work(joint.impulse, island.v_before[static_cast<std::size_t>(joint.dof)], mobility);
        }
    }
    for (const CouplingRow& coupling : rows.couplings) {
        if (coupling.motor == nullptr) continue;
        double velocity = 0;
        for (std::size_t c = coupling.first; c < coupling.last; ++c) {
            const CouplingColumn& column = rows.coupling_columns[c];
            velocity += column.j * island.v_before[static_cast<std::size_t>(column.dof)];
        }
        work += most_work(coupling.impulse, velocity, coupling.compliance / model.accuracy.compliance);
    }
    return work;
}

/// J that the springs of soft contacts hold.
double energy_of_soft_contacts(const IslandGuard::Island& island) {
    double energy = 0;
    for (std::size_t c = 0; c < island.surfaces.size(); ++c) {
        if (!island.rows.contacts[c].soft) continue;
        const double depth = std::max(-island.contacts[c]->gap, 0.0);
        energy += 0.5 * island.surfaces[c].softness.stiffness * depth * depth;
    }
    return energy;
}

/// J, at most, that surfaces in motion give in the tick: their impulses times their velocities.
double most_work_of_surfaces(const IslandGuard::Island& island) {
    double work = 0;
    for (std::size_t c = 0; c < island.surfaces.size(); ++c) {
        if (!island.surfaces[c].moves()) continue;
        const Contact& contact = *island.contacts[c];
        const Vec3 impulse = contact.normal * contact.impulse + contact.friction;
        work += std::fabs(dot(impulse, island.surfaces[c].velocity)) +
                std::fabs(dot(contact.moment, island.surfaces[c].turning));
    }
    return work;
}

}  // namespace

BodySums sum_robots(const Model& model, std::span<RobotWork> robots, std::span<const std::uint32_t> members,
                    const Vec3& origin, RobotWork& buffer) {
    BodySums all;
    for (const std::uint32_t m : members) {
        const RobotWork& robot = robots[m];
        if (robot.type->nv == 0) continue;
        buffer.take(*robot.type, *robot.state);
        all += sum_bodies(model, robot.state->q, robot.state->v, origin, buffer);
    }
    return all;
}

void add_momentum(std::span<RobotWork> robots, std::span<const std::uint32_t> members, BodySums sums,
                  const Spatial& momentum, const Vec3& origin) {
    sums.momentum = momentum;
    Spatial motion;
    if (!sums.rigid_motion(motion)) return;
    for (const std::uint32_t m : members)
        if (robots[m].type->free_base) add_rigid_motion(motion, origin, 1.0, *robots[m].state);
}

void turn_island(const Model& model, std::span<RobotWork> robots, std::span<const std::uint32_t> members,
                 const Vec3& moment, RobotWork& buffer) {
    const Vec3 origin = robots[members[0]].origin;
    const BodySums sums = sum_robots(model, robots, members, origin, buffer);
    add_momentum(robots, members, sums, {moment, {}}, origin);
}

bool touches_fixed(std::span<const RobotWork> robots, const Contact& contact) {
    const auto is_fixed = [&](int robot) {
        return robot < 0 || !robots[static_cast<std::size_t>(robot)].type->free_base;
    };
    return is_fixed(contact.robot_a) || is_fixed(contact.robot_b);
}

bool throws_back(const IslandRows& rows) {
    return std::ranges::any_of(rows.contacts, [](const ContactRow& row) { return throws_back<double>(row); });
}

/// True if a motor drives a joint that closes a loop by an effort or a servo: its work is not counted.
bool has_soft_loop_motor(const RobotWork& robot) {
    for (const LoopJoint& loop : robot.type->loops)
        for (std::size_t k = 0; k < loop.dofs.size(); ++k) {
            const Dof& dof = loop.dofs[k];
            const MotorMode mode = robot.state->motors[static_cast<std::size_t>(loop.motor_index) + k].mode;
            const bool has_gains = dof.velocity_gain > 0 || dof.position_gain > 0;
            if (mode == MotorMode::kEffort || (mode != MotorMode::kPassive && has_gains)) return true;
        }
    return false;
}

bool IslandGuard::start(const Model& model, std::span<RobotWork> robots, const Island& island,
                        RobotWork& buffer) {
    const auto any = [&](auto&& is) {
        return std::ranges::any_of(island.members, [&](std::uint32_t m) { return is(robots[m]); });
    };
    const bool driven = any([&](const RobotWork& robot) { return !is_passive(model, robot); });
    const bool soft = std::ranges::any_of(island.rows.contacts, &ContactRow::soft);
    if (driven || soft) {
        if (!island.drifts || any([&](const RobotWork& robot) {
                return !only_motors_drive(model, robot) || has_soft_loop_motor(robot);
            }))
            return false;
    } else {
        const auto bends = [&](const RobotWork& robot) {
            return !robot.type->dofs.empty() ||
                   fastest_turn(robot) * model.dt_s * model.dt_s > kSlowTurn * kSlowTurn;
        };
        const bool contacts_may_add = island.touched && (island.bounces || any(bends));
        if (!island.bonded && !contacts_may_add && !(island.blown && any(bends))) return false;
    }
    anchored_ =
        island.anchored || island.blown || any([](const RobotWork& robot) { return !robot.type->free_base; });
    origin_ = robots[island.members[0]].origin;
    energy_ = sum_robots(model, robots, island.members, origin_, buffer).energy();
    if (driven) energy_ += most_work_of_motors(model, robots, island);
    energy_ += most_work_of_surfaces(island);
    if (soft) energy_ += energy_of_soft_contacts(island);
    return true;
}

void IslandGuard::finish(const Model& model, std::span<RobotWork> robots,
                         std::span<const std::uint32_t> members, RobotWork& buffer) const {
    const BodySums now = sum_robots(model, robots, members, origin_, buffer);
    const Slowdown slowdown = slowdown_to(energy_ - now.potential, now, anchored_);
    for (const std::uint32_t m : members)
        if (robots[m].type->nv > 0) slowdown.apply(*robots[m].type, origin_, *robots[m].state);
}

}  // namespace roboss
