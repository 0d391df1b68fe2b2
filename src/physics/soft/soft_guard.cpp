// See soft_guard.h.
#include "physics/soft/soft_guard.h"

#include <algorithm>

#include "physics/contact/island_guard.h"

namespace roboss::soft {
namespace {

/// About the common centre of mass, of sums about another point.
Vec3 own_momentum(const BodySums& sums) {
    return sums.momentum.angular - cross(sums.centre(), sums.momentum.linear);
}

bool is_left_alone(const Island& island, std::uint32_t member) {
    const RobotWork& robot = island.robots[member];
    if (robot.type->nv == 0) return true;
    const auto is_pulled = [](const roboss::Body& body) { return body.gravity_mass != body.mass; };
    return robot.type->free_base && robot.state->wrenches.empty() &&
           std::ranges::none_of(robot.type->bodies, is_pulled);
}

}  // namespace

bool Guard::start(const Island& island, RobotWork& buffer) {
    const auto is_pushed_from_outside = [&](const Contact* c) {
        return c->impulse > 0 && touches_fixed(island.robots, *c);
    };
    if (std::ranges::any_of(island.contacts, is_pushed_from_outside) ||
        std::ranges::any_of(island.surfaces, &SurfacePair::moves) ||
        !std::ranges::all_of(island.members, [&](std::uint32_t m) { return is_left_alone(island, m); }))
        return false;
    origin_ = island.robots[island.members[0]].origin;
    const BodySums before = sum_robots(island.model, island.robots, island.members, origin_, buffer);
    if (!(before.inertia.mass > 0)) return false;
    momentum_ = own_momentum(before), energy_ = before.energy();
    guards_energy_ = std::ranges::all_of(
        island.members, [&](std::uint32_t m) { return island.robots[m].type->dofs.empty(); });
    return true;
}

void Guard::finish(const Island& island, RobotWork& buffer) const {
    const auto sums = [&] {
        return sum_robots(island.model, island.robots, island.members, origin_, buffer);
    };
    const BodySums after = sums();
    add_momentum(island.robots, island.members, after, {momentum_ - own_momentum(after), {}}, origin_);
    if (!guards_energy_) return;
    const BodySums now = sums();
    const Slowdown slowdown = slowdown_to(energy_ - now.potential, now, false);
    for (const std::uint32_t m : island.members)
        if (island.robots[m].type->nv > 0)
            slowdown.apply(*island.robots[m].type, origin_, *island.robots[m].state);
}

}  // namespace roboss::soft
