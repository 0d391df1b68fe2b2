// See island_parts.h.
#include "physics/contact/island_parts.h"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include "core/check.h"
#include "physics/contact/friction_bounds.h"
#include "physics/solver/row_math.h"
#include "physics/step.h"

namespace roboss {
namespace {

constexpr int kRoundsMax = 6;         // then the island is solved whole
constexpr double kViolation = 1e-12;  // m/s, along a normal that was left out

/// At these velocities. False for those that are not numbers, which later checks report.
bool would_push(const IslandSolver::Problem& p, const ContactRow& row, const std::vector<double>& v) {
    double u = 0;
    for (std::size_t c = row.first; c < row.last; ++c)
        u += p.rows.columns.n[c] * v[static_cast<std::size_t>(p.rows.columns.dof[c])];
    return (p.position ? row.normal.position_target : row.normal.target) - u > kViolation;
}

}  // namespace

void IslandParts::ByPart::sort(std::size_t parts, std::span<const std::uint32_t> part_of_item) {
    first.assign(parts + 1, 0);
    std::uint32_t count = 0;
    for (const std::uint32_t part : part_of_item)
        if (part < parts) ++first[part + 1], ++count;
    for (std::size_t k = 0; k < parts; ++k) first[k + 1] += first[k];
    items.resize(count);
    for (std::uint32_t i = 0; i < part_of_item.size(); ++i)
        if (part_of_item[i] < parts) items[first[part_of_item[i]]++] = i;
    for (std::size_t k = parts; k > 0; --k) first[k] = first[k - 1];
    first[0] = 0;
}

SolveReport IslandParts::solve(Problem p, std::vector<double>& v, const Team& team, std::size_t solved) {
    const std::size_t count = p.robots.size();
    largest_part_ = static_cast<int>(count);
    SolveReport report;
    in_parts_ = false;
    solves_ = {};
    const auto count_solve = [&] { ++solves_[static_cast<std::size_t>(report.method)]; };
    if (is_plain_body(p) && solvers_[0].islands.solve_plainly(p, v, report)) return count_solve(), report;
    if (!has_parts(p)) {
        solvers_[0].islands.share_with(team);
        report = solvers_[0].islands.solve(p, v);
        return count_solve(), report;
    }
    in_parts_ = true;
    prepare(p, v.size());
    join_by_pushing(p, v);
    changed_.assign(count, solved == 0 ? 1 : 0);
    if (solved > 0) mark_open(p, solved);
    largest_part_ = 0;
    for (int round = 0;; ++round) {
        sort_by_parts(p);
        list_changed(p, team);
        p.again = round > 0;
        solve_changed(p, team, v, report);
        std::ranges::fill(changed_, 0);
        if (!join_violated(p, v)) break;
        if (round + 1 == kRoundsMax) join_all();
    }
    finish_left_out(p, v);
    return report;
}

bool IslandParts::has_parts(const Problem& p) {
    const bool is_alone = p.robots.size() == 1 && !BodySolver::can_solve(*p.robots[0]);
    return !is_alone && !p.rows.contacts.empty();
}

/// A free body that nothing but plain contacts along one normal pushes.
bool IslandParts::is_plain_body(const Problem& p) {
    return p.robots.size() == 1 && BodySolver::can_solve(*p.robots[0]) && !p.rows.contacts.empty() &&
           p.rows.couplings.empty() && p.rows.angulars.empty() &&
           std::ranges::all_of(p.rows.contacts,
                               [](const ContactRow& row) { return BodySolver::can_solve(row); }) &&
           newton::have_one_normal<double>(p.rows);
}

void IslandParts::profile_friction(const Problem& p, SolverProfile& profile) const {
    const auto add = [&](const friction::BoundError<double>& error) {
        if (error.largest > 0) profile.add_friction(error.relative(), p.accuracy.friction_tolerance);
    };
    if (!in_parts_) return add(friction::bound_error(p.rows));
    for (std::size_t part = 0; part + 1 < robots_.first.size(); ++part) {
        friction::BoundError<double> error;
        for (const std::uint32_t c : contacts_.of(part)) error.add(p.rows.contacts[c]);
        for (const std::uint32_t a : angulars_.of(part)) {
            const AngularRow& row = p.rows.angulars[a];
            error.add(row, p.rows.contacts[row.contact].normal.impulse);
        }
        add(error);
    }
}

/// Lists the parts that are to be solved. For a team: first those that all its threads solve together, which
/// are more than a thread's share; then the others, sorted within the share of each thread.
void IslandParts::list_changed(const Problem& p, const Team& team) {
    to_solve_.clear(), together_ = 0;
    std::size_t all = 0;
    for (std::uint32_t part = 0; part + 1 < robots_.first.size(); ++part) {
        if (std::ranges::none_of(robots_.of(part), [&](std::uint32_t r) { return changed_[r] != 0; }))
            continue;
        to_solve_.push_back(part);
        all += robots_.of(part).size();
    }
    if (team.size() == 1) return;
    const auto size = [&](std::uint32_t part) { return robots_.of(part).size(); };
    const auto net = [&](std::uint32_t part) {  // bodies of robots with many loops
        std::size_t sum = 0;
        for (const std::uint32_t r : robots_.of(part))
            if (!p.robots[r]->type->elimination.empty()) sum += weight_of(*p.robots[r]->type);
        return sum;
    };
    const auto is_large = [&](std::uint32_t part) {
        return net(part) >= kTeamFrom ||
               (size(part) >= BodySolver::kWorthATeam && 2 * size(part) * team.size() > all);
    };
    const auto first_other = std::partition(to_solve_.begin(), to_solve_.end(), is_large);
    const std::span<std::uint32_t> others(first_other, to_solve_.end());
    together_ = to_solve_.size() - others.size();
    team.sort_shares(others, size, std::identity());
}

/// Each part has rows and velocities of its own, so they may be solved side by side.
void IslandParts::solve_changed(const Problem& p, const Team& team, std::vector<double>& v,
                                SolveReport& report) {
    if (solvers_.size() < team.size()) solvers_.resize(team.size());
    reports_.resize(to_solve_.size());
    solvers_[0].islands.share_with(team);
    for (std::size_t k = 0; k < together_; ++k)
        reports_[k] = solve_part(p, to_solve_[k], solvers_[0], v, team);
    solvers_[0].islands.share_with({});
    team.run(to_solve_.size() - together_, [&](std::size_t k, std::size_t worker) {
        reports_[together_ + k] = solve_part(p, to_solve_[together_ + k], solvers_[worker], v, {});
    });
    for (std::size_t k = 0; k < to_solve_.size(); ++k) {
        report.iterations += reports_[k].iterations;
        ++solves_[static_cast<std::size_t>(reports_[k].method)];
        report.residual = std::max(report.residual, reports_[k].residual);
        largest_part_ = std::max(largest_part_, static_cast<int>(robots_.of(to_solve_[k]).size()));
    }
}

SolveReport IslandParts::solve_part(const Problem& p, std::size_t part, PartSolver& s, std::vector<double>& v,
                                    const Team& team) const {
    SolveReport tried;
    if (is_of_bodies(p, part) &&
        s.bodies.solve({p, robots_.of(part), contacts_.of(part), robot_of_}, v, tried, team))
        return tried;
    SolveReport report;
    if (robots_.of(part).size() == p.robots.size()) {
        report = s.islands.solve(p, v);
    } else {
        take_part(p, part, v, s);
        report = s.islands.solve({p.accuracy, s.robots, s.offsets, s.rows, p.position, p.again}, s.v);
        give_back(p, part, s, v);
    }
    report.iterations += tried.iterations;
    return report;
}

/// Whether the part is one for BodySolver.
bool IslandParts::is_of_bodies(const Problem& p, std::size_t part) const {
    return couplings_.of(part).empty() && angulars_.of(part).empty() &&
           std::ranges::all_of(robots_.of(part),
                               [&](std::uint32_t r) { return BodySolver::can_solve(*p.robots[r]); }) &&
           std::ranges::all_of(contacts_.of(part),
                               [&](std::uint32_t c) { return BodySolver::can_solve(p.rows.contacts[c]); });
}

/// Finds which robots rows belong to. Joins those that couplings join.
void IslandParts::prepare(const Problem& p, std::size_t n) {
    const std::size_t count = p.robots.size();
    robot_of_.resize(n);
    for (std::uint32_t r = 0; r < count; ++r) {
        ROBOSS_CHECK(static_cast<std::size_t>(p.offsets[r] + p.robots[r]->type->nv) <= n, std::to_string(n));
        std::fill_n(robot_of_.begin() + p.offsets[r], static_cast<std::size_t>(p.robots[r]->type->nv), r);
    }
    joint_first_.resize(count + 1);
    std::uint32_t row = 0;
    for (std::uint32_t r = 0; r < count; ++r) {
        joint_first_[r] = row;
        const int end = p.offsets[r] + p.robots[r]->type->nv;
        while (row < p.rows.joints.size() && p.rows.joints[row].dof < end) ++row;
    }
    joint_first_[count] = row;
    joined_.reset(count);
    ends_.clear();
    for (const ContactRow& contact : p.rows.contacts) {
        if (contact.first == contact.last) {
            ends_.push_back({});
            continue;
        }
        ends_.push_back({robot_of_[static_cast<std::size_t>(p.rows.columns.dof[contact.first])],
                         robot_of_[static_cast<std::size_t>(p.rows.columns.dof[contact.last - 1])]});
    }
    for (const CouplingRow& coupling : p.rows.couplings) {
        if (coupling.first == coupling.last) continue;
        const auto robot = [&](std::size_t c) {
            return robot_of_[static_cast<std::size_t>(p.rows.coupling_columns[c].dof)];
        };
        joined_.unite(robot(coupling.first), robot(coupling.last - 1));
    }
}

/// Joins the robots of the contacts that carried something last, or would push at these velocities.
void IslandParts::join_by_pushing(const Problem& p, const std::vector<double>& v) {
    for (std::size_t c = 0; c < ends_.size(); ++c) {
        const Ends& ends = ends_[c];
        if (ends.a == ends.b) continue;
        const ContactRow& row = p.rows.contacts[c];
        if (row.normal.impulse > 0 || would_push(p, row, v)) joined_.unite(ends.a, ends.b);
    }
}

/// Marks the robots of rows that v does not solve (see solve()).
void IslandParts::mark_open(const Problem& p, std::size_t solved) {
    const auto mark = [&](int dof) { changed_[robot_of_[static_cast<std::size_t>(dof)]] = 1; };
    for (const JointRow& row : p.rows.joints)
        if (displaces_otherwise(row)) mark(row.dof);
    for (const CouplingRow& row : p.rows.couplings)
        if (row.first < row.last && displaces_otherwise(row)) mark(p.rows.coupling_columns[row.first].dof);
    for (std::size_t c = 0; c < ends_.size(); ++c) {
        const ContactRow& row = p.rows.contacts[c];
        if (row.first == row.last || (c < solved && !displaces_otherwise(row.normal))) continue;
        if (joined_.find(ends_[c].a) == joined_.find(ends_[c].b)) changed_[ends_[c].a] = 1;
    }
}

/// Joins the parts between which a contact would push at these velocities; false if there is none.
bool IslandParts::join_violated(const Problem& p, const std::vector<double>& v) {
    bool some = false;
    for (std::size_t c = 0; c < ends_.size(); ++c) {
        if (!is_left_out(c)) continue;
        const ContactRow& row = p.rows.contacts[c];
        if (!would_push(p, row, v)) continue;
        joined_.unite(ends_[c].a, ends_[c].b);
        changed_[ends_[c].a] = changed_[ends_[c].b] = 1;
        some = true;
    }
    return some;
}

void IslandParts::join_all() {
    for (std::uint32_t r = 1; r < changed_.size(); ++r) joined_.unite(0, r);
    std::ranges::fill(changed_, 1);
}

/// Parts in the order of their first robots, and what belongs to each.
void IslandParts::sort_by_parts(const Problem& p) {
    constexpr std::uint32_t kNone = 0xffffffff;
    const std::size_t count = p.robots.size();
    keys_.assign(count, kNone);  // part of a root
    part_of_.resize(count);
    std::uint32_t parts = 0;
    for (std::uint32_t r = 0; r < count; ++r) {
        std::uint32_t& part = keys_[joined_.find(r)];
        if (part == kNone) part = parts++;
        part_of_[r] = part;
    }
    robots_.sort(parts, part_of_);
    keys_.clear();
    for (const CouplingRow& row : p.rows.couplings)
        keys_.push_back(
            row.first == row.last
                ? part_of_[0]
                : part_of_[robot_of_[static_cast<std::size_t>(p.rows.coupling_columns[row.first].dof)]]);
    couplings_.sort(parts, keys_);
    keys_.clear();
    for (std::size_t c = 0; c < ends_.size(); ++c)
        keys_.push_back(is_left_out(c) ? kNone : part_of_[ends_[c].a]);
    contacts_.sort(parts, keys_);
    std::size_t at = 0;
    for (const AngularRow& row : p.rows.angulars) keys_[at++] = keys_[row.contact];
    keys_.resize(at);
    angulars_.sort(parts, keys_);
}

/// Copies the columns of a row into the part and renumbers their degrees of freedom.
void IslandParts::take_columns(const Problem& p, PartSolver& s, std::size_t& first, std::size_t& last) const {
    const ContactColumns& from = p.rows.columns;
    ContactColumns& to = s.rows.columns;
    const std::size_t begin = to.size(), count = last - first;
    to.extend(count);
    for (std::size_t k = 0; k < count; ++k) {
        const int dof = from.dof[first + k];
        to.dof[begin + k] = dof + s.shift[robot_of_[static_cast<std::size_t>(dof)]];
        to.base[begin + k] = from.base[first + k];
        to.n[begin + k] = from.n[first + k];
        to.t1[begin + k] = from.t1[first + k], to.t2[begin + k] = from.t2[first + k];
    }
    first = begin, last = begin + count;
}

void IslandParts::take_part(const Problem& p, std::size_t part, const std::vector<double>& v,
                            PartSolver& s) const {
    s.rows.clear(), s.robots.clear(), s.offsets.clear(), s.v.clear();
    s.shift.resize(p.robots.size());
    for (const std::uint32_t r : robots_.of(part)) {
        const int offset = static_cast<int>(s.v.size());
        s.shift[r] = offset - p.offsets[r];
        s.robots.push_back(p.robots[r]);
        s.offsets.push_back(offset);
        const auto from = v.begin() + p.offsets[r];
        s.v.insert(s.v.end(), from, from + p.robots[r]->type->nv);
        for (std::uint32_t j = joint_first_[r]; j < joint_first_[r + 1]; ++j)
            s.rows.joints.emplace_back(p.rows.joints[j]).dof += s.shift[r];
    }
    for (const std::uint32_t c : couplings_.of(part)) {
        CouplingRow& row = s.rows.couplings.emplace_back(p.rows.couplings[c]);
        const std::size_t begin = s.rows.coupling_columns.size();
        for (std::size_t k = row.first; k < row.last; ++k) {
            CouplingColumn column = p.rows.coupling_columns[k];
            column.dof += s.shift[robot_of_[static_cast<std::size_t>(column.dof)]];
            s.rows.coupling_columns.push_back(column);
        }
        row.first = begin, row.last = s.rows.coupling_columns.size();
    }
    s.local_contact.resize(p.rows.contacts.size());
    for (const std::uint32_t c : contacts_.of(part)) {
        s.local_contact[c] = static_cast<std::uint32_t>(s.rows.contacts.size());
        ContactRow& row = s.rows.contacts.emplace_back(p.rows.contacts[c]);
        if (p.rows.keeps_places) s.rows.places.push_back(p.rows.places[c]);
        take_columns(p, s, row.first, row.last);
    }
    for (const std::uint32_t a : angulars_.of(part)) {
        AngularRow& row = s.rows.angulars.emplace_back(p.rows.angulars[a]);
        take_columns(p, s, row.first, row.last);
        row.contact = s.local_contact[row.contact];
    }
}

/// Velocities and rows as the solver left them.
void IslandParts::give_back(const Problem& p, std::size_t part, const PartSolver& s,
                            std::vector<double>& v) const {
    std::size_t at = 0, joint = 0;
    for (const std::uint32_t r : robots_.of(part)) {
        const auto nv = static_cast<std::size_t>(p.robots[r]->type->nv);
        std::copy_n(s.v.begin() + static_cast<std::ptrdiff_t>(at), nv, v.begin() + p.offsets[r]);
        at += nv;
        for (std::uint32_t j = joint_first_[r]; j < joint_first_[r + 1]; ++j, ++joint) {
            const int dof = p.rows.joints[j].dof;
            p.rows.joints[j] = s.rows.joints[joint];
            p.rows.joints[j].dof = dof;
        }
    }
    const auto put = [](auto& to, const auto& from) {
        const std::size_t first = to.first, last = to.last;
        to = from;
        to.first = first, to.last = last;
    };
    at = 0;
    for (const std::uint32_t c : couplings_.of(part)) put(p.rows.couplings[c], s.rows.couplings[at++]);
    at = 0;
    for (const std::uint32_t c : contacts_.of(part)) put(p.rows.contacts[c], s.rows.contacts[at++]);
    at = 0;
    for (const std::uint32_t a : angulars_.of(part)) {
        const std::size_t contact = p.rows.angulars[a].contact;
        put(p.rows.angulars[a], s.rows.angulars[at++]);
        p.rows.angulars[a].contact = contact;
    }
}

/// Rows of contacts between parts, as the solver leaves rows that do not push.
void IslandParts::finish_left_out(const Problem& p, const std::vector<double>& v) const {
    const auto finish = [&](std::size_t first, std::size_t last, BoundedRow& row, FrictionDisc& disc) {
        if (p.position) aim_at_displacement(row);
        row.stiffness = 1 / row.compliance, disc.stiffness = 1 / disc.compliance;
        const jacobian::Along<double> u = jacobian::along(p.rows.columns, first, last, v);
        row.u = u.n, disc.u_1 = u.t1 - disc.target_1, disc.u_2 = u.t2 - disc.target_2;
        row.impulse = row.d = 0;
        disc.bound = disc.impulse_1 = disc.impulse_2 = disc.d_11 = disc.d_12 = disc.d_22 = 0;
    };
    for (std::size_t c = 0; c < ends_.size(); ++c) {
        ContactRow& row = p.rows.contacts[c];
        if (is_left_out(c)) finish(row.first, row.last, row.normal, row.slip);
    }
    for (AngularRow& row : p.rows.angulars) {
        if (!is_left_out(row.contact)) continue;
        finish(row.first, row.last, row.spin, row.roll);
        row.spin.low = row.spin.high = 0;
    }
}

}  // namespace roboss
