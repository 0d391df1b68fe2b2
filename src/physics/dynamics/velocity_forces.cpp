// See velocity_forces.h. Ordinary motion costs one comparison and changes no bit.
#include "physics/dynamics/velocity_forces.h"

#include <cmath>

#include "physics/dynamics/fast_turning.h"
#include "physics/dynamics/lone_body.h"
#include "physics/dynamics/tree_factor.h"

namespace roboss {
namespace {

/// Impulse of the forces that do not depend on velocities, into buffer.work.impulse.
void add_up_forces_at_rest(const Model& model, const RobotWork& work, FreeBuffer& buffer) {
    buffer.v.assign(work.impulse.size(), 0.0);
    buffer.work.take(*work.type, *work.state);
    forward_kinematics<double>(*work.type, work.state->q, buffer.work);
    forward_velocities<double>(*work.type, buffer.v, buffer.work);
    compute_impulse(model, model.dt_s, 0.0, work.state->q, buffer.v, buffer.work);
}

void leave_out_gyroscopic_torque(const Model& model, RobotWork& work, FreeBuffer& buffer) {
    add_up_forces_at_rest(model, work, buffer);
    tree_times(work.type->paths, work.mass_matrix.data(), work.state->v.data(), work.impulse.data());
    for (std::size_t i = 0; i < work.impulse.size(); ++i) work.impulse[i] += buffer.work.impulse[i];
}

}  // namespace

void limit_velocity_forces(const Model& model, RobotWork& work, FreeBuffer& buffer) {
    constexpr double kShare = 0.002;    // of the kinetic energy
    constexpr double kTurn = 0.5;       // rad
    if (work.type->feels_flow) return;  // their forces depend on the velocities, too, and are to stay
    const bool lone = is_free_body(*work.type);
    const bool turns = lone || fastest_turn(work) * model.dt_s * model.dt_s > kTurn * kTurn;
    if (!turns || !turns_fast<double>(work, model.dt_s)) return;
    if (lone) return leave_out_gyroscopic_torque(model, work, buffer);
    add_up_forces_at_rest(model, work, buffer);
    const DofPaths& paths = work.type->paths;
    const std::vector<double>&v = work.state->v, &at_rest = buffer.work.impulse;
    std::vector<double>&momentum = buffer.wanted, &j = buffer.change;
    momentum.resize(v.size()), j.resize(v.size());
    tree_times(paths, work.mass_matrix.data(), v.data(), momentum.data());
    buffer.factor = work.mass_matrix;
    tree_factor(paths, buffer.factor.data());
    for (std::size_t i = 0; i < v.size(); ++i) j[i] = work.impulse[i] - momentum[i] - at_rest[i];
    buffer.v = j;
    tree_solve(paths, buffer.factor.data(), buffer.v.data());
    double energy = 0, first = 0, second = 0;  // first + second: what j adds
    for (std::size_t i = 0; i < v.size(); ++i)
        energy += 0.5 * v[i] * momentum[i], first += v[i] * j[i], second += 0.5 * buffer.v[i] * j[i];
    const double most = kShare * energy;
    if (!(first + second > most)) return;
    const double share = (std::sqrt(first * first + 4 * second * most) - first) / (2 * second);
    for (std::size_t i = 0; i < v.size(); ++i) work.impulse[i] = momentum[i] + at_rest[i] + share * j[i];
}

}  // namespace roboss
