// Coordinates and their rates; quaternions are integrated as four numbers with q' = 1/2 w q and normalised,
// which keeps the method's order (Hairer, Lubich, Wanner 2006, IV.4: projection after the step).
#include "physics/dynamics/integrate.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "physics/dynamics/joint_rows.h"
#include "physics/dynamics/robot_energy.h"
#include "physics/dynamics/tree_factor.h"

namespace roboss {
namespace {

/// dq/dt of all coordinates; `rate` has the size of q.
void coordinate_rate(const RobotType& type, std::span<const double> q, std::span<const double> v,
                     std::span<double> rate) {
    std::fill(rate.begin(), rate.end(), 0.0);
    for (const Body& body : type.bodies)
        visit_joint(body.joint, [&](auto joint) {
            joint.rate(q.data() + body.q_index, v.data() + body.v_index, rate.data() + body.q_index);
        });
}

void normalise(const RobotType& type, std::span<double> q) {
    for (const Body& body : type.bodies)
        visit_joint(body.joint, [&](auto joint) { joint.normalise(q.data() + body.q_index); });
}

/// The acceleration of a net by the forces on its tree, loops closed, into its work's velocity.
void net_acceleration(std::span<const double> q, std::span<const char> locked, FreeBuffer& free) {
    RobotWork& work = free.work;
    gather_for_solver(work, q, free.equalities, free.walk.team());
    leave_out_locked(locked, free.equalities);
    free.solver.prepare(work, locked, free.equalities);
    free.wanted.clear();
    for (const EqualityRow& row : free.equalities.rows) free.wanted.push_back(-row.curvature);
    work.velocity.resize(work.impulse.size());
    free.solver.accelerate(work.impulse, free.wanted, work.velocity);
}

/// Adds what loops and couplings accelerate: so much that their second derivatives are zero.
void add_equality_acceleration(std::span<const double> q, std::span<const char> locked, FreeBuffer& free) {
    RobotWork& work = free.work;
    gather_for_solver(work, q, free.equalities);
    leave_out_locked(locked, free.equalities);
    free.solver.prepare(work, locked, free.equalities);
    times_rows(work, work.velocity, locked, free.equalities, free.wanted);
    for (std::size_t r = 0; r < free.wanted.size(); ++r)
        free.wanted[r] = -free.equalities.rows[r].curvature - free.wanted[r];
    free.change.resize(work.velocity.size());
    free.solver.solve(free.wanted, free.change);
    for (std::size_t i = 0; i < free.change.size(); ++i) work.velocity[i] += free.change[i];
}

/// Damping and springs of the tree's joints, as forces at (q, v). Springs stand in `impulse` already; where
/// they are stiff, the steady force holds both.
void add_joint_forces(const Model& model, std::span<const double> q, std::span<const double> v,
                      bool has_stiff, RobotWork& work) {
    const RobotType& type = *work.type;
    const std::span<const Dof> dofs = work.type->dofs;
    for (std::size_t d = 0; d < dofs.size(); ++d) {
        const Dof& dof = dofs[d];
        const std::size_t i = d + static_cast<std::size_t>(type.base_nv());
        if (!has_stiff || !is_stiff(dof, model.dt_s)) {
            work.impulse[i] -= dof.damping * v[i];
        } else if (dof.spring_stiffness != 0) {
            const Body& body = type.bodies[static_cast<std::size_t>(dof.body)];
            work.impulse[i] +=
                dof.spring_stiffness * (q[static_cast<std::size_t>(body.q_index)] - dof.spring_reference);
        }
    }
}

/// Places the robot at (q, v) and sums what acts on its tree into its work's impulse.
void gather_forces(const Model& model, const SteadyRows& rows, std::span<const double> q,
                   std::span<const double> v, FreeBuffer& free) {
    RobotWork& buffer = free.work;
    const RobotType& type = *buffer.type;
    free.walk.place(type, q, buffer);
    free.walk.move(type, v, buffer);
    compute_impulse(model, 1.0, 0.0, q, v, buffer, &free.walk);
    add_joint_forces(model, q, v, rows.has_stiff, buffer);
    for (std::size_t i = 0; i < rows.force.size(); ++i) buffer.impulse[i] += rows.force[i];
    for (std::size_t i = 0; i < rows.locked.size(); ++i)
        if (rows.locked[i]) buffer.impulse[i] = 0;
}

/// Acceleration of the robot's tree by these forces, its loops open, into its work's velocity.
void tree_acceleration(const SteadyRows& rows, FreeBuffer& free) {
    RobotWork& buffer = free.work;
    const RobotType& type = *buffer.type;
    compute_mass_matrix<double>(type, 0.0, buffer);
    lock_rows(type.paths, rows.locked, buffer.mass_matrix.data());
    tree_factor(type.paths, buffer.mass_matrix.data());
    buffer.velocity = buffer.impulse;
    tree_solve(type.paths, buffer.mass_matrix.data(), buffer.velocity.data());
}

/// An explicit Runge-Kutta method: stage s starts from the rates of those before it, weighed by `from[s]`.
struct Method {
    std::size_t stages;
    std::array<std::array<double, 6>, 7> from;
    std::array<double, 7> weight;
};

/// The classical method, of fourth order.
constexpr Method kClassical{
    4, {{{}, {0.5}, {0.0, 0.5}, {0.0, 0.0, 1.0}}}, {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}};

/// Of sixth order with the fewest stages that one can have (Butcher, On Runge-Kutta processes of high order,
/// 1964).
constexpr Method kButcher{7,
                          {{{},
                            {1.0 / 3},
                            {0.0, 2.0 / 3},
                            {1.0 / 12, 1.0 / 3, -1.0 / 12},
                            {-1.0 / 16, 9.0 / 8, -3.0 / 16, -3.0 / 8},
                            {0.0, 9.0 / 8, -3.0 / 8, -3.0 / 4, 1.0 / 2},
                            {9.0 / 44, -9.0 / 11, 63.0 / 44, 18.0 / 11, 0.0, -16.0 / 11}}},
                          {11.0 / 120, 0.0, 27.0 / 40, 27.0 / 40, -4.0 / 15, -4.0 / 15, 11.0 / 120}};

/// Many loops, of which each stage needs a factorisation (sparse_equality.h).
bool is_net(const RobotType& type) {
    return !type.elimination.empty();
}

/// Links on joints whip each other round far faster than they swing; a lone body has nothing that does, and
/// in a net links hold each other.
const Method& method_of(const RobotType& type) {
    return type.dofs.empty() || is_net(type) ? kClassical : kButcher;
}

/// to = from + dt * (rates of the stages, weighed); `rates` holds one stage after the other.
void add_rates(std::span<const double> from, double dt, std::span<const double> weights,
               std::span<const double> rates, std::span<double> sum, std::span<double> to) {
    const std::size_t size = from.size();
    std::fill(sum.begin(), sum.end(), 0.0);
    for (std::size_t stage = 0; stage < weights.size(); ++stage) {
        if (weights[stage] == 0) continue;
        const auto rate = rates.subspan(stage * size, size);
        for (std::size_t i = 0; i < size; ++i) sum[i] += weights[stage] * rate[i];
    }
    for (std::size_t i = 0; i < size; ++i) to[i] = from[i] + dt * sum[i];
}

/// Makes room for a step and keeps where it begins.
void start_part(const Method& method, RobotWork& work, FreeBuffer& buffer) {
    const RobotState& state = *work.state;
    const std::size_t nq = state.q.size(), nv = state.v.size();
    for (auto* sized_q : {&buffer.q, &buffer.q_sum}) sized_q->resize(nq);
    for (auto* sized_v : {&buffer.v, &buffer.v_sum}) sized_v->resize(nv);
    buffer.q_rates.resize(method.stages * nq), buffer.v_rates.resize(method.stages * nv);
    buffer.work.take(*work.type, *work.state);
    if (!work.type->has_equalities()) return;
    buffer.q_start = state.q, buffer.v_start = state.v;
}

/// Puts the state back onto the loops and couplings.
void close(const SteadyRows& rows, RobotState& state, FreeBuffer& buffer) {
    buffer.projection.close_coordinates(buffer.work, state.q, rows.locked);
    buffer.projection.close_velocities(buffer.work, state.q, state.v, rows.locked);
}

/// The velocity after a step with the loops open, by the acceleration of the tree at the beginning.
void set_open_velocity(double dt, const RobotWork& work, std::span<const double> before, FreeBuffer& buffer) {
    buffer.open_velocity.assign(before.begin(), before.end());
    for (std::size_t i = 0; i < buffer.open_velocity.size(); ++i)
        buffer.open_velocity[i] += dt * work.velocity[i];
}

/// The same of a net, whose steps do without that acceleration.
void find_open_velocity(const Model& model, double dt, const SteadyRows& rows, const RobotWork& work,
                        FreeBuffer& buffer) {
    buffer.q = buffer.q_start;
    normalise(*work.type, buffer.q);
    gather_forces(model, rows, buffer.q, buffer.v_start, buffer);
    tree_acceleration(rows, buffer);
    set_open_velocity(dt, buffer.work, buffer.v_start, buffer);
}

/// Bounds from below what kinetic energy a net has at the beginning of a step, and would have after it with
/// its loops open. With a = M^-1 f that is T + dt v f + dt^2 / 2 a M a, where the last term is not negative.
/// A joint that is locked and moves does work that f does not tell.
void note_energies(double dt, const SteadyRows& rows, std::span<const double> v, FreeBuffer& buffer) {
    double kinetic = 0, power = 0;
    for (const BodyWork& body : buffer.work.bodies)
        kinetic += 0.5 * dot(body.inertia * body.velocity, body.velocity);
    bool is_known = true;
    for (std::size_t i = 0; i < v.size(); ++i) {
        power += v[i] * buffer.work.impulse[i];
        is_known = is_known && (rows.locked.empty() || !rows.locked[i] || v[i] == 0);
    }
    buffer.kinetic_start = kinetic;
    buffer.kinetic_open = is_known ? kinetic + dt * power : kinetic;
}

/// True where a step made kinetic energy that no force gave. Loop reactions do no work, so at most the energy
/// remains that the robot had, or would have with its loops open. Near a dead point of a mechanism the
/// conditions of its loops are almost dependent, and reactions grow beyond what the method follows.
bool gained_energy(const Model& model, double dt, const SteadyRows& rows, const RobotWork& work,
                   FreeBuffer& buffer) {
    constexpr double kMore = 1.05;
    const auto kinetic = [&](std::span<const double> q, std::span<const double> v) {
        return sum_bodies(model, q, v, work.origin, buffer.work, &buffer.walk).kinetic;
    };
    const double now = kinetic(work.state->q, work.state->v);
    if (is_net(*work.type)) {
        if (now <= kMore * std::max(buffer.kinetic_start, buffer.kinetic_open)) return false;
        find_open_velocity(model, dt, rows, work, buffer);
    }
    const double most =
        std::max(kinetic(buffer.q_start, buffer.v_start), kinetic(buffer.q_start, buffer.open_velocity));
    return !(now <= kMore * most);
}

/// A step of first order that projects velocities onto the loops: that takes energy and never gives it.
void advance_projected(double dt, const SteadyRows& rows, RobotWork& work, FreeBuffer& buffer) {
    const RobotType& type = *work.type;
    RobotState& state = *work.state;
    state.q = buffer.q_start, state.v = buffer.open_velocity;
    buffer.projection.close_velocities(buffer.work, state.q, state.v, rows.locked);
    advance_coordinates<double>(type, state.v, dt, state.q);
    close(rows, state, buffer);
}

/// The acceleration at the buffer's q and v, into its work's velocity; at the first stage also the velocity
/// after the step with the loops open.
void accelerate(const Model& model, double dt, const SteadyRows& rows, bool is_first, const RobotWork& work,
                FreeBuffer& buffer) {
    const RobotType& type = *work.type;
    gather_forces(model, rows, buffer.q, buffer.v, buffer);
    if (is_net(type)) {
        if (is_first) note_energies(dt, rows, buffer.v, buffer);
        return net_acceleration(buffer.q, rows.locked, buffer);
    }
    tree_acceleration(rows, buffer);
    if (!type.has_equalities()) return;
    if (is_first) set_open_velocity(dt, buffer.work, work.state->v, buffer);
    add_equality_acceleration(buffer.q, rows.locked, buffer);
}

/// One step of the method, of length `dt`.
void advance_part(const Model& model, double dt, const SteadyRows& rows, RobotWork& work,
                  FreeBuffer& buffer) {
    const RobotType& type = *work.type;
    const Method& method = method_of(type);
    RobotState& state = *work.state;
    const std::size_t nq = state.q.size(), nv = state.v.size();
    start_part(method, work, buffer);
    for (std::size_t stage = 0; stage < method.stages; ++stage) {
        const auto weights = std::span(method.from[stage]).first(stage);
        add_rates(state.q, dt, weights, buffer.q_rates, buffer.q_sum, buffer.q);
        add_rates(state.v, dt, weights, buffer.v_rates, buffer.v_sum, buffer.v);
        normalise(type, buffer.q);
        coordinate_rate(type, buffer.q, buffer.v, std::span(buffer.q_rates).subspan(stage * nq, nq));
        accelerate(model, dt, rows, stage == 0, work, buffer);
        std::copy(buffer.work.velocity.begin(), buffer.work.velocity.end(),
                  buffer.v_rates.begin() + static_cast<std::ptrdiff_t>(stage * nv));
    }
    const auto weights = std::span(method.weight).first(method.stages);
    add_rates(state.q, dt, weights, buffer.q_rates, buffer.q_sum, state.q);
    add_rates(state.v, dt, weights, buffer.v_rates, buffer.v_sum, state.v);
    normalise(type, state.q);
    if (!type.has_equalities()) return;
    close(rows, state, buffer);
    if (gained_energy(model, dt, rows, work, buffer)) advance_projected(dt, rows, work, buffer);
}

}  // namespace

int parts_of_tick(const RobotType& type, double fastest, double dt) {
    // In a net, which others hold, a body that turns fast swings to and fro: less exact will do.
    constexpr double kTurnOfBody = 0.05, kTurnOfTree = 0.25, kTurnOfNet = 0.16;  // rad
    constexpr double kPartsMax = 64;
    const double turn = type.dofs.empty() ? kTurnOfBody : is_net(type) ? kTurnOfNet : kTurnOfTree;
    return static_cast<int>(std::ceil(std::clamp(std::sqrt(fastest) * dt / turn, 1.0, kPartsMax)));
}

double fastest_turn(const Mechanics<double>& work) {
    double fastest = 0;
    for (const BodyWork& body : work.bodies) fastest = std::max(fastest, norm_squared(body.velocity.angular));
    return fastest;
}

void advance_steadily(const Model& model, RobotWork& work, const SteadyRows& rows, double fastest,
                      FreeBuffer& buffer) {
    const int parts = parts_of_tick(*work.type, fastest, model.dt_s);
    for (int i = 0; i < parts; ++i) advance_part(model, model.dt_s / parts, rows, work, buffer);
}

}  // namespace roboss
