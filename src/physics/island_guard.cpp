// See island_guard.h.
#include "physics/island_guard.h"

#include <algorithm>

namespace roboss {
namespace {

constexpr double kSlow = 0.005;  // rad in a tick: less turning of a lone body adds nothing that counts

constexpr double kRebound = 1e-3;  // m/s

bool has_soft_contacts(const IslandRows& rows) {
    return std::ranges::any_of(rows.contacts,
                               [](const ContactRow& row) { return row.soft && row.normal.impulse > 0; });
}

}  // namespace

BodySums IslandGuard::sums(const Model& model, std::span<RobotWork> robots,
                           std::span<const std::uint32_t> members, RobotWork& buffer) const {
    BodySums all;
    for (const std::uint32_t m : members) {
        const RobotWork& robot = robots[m];
        if (robot.type->nv == 0) continue;
        buffer.type = robot.type, buffer.state = robot.state;
        all += sum_bodies(model, robot.state->q, robot.state->v, origin_, buffer);
    }
    return all;
}

bool throws_back(const IslandRows& rows) {
    return std::ranges::any_of(rows.contacts, [](const ContactRow& row) {
        return !row.soft && row.normal.impulse > 0 &&
               row.normal.target - row.normal.compliance * row.normal.impulse > kRebound;
    });
}

bool IslandGuard::start(const Model& model, std::span<RobotWork> robots,
                        std::span<const std::uint32_t> members, bool anchored, bool bounces,
                        const IslandRows& rows, RobotWork& buffer) {
    const auto bends = [&](std::uint32_t m) {
        return !robots[m].type->dofs.empty() ||
               fastest_turn(robots[m]) * model.dt_s * model.dt_s > kSlow * kSlow;
    };
    const auto passive = [&](std::uint32_t m) { return is_passive(robots[m]); };
    if (!std::ranges::any_of(members, bends) && !bounces) return false;
    if (!std::ranges::all_of(members, passive) || has_soft_contacts(rows)) return false;
    anchored_ = anchored;
    origin_ = robots[members[0]].origin;
    energy_ = sums(model, robots, members, buffer).energy();
    return true;
}

void IslandGuard::finish(const Model& model, std::span<RobotWork> robots,
                         std::span<const std::uint32_t> members, RobotWork& buffer) const {
    const BodySums now = sums(model, robots, members, buffer);
    const Slowdown slowdown = slowdown_to(energy_ - now.potential, now, anchored_);
    for (const std::uint32_t m : members)
        if (robots[m].type->nv > 0) slowdown.apply(*robots[m].type, origin_, *robots[m].state);
}

}  // namespace roboss
