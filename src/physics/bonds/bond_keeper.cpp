// See bond_keeper.h.
#include "physics/bonds/bond_keeper.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/collide.h"

namespace roboss {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kTookHold = -1;  // Bond::reach in the tick after it took hold
constexpr double kTip = 1e-3;  // m: radius of the sphere that the narrow phase takes for the point of a cup

/// Index of the robot in the group; kScenery: it is not there.
std::uint32_t find(std::span<const RobotWork> robots, std::uint32_t id) {
    const auto found = std::ranges::lower_bound(robots, RobotId(id), {}, &RobotWork::id);
    if (found == robots.end() || found->id.value != id) return HeldBond::kScenery;
    return static_cast<std::uint32_t>(found - robots.begin());
}

void place_sleeper(const Model& model, RobotWork& work) {
    if (work.placed) return;
    place_robot(model, work.id, *work.state, work);
    work.asleep = true;
}

int body_of(const RobotWork& robot, LinkId link) {
    return robot.type->links[link.index()].body;
}

HeldBond held_bond(std::span<const RobotWork> robots, std::uint32_t holder, std::uint32_t other, Bond& bond) {
    HeldBond held{holder, other, body_of(robots[holder], bond.link), -1, &bond};
    if (other != HeldBond::kScenery) held.other_body = body_of(robots[other], bond.other_link);
    return held;
}

/// From now on the bond keeps the two as they stand.
void take_hold(std::span<const RobotWork> robots, std::uint32_t holder, std::uint32_t other, bool at_cup,
               Bond& bond) {
    const Transform X_WL = pose_of(robots[holder], bond.link);
    Transform X_WO;
    Vec3 centre = X_WL.p;
    if (other != HeldBond::kScenery) {
        const RobotWork& work = robots[other];
        X_WO = pose_of(work, bond.other_link);
        const Link& link = work.type->links[bond.other_link.index()];
        centre = link.body < 0 ? X_WO.p : work.bodies[static_cast<std::size_t>(link.body)].X_WB * link.p_BC;
    }
    const Transform X_LW = inverse(X_WL);
    bond.X_LO = to_pose(X_LW * X_WO);
    bond.X_LO.q = normalized(bond.X_LO.q);
    if (!at_cup) bond.p_L = X_LW * centre;
    bond.phase = BondPhase::kHolds;
    bond.reach = kTookHold;
    bond.force_impulse = bond.torque_impulse = {};
}

/// The box of the robot's own shapes.
Aabb own_box(const RobotWork& work) {
    Aabb box;
    for (const std::uint32_t s : work.type->shape_groups.loose) box.include(work.shapes[s].box);
    for (const auto& crowd : work.crowds) box.include(crowd.box);
    if (work.shapes.empty()) box.include(work.origin);
    return box;
}

Shape tip_of(double reach) {
    Shape tip;
    tip.kind = ShapeKind::kSphere;
    tip.radius = std::min(kTip, 0.5 * reach);
    return tip;
}

double least_gap(const Manifold& manifold) {
    double least = kFar;
    for (int i = 0; i < manifold.count; ++i)
        least = std::min(least, manifold.points[static_cast<std::size_t>(i)].gap);
    return least;
}

}  // namespace

BondFrames frames_of(std::span<const RobotWork> robots, const HeldBond& held) {
    const Bond& bond = *held.bond;
    const Transform X_WL = pose_of(robots[held.holder], bond.link);
    const Transform X_WO =
        held.other == HeldBond::kScenery ? Transform{} : pose_of(robots[held.other], bond.other_link);
    const Transform X_LO = to_transform(bond.X_LO);
    const Mat3 R = X_WO.R * transpose(X_WL.R * X_LO.R);
    BondFrames frames;
    frames.p_W = X_WL * bond.p_L;
    frames.p_other_W = X_WO * (inverse(X_LO) * bond.p_L);
    frames.twist = Vec3{R.r2.y - R.r1.z, R.r0.z - R.r2.x, R.r1.x - R.r0.y} * 0.5;
    if (R.r0.x + R.r1.y + R.r2.z < 1) frames.twist = frames.twist + Vec3{1, 0, 0};  // beyond a right angle
    return frames;
}

void let_go_of_overloads(double dt, RobotState& state) {
    for (Bond& bond : state.bonds) {
        if (bond.phase != BondPhase::kHolds) continue;
        if (bond.reach == kTookHold) {  // what it bore was the blow of taking hold, not a load
            bond.reach = 0;
            bond.force_impulse = bond.torque_impulse = {};
        } else if (norm(bond.force_impulse) > bond.max_force * dt ||
                   norm(bond.torque_impulse) > bond.max_torque * dt) {
            bond.phase = BondPhase::kLoosed;
        }
    }
}

void BondKeeper::form(const Model& model, std::span<RobotWork> robots, WakeBuffers& wake) {
    woken_.clear(), held_.clear();
    for (std::uint32_t i = 0; i < robots.size(); ++i) {
        if (robots[i].asleep) continue;
        std::vector<Bond>& bonds = robots[i].state->bonds;
        for (Bond& bond : bonds) {
            if (bond.phase == BondPhase::kHolds) continue;
            if (bond.phase == BondPhase::kForming) form_one(model, robots, i, bond);
            if (bond.other == RobotId::kNone) continue;
            if (const std::uint32_t j = find(robots, bond.other); j != HeldBond::kScenery && robots[j].asleep)
                woken_.push_back(j);
        }
        std::erase_if(bonds, [](const Bond& bond) { return bond.phase != BondPhase::kHolds; });
    }
    for (const std::uint32_t j : woken_) wake_sleeper(model, robots, j, wake);
}

/// A bond that does not form stays kForming.
void BondKeeper::form_one(const Model& model, std::span<RobotWork> robots, std::uint32_t holder, Bond& bond) {
    if (bond.other == RobotId::kNone) return form_at_cup(model, robots, holder, bond);
    const std::uint32_t other = find(robots, bond.other);
    if (other != HeldBond::kScenery && bond.other_link.index() < robots[other].type->links.size() &&
        overlaps(own_box(robots[holder]).inflated(bond.reach), robots[other].box)) {
        place_sleeper(model, robots[other]);
        return take_hold(robots, holder, other, false, bond);
    }
    bond.other = RobotId::kNone;  // nobody to wake
}

/// The cup takes what is nearest to it: a link of another robot, or the scenery.
void BondKeeper::form_at_cup(const Model& model, std::span<RobotWork> robots, std::uint32_t holder,
                             Bond& bond) {
    const RobotWork& own = robots[holder];
    const Vec3 cup = pose_of(own, bond.link) * bond.p_L;
    Aabb ball;
    ball.include(cup);
    ball = ball.inflated(bond.reach + kBaseMargin);
    const Shape tip = tip_of(bond.reach);
    const std::uint32_t family = model.robots[own.id.index()].family;
    double nearest = bond.reach - tip.radius;
    std::uint32_t other = HeldBond::kScenery;
    for (std::uint32_t j = 0; j < robots.size(); ++j) {
        RobotWork& work = robots[j];
        if (j == holder || !overlaps(ball, work.box) || model.robots[work.id.index()].family == family)
            continue;
        place_sleeper(model, work);
        for (const std::uint32_t s : search_.in_box(work, ball)) {
            const BodyShape& shape = work.type->shapes[s];
            const double gap = least_gap(
                collide(tip, {Mat3::identity(), cup}, shape.shape, shape_pose(work, s), bond.reach));
            if (!(gap < nearest)) continue;
            nearest = gap, other = j, bond.other_link = shape.link;
        }
    }
    if (nearest_scenery(model, cup, bond.reach) < nearest) {
        bond.other_link = {};
        return take_hold(robots, holder, HeldBond::kScenery, true, bond);
    }
    if (other == HeldBond::kScenery) return;
    bond.other = robots[other].id.value;
    take_hold(robots, holder, other, true, bond);
}

/// Gap between the tip of the cup and the scenery.
double BondKeeper::nearest_scenery(const Model& model, const Vec3& cup, double reach) {
    const Shape tip = tip_of(reach);
    const Transform X{Mat3::identity(), cup};
    Aabb ball;
    ball.include(cup);
    model.static_bvh.query(ball.inflated(reach + kBaseMargin), scenery_);
    double nearest = kFar;
    for (const std::uint32_t i : scenery_) {
        const StaticShape& scenery = model.statics[i];
        if (scenery.shape.kind != ShapeKind::kSurface) {
            nearest = std::min(nearest, least_gap(collide(tip, X, scenery.shape, scenery.X_WS, reach)));
            continue;
        }
        collide_surface(tip, X, *scenery.shape.surface, scenery.X_WS, reach, surface_);
        for (const SurfaceContact& point : surface_.points) nearest = std::min(nearest, point.gap);
    }
    return nearest;
}

/// Whether the links of a bond, which are in place, are further from where they are to be than it bears.
bool BondKeeper::is_torn(std::span<const RobotWork> robots, const HeldBond& held) {
    const Bond& bond = *held.bond;
    const BondFrames frames = frames_of(robots, held);
    if (!(norm(frames.twist) <= kTwist)) return true;
    if (held.other == HeldBond::kScenery) return !(norm(frames.slip()) <= kTear);
    const Vec3 p_L = point_of(*robots[held.other].type, bond.other_link).p_L;
    const Vec3 wanted = pose_of(robots[held.holder], bond.link) * (to_transform(bond.X_LO) * p_L);
    return !(norm(pose_of(robots[held.other], bond.other_link) * p_L - wanted) <= kTear);
}

void BondKeeper::hold(std::span<RobotWork> robots) {
    for (std::uint32_t i = 0; i < robots.size(); ++i) {
        if (robots[i].asleep || robots[i].state->bonds.empty()) continue;
        std::vector<Bond>& bonds = robots[i].state->bonds;
        std::erase_if(bonds, [&](Bond& bond) {
            if (bond.other == RobotId::kNone)
                return is_torn(robots, held_bond(robots, i, HeldBond::kScenery, bond));
            const std::uint32_t j = find(robots, bond.other);
            if (j == HeldBond::kScenery || !overlaps(robots[i].box, robots[j].box)) return true;
            if (bond.other_link.index() >= robots[j].type->links.size()) return true;
            return !robots[j].asleep && is_torn(robots, held_bond(robots, i, j, bond));
        });
        for (Bond& bond : bonds) {
            const bool is_scenery = bond.other == RobotId::kNone;
            const std::uint32_t j = is_scenery ? HeldBond::kScenery : find(robots, bond.other);
            if (!is_scenery && robots[j].asleep) continue;
            const HeldBond held = held_bond(robots, i, j, bond);
            if (held.body < 0 && held.other_body < 0) continue;  // neither can move
            held_.push_back(held);
            robots[i].bonded = true;
            if (!is_scenery) robots[j].bonded = true;
        }
    }
}

bool BondKeeper::joins(int robot_a, int body_a, int robot_b, int body_b) const {
    const auto same = [](std::uint32_t i, int robot) {
        return robot < 0 ? i == HeldBond::kScenery : i == static_cast<std::uint32_t>(robot);
    };
    return std::ranges::any_of(held_, [&](const HeldBond& h) {
        return (same(h.holder, robot_a) && h.body == body_a && same(h.other, robot_b) &&
                (robot_b < 0 || h.other_body == body_b)) ||
               (robot_b >= 0 && same(h.holder, robot_b) && h.body == body_b && same(h.other, robot_a) &&
                h.other_body == body_a);
    });
}

}  // namespace roboss
