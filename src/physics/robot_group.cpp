// See robot_group.h.
#include "physics/robot_group.h"

#include <algorithm>
#include <atomic>
#include <string>
#include <utility>

#include "core/check.h"
#include "core/hash.h"
#include "physics/step_failure.h"

namespace roboss {
namespace {

constexpr std::size_t kBlock = 32;  // robots that a thread of a team takes at a time

/// A sleeper's box is in its state; the rest of it is computed only if something comes near.
void place(const Model& model, RobotId id, RobotState& state, RobotWork& work) {
    if (!state.rest.asleep) return place_robot(model, id, state, work);
    work.id = id;
    work.take(type_of(model.type_of(id), state), state);
    work.contacts = 0;
    work.touches_robot = work.pushed = work.held = work.bonded = work.placed = false;
    work.asleep = true;
    work.box = state.rest.bound;
    work.base = {};
}

void count_contacts(const Model& model, std::span<const Contact> contacts, StepReport& report) {
    for (const Contact& c : contacts) {
        if (c.impulse <= 0) continue;
        ++report.contacts;
        if (c.robot_b < 0 && model.statics[c.shape_b].shape.kind != ShapeKind::kPlane)
            ++report.static_contacts;
    }
}

void expire_wrenches(Tick tick, RobotState& state) {
    std::erase_if(state.wrenches, [&](const TimedWrench& w) { return w.until <= tick + 1; });
}

/// A kinematic robot goes where its velocity leads, whatever it meets.
void advance_base(const Spatial& velocity, double dt, RobotState& state) {
    const Pose X = base_pose(state);
    const Quat q = exponential(velocity.angular * dt) * X.q;
    set_base_pose(state, {X.p + velocity.linear * dt, normalized(q)});
}

/// Robots that stand on the same ground have contacts alike; who leans on something too is mostly the only
/// one of its lanes.
bool touches_one_thing(std::span<const Contact> contacts) {
    return std::ranges::all_of(contacts, [&](const Contact& c) { return c.shape_b == contacts[0].shape_b; });
}

}  // namespace

bool RobotGroup::forward_kinematics() {
    ROBOSS_CHECK(robots_.size() == chosen_.size(), std::to_string(chosen_.size()) + " robots");
    ROBOSS_CHECK(std::ranges::is_sorted(chosen_), "robots of a group");
    weight_ = 0;
    for (const std::uint32_t i : chosen_) weight_ += weight_of(call_.model.type_of(call_.robots[i]));
    std::atomic<bool> all_fine{true};
    team().run_blocks(chosen_.size(), kBlock, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
            const std::uint32_t i = chosen_[k];
            RobotWork& work = robots_[k];
            place(call_.model, call_.robots[i], *call_.states[i], work);
            work.ordered = call_.ordered[i] != 0;
            call_.bounds[i] = work.box;
            if (!work.asleep && body_beyond_numbers(work)) all_fine = false;
        }
    });
    if (all_fine) return true;
    bool fine = true;
    for (const RobotWork& work : robots_) {
        if (work.asleep) continue;
        const std::optional<int> body = body_beyond_numbers(work);
        if (!body) continue;
        note_beyond_numbers(work, *body, call_.report);
        fine = false;
    }
    return fine;
}

bool RobotGroup::find_contacts() {
    s_.finder.find(call_.model, robots_, &s_.bonds, s_.keep_reactions, s_.contacts, team());
    ROBOSS_CHECK(std::ranges::is_sorted(s_.contacts, {}, &Contact::robot_a), "contacts");
    team().run_blocks(robots_.size(), kBlock, [&](std::size_t first, std::size_t last) {
        recall_impulses(robots_, first, last, s_.contacts);
    });
    return true;
}

/// Joins robots in contact, or that may come into contact, and bonded ones; `members` are the robots that are
/// awake, contact island by contact island.
void RobotGroup::build_contact_islands() {
    s_.islands.reset(robots_.size());
    const auto join = [&](int a, int b) {
        if (b >= 0) s_.islands.unite(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
    };
    for (const Contact& c : s_.contacts) join(c.robot_a, c.robot_b);
    for (const NearMiss& miss : s_.finder.near_misses()) join(miss.robot_a, miss.robot_b);
    for (const HeldBond& bond : s_.bonds.held())
        if (bond.other != HeldBond::kScenery) s_.islands.unite(bond.holder, bond.other);
    s_.members.clear();
    for (std::uint32_t i = 0; i < robots_.size(); ++i)
        if (!robots_[i].asleep) s_.members.push_back(i);
    s_.islands.sort_by_set(s_.members);
}

/// Reactions are kept in the order of the islands.
Team RobotGroup::team() const {
    return weight_ < kTeamFrom || s_.keep_reactions ? Team() : s_.team;
}

/// Tells each thread's islands about the group.
void RobotGroup::start_islands() {
    s_.waiting.clear(), s_.lane_members.clear();
    if (s_.island.size() < team().size()) s_.island.resize(team().size());
    for (std::size_t worker = 0; worker < team().size(); ++worker) {
        IslandScratch& island = s_.island[worker];
        island.group = {s_.contacts,       s_.finder.near_misses(),
                        s_.bonds.held(),   &s_.finder.free_courses(),
                        s_.keep_reactions, s_.profiles_solver};
        if (worker == 0) continue;
        island.free_courses.start(robots_.size(), s_.keep_reactions);
        island.group.free_courses = &island.free_courses;
    }
}

/// Sorts the waiting islands by descending size; how many of them are so large that the team shares their
/// work.
std::size_t RobotGroup::count_large() {
    using Members = std::span<const std::uint32_t>;
    const auto weight = [&](const Members& members) {
        if (weight_ == robots_.size()) return members.size();
        std::size_t sum = 0;
        for (const std::uint32_t m : members) sum += weight_of(*robots_[m].type);
        return sum;
    };
    std::ranges::sort(s_.waiting, [&](const Members& a, const Members& b) {
        return std::pair(weight(b), a.front()) < std::pair(weight(a), b.front());
    });
    std::size_t all = 0, large = 0;
    for (const Members& members : s_.waiting) all += weight(members);
    while (large < s_.waiting.size() && weight(s_.waiting[large]) * 2 * team().size() > all) ++large;
    return large;
}

/// Islands whose robots have neighbouring numbers go to one thread of the team, as in the other stages, so
/// that they stay in its cache; of each share the largest first.
void RobotGroup::sort_shares(std::size_t first) {
    using Members = std::span<const std::uint32_t>;
    const std::span<Members> waiting = std::span(s_.waiting).subspan(first);
    team().sort_shares(
        waiting, [](const Members& members) { return members.size(); },
        [](const Members& members) { return members.front(); });
}

/// A robot that touches nobody may wait until there are enough of its type. In floats it must: whether it is
/// stepped so hangs on nothing but itself and on who touches it.
bool RobotGroup::goes_in_lanes(std::span<const std::uint32_t> members) const {
    const RobotWork& work = robots_[members[0]];
    if (!s_.lanes || s_.tried_alone || s_.keep_reactions || members.size() > 1 || work.touches_robot)
        return false;
    if (!misses_of(members[0], s_.finder.near_misses()).empty()) return false;
    if (!s_.lanes.take(call_.model, *work.type, *work.state)) return false;
    if (s_.lanes.in_floats()) return true;
    if (s_.rough && !s_.rough_luck.is_good(call_.tick)) return false;
    return (robots_.size() > 1 && touches_one_thing(contacts_of(members[0], s_.contacts)));
}

/// Robots of equal kinds have contacts alike; other ones may share a kind by chance, and lanes will notice.
std::uint64_t RobotGroup::lane_kind(std::uint32_t robot) const {
    Hash kind;
    kind.add(static_cast<std::uint64_t>(call_.model.like(robots_[robot].id).index()));
    for (const Contact& c : contacts_of(robot, s_.contacts))
        kind.add(std::uint64_t{c.shape_a} << 32 | c.shape_b);
    return kind.value();
}

void RobotGroup::report() {
    StepReport& report = call_.report;
    team().run_blocks(robots_.size(), kBlock, [&](std::size_t first, std::size_t last) {
        remember_impulses(robots_, first, last, s_.contacts);
    });
    count_contacts(call_.model, s_.contacts, report);
    report.asleep += static_cast<int>(robots_.size() - s_.members.size());
    for (RobotWork& work : robots_) {
        report.placed += work.placed ? 1 : 0;
        if (work.asleep) continue;
        expire_wrenches(call_.tick, *work.state);
        if (!is_zero(work.base)) advance_base(work.base, call_.model.dt_s, *work.state);
        if (!is_finite(*work.state)) note_not_finite(work, report);
    }
    if (s_.keep_reactions) keep_contact_reports();
}

/// Who touched whom, for read_contacts.
void RobotGroup::keep_contact_reports() {
    for (const Contact& c : s_.contacts) {
        if (c.impulse <= 0) continue;
        const RobotWork& a = robots_[static_cast<std::size_t>(c.robot_a)];
        ContactReport report;
        report.robot_a = a.id;
        report.shape_a = c.shape_a, report.link_a = a.type->shapes[c.shape_a].link;
        if (c.robot_b >= 0) {
            const RobotWork& b = robots_[static_cast<std::size_t>(c.robot_b)];
            report.robot_b = b.id;
            report.shape_b = c.shape_b, report.link_b = b.type->shapes[c.shape_b].link;
        } else {
            report.scenery = c.shape_b;
        }
        report.p_W = c.p_W, report.shift_b = c.shift_b, report.normal = c.normal, report.gap = c.gap;
        report.impulse = c.impulse, report.friction = c.friction, report.moment = c.moment;
        s_.contact_reports.push_back(report);
    }
}

}  // namespace roboss
