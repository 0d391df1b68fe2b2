// See surface_motion.h.
#include "physics/contact/surface_motion.h"

#include <algorithm>

#include "physics/dynamics/fast_turning.h"

namespace roboss {
namespace {

SurfaceFlow placed(const SurfaceMotion& motion, const Transform& X_WL) {
    return {X_WL.R * motion.linear_L, X_WL.R * motion.angular_L, X_WL.R * motion.belt_L, X_WL.p};
}

const SurfaceMotion* find_motion(const RobotState& state, LinkId link) {
    const auto at = std::ranges::find(state.surfaces, link, &SurfaceMotion::link);
    return at == state.surfaces.end() ? nullptr : &*at;
}

const SurfaceMotion* motion_of(const RobotWork& robot, std::uint32_t shape) {
    if (robot.state->surfaces.empty()) return nullptr;
    const BodyShape& of_link = robot.type->shapes[shape];
    return of_link.moves || robot.type->kinematic ? find_motion(*robot.state, of_link.link) : nullptr;
}

Transform pose_of(const RobotWork& robot, LinkId link) {
    const Link& l = robot.type->links[link.index()];
    const Transform X_WB = l.body < 0 ? to_transform(base_pose(*robot.state))
                                      : robot.bodies[static_cast<std::size_t>(l.body)].X_WB;
    return X_WB * l.X_BL;
}

/// A side of a contact: its flow, and what else its velocity depends on.
struct Side {
    std::optional<SurfaceFlow> flow;
    const SurfaceMotion* motion = nullptr;
    bool solid = false;  // the body itself moves so: across its surface too
};

Side side_of(const Model& model, std::span<const RobotWork> robots, int robot, std::uint32_t shape) {
    if (robot < 0) {
        const StaticShape& scenery = model.statics[shape];
        const RobotWork* driver = driver_of(robots, scenery);
        return {flow_of(robots, scenery),
                driver == nullptr ? nullptr : find_motion(*driver->state, scenery.link), false};
    }
    const RobotWork& work = robots[static_cast<std::size_t>(robot)];
    return {flow_of(work, shape), motion_of(work, shape), work.type->kinematic};
}

/// Axis of the belt at p: with a centre of rotation it points away from that, so that the flow there is at
/// right angles to the line to it, as fast as ever.
Vec3 belt_at(const Side& side, const Vec3& p, const Vec3& outward) {
    const Vec3& belt = side.flow->belt;
    if (side.motion == nullptr || !side.motion->turns) return belt;
    Vec3 away = p - side.motion->centre_W;
    away = away - outward * dot(outward, away);
    const double distance = norm(away), along = dot(belt, away);
    if (!(distance > 1e-6) || along == 0) return {};
    return away * ((along < 0 ? -norm(belt) : norm(belt)) / distance);
}

/// Velocity of the surface at the contact point. What rides on a turning surface shall stay on its circle,
/// though it moves straight within a tick: so the velocity is that of the chord, for a rider at `rider`.
Vec3 velocity_at(const Side& side, const Vec3& p, const Vec3& outward, const Vec3& rider, double dt) {
    const SurfaceFlow& flow = *side.flow;
    Vec3 v = flow.linear + cross(belt_at(side, p, outward), outward);
    if (flow.angular != Vec3{}) {
        const Vec3& w = flow.angular;
        v = v + cross(w, p - flow.at) + cross(w, cross(w, rider - flow.at)) * (0.5 * dt);
    }
    return side.solid ? v : v - outward * dot(outward, v);
}

/// What moves straight within a tick: the origin of a free base. Elsewhere the body's centre of mass, or the
/// contact point where there is none.
Vec3 rider_at(std::span<const RobotWork> robots, int robot, int body, const Vec3& p) {
    if (robot < 0 || body < 0) return p;
    const RobotWork& work = robots[static_cast<std::size_t>(robot)];
    if (work.type->free_base) return work.origin;
    return work.origin + work.bodies[static_cast<std::size_t>(body)].centre;
}

/// A body of a robot in contact.
struct Partner {
    const RobotWork& robot;
    int body;
};

/// Whether one may carry the other: a robot with motors a lone body, one on a fixed base all that is free.
bool may_carry(const Partner& carrier, const Partner& rider) {
    const RobotType& type = *rider.robot.type;
    return carrier.body >= 0 && rider.body >= 0 && type.free_base &&
           (type.nv == 6 || !carrier.robot.type->free_base) && is_driven<double>(carrier.robot.state->motors);
}

/// m/s: by how much the velocity of the chord differs from that before the tick, at the origin of the rider's
/// base, which turns with the carrier. The carrier's own base moves straight, too, so that only what turns
/// about its origin counts. In part, where the rider turns along in part.
Vec3 chord(const Partner& carrier, const Partner& rider, double dt) {
    const BodyWork& link = carrier.robot.bodies[static_cast<std::size_t>(carrier.body)];
    const Vec3& w = link.velocity.angular;
    const Vec3& of_rider = rider.robot.bodies[static_cast<std::size_t>(rider.body)].velocity.angular;
    const double along = dot(w, of_rider);
    if (!(along > 0)) return {};
    const Vec3 arm = rider.robot.origin - carrier.robot.origin;
    const Vec3 acceleration =
        link.bias.linear + cross(link.bias.angular, arm) + cross(w, link.velocity.linear + cross(w, arm));
    return acceleration * (0.5 * dt * along / std::max(dot(w, w), dot(of_rider, of_rider)));
}

}  // namespace

std::optional<SurfaceFlow> flow_of(const RobotWork& robot, std::uint32_t shape) {
    const SurfaceMotion* motion = motion_of(robot, shape);
    if (motion == nullptr) return std::nullopt;
    return placed(*motion, pose_of(robot, motion->link));
}

const RobotWork* driver_of(std::span<const RobotWork> robots, const StaticShape& scenery) {
    if (!scenery.driven) return nullptr;
    const auto at = std::ranges::lower_bound(robots, scenery.robot, {}, &RobotWork::id);
    return at == robots.end() || at->id != scenery.robot ? nullptr : &*at;
}

std::optional<SurfaceFlow> flow_of(std::span<const RobotWork> robots, const StaticShape& scenery) {
    if (const RobotWork* driver = driver_of(robots, scenery)) {
        const SurfaceMotion* motion = find_motion(*driver->state, scenery.link);
        if (motion != nullptr) return placed(*motion, pose_of(*driver, scenery.link));
    }
    return scenery.flow.moves() ? std::optional(scenery.flow) : std::nullopt;
}

void add_motion(const Model& model, std::span<const RobotWork> robots, const Contact& c, SurfacePair& pair) {
    if (!has_motion(model, robots, c)) return;
    const Side a = side_of(model, robots, c.robot_a, c.shape_a);
    const Side b = side_of(model, robots, c.robot_b, c.shape_b);
    if (a.flow) {
        const Vec3 rider = rider_at(robots, c.robot_b, c.body_b, c.p_W);
        pair.velocity = velocity_at(a, c.p_W, -c.normal, rider, model.dt_s);
        pair.turning = a.flow->angular;
    }
    if (b.flow) {
        const Vec3 p = c.p_W + c.shift_b, rider = rider_at(robots, c.robot_a, c.body_a, p);
        pair.velocity = pair.velocity - velocity_at(b, p, c.normal, rider, model.dt_s);
        pair.turning = pair.turning - b.flow->angular;
    }
}

void add_carrying(const Model& model, std::span<const RobotWork> robots, const Contact& c,
                  SurfacePair& pair) {
    if (c.robot_b < 0 || c.robot_a == c.robot_b || !(c.load > 0)) return;
    const Partner a{robots[static_cast<std::size_t>(c.robot_a)], c.body_a},
        b{robots[static_cast<std::size_t>(c.robot_b)], c.body_b};
    Vec3 velocity;
    if (may_carry(a, b))
        velocity = chord(a, b, model.dt_s);
    else if (may_carry(b, a))
        velocity = -chord(b, a, model.dt_s);
    pair.velocity += velocity - c.normal * dot(c.normal, velocity);
}

bool has_motion(const Model& model, std::span<const RobotWork> robots, const Contact& c) {
    const auto moves = [&](int robot) {
        return robot >= 0 && !robots[static_cast<std::size_t>(robot)].state->surfaces.empty();
    };
    if (moves(c.robot_a) || moves(c.robot_b)) return true;
    if (c.robot_b >= 0) return false;
    const StaticShape& scenery = model.statics[c.shape_b];
    const RobotWork* driver = driver_of(robots, scenery);
    return scenery.flow.moves() || (driver != nullptr && !driver->state->surfaces.empty());
}

}  // namespace roboss
