// See sleep.h.
#include "physics/sleep.h"

#include <algorithm>
#include <cmath>

#include "onboard/onboard.h"
#include "physics/bonds/bond_keeper.h"
#include "physics/contact/surface_motion.h"
#include "physics/dynamics/dynamics.h"

namespace roboss {
namespace {

constexpr double kRestJoint = 1e-2;      // rad/s or m/s
constexpr double kRestTime = 0.5;        // s
constexpr double kTargetReached = 1e-4;  // rad or m
constexpr double kServoStill = 1e-5;  // rad/s or m/s: a servo off its target that moves no faster has stopped
constexpr double kTouching = 1e-3;    // m: what is nearer counts as touched when falling asleep
constexpr double kReach = 2e-3;       // m: a moving robot this near wakes

std::uint32_t index_of(std::span<const RobotWork> robots, const WakeBuffers& buffers, std::uint32_t id) {
    const std::uint32_t i = id < buffers.place_of.size() ? buffers.place_of[id] : RobotId::kNone;
    return i < robots.size() && robots[i].id.value == id ? i : RobotId::kNone;
}

void note_places(std::span<const RobotWork> robots, WakeBuffers& buffers) {
    const std::size_t size = robots.empty() ? 0 : robots.back().id.index() + 1;
    if (buffers.place_of.size() < size) buffers.place_of.resize(size, RobotId::kNone);
    for (std::size_t i = 0; i < robots.size(); ++i)
        buffers.place_of[robots[i].id.index()] = static_cast<std::uint32_t>(i);
}

/// Wakes the sleeper and all that are joined to it by frozen edges.
void wake_from(const Model& model, std::span<RobotWork> robots, std::uint32_t first, WakeBuffers& buffers) {
    buffers.stack.assign(1, first);
    while (!buffers.stack.empty()) {
        RobotWork& work = robots[buffers.stack.back()];
        buffers.stack.pop_back();
        if (!work.asleep) continue;
        for (const std::uint32_t id : work.state->rest.neighbours)
            if (const std::uint32_t i = index_of(robots, buffers, id);
                i != RobotId::kNone && robots[i].asleep)
                buffers.stack.push_back(i);
        work.state->rest = {};
        place_robot(model, work.id, *work.state, work);
    }
}

/// A robot it touched is gone, or awake.
bool lost_a_neighbour(std::span<const RobotWork> robots, const RobotWork& sleeper,
                      const WakeBuffers& buffers) {
    return std::any_of(
        sleeper.state->rest.neighbours.begin(), sleeper.state->rest.neighbours.end(), [&](std::uint32_t id) {
            const std::uint32_t i = index_of(robots, buffers, id);
            if (i == RobotId::kNone) return true;
            return wakes_neighbours(*robots[i].type, *robots[i].state, robots[i].asleep, robots[i].ordered);
        });
}

Vec3 velocity_at(const RobotWork& robot, int body, const Vec3& p_W) {
    const Spatial& v = body < 0 ? robot.base : robot.bodies[static_cast<std::size_t>(body)].velocity;
    return v.linear + cross(v.angular, p_W - robot.origin);
}

/// Whether the awake robot will touch the sleeper in this tick; one that moves, or was moved, counts from
/// afar.
bool will_touch(const Model& model, std::span<RobotWork> robots, std::uint32_t awake, std::uint32_t sleeper,
                ContactFinder& finder, WakeBuffers& buffers) {
    const RobotWork& mover = robots[awake];
    if (mover.type->nv == 0 && !mover.ordered && is_zero(mover.base)) return false;
    RobotWork& work = robots[sleeper];
    if (!work.placed) {
        place_robot(model, work.id, *work.state, work);
        work.asleep = true;
    }
    const bool moves = mover.ordered || mover.state->rest.still_ticks == 0;
    buffers.contacts.clear();
    finder.with_robot(model, robots, std::min(awake, sleeper), std::max(awake, sleeper), buffers.contacts);
    return std::any_of(buffers.contacts.begin(), buffers.contacts.end(), [&](const Contact& c) {
        const bool mover_is_a = static_cast<std::uint32_t>(c.robot_a) == awake;
        const Vec3 v = velocity_at(mover, mover_is_a ? c.body_a : c.body_b, c.p_W) +
                       gravity_of(model, *mover.type) * model.dt_s;
        const double apart = dot(c.normal, v) * (mover_is_a ? 1.0 : -1.0);
        return c.gap + model.dt_s * apart < (moves ? kReach : 0.0);
    });
}

bool any_sleeps(std::span<const RobotWork> robots) {
    return std::ranges::any_of(robots, [](const RobotWork& work) { return work.asleep; });
}

/// True if any was.
bool wake_touched_once(const Model& model, std::span<RobotWork> robots, ContactFinder& finder,
                       WakeBuffers& buffers) {
    bool woken = false;
    for (const auto& [a, b] : finder.pairs()) {
        if (robots[a].asleep == robots[b].asleep) continue;
        const std::uint32_t sleeper = robots[a].asleep ? a : b, awake = robots[a].asleep ? b : a;
        if (!will_touch(model, robots, awake, sleeper, finder, buffers)) continue;
        wake_from(model, robots, sleeper, buffers);
        woken = true;
    }
    return woken;
}

/// A servo need not be at its target: gravity makes one with gains droop, and something may stand in its way.
/// Then it has to stand still, so that none that approaches slowly is stopped before it arrives.
bool motor_rests(const Dof& dof, const MotorSetpoint& motor, double q, double v) {
    switch (motor.mode) {
        case MotorMode::kPassive:
            return true;
        case MotorMode::kVelocity:
        case MotorMode::kEffort:
            return motor.target == 0;
        case MotorMode::kPosition:
            return std::fabs(v) <= kServoStill ||
                   std::fabs(std::clamp(motor.target, dof.lower, dof.upper) - q) <= kTargetReached;
    }
    return false;
}

/// rad/s or m/s: the speed that the joint could gain within the time of rest if its dampers let go, beside
/// the one that it has. Dampers that slow a joint down do not hold it: it creeps on for ever, and would be
/// left hanging.
double speed_undamped(const Dof& dof, const MotorSetpoint& motor, double v) {
    const bool motor_damps = motor.mode == MotorMode::kVelocity || motor.mode == MotorMode::kPosition;
    const double damping = dof.damping + (motor_damps ? dof.velocity_gain : 0);
    return std::fabs(v) * (1 + kRestTime * damping * dof.inverse_inertia);
}

bool moves_slowly(const RobotWork& work) {
    if (work.speed > kRestSpeed) return false;
    for (const BodyWork& body : work.bodies)
        if (norm(body.velocity.linear + cross(body.velocity.angular, body.centre)) > kRestSpeed) return false;
    return true;
}

bool joints_rest(const RobotWork& work) {
    const RobotType& type = *work.type;
    double fastest = 0;
    const std::span<const Dof> dofs = work.type->dofs;
    for (std::size_t d = 0; d < dofs.size(); ++d) {
        const Body& body = type.bodies[static_cast<std::size_t>(dofs[d].body)];
        const double v = work.state->v[d + static_cast<std::size_t>(type.base_nv())];
        if (speed_undamped(dofs[d], work.state->motors[d], v) > kRestJoint) return false;
        fastest = std::max(fastest, std::fabs(v));
        const double q = work.state->q[static_cast<std::size_t>(body.q_index)];
        if (!motor_rests(dofs[d], work.state->motors[d], q, v)) return false;
    }
    // motors of joints that close loops: their coordinate is not in q
    const std::vector<MotorSetpoint>& motors = work.state->motors;
    return std::all_of(motors.begin() + static_cast<std::ptrdiff_t>(type.dofs.size()), motors.end(),
                       [&](const MotorSetpoint& m) {
                           if (m.mode == MotorMode::kPosition) return fastest <= kServoStill;
                           return m.mode == MotorMode::kPassive || m.target == 0;
                       });
}

/// m/s, of a body that turned from one attitude to another within `dt` by little: the speed at `radius`.
double speed_of_turn(const Mat3& from, const Mat3& to, double radius, double dt) {
    const Vec3 a = to.r0 - from.r0, b = to.r1 - from.r1, c = to.r2 - from.r2;
    return std::sqrt(0.5 * (norm_squared(a) + norm_squared(b) + norm_squared(c))) * radius / dt;
}

/// True if the tick moved no point of the robot faster than `most`, and turned no joint faster than joints at
/// rest turn. The poses at the beginning of the tick, in `work`, against those of the coordinates at its end:
/// whatever moves a robot counts, also what gives it no velocity. `after` is overwritten.
bool stays_put(const RobotWork& work, double dt, double most, RobotWork& after) {
    const RobotType& type = *work.type;
    forward_kinematics<double>(type, work.state->q, after);
    for (std::size_t b = 0; b < type.bodies.size(); ++b) {
        const BodyWork &from = work.bodies[b], &to = after.bodies[b];
        const Vec3 moved = (after.origin - work.origin) + (to.centre - from.centre);
        if (norm(moved) > most * dt) return false;
        if (type.bodies[b].joint == JointKind::kFree) continue;
        if (speed_of_turn(from.X_WB.R, to.X_WB.R, 1, dt) > kRestJoint) return false;
    }
    for (std::size_t s = 0; s < type.shapes.size(); ++s) {
        const BodyShape& shape = type.shapes[s];
        if (shape.body < 0) continue;
        const Transform &from = work.shapes[s].X_WS,
                        &X_WB = after.bodies[static_cast<std::size_t>(shape.body)].X_WB;
        const Transform to = X_WB * shape.X_BS;
        const double radius = bounding_radius(shape.shape);
        const double turn = std::isfinite(radius) ? speed_of_turn(from.R, to.R, radius, dt) : 0;
        if (norm(to.p - from.p) + turn * dt > most * dt) return false;
    }
    return true;
}

/// The greatest speed that counts as rest in the tick, m/s: less where a contact still recovers, by surfaces
/// so slow that this would else count as rest.
double rest_speed(std::span<Contact* const> contacts, std::span<const SurfacePair> surfaces, double dt) {
    constexpr double kShare = 0.5;  // of the speed of recovery
    double speed = kRestSpeed;
    for (std::size_t c = 0; c < std::min(contacts.size(), surfaces.size()); ++c) {
        const Contact& contact = *contacts[c];
        const double recovery = surfaces[c].correction_speed;
        if (recovery * kShare >= speed || recovery == 0 || contact.gap >= 0) continue;
        const bool recovers = surfaces[c].softness.stiffness > 0
                                  ? contact.load < contact.impulse  // its spring has not taken all over yet
                                  : -contact.gap - surfaces[c].slop > recovery * dt;
        if (recovers) speed = kShare * recovery;
    }
    return speed;
}

/// The facts that the members of an island share in a tick.
struct IslandRest {
    bool is_held = false;      // something holds the island
    double dt = 0, speed = 0;  // s, m/s: what is no faster rests
    RobotWork& buffer;
};

bool is_at_rest(const RobotWork& work, const IslandRest& island) {
    const bool is_held =
        work.held && (work.pushed || !work.type->free_base || (work.bonded && island.is_held));
    return work.type->may_sleep && is_held && !work.ordered && work.state->wrenches.empty() &&
           work.state->surfaces.empty() && moves_slowly(work) && joints_rest(work) &&
           onboard_rests(*work.type, *work.state) && stays_put(work, island.dt, island.speed, island.buffer);
}

void fall_asleep(const Model& model, std::span<RobotWork> robots, std::span<const std::uint32_t> members,
                 std::span<Contact* const> contacts, std::span<const HeldBond> bonds) {
    for (const Contact* c : contacts)
        if (c->impulse > 0 && c->gap > kTouching) return;  // about to touch
    for (const std::uint32_t m : members) {
        place_robot(model, robots[m].id, *robots[m].state, robots[m]);
        if (!moves_slowly(robots[m])) return;
    }
    for (const std::uint32_t m : members) {
        if (robots[m].type->nv == 0) continue;
        RobotState& state = *robots[m].state;
        std::fill(state.v.begin(), state.v.end(), 0.0);
        place_robot(model, robots[m].id, state, robots[m]);
        state.rest.asleep = true;
        state.rest.bound = robots[m].box;
    }
    const auto add = [&](auto of, auto other) {
        RobotWork& work = robots[static_cast<std::size_t>(of)];
        if (work.type->nv > 0)
            work.state->rest.neighbours.push_back(robots[static_cast<std::size_t>(other)].id.value);
    };
    for (const HeldBond& bond : bonds) {
        if (bond.other == HeldBond::kScenery) continue;
        add(bond.holder, bond.other);
        add(bond.other, bond.holder);
    }
    for (const Contact* c : contacts) {
        if (c->robot_b < 0 || c->robot_b == c->robot_a || (c->impulse <= 0 && c->gap > kTouching)) continue;
        add(c->robot_a, c->robot_b);
        add(c->robot_b, c->robot_a);
    }
    for (const Contact* c : contacts) {
        if (c->robot_b >= 0 || (c->impulse <= 0 && c->gap > kTouching)) continue;
        if (const RobotWork* driver = driver_of(robots, model.statics[c->shape_b]))
            add(c->robot_a, static_cast<int>(driver - robots.data()));
    }
    for (const std::uint32_t m : members) {
        std::vector<std::uint32_t>& edges = robots[m].state->rest.neighbours;
        std::sort(edges.begin(), edges.end());
        edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    }
}

}  // namespace

void wake_left(const Model& model, std::span<RobotWork> robots, WakeBuffers& buffers) {
    if (!any_sleeps(robots)) return;
    note_places(robots, buffers);
    for (std::uint32_t i = 0; i < robots.size(); ++i)
        if (robots[i].asleep && lost_a_neighbour(robots, robots[i], buffers))
            wake_from(model, robots, i, buffers);
}

void wake_sleeper(const Model& model, std::span<RobotWork> robots, std::uint32_t sleeper,
                  WakeBuffers& buffers) {
    note_places(robots, buffers);
    wake_from(model, robots, sleeper, buffers);
}

void wake_touched(const Model& model, std::span<RobotWork> robots, ContactFinder& finder,
                  WakeBuffers& buffers) {
    if (!any_sleeps(robots)) return;
    // The woken may touch others; pairs of two sleepers were left out.
    while (wake_touched_once(model, robots, finder, buffers)) finder.find_pairs(robots);
}

void settle_island(const Model& model, std::span<RobotWork> robots, std::span<const std::uint32_t> members,
                   std::span<Contact* const> contacts, std::span<const SurfacePair> surfaces,
                   std::span<const HeldBond> bonds, RobotWork& buffer) {
    if (!model.sleep) return;
    const bool holds =
        std::ranges::any_of(
            members, [&](std::uint32_t m) { return robots[m].pushed || !robots[m].type->free_base; }) ||
        std::ranges::any_of(bonds, [](const HeldBond& b) { return b.other == HeldBond::kScenery; });
    const IslandRest island{holds, model.dt_s, rest_speed(contacts, surfaces, model.dt_s), buffer};
    const auto enough = static_cast<std::uint32_t>(std::ceil(kRestTime / model.dt_s));
    bool all = std::ranges::none_of(contacts,
                                    [&](const Contact*c) {
                                        return (c->impulse > 0 || c->gap <= kTouching) &&
                                               has_motion(model, robots, *c);
                                    }),
         any = false;
    for (const std::uint32_t m : members) {
        if (robots[m].type->nv == 0) continue;
        Rest& rest = robots[m].state->rest;
        rest.still_ticks = is_at_rest(robots[m], island) ? std::min(rest.still_ticks + 1, enough) : 0;
        all = all && rest.still_ticks == enough;
        any = true;
    }
    if (all && any) fall_asleep(model, robots, members, contacts, bonds);
}

}  // namespace roboss
