// step_island: orders, kinematics, contacts, then each contact island by itself, then the new state.
#include "physics/step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/float_env.h"
#include "physics/axis_rows.h"
#include "physics/integrate.h"
#include "physics/sleep.h"
#include "physics/solver.h"

namespace roboss {

struct StepScratch::Impl {
    std::vector<RobotWork> robots;  // only the first `count` are of this island
    ContactFinder finder;
    std::vector<Contact> contacts;
    std::vector<int> group;  // union-find over the robots: contact islands
    std::vector<std::uint32_t> members;
    std::vector<Contact*> island_contacts;
    std::vector<const RobotWork*> island_robots;
    std::vector<int> offsets, island_offsets;
    IslandRows rows;
    std::vector<double> v, v_before;
    IslandSolver solver;
    RowBuffer buffer;
    FreeBuffer free_buffer;
    WakeBuffers wake;
};

StepScratch::StepScratch() : impl_(std::make_unique<Impl>()) {}
StepScratch::~StepScratch() = default;
StepScratch::StepScratch(StepScratch&&) noexcept = default;
StepScratch& StepScratch::operator=(StepScratch&&) noexcept = default;

namespace {

using Impl = StepScratch::Impl;

/// A sleeper's box is in its state; the rest of it is computed only if something comes near.
void place(const Model& model, RobotId id, RobotState& state, RobotWork& work) {
    if (!state.rest.asleep) return place_robot(model, id, state, work);
    work.id = id;
    work.type = &model.type_of(id);
    work.state = &state;
    work.contacts = 0;
    work.touches_robot = work.pushed = work.held = work.placed = false;
    work.asleep = true;
    work.box = state.rest.bound;
}

void apply_orders(const Model& model, std::span<const RobotId> robots, std::span<RobotState* const> states,
                  std::span<const Order> orders, std::span<RobotWork> works) {
    for (RobotWork& work : works) work.ordered = false;
    for (const Order& order : orders) {
        const auto found = std::lower_bound(robots.begin(), robots.end(), order.robot);
        if (found == robots.end() || *found != order.robot) continue;
        const auto i = static_cast<std::size_t>(found - robots.begin());
        apply_order(model, order, *states[i]);
        works[i].ordered = true;
    }
}

int root_of(std::vector<int>& group, int i) {
    while (group[static_cast<std::size_t>(i)] != i) {
        int& parent = group[static_cast<std::size_t>(i)];
        parent = group[static_cast<std::size_t>(parent)];
        i = parent;
    }
    return i;
}

/// Joins robots in contact; afterwards group[i] is the lowest robot of i's contact island, and `members` are
/// the robots that are awake, island by island.
void build_contact_islands(Impl& s, std::size_t count) {
    s.group.resize(count);
    for (std::size_t i = 0; i < count; ++i) s.group[i] = static_cast<int>(i);
    for (const Contact& c : s.contacts) {
        if (c.robot_b < 0 || c.robot_b == c.robot_a) continue;
        const int a = root_of(s.group, c.robot_a), b = root_of(s.group, c.robot_b);
        s.group[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
    for (std::size_t i = 0; i < count; ++i) s.group[i] = root_of(s.group, static_cast<int>(i));
    s.members.clear();
    for (std::size_t i = 0; i < count; ++i)
        if (!s.robots[i].asleep) s.members.push_back(static_cast<std::uint32_t>(i));
    std::sort(s.members.begin(), s.members.end(), [&](std::uint32_t i, std::uint32_t j) {
        return s.group[i] != s.group[j] ? s.group[i] < s.group[j] : i < j;
    });
}

/// Marks the robots that a contact pushes, in their velocity or on their way.
void mark_pushed(Impl& s) {
    for (std::size_t c = 0; c < s.rows.contacts.size(); ++c) {
        const Contact& contact = *s.island_contacts[c];
        if (contact.impulse <= 0 && s.rows.contacts[c].normal.impulse <= 0) continue;
        s.robots[static_cast<std::size_t>(contact.robot_a)].pushed = true;
        if (contact.robot_b >= 0) s.robots[static_cast<std::size_t>(contact.robot_b)].pushed = true;
    }
}

/// Writes the solved velocities into the states and moves the coordinates. A robot that is near something but
/// not pushed moves freely, else a ball would lose height in every tick that it spends close to the ground.
void finish_island(const Model& model, Impl& s, std::span<const std::uint32_t> members,
                   std::span<const double> way) {
    for (std::size_t m = 0; m < members.size(); ++m) {
        RobotWork& work = s.robots[members[m]];
        const auto offset = static_cast<std::size_t>(s.island_offsets[m]);
        const auto nv = static_cast<std::size_t>(work.type->nv);
        if (!work.pushed && moves_freely(model, work)) {
            advance_freely(model, work, s.free_buffer);
            continue;
        }
        work.held = true;
        std::copy_n(s.v.begin() + static_cast<std::ptrdiff_t>(offset), nv, work.state->v.begin());
        advance_coordinates(*work.type, way.subspan(offset, nv), model.dt_s, work.state->q);
        if (work.type->has_equalities())
            s.free_buffer.projection.close_coordinates(*work.type, work.state->q);
    }
}

/// Gathers rows and first guess of one contact island; true if the way of the tick needs a solution of its
/// own.
bool gather_island(const Model& model, Impl& s, std::span<const std::uint32_t> members,
                   std::span<Contact> contacts) {
    s.island_robots.clear(), s.island_offsets.clear();
    s.rows.clear(), s.v.clear();
    s.offsets.resize(s.robots.size());
    bool split = false;
    for (std::uint32_t m : members) {
        RobotWork& work = s.robots[m];
        const int offset = static_cast<int>(s.v.size());
        s.offsets[m] = offset;
        s.island_robots.push_back(&work);
        s.island_offsets.push_back(offset);
        compute_impulse(model, model.dt_s, 1.0, work.state->q, work.state->v, work);
        compute_mass_matrix(*work.type, model.dt_s, work);
        split |= add_joint_rows(model, work, offset, s.buffer, s.rows);
        s.v.insert(s.v.end(), work.state->v.begin(), work.state->v.end());
    }
    for (std::uint32_t m : members) {  // contacts are sorted by their first robot
        const auto first = std::lower_bound(contacts.begin(), contacts.end(), static_cast<int>(m),
                                            [](const Contact& c, int robot) { return c.robot_a < robot; });
        for (auto c = first; c != contacts.end() && c->robot_a == static_cast<int>(m); ++c) {
            split |= add_contact_row(model, *c, s.robots, s.offsets, s.rows);
            add_angular_row(model, *c, s.robots, s.offsets, s.rows);
            s.island_contacts.push_back(&*c);
        }
    }
    return split;
}

/// The solved impulses, into the contacts: what the next tick starts from.
void take_impulses(Impl& s) {
    for (std::size_t c = 0; c < s.rows.contacts.size(); ++c) {
        const ContactRow& row = s.rows.contacts[c];
        Contact& contact = *s.island_contacts[c];
        const ContactFrame frame = frame_of(contact);
        contact.load = std::min({contact.impulse, row.normal.impulse, row.load_max});
        contact.impulse = row.normal.impulse;
        contact.friction = frame.t1 * row.slip.impulse_1 + frame.t2 * row.slip.impulse_2;
    }
    for (const AngularRow& row : s.rows.angulars) {
        Contact& contact = *s.island_contacts[row.contact];
        Vec3 t1, t2;
        tangents(contact.normal, t1, t2);
        contact.moment =
            contact.normal * row.spin.impulse + t1 * row.roll.impulse_1 + t2 * row.roll.impulse_2;
    }
}

void solve_island(const Model& model, Impl& s, std::span<const std::uint32_t> members, StepReport& report) {
    s.island_contacts.clear();
    if (members.size() == 1) {
        RobotWork& work = s.robots[members[0]];
        if (work.type->nv == 0) return;
        if (work.contacts == 0 && moves_freely(model, work))
            return advance_freely(model, work, s.free_buffer);
    }
    const bool split = gather_island(model, s, members, s.contacts);
    s.v_before = s.v;
    const SolveReport solved =
        s.solver.solve({model.accuracy, s.island_robots, s.island_offsets, s.rows}, s.v);
    report.iterations += solved.iterations;
    report.residual = std::max(report.residual, solved.residual);
    take_impulses(s);
    if (split) {
        for (ContactRow& row : s.rows.contacts) row.slip.bound = row.slip.coefficient * row.normal.impulse;
        report.iterations +=
            s.solver.solve({model.accuracy, s.island_robots, s.island_offsets, s.rows, true}, s.v_before)
                .iterations;
    }
    mark_pushed(s);
    finish_island(model, s, members, split ? s.v_before : s.v);
}

bool is_finite(const RobotState& state) {
    double sum = 0;
    for (double x : state.q) sum += x - x;
    for (double x : state.v) sum += x - x;
    return sum == 0;
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

/// A robot so fast that its way in one tick is no number: it would meet everybody, and spoil them.
bool is_beyond_numbers(const RobotWork& work) {
    for (const ShapeWork& shape : work.shapes)
        if (!std::isfinite(shape.margin)) return true;
    return !is_finite(work.origin);
}

}  // namespace

Aabb interaction_bound(const Model& model, RobotId robot, const RobotState& state) {
    const ExactFloatScope exact;
    RobotWork work;
    RobotState copy = state;
    place_robot(model, robot, copy, work);
    return work.box;
}

StepReport step_island(const Model& model, Tick tick, std::span<const RobotId> robots,
                       std::span<RobotState* const> states, std::span<const Order> orders,
                       std::span<Aabb> bounds, StepScratch& scratch) {
    const ExactFloatScope exact;
    Impl& s = scratch.impl();
    const std::size_t count = robots.size();
    if (s.robots.size() < count) s.robots.resize(count);
    const std::span<RobotWork> works(s.robots.data(), count);
    apply_orders(model, robots, states, orders, works);
    for (std::size_t i = 0; i < count; ++i) {
        place(model, robots[i], *states[i], works[i]);
        bounds[i] = works[i].box;
    }
    StepReport report;
    for (const RobotWork& work : works) {
        if (work.asleep || !is_beyond_numbers(work)) continue;
        report.not_finite = work.id;
        return report;
    }
    wake_sleepers(model, works, s.finder, s.wake);
    s.finder.find(model, works, s.contacts);
    recall_impulses(works, s.contacts);
    build_contact_islands(s, count);

    report.asleep = static_cast<int>(count - s.members.size());
    for (std::size_t first = 0; first < s.members.size();) {
        std::size_t last = first + 1;
        while (last < s.members.size() && s.group[s.members[last]] == s.group[s.members[first]]) ++last;
        const auto members = std::span<const std::uint32_t>(s.members).subspan(first, last - first);
        first = last;
        solve_island(model, s, members, report);
        settle_island(model, works, members, s.island_contacts);
    }
    remember_impulses(works, s.contacts);
    count_contacts(model, s.contacts, report);
    for (std::size_t i = 0; i < count; ++i) {
        if (works[i].asleep) continue;
        expire_wrenches(tick, *states[i]);
        if (!report.not_finite.valid() && !is_finite(*states[i])) report.not_finite = robots[i];
    }
    return report;
}

void read_contacts(StepScratch& scratch, std::vector<ContactReport>& reports) {
    const Impl& s = scratch.impl();
    reports.clear();
    for (const Contact& c : s.contacts) {
        if (c.impulse <= 0) continue;
        const RobotWork& a = s.robots[static_cast<std::size_t>(c.robot_a)];
        ContactReport report;
        report.robot_a = a.id;
        report.link_a = a.type->shapes[c.shape_a].link;
        if (c.robot_b >= 0) {
            const RobotWork& b = s.robots[static_cast<std::size_t>(c.robot_b)];
            report.robot_b = b.id;
            report.link_b = b.type->shapes[c.shape_b].link;
        } else {
            report.scenery = c.shape_b;
        }
        report.p_W = c.p_W, report.normal = c.normal, report.gap = c.gap;
        report.impulse = c.impulse, report.friction = c.friction, report.moment = c.moment;
        reports.push_back(report);
    }
}

bool moved_freely(StepScratch& scratch, std::size_t index) {
    return !scratch.impl().robots[index].held;
}

}  // namespace roboss
