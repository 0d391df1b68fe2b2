// See kick_drift.h.
#include "physics/dynamics/kick_drift.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "physics/dynamics/axis_rows.h"
#include "physics/dynamics/fast_turning.h"
#include "physics/dynamics/fluid_forces.h"
#include "physics/dynamics/lone_body.h"
#include "physics/dynamics/tree_factor.h"

namespace roboss {
namespace {

constexpr double kTurnMost = 16;  // rad in a tick
constexpr double kGrowth = 2e-5;  // 1/s: of the kinetic energy, left to the method's errors of either sign

/// Where the centre of mass comes to (from the origin), and the momentum about the origin.
struct FreeCourse {
    Vec3 centre;
    Spatial momentum;
};

/// One robot's tick.
class KickDrift {
  public:
    KickDrift(const Model& model, const SolvedTick& solved, RobotWork& work, FreeBuffer& buffer)
        : model_(model), solved_(solved), work_(work), buffer_(buffer) {
        buffer_.work.take(*work.type, *work.state);
    }

    /// Where no row acts at the beginning.
    void fly() {
        const BodySums before = sums();
        fastest_ = fastest_turn(work_);
        if (is_too_fast(fastest_)) return spin_on(before);
        start();
        advance_steadily(model_, work_, {}, fastest_, buffer_);
        stop_at_passed_limits();
        finish(before);
    }

    /// Where rows act. The first attempt may pass a limit, which the solver did not know of, or may gain
    /// energy, because a joint that moves as solved works against forces that the solver took at the
    /// beginning.
    Vec3 advance() {
        const BodySums before = sums();
        start();
        attempt();
        stop_at_passed_limits();
        if (is_far_off(before)) {
            take_solution();
        } else {
            finish(before);
            shift();
        }
        return gained_;
    }

  private:
    static constexpr int kLimitRounds = 3;
    static constexpr double kMoreByShift = 1.01;  // times the kinetic energy about the centre of mass

    /// True where nothing may add to the robot's energy.
    bool keeps_energy() const { return solved_.isolated && solved_.passive; }
    bool rows_act() const { return !solved_.velocity.empty(); }
    BodySums sums() { return sum_bodies(model_, state_.q, state_.v, origin_, buffer_.work, &buffer_.walk); }
    std::size_t dof_index(std::size_t d) const { return d + static_cast<std::size_t>(type_.base_nv()); }

    void start() {
        HeldJoints& held = buffer_.held;
        held.locked.assign(solved_.locked.begin(), solved_.locked.end());
        held.velocity.assign(solved_.held.begin(), solved_.held.end());
        held.locked.resize(state_.v.size()), held.velocity.resize(state_.v.size());
        held.q_start = state_.q, held.v_start = state_.v;
    }
    void stop_at_passed_limits() {
        for (int i = 0; i < kLimitRounds && stop_at_limits(); ++i) attempt_again();
    }
    /// Keeps momentum and energy as they have to be; the last resorts cost relative motion of the links.
    void finish(const BodySums& before) {
        bool kept = guard(before);
        if (!kept && hold_still()) {
            attempt_again();
            kept = guard(before);
        }
        if (kept) return;
        hold_all();
        attempt_again();
        guard(before);
    }

    void attempt() {
        kick();
        if (!keeps_energy()) kicked_ = sums();
        drift();
    }
    void attempt_again() {
        state_.q = buffer_.held.q_start, state_.v = buffer_.held.v_start;
        buffer_.walk.place(type_, state_.q, work_);
        attempt();
    }

    /// Velocities right after the kick: those of locked joints as they are to be, the others by the kick and
    /// by how the locked ones move them.
    void kick() {
        const DofPaths& paths = type_.paths;
        const HeldJoints& held = buffer_.held;
        const std::size_t nv = state_.v.size();
        buffer_.work.bodies = work_.bodies, buffer_.work.axes = work_.axes,
        buffer_.work.origin = work_.origin;
        compute_inertias(type_, buffer_.work);
        compute_mass_matrix<double>(type_, 0.0, buffer_.work);
        std::vector<double>&mass_matrix = buffer_.work.mass_matrix, &change = buffer_.change,
        &by_locked = buffer_.wanted, &jump = buffer_.v;
        jump.assign(nv, 0.0), by_locked.resize(nv), change.resize(nv);
        for (std::size_t i = 0; i < nv; ++i)
            if (held.locked[i]) jump[i] = held.velocity[i] - state_.v[i];
        tree_times(paths, mass_matrix.data(), jump.data(), by_locked.data());
        for (std::size_t i = 0; i < nv; ++i)
            change[i] = held.locked[i] ? jump[i] : (rows_act() ? solved_.kick[i] : 0.0) - by_locked[i];
        lock_rows(paths, held.locked, mass_matrix.data());
        tree_factor(paths, mass_matrix.data());
        tree_solve(paths, mass_matrix.data(), change.data());
        for (std::size_t i = 0; i < nv; ++i)
            state_.v[i] = held.locked[i] ? held.velocity[i] : state_.v[i] + change[i];
        if (type_.has_equalities())
            buffer_.projection.close_velocities(work_, state_.q, state_.v, held.locked);
    }

    void drift() {
        fastest_ = 0;
        const std::vector<double>& before = buffer_.held.v_start;
        for (const std::span<const double> v :
             {std::span(before), rows_act() ? solved_.velocity : std::span(before),
              std::span<const double>(state_.v)}) {
            buffer_.walk.move(type_, v, work_);
            fastest_ = std::max(fastest_, fastest_turn(work_));
        }
        buffer_.force.assign(solved_.load.begin(), solved_.load.end());
        for (double& x : buffer_.force) x /= model_.dt_s;
        if (rows_act()) add_stiff_forces();
        advance_steadily(model_, work_, {buffer_.force, buffer_.held.locked, true}, fastest_, buffer_);
    }

    /// Stiff springs and dampings as the solver took them: at the end of the tick.
    void add_stiff_forces() {
        for (std::size_t d = 0; d < type_.dofs.size(); ++d) {
            const Dof& dof = work_.type->dofs[d];
            if (!is_stiff(dof, model_.dt_s)) continue;
            const double rate = solved_.velocity[dof_index(d)];
            double& force = buffer_.force[dof_index(d)];
            force -= dof.damping * rate;
            if (dof.spring_stiffness == 0) continue;
            const double q = state_.q[static_cast<std::size_t>(body_of(dof).q_index)];
            force -= dof.spring_stiffness * (q - dof.spring_reference + model_.dt_s * rate);
        }
    }

    /// True where a body turns further than the method can follow.
    bool is_too_fast(double fastest) const {
        return !(fastest * model_.dt_s * model_.dt_s < kTurnMost * kTurnMost);
    }

    /// Velocities stay but for what gravity adds: about its axis of rotation a body keeps its energy.
    void spin_on(const BodySums& before) {
        if (type_.free_base) add_rigid_motion({{}, gravity_ * model_.dt_s}, origin_, 1.0, state_);
        advance_coordinates<double>(type_, state_.v, model_.dt_s, state_.q);
        if (type_.has_equalities()) buffer_.projection.close_coordinates(work_, state_.q);
        if (!type_.dofs.empty()) guard(before);
    }

    /// True where the drift is no better than the solution: a body turns further than the method can follow,
    /// or large loads or kicks (jammed limbs between strong motors) have carried it away.
    bool is_far_off(const BodySums& before) {
        constexpr double kMoreByKick = 2, kMoreByDrift = 1.2;  // times the kinetic energy
        if (is_too_fast(fastest_)) return true;
        if (keeps_energy()) return false;
        const double solution =
            sum_bodies(model_, buffer_.held.q_start, solved_.velocity, origin_, buffer_.work, &buffer_.walk)
                .kinetic;
        if (!(kicked_.kinetic <= kMoreByKick * std::max(before.kinetic, solution))) return true;
        const BodySums now = sums();
        return !(now.energy() <= kMoreByDrift * std::max(kicked_.kinetic, solution) + kicked_.potential);
    }

    /// The explicit step: the solved velocities and displacement.
    void take_solution() {
        state_.q = buffer_.held.q_start;
        std::copy(solved_.velocity.begin(), solved_.velocity.end(), state_.v.begin());
        advance_coordinates<double>(type_, solved_.displacement, model_.dt_s, state_.q);
        if (type_.has_equalities()) buffer_.projection.close_coordinates(work_, state_.q);
    }

    const Body& body_of(const Dof& dof) const { return type_.bodies[static_cast<std::size_t>(dof.body)]; }

    /// Joints that passed a hard or stiff limit in the drift are locked: they come to the limit at the end of
    /// the tick, or less far if they were slower. False if none did.
    bool stop_at_limits() {
        constexpr double kSlop = 1e-9;  // rad or m
        HeldJoints& held = buffer_.held;
        const double dt = model_.dt_s;
        bool any = false;
        for (std::size_t d = 0; d < type_.dofs.size(); ++d) {
            const Dof& dof = work_.type->dofs[d];
            const Body& body = body_of(dof);
            const std::size_t i = dof_index(d);
            if (held.locked[i] || !joint_traits(body.joint).has_positions()) continue;
            if (dof.limit_stiffness * dt * dt * dof.inverse_inertia < 1) continue;
            const double q0 = held.q_start[static_cast<std::size_t>(body.q_index)];
            const double q1 = state_.q[static_cast<std::size_t>(body.q_index)], v0 = held.v_start[i];
            const bool above = q1 > std::max(dof.upper, q0) + kSlop,
                       below = q1 < std::min(dof.lower, q0) - kSlop;
            if (!above && !below) continue;
            const double room = (above ? std::max(dof.upper - q0, 0.0) : std::min(dof.lower - q0, 0.0)) / dt;
            held.velocity[i] = above ? std::min(room, std::max(v0, 0.0)) : std::max(room, std::min(v0, 0.0));
            held.locked[i] = 1;
            any = true;
        }
        return any;
    }

    /// Locked joints that moved go to where they were to come at once, momentum unchanged, and stay there.
    /// Quasi-static motion of a stiff spring takes energy then. False if none moved.
    bool hold_still() {
        HeldJoints& held = buffer_.held;
        bool any = false;
        std::vector<double>& displacement = buffer_.wanted;
        displacement.assign(state_.v.size(), 0.0);
        for (std::size_t i = 0; i < displacement.size(); ++i) {
            if (!held.locked[i] || held.velocity[i] == 0) continue;
            displacement[i] = held.velocity[i], held.velocity[i] = 0;
            any = true;
        }
        if (!any) return false;
        state_.q = held.q_start, state_.v = held.v_start;
        const BodySums before = sums();
        advance_coordinates<double>(type_, displacement, model_.dt_s, state_.q);
        if (type_.has_equalities()) buffer_.projection.close_coordinates(work_, state_.q);
        BodySums after = sums();
        if (type_.free_base) set_course({before.centre(), before.momentum}, after);
        if (after.energy() <= before.energy()) held.q_start = state_.q, held.v_start = state_.v;
        return true;
    }

    /// The last resort: all joints stay for this tick, and a rigid body gains no energy.
    void hold_all() {
        HeldJoints& held = buffer_.held;
        for (std::size_t i = dof_index(0); i < held.locked.size(); ++i)
            held.locked[i] = 1, held.velocity[i] = 0;
    }

    /// Penetration recovery and what impacts inside the tick change in the displacement. Momentum
    /// stays, so a slender body that is turned would have to spin faster about its axis: such a turn is cut.
    void shift() {
        std::vector<double>& extra = buffer_.wanted;
        extra.resize(state_.v.size());
        bool any = false;
        for (std::size_t i = 0; i < extra.size(); ++i) {
            extra[i] = solved_.displacement[i] - solved_.velocity[i];
            any |= extra[i] != 0;
        }
        if (!any) return;
        if (!type_.free_base) return displace(1);
        if (solved_.flies_displaced) return fly_displaced();
        const BodySums before = sums();
        const Vec3 displacement = displaced().linear * (model_.dt_s / before.inertia.mass);
        gained_ = cross(displacement, before.momentum.linear);
        Spatial momentum = before.momentum;
        momentum.angular += gained_;
        HeldJoints& held = buffer_.held;
        held.q_start = state_.q, held.v_start = state_.v;
        for (const double share : {1.0, 0.25, 0.0}) {
            state_.q = held.q_start, state_.v = held.v_start;
            displace(share);
            BodySums now = sums();
            set_course({before.centre() + displacement, momentum}, now);
            if (keeps_energy()) limit(before.energy(), now);
            if (now.inner_kinetic() <= kMoreByShift * before.inner_kinetic()) return;
        }
    }

    /// The velocity of the base goes with it from that orientation to the present one.
    void turn_velocity(const Quat& from) {
        const Quat turn = get_quat(state_.q.data() + 3) * conjugate(from);
        const Vec3 angular = rotate(turn, {state_.v[0], state_.v[1], state_.v[2]});
        for (std::size_t i = 0; i < 3; ++i) state_.v[i] = angular[i];
    }

    /// A lone body that something outside pushes goes the way of its displacement as it would fly with that
    /// as its velocity, and has the velocity of the drift. Far turns about two axes one after the other would
    /// lead elsewhere, and back from a hit to anywhere.
    void fly_displaced() {
        const Body& body = type_.bodies[0];
        const Vec3 arm = rotate(get_quat(buffer_.held.q_start.data() + 3), body.p_BC);
        const std::span<const double> d = solved_.displacement;
        const Vec3 angular{d[0], d[1], d[2]}, linear{d[3], d[4], d[5]};
        if (is_too_fast(norm_squared(angular))) return displace(1);
        const Quat drifted = get_quat(state_.q.data() + 3);
        const Vec3 w{state_.v[0], state_.v[1], state_.v[2]};
        const Vec3 velocity =
            Vec3{state_.v[3], state_.v[4], state_.v[5]} + cross(w, rotate(drifted, body.p_BC));
        Vec3 centre = arm + (linear + cross(angular, arm)) * model_.dt_s;
        for (std::size_t i = 0; i < 3; ++i) centre[i] += buffer_.held.q_start[i];
        state_.q = buffer_.held.q_start;
        state_.v.assign(d.begin(), d.end());
        advance_steadily(model_, work_, {}, norm_squared(angular), buffer_);
        for (std::size_t i = 0; i < 3; ++i) state_.v[i] = w[i];
        turn_velocity(drifted);
        const Vec3 turned = rotate(get_quat(state_.q.data() + 3), body.p_BC),
                   moving = velocity - cross({state_.v[0], state_.v[1], state_.v[2]}, turned);
        for (std::size_t i = 0; i < 3; ++i) state_.q[i] = centre[i] - turned[i], state_.v[3 + i] = moving[i];
    }

    /// Turns and bends the robot by a share of the extra displacement.
    void displace(double share) {
        advance_coordinates<double>(type_, buffer_.wanted, share * model_.dt_s, state_.q);
        if (type_.has_equalities()) buffer_.projection.close_coordinates(work_, state_.q);
    }

    /// The momentum that the extra displacement over dt would have as a velocity, at the beginning of the
    /// tick.
    Spatial displaced() {
        const std::vector<double>& extra = buffer_.wanted;
        return sum_bodies(model_, buffer_.held.q_start, extra, origin_, buffer_.work, &buffer_.walk).momentum;
    }

    /// What the drift loses of momentum, and gains of energy, is put right. False if too much energy remains.
    bool guard(const BodySums& before) {
        const std::optional<FreeCourse> course = course_of(before);
        if (!course && !keeps_energy()) return true;
        BodySums now = sums();
        if (!std::isfinite(now.energy())) return false;  // joints held through a dead point of a loop
        if (course) set_course(*course, now);
        return !keeps_energy() || limit(before.energy() + kGrowth * model_.dt_s * before.kinetic, now);
    }

    /// The base's part of a generalised impulse of rows: what they push from outside, about the origin.
    Spatial outer(std::span<const double> impulse) const {
        if (impulse.empty()) return {};
        return {{impulse[0], impulse[1], impulse[2]}, {impulse[3], impulse[4], impulse[5]}};
    }

    /// The course of a robot on which contacts and gravity are all that acts from outside: kicks act at the
    /// beginning, loads evenly, and the torque of the weight is integrated along the parabola.
    std::optional<FreeCourse> course_of(const BodySums& before) const {
        if (!type_.free_base || !state_.wrenches.empty() || !type_.drags.empty() || type_.feels_flow)
            return std::nullopt;
        if (gravity_ != Vec3{})
            for (const Body& body : type_.bodies)
                if (body.gravity_mass != body.mass) return std::nullopt;
        const double dt = model_.dt_s, mass = before.inertia.mass;
        const Spatial kick = outer(solved_.kick), load = outer(solved_.load);
        const Vec3 weight = gravity_ * mass;
        const Vec3 velocity = (before.momentum.linear + kick.linear) * (1.0 / mass);
        const Vec3 acceleration = gravity_ + load.linear * (1.0 / (mass * dt));
        const Vec3 centre = before.centre();
        const Vec3 arm = centre * dt + velocity * (0.5 * dt * dt);
        Spatial momentum = before.momentum + kick + load;
        momentum += Spatial{cross(arm, weight), weight * dt};
        return FreeCourse{centre + velocity * dt + acceleration * (0.5 * dt * dt), momentum};
    }

    /// Moves the robot as a whole onto the course; `now` are its sums.
    void set_course(const FreeCourse& course, BodySums& now) {
        const Vec3 off = course.centre - now.centre();
        for (std::size_t i = 0; i < 3; ++i) state_.q[i] += off[i];
        translate(off, gravity_, now);
        BodySums lacks = now;
        lacks.momentum = {course.momentum.angular - now.momentum.angular,
                          course.momentum.linear - now.momentum.linear};
        Spatial missing;
        if (!lacks.rigid_motion(missing)) return;
        add_rigid_motion(missing, origin_, 1.0, state_);
        add_motion(missing, now);
    }

    /// Takes the energy beyond `most` out of the motion of the joints against each other: momentum stays. On
    /// a fixed base, out of all motion. False if more may remain.
    bool limit(double most, const BodySums& now) {
        const Slowdown slowdown = slowdown_to(most - now.potential, now, !type_.free_base);
        slowdown.apply(type_, origin_, state_);
        return slowdown.share > 0;
    }

    const Model& model_;
    const SolvedTick& solved_;
    RobotWork& work_;
    FreeBuffer& buffer_;
    const RobotType& type_ = *work_.type;
    const Vec3 gravity_ = gravity_of(model_, type_);
    RobotState& state_ = *work_.state;
    const Vec3 origin_ = work_.origin;
    BodySums kicked_;     // right after the kick
    double fastest_ = 0;  // (rad/s)^2
    Vec3 gained_;         // N m s, about any fixed point: by moving the centre of mass at once
};

/// True where the angular velocity of the base or the velocity of a joint changed by so much in one tick that
/// the method's error counts.
bool changed_suddenly(const Model& model, const RobotType& type, std::span<const double> before,
                      std::span<const double> now) {
    constexpr double kSudden = 1e-3;  // rad or m in a tick
    for (std::size_t i = 0; i < now.size(); ++i) {
        const bool is_linear = i >= 3 && i < static_cast<std::size_t>(type.base_nv());
        if (!is_linear && !(std::fabs(now[i] - before[i]) * model.dt_s < kSudden)) return true;
    }
    return false;
}

/// The step of a slow robot, without guards. False, and the robot stays, where that may lose momentum: where
/// the mass matrix is almost singular (a light link between heavy ones), joints whip round within a few
/// ticks, however slowly they turned before.
bool advance_unguarded(const Model& model, RobotWork& work, double fastest, FreeBuffer& buffer) {
    const RobotType& type = *work.type;
    RobotState& state = *work.state;
    const bool may_whip = type.free_base && !type.dofs.empty();
    HeldJoints& start = buffer.held;
    if (may_whip) start.q_start = state.q, start.v_start = state.v;
    advance_steadily(model, work, {}, fastest, buffer);
    if (!may_whip || !changed_suddenly(model, type, start.v_start, state.v)) return true;
    state.q = start.q_start, state.v = start.v_start;
    return false;
}

}  // namespace

bool is_passive(const Model& model, const RobotWork& work) {
    return !is_driven<double>(work.state->motors) && only_motors_drive(model, work);
}

bool only_motors_drive(const Model& model, const RobotWork& work) {
    const RobotType& type = *work.type;
    if (!work.state->wrenches.empty()) return false;
    if (type.feels_flow && !flow_takes_energy(model, work)) return false;
    for (const LinkDrag& drag : type.drags)
        if (drag.wind) return false;
    for (const LoopJoint& loop : type.loops)
        for (std::size_t k = 0; k < loop.dofs.size(); ++k) {
            const Dof& dof = loop.dofs[k];
            if (dof.spring_stiffness > 0 || std::isfinite(dof.limit_stiffness)) return false;
        }
    return true;
}

Vec3 advance_kick_drift(const Model& model, RobotWork& work, const SolvedTick& solved, FreeBuffer& buffer) {
    return KickDrift(model, solved, work, buffer).advance();
}

void advance_freely(const Model& model, RobotWork& work, FreeBuffer& buffer) {
    const double slow =
        work.type->dofs.empty() ? 0.005 : 0.02;  // rad in a tick: the methods' errors are small
    const double fastest = fastest_turn(work);
    if (is_lone_body(model, work) && fastest * model.dt_s * model.dt_s < kTurnMost * kTurnMost &&
        advance_lone_body(model, fastest, work))
        return;
    const bool is_slow = fastest * model.dt_s * model.dt_s < slow * slow;
    if (is_slow && !work.type->has_equalities() && advance_unguarded(model, work, fastest, buffer)) return;
    SolvedTick free;
    free.isolated = true;
    free.passive = is_passive(model, work);
    KickDrift(model, free, work, buffer).fly();
}

}  // namespace roboss
