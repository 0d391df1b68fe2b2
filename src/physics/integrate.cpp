// Coordinates and their rates; quaternions are integrated as four numbers with q' = 1/2 w q and normalised,
// which keeps the method's order (Hairer, Lubich, Wanner 2006, IV.4: projection after the step).
#include "physics/integrate.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "physics/tree_factor.h"

namespace roboss {
namespace {

Quat get_quat(std::span<const double> q, std::size_t i) {
    return {q[i], q[i + 1], q[i + 2], q[i + 3]};
}

void put_quat(std::span<double> q, std::size_t i, const Quat& x) {
    q[i] = x.w, q[i + 1] = x.x, q[i + 2] = x.y, q[i + 3] = x.z;
}

Quat quat_rate(const Vec3& w, const Quat& q) {
    const Quat r = Quat{0, w.x, w.y, w.z} * q;
    return {0.5 * r.w, 0.5 * r.x, 0.5 * r.y, 0.5 * r.z};
}

Vec3 get_vec(std::span<const double> v, std::size_t i) {
    return {v[i], v[i + 1], v[i + 2]};
}

/// dq/dt of all coordinates; `rate` has the size of q.
void coordinate_rate(const RobotType& type, std::span<const double> q, std::span<const double> v,
                     std::span<double> rate) {
    std::fill(rate.begin(), rate.end(), 0.0);
    for (const Body& body : type.bodies) {
        const auto i = static_cast<std::size_t>(body.q_index);
        const auto k = static_cast<std::size_t>(body.v_index);
        if (body.joint == JointKind::kFree) {
            for (std::size_t a = 0; a < 3; ++a) rate[a] = v[k + 3 + a];
            put_quat(rate, 3, quat_rate(get_vec(v, k), get_quat(q, 3)));
        } else if (body.joint == JointKind::kBall) {
            put_quat(rate, i, quat_rate(get_vec(v, k), get_quat(q, i)));
        } else {
            rate[i] = v[k];
        }
    }
}

void normalise(const RobotType& type, std::span<double> q) {
    for (const Body& body : type.bodies) {
        if (body.joint == JointKind::kFree) put_quat(q, 3, normalized(get_quat(q, 3)));
        const auto i = static_cast<std::size_t>(body.q_index);
        if (body.joint == JointKind::kBall) put_quat(q, i, normalized(get_quat(q, i)));
    }
}

/// Adds what loops and couplings accelerate: so much that their second derivatives are zero.
void add_equality_acceleration(FreeBuffer& free, std::span<const double> q) {
    RobotWork& work = free.work;
    const RobotType& type = *work.type;
    gather_equalities(work, q, free.equalities);
    free.solver.prepare(type, work.mass_matrix, free.equalities);
    free.wanted.clear();
    for (const EqualityRow& row : free.equalities.rows)
        free.wanted.push_back(-row.curvature - times_row(free.equalities, row, work.velocity));
    free.change.resize(work.velocity.size());
    free.solver.solve(free.wanted, free.change);
    for (std::size_t i = 0; i < free.change.size(); ++i) work.velocity[i] += free.change[i];
}

/// Acceleration of the free robot at (q, v), explicit damping included, into its work's velocity.
void free_acceleration(const Model& model, std::span<const double> q, std::span<const double> v,
                       FreeBuffer& free) {
    RobotWork& buffer = free.work;
    const RobotType& type = *buffer.type;
    place_bodies<double>(type, q, buffer);
    move_bodies<double>(type, v, buffer);
    compute_impulse(model, 1.0, 0.0, q, v, buffer);
    compute_mass_matrix<double>(type, 0.0, buffer);
    for (std::size_t d = 0; d < type.dofs.size(); ++d) {
        const std::size_t i = d + static_cast<std::size_t>(type.base_nv());
        buffer.impulse[i] -= type.dofs[d].damping * v[i];
    }
    tree_factor(type.paths, buffer.mass_matrix.data());
    buffer.velocity = buffer.impulse;
    tree_solve(type.paths, buffer.mass_matrix.data(), buffer.velocity.data());
    if (type.has_equalities()) add_equality_acceleration(free, q);
}

/// Into so many parts the tick is cut: no body turns further than half a radian in one, for beyond
/// that the method loses the motion, and far beyond its stability.
int parts_of_tick(const RobotWork& work, double dt) {
    constexpr double kTurnMax = 0.5, kPartsMax = 64;
    double fastest = 0;
    for (const BodyWork& body : work.bodies) fastest = std::max(fastest, norm_squared(body.velocity.angular));
    return static_cast<int>(std::ceil(std::clamp(std::sqrt(fastest) * dt / kTurnMax, 1.0, kPartsMax)));
}

/// One step of the method, of length `dt`.
void advance_part(const Model& model, double dt, RobotWork& work, FreeBuffer& buffer) {
    const RobotType& type = *work.type;
    RobotState& state = *work.state;
    constexpr std::array<double, 4> kAt{0.0, 0.5, 0.5, 1.0};
    constexpr std::array<double, 4> kWeight{1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    const std::size_t nq = state.q.size(), nv = state.v.size();
    for (auto* sized_q : {&buffer.q, &buffer.q_rate, &buffer.q_sum}) sized_q->assign(nq, 0.0);
    for (auto* sized_v : {&buffer.v, &buffer.v_rate, &buffer.v_sum}) sized_v->assign(nv, 0.0);
    buffer.work.type = work.type;
    buffer.work.state = work.state;
    for (std::size_t stage = 0; stage < 4; ++stage) {
        const double h = dt * kAt[stage];
        for (std::size_t i = 0; i < nq; ++i) buffer.q[i] = state.q[i] + h * buffer.q_rate[i];
        for (std::size_t i = 0; i < nv; ++i) buffer.v[i] = state.v[i] + h * buffer.v_rate[i];
        normalise(type, buffer.q);
        coordinate_rate(type, buffer.q, buffer.v, buffer.q_rate);
        free_acceleration(model, buffer.q, buffer.v, buffer);
        buffer.v_rate = buffer.work.velocity;
        for (std::size_t i = 0; i < nq; ++i) buffer.q_sum[i] += kWeight[stage] * buffer.q_rate[i];
        for (std::size_t i = 0; i < nv; ++i) buffer.v_sum[i] += kWeight[stage] * buffer.v_rate[i];
    }
    for (std::size_t i = 0; i < nq; ++i) state.q[i] += dt * buffer.q_sum[i];
    for (std::size_t i = 0; i < nv; ++i) state.v[i] += dt * buffer.v_sum[i];
    normalise(type, state.q);
    if (!type.has_equalities()) return;
    buffer.projection.close_coordinates(type, state.q);
    buffer.projection.close_velocities(type, state.q, state.v);
}

}  // namespace

void advance_freely(const Model& model, RobotWork& work, FreeBuffer& buffer) {
    const int parts = parts_of_tick(work, model.dt_s);
    for (int i = 0; i < parts; ++i) advance_part(model, model.dt_s / parts, work, buffer);
}

}  // namespace roboss
