// See contact_island.h.
#include "physics/contact/contact_island.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/check.h"
#include "core/make_room.h"
#include "physics/bonds/bond_rows.h"
#include "physics/contact/even_motion.h"
#include "physics/dynamics/drag.h"
#include "physics/dynamics/fast_turning.h"
#include "physics/dynamics/fluid_forces.h"
#include "physics/dynamics/lone_body.h"
#include "physics/dynamics/velocity_forces.h"
#include "physics/dynamics/warm_start.h"
#include "physics/solver/row_math.h"

namespace roboss {
namespace {

/// Marks the robots that a contact pushes, in their velocity or displacement.
void mark_pushed(std::span<RobotWork> robots, IslandScratch& s) {
    for (std::size_t c = 0; c < s.rows.contacts.size(); ++c) {
        const Contact& contact = *s.contacts[c];
        if (contact.impulse <= 0 && s.rows.contacts[c].normal.impulse <= 0) continue;
        robots[static_cast<std::size_t>(contact.robot_a)].pushed = true;
        if (contact.robot_b >= 0) robots[static_cast<std::size_t>(contact.robot_b)].pushed = true;
    }
}

bool flies(const Model& model, const RobotWork& work, const IslandScratch& s) {
    return moves_freely(model, work) && !(s.group.keep_reactions && !work.type->loops.empty());
}

/// By the last solution, of the exact solver in the rows, of soft substeps in the contacts.
bool pushes(const IslandScratch& s, std::size_t c) {
    return (s.rows.contacts.empty() ? s.contacts[c]->impulse : s.rows.contacts[c].normal.impulse) > 0;
}

/// Marks the robots that another robot or scenery pushes, by the impulses of the last solution, and notes
/// whether the island is anchored: pushed by something that does not move freely.
void mark_touched(std::span<const RobotWork> robots, IslandScratch& s) {
    // With the exact solver the hits that were found last may have no rows.
    const std::size_t solved = s.rows.contacts.empty() ? s.contacts.size() : s.rows.contacts.size();
    for (std::size_t c = 0; c < solved; ++c) {
        const Contact& contact = *s.contacts[c];
        if (!pushes(s, c) || contact.robot_a == contact.robot_b) continue;
        s.anchored |= touches_fixed(robots, contact);
        s.touched[static_cast<std::size_t>(contact.robot_a)] = 1;
        if (contact.robot_b >= 0) s.touched[static_cast<std::size_t>(contact.robot_b)] = 1;
    }
}

/// Which members drift, and, if any does (then true), the split of the solved impulses. Where nothing pushes
/// an island from outside its momentum is to stay, and that of its energy that no motor gives: then all
/// drift. Others do where they turn fast.
bool choose_drifting(const Model& model, std::span<const RobotWork> robots, IslandScratch& s,
                     std::span<const std::uint32_t> members, bool is_soft = false) {
    s.touched.resize(robots.size());
    for (const std::uint32_t m : members) s.touched[m] = 0;
    s.anchored = false;
    mark_touched(robots, s);
    s.drifts.assign(members.size(), 0);
    bool any = false;
    for (std::size_t m = 0; m < members.size(); ++m) {
        const RobotWork& work = robots[members[m]];
        if (work.type->nv == 0 || drag_is_stiff(model, work)) continue;
        if (is_soft && work.type->dofs.empty()) continue;  // soft substeps move free bodies
        if (work.type->feels_flow && flow_is_stiff(model, work)) continue;
        const bool kept = s.touched[members[m]]
                              ? !s.anchored
                              : work.type->free_base || !is_driven<double>(work.state->motors);
        if (!kept && !turns_fast<double>(work, model.dt_s)) continue;
        s.drifts[m] = 1;
        any = true;
    }
    if (any) split_rows({model.accuracy, s.robots, s.offsets, s.rows}, s.v_before, s.v, model.dt_s, s.split);
    return any;
}

/// Solves for the displacement of the tick, from what stands there. `solved`: see IslandParts::solve.
void solve_displacement(const Model& model, IslandScratch& s, std::size_t solved, StepReport& report) {
    const IslandSolver::Problem problem{model.accuracy, s.robots, s.offsets, s.rows, true};
    report.iterations += s.solver.solve(problem, s.displacement, s.team, solved).iterations;
    if (s.group.profiles_solver) add_solves(s.solver.solves(), report.profile.solver.displacements);
}

/// N m s: what the rows of swept contacts between robots lack of conserving angular momentum. They push both
/// robots at the place of the impact, but with the arms that it has from where the bodies are at the
/// beginning.
Vec3 late_moment(const IslandScratch& s) {
    Vec3 moment;
    for (const Contact* c : s.contacts) {
        if (c->time == 0 || c->robot_a == c->robot_b || c->robot_b < 0) continue;
        const Vec3 push = c->normal * c->impulse + c->friction;
        moment += cross(c->shift_b, push);
    }
    return moment;
}

/// Moves one member by the kick-drift step.
void drift(const Model& model, RobotWork& work, std::size_t member, bool touched,
           std::span<const double> displacement, IslandScratch& s) {
    const auto offset = static_cast<std::size_t>(s.offsets[member]);
    const auto nv = static_cast<std::size_t>(work.type->nv);
    const auto own = [&](const auto& array) { return std::span(array).subspan(offset, nv); };
    SolvedTick solved;
    solved.velocity = own(s.v), solved.displacement = displacement.subspan(offset, nv);
    solved.kick = own(s.split.kick), solved.load = own(s.split.load), solved.locked = own(s.split.locked);
    solved.held = own(s.split.held);
    solved.isolated = !touched && !work.bonded;
    solved.passive = is_passive(model, work);
    solved.flies_displaced = s.anchored && s.large_turns[member] != 0;
    s.gained_moment += advance_kick_drift(model, work, solved, s.free_buffer);
}

/// Writes the solved velocities into the states and moves the coordinates. A robot that is near something but
/// not pushed moves freely, else a ball would lose height in every tick that it spends close to the ground.
void finish_island(const Model& model, std::span<RobotWork> robots, IslandScratch& s,
                   std::span<const std::uint32_t> members, std::span<const double> displacement,
                   bool is_soft = false) {
    for (std::size_t m = 0; m < members.size(); ++m) {
        RobotWork& work = robots[members[m]];
        if (is_soft && work.type->dofs.empty()) continue;  // soft substeps move free bodies
        const auto offset = static_cast<std::size_t>(s.offsets[m]);
        const auto nv = static_cast<std::size_t>(work.type->nv);
        if (!work.pushed && flies(model, work, s)) {
            advance_freely(model, work, s.free_buffer);
            continue;
        }
        work.held = true;
        if (s.drifts[m]) {
            drift(model, work, m, s.touched[members[m]] != 0, displacement, s);
            continue;
        }
        std::copy_n(s.v.begin() + static_cast<std::ptrdiff_t>(offset), nv, work.state->v.begin());
        advance_coordinates<double>(*work.type, displacement.subspan(offset, nv), model.dt_s, work.state->q);
        if (work.type->has_equalities()) s.free_buffer.projection.close_coordinates(work, work.state->q);
    }
}

/// Empties the island. The velocities of its robots will be in `v`.
void start_island(std::size_t robots_of_group, IslandScratch& s, std::vector<double>& v) {
    s.robots.clear(), s.offsets.clear(), s.rows.clear(), v.clear();
    s.offsets_of_group.resize(robots_of_group);
}

/// Adds a robot by its number in the group, and its velocities before the tick to `v`; their first place
/// there.
int add_robot(std::uint32_t number, RobotWork& work, IslandScratch& s, std::vector<double>& v) {
    const int offset = static_cast<int>(v.size());
    s.offsets_of_group[number] = offset;
    s.robots.push_back(&work), s.offsets.push_back(offset);
    v.insert(v.end(), work.state->v.begin(), work.state->v.end());
    return offset;
}

/// Adds what drives a robot: its impulse, its mass matrix, the rows of its joints. As gather_island.
bool add_drives(const Model& model, RobotWork& work, int offset, IslandScratch& s) {
    compute_impulse(model, model.dt_s, 1.0, work.state->q, work.state->v, work);
    compute_mass_matrix<double>(*work.type, model.dt_s, work);
    limit_velocity_forces(model, work, s.free_buffer);
    return add_joint_rows(model, work, offset, s.buffer, s.rows);
}

/// Gathers rows and first guess of one contact island; true if the displacement of the tick needs a solution
/// of its own.
bool gather_island(const Model& model, std::span<RobotWork> robots, IslandScratch& s,
                   std::span<const std::uint32_t> members, std::span<Contact> contacts) {
    start_island(robots.size(), s, s.v);
    s.surfaces.clear();
    s.rows.keeps_places =
        std::ranges::any_of(members, [&](std::uint32_t m) { return !robots[m].type->elimination.empty(); });
    bool split = false;
    for (std::uint32_t m : members) {
        const int offset = add_robot(m, robots[m], s, s.v);
        split |= add_drives(model, robots[m], offset, s);
    }
    for (std::uint32_t m : members) {
        const std::span<Contact> own = contacts_of(m, contacts);
        make_room(s.rows.contacts, s.rows.contacts.size() + own.size());
        make_room(s.surfaces, s.surfaces.size() + own.size());
        for (Contact& c : own) {
            const SurfacePair& surface = s.surfaces.emplace_back(surface_of(model, robots, c));
            split |= add_contact_row(model, c, surface, robots, s.offsets_of_group, s.rows);
            add_angular_row(model, c, surface, robots, s.offsets_of_group, s.rows);
            s.contacts.push_back(&c);
        }
    }
    for (std::size_t b = 0; b < s.bonds.size(); ++b)
        add_bond_rows(model, robots, s.offsets_of_group, s.bonds[b], static_cast<int>(b), s.rows);
    return split;
}

/// The solved impulses, into motors and contacts: what the next tick starts from.
void take_impulses(IslandScratch& s) {
    for (const JointRow& row : s.rows.joints)
        if (row.motor != nullptr) store_warm_start(row.impulse, *row.motor);
    for (const CouplingRow& row : s.rows.couplings)
        if (row.motor != nullptr) store_warm_start(row.impulse, *row.motor);
    take_bond_impulses(s.rows, s.bonds);
    if (s.group.keep_reactions)
        for (const CouplingRow& row : s.rows.couplings)
            if (row.loop >= 0) s.reactions.push_back({row.robot, row.loop, row.wrench * row.impulse});
    for (std::size_t c = 0; c < s.rows.contacts.size(); ++c)
        take_impulse(s.rows.contacts[c], s.surfaces[c].friction, *s.contacts[c]);
    for (const AngularRow& row : s.rows.angulars) {
        Contact& contact = *s.contacts[row.contact];
        Vec3 t1, t2;
        tangents(contact.normal, t1, t2);
        contact.moment =
            contact.normal * row.spin.impulse + t1 * row.roll.impulse_1 + t2 * row.roll.impulse_2;
    }
}

/// The displacement of the whole island goes back towards its velocity, by one share, so that it still fits
/// at every contact.
void limit_correction(std::span<const RobotWork> robots, IslandScratch& s,
                      std::span<const std::uint32_t> members) {
    double share = 1;
    for (std::size_t m = 0; m < members.size(); ++m) {
        const std::vector<double>& before = robots[members[m]].state->v;
        const auto part = [&](const std::vector<double>& v) {
            return std::span(v).subspan(static_cast<std::size_t>(s.offsets[m]), before.size());
        };
        share = std::min(share, share_of_correction<double>(before, part(s.v), part(s.displacement)));
    }
    if (share == 1) return;
    for (std::size_t i = 0; i < s.v.size(); ++i)
        s.displacement[i] = s.v[i] + share * (s.displacement[i] - s.v[i]);
}

/// Free bodies that hardly turn, before and after the tick.
bool slides_only(std::span<const RobotWork> robots, const IslandScratch& s,
                 std::span<const std::uint32_t> members) {
    for (std::size_t m = 0; m < members.size(); ++m) {
        const RobotType& type = *robots[members[m]].type;
        if (type.nv == 0) continue;
        if (!is_free_body(type)) return false;
        const auto offset = static_cast<std::size_t>(s.offsets[m]);
        const auto own = [&](const std::vector<double>& v) { return std::span(v).subspan(offset, 6); };
        if (!hardly_turns<double>(own(s.v_before)) || !hardly_turns<double>(own(s.v))) return false;
    }
    return true;
}

/// What slides without turning moves by the mean of its velocities before and after the tick, which is exact
/// while it speeds up or slows down evenly. Only there, for no force on it depends on its place; where one
/// does (whatever rocks, swings or hangs on a spring) this would add energy to the motion in each tick.
void take_mean_displacement(std::span<const RobotWork> robots, IslandScratch& s,
                            std::span<const std::uint32_t> members, bool drifts, double dt) {
    const bool even = !drifts && slides_only(robots, s, members) &&
                      contacts_are_steady<double>(s.rows, s.v_before, s.v, dt);
    s.displacement.resize(s.v.size());
    for (std::size_t i = 0; i < s.v.size(); ++i)
        s.displacement[i] = even ? 0.5 * (s.v_before[i] + s.v[i]) : s.v[i];
}

/// From now on no contact asks for more than the displacement gives, and friction is that of the velocities.
void hold_displacement(IslandScratch& s, bool split) {
    for (ContactRow& row : s.rows.contacts) {
        const jacobian::Along<double> u =
            jacobian::along(s.rows.columns, row.first, row.last, s.displacement);
        const double given = u.n + row.normal.position_compliance * row.normal.impulse;
        row.normal.position_target = std::min(row.normal.position_target, given);
        if (!split) row.slip.bound = row.slip.coefficient * row.normal.impulse;
    }
    for_each_bounded(s.rows, [](BoundedRow& row) { aim_at_displacement(row); });
}

/// Stops the displacement at the first hit. Where robots hit only each other, their centre of mass goes on:
/// it is their motion relative to it that stops.
void stop_at_first_hit(const Model& model, std::span<RobotWork> robots, IslandScratch& s,
                       std::span<const std::uint32_t> members) {
    const double share = s.look.first_time() / model.dt_s;
    const bool free = !s.anchored && std::ranges::none_of(s.look.hits(), [&](const Contact& hit) {
        return touches_fixed(robots, hit);
    });
    s.anchored |= !free;  // what is stopped gets its momentum from there
    for (const Contact& hit : s.look.hits()) {
        if (hit.robot_a == hit.robot_b) continue;
        s.touched[static_cast<std::size_t>(hit.robot_a)] = 1;
        if (hit.robot_b >= 0) s.touched[static_cast<std::size_t>(hit.robot_b)] = 1;
    }
    BodySums all;
    for (std::size_t m = 0; free && m < members.size(); ++m) {
        const RobotWork& robot = robots[members[m]];
        if (!robot.type->free_base) continue;
        const auto own =
            std::span(s.displacement)
                .subspan(static_cast<std::size_t>(s.offsets[m]), static_cast<std::size_t>(robot.type->nv));
        s.free_buffer.work.take(*robot.type, *robot.state);
        all += sum_bodies(model, robot.state->q, own, robot.origin, s.free_buffer.work);
    }
    const Vec3 common = all.inertia.mass > 0 ? all.momentum.linear * (1.0 / all.inertia.mass) : Vec3{};
    for (double& x : s.displacement) x *= share;
    for (std::size_t m = 0; free && m < members.size(); ++m) {
        if (!robots[members[m]].type->free_base) continue;
        const auto linear = static_cast<std::size_t>(s.offsets[m]) + 3;
        for (std::size_t i = 0; i < 3; ++i) s.displacement[linear + i] += (1 - share) * common[i];
    }
}

/// Lone bodies whose velocity or displacement is a large turn: where one is, the other may be small. Decided
/// once for the second look and the integrator, and before the displacement is cut at a hit.
void find_large_turns(const Model& model, std::span<const RobotWork> robots, IslandScratch& s,
                      std::span<const std::uint32_t> members) {
    s.large_turns.resize(members.size());
    for (std::size_t m = 0; m < members.size(); ++m) {
        const RobotType& type = *robots[members[m]].type;
        const auto turns = [&](const std::vector<double>& v) {
            const double* w = v.data() + s.offsets[m];
            return is_large_turn(type, {w[0], w[1], w[2]}, model.dt_s);
        };
        s.large_turns[m] = is_free_body(type) && (turns(s.v) || turns(s.displacement));
    }
}

/// Whether mark_touched will find the island anchored, by what is solved so far.
bool is_anchored(std::span<const RobotWork> robots, const IslandScratch& s) {
    bool anchored = s.anchored;
    if (std::ranges::find(s.large_turns, 1) == s.large_turns.end()) return anchored;
    for (std::size_t c = 0; c < s.contacts.size() && !anchored; ++c)
        anchored = s.rows.contacts[c].normal.impulse > 0 &&
                   s.contacts[c]->robot_a != s.contacts[c]->robot_b && touches_fixed(robots, *s.contacts[c]);
    return anchored;
}

/// Keeps the displacement from what it would hit beyond the contacts that it was solved for. What a few
/// rounds do not settle stops at the first hit.
void stop_late_hits(const Model& model, std::span<RobotWork> robots, IslandScratch& s,
                    std::span<const std::uint32_t> members, bool split, StepReport& report) {
    constexpr int kRounds = 4;
    s.look.clear();
    find_large_turns(model, robots, s, members);
    if (!is_plausible(s.displacement)) return;
    const std::size_t found = s.contacts.size();
    for (int round = 0; round <= kRounds; ++round) {
        SolvedIsland island = solved_island(model, robots, members, s, found);
        island.anchored = is_anchored(robots, s);
        if (!s.look.find(island, round == 0)) break;
        if (round == kRounds) {
            stop_at_first_hit(model, robots, s, members);
            break;
        }
        if (round == 0) hold_displacement(s, split);
        for (const Contact& hit : s.look.hits()) {
            if (hit.robot_b < 0) continue;
            robots[static_cast<std::size_t>(hit.robot_a)].touches_robot = true;
            robots[static_cast<std::size_t>(hit.robot_b)].touches_robot = true;
        }
        const std::size_t solved = s.rows.contacts.size();
        s.look.add_rows(island, s.rows, s.surfaces);
        solve_displacement(model, s, solved, report);
        find_large_turns(model, robots, s, members);
    }
    s.contacts.resize(found);
    for (Contact& hit : s.look.hits()) s.contacts.push_back(&hit);
    if (s.contacts.size() > found) mark_pushed(robots, s);
}

/// True if the island's energy is to be guarded.
bool start_guard(const Model& model, std::span<RobotWork> robots, IslandScratch& s,
                 std::span<const std::uint32_t> members, bool bounces, bool drifts) {
    IslandGuard::Island island{members, s.offsets, s.v_before, s.surfaces, s.contacts, s.rows};
    island.touched = std::ranges::any_of(members, [&](std::uint32_t m) { return s.touched[m] != 0; });
    island.bonded = !s.bonds.empty();
    island.anchored = s.anchored, island.bounces = bounces, island.drifts = drifts;
    for (std::size_t m = 0; m < members.size(); ++m)
        island.blown |= s.drifts[m] == 0 && robots[members[m]].type->feels_flow;
    return s.guard.start(model, robots, island, s.free_buffer.work);
}

/// The bonds that join the members.
void gather_bonds(std::span<const std::uint32_t> members, IslandScratch& s) {
    s.bonds.clear();
    const std::span<const HeldBond> held = s.group.bonds;
    if (held.empty()) return;
    for (const std::uint32_t m : members)
        for (auto at = std::ranges::lower_bound(held, m, {}, &HeldBond::holder);
             at != held.end() && at->holder == m; ++at)
            s.bonds.push_back(*at);
}

/// Keeps what the next tick starts from: what hard motors gave; of an axis without one, what its limits and
/// friction bore.
void remember_joints(const Model& model, const RobotWork& robot, std::span<const JointRow> rows, int offset) {
    const RobotType& type = *robot.type;
    std::vector<MotorSetpoint>& motors = robot.state->motors;
    const auto is_hard = [&](std::size_t d) {
        const JointStates<double> states{robot.state->q, robot.state->v, motors, robot.type->dofs};
        return has_hard_motor(tree_axis<double>(model, type, states, d));
    };
    for (std::size_t d = 0; d < type.dofs.size(); ++d)
        if (!is_hard(d)) motors[d].impulse = motors[d].load = 0;
    for (const JointRow& row : rows) {
        const auto d = static_cast<std::size_t>(row.dof - offset - type.base_nv());
        if (row.motor != nullptr)
            store_warm_start(row.impulse, motors[d]);
        else if (soft::is_remembered(row) && !is_hard(d))
            motors[d].impulse += row.impulse;
    }
}

}  // namespace

/// Robots, their places among the velocities, and what drives those with joints; true if there are any.
bool ContactIsland::gather_joints() {
    start_island(robots_.size(), s_, s_.v_before);
    bool any = false;
    for (const std::uint32_t m : members_) {
        const int offset = add_robot(m, robots_[m], s_, s_.v_before);
        if (robots_[m].type->dofs.empty()) continue;
        any = true;
        add_drives(model_, robots_[m], offset, s_);
    }
    s_.v.resize(s_.v_before.size()), s_.displacement.resize(s_.v.size());
    return any;
}

/// How soft substeps' robots with joints are to move, and what their motors start from in the next tick.
void ContactIsland::finish_joints() {
    for (JointRow& row : s_.rows.joints) row.stiffness = 1 / row.compliance;
    drifts_ = choose_drifting(model_, robots_, s_, members_, true);
    if (drifts_) s_.soft.prepare_drift(soft_island(), s_.drifts, s_.split.kick, s_.displacement);
    std::size_t row = 0;
    for (std::size_t m = 0; m < members_.size(); ++m) {
        const RobotWork& work = robots_[members_[m]];
        const auto end = static_cast<std::size_t>(
            std::ranges::lower_bound(s_.rows.joints, s_.offsets[m] + work.type->nv, {}, &JointRow::dof) -
            s_.rows.joints.begin());
        remember_joints(model_, work, std::span(s_.rows.joints).subspan(row, end - row), s_.offsets[m]);
        row = end;
    }
    s_.large_turns.assign(members_.size(), 0), s_.gained_moment = {};
}

ContactIsland::ContactIsland(const Model& model, std::span<RobotWork> robots,
                             std::span<const std::uint32_t> members, IslandScratch& scratch,
                             StepReport& report)
    : model_(model), robots_(robots), members_(members), s_(scratch), report_(report) {
    ROBOSS_CHECK(!members.empty(), "a contact island without robots");
    s_.contacts.clear();
    s_.free_buffer.share_with(s_.team);
    gather_bonds(members, s_);
    const auto is_tied = [&](const HeldBond& b) {
        return b.other == HeldBond::kScenery || !robots[b.holder].type->free_base ||
               !robots[b.other].type->free_base;
    };
    is_tied_ = std::ranges::any_of(s_.bonds, is_tied);
    if (members.size() > 1) return;
    const RobotWork& work = robots[members[0]];
    has_rows_ = work.type->nv > 0 && (work.contacts > 0 || !flies(model, work, s_));
}

void ContactIsland::build_rows() {
    is_soft_ = take_soft();
    if (is_soft_) return;
    needs_displacement_ = gather_island(model_, robots_, s_, members_, s_.group.contacts);
    s_.v_before = s_.v;
    ROBOSS_CHECK(
        s_.rows.contacts.size() == s_.contacts.size() && s_.rows.contacts.size() == s_.surfaces.size(),
        std::to_string(s_.rows.contacts.size()) + " contact rows, " + std::to_string(s_.contacts.size()) +
            " contacts");
}

void ContactIsland::solve_velocities() {
    iterations_before_ = report_.iterations;
    if (is_soft_) return solve_soft();
    const IslandSolver::Problem problem{model_.accuracy, s_.robots, s_.offsets, s_.rows};
    const SolveReport solved = s_.solver.solve(problem, s_.v, s_.team);
    largest_part_ = s_.solver.largest_part();
    if (s_.group.profiles_solver) {
        s_.solver.profile_friction(problem, report_.profile.solver);
        add_solves(s_.solver.solves(), report_.profile.solver.velocities);
    }
    report_.iterations += solved.iterations;
    report_.residual = std::max(report_.residual, solved.residual);
    ROBOSS_CHECK(s_.v.size() == s_.v_before.size(), std::to_string(s_.v.size()));
    drifts_ = choose_drifting(model_, robots_, s_, members_);
    s_.anchored |= is_tied_;
    take_impulses(s_);
    bounces_ = throws_back(s_.rows);
}

void ContactIsland::solve_displacements() {
    if (is_soft_) return;
    if (needs_displacement_) {
        s_.displacement = s_.v;
        for (ContactRow& row : s_.rows.contacts) turn_to_displacement(row);
        solve_displacement(model_, s_, s_.rows.contacts.size(), report_);
        limit_correction(robots_, s_, members_);
    } else {
        take_mean_displacement(robots_, s_, members_, drifts_, model_.dt_s);
    }
    mark_pushed(robots_, s_);
    stop_late_hits(model_, robots_, s_, members_, needs_displacement_, report_);
    mark_touched(robots_, s_);
    if (s_.group.profiles_solver) profile_island(largest_part_);
}

void ContactIsland::profile_island(int largest_part) {
    SolverProfile& profile = report_.profile.solver;
    profile.add_island(members_.size(), static_cast<std::size_t>(largest_part),
                       report_.iterations - iterations_before_);
    if (members_.size() > 1)
        profile.most_contacts = std::max<std::uint64_t>(profile.most_contacts, s_.contacts.size());
}

void ContactIsland::integrate() {
    if (!has_rows_) {
        RobotWork& work = robots_[members_[0]];
        if (work.type->nv > 0) advance_freely(model_, work, s_.free_buffer);
        return;
    }
    if (is_soft_) {
        guards_momentum_ = s_.soft_guard.start(soft_island(), s_.free_buffer.work);
        guards_energy_ = has_joints_ && start_guard(model_, robots_, s_, members_, s_.soft.bounces(),
                                                    drifts_ || s_.soft.is_deep());
        s_.soft.move(soft_island(), s_.free_buffer);
        if (has_joints_) finish_island(model_, robots_, s_, members_, s_.displacement, true);
        return;
    }
    s_.gained_moment = {};
    guards_energy_ = start_guard(model_, robots_, s_, members_, bounces_, drifts_);
    ROBOSS_CHECK(s_.displacement.size() == s_.v.size(), std::to_string(s_.displacement.size()));
    finish_island(model_, robots_, s_, members_, s_.displacement);
}

void ContactIsland::guard() {
    if (!has_rows_) return;
    if (is_soft_) {
        if (guards_momentum_) s_.soft_guard.finish(soft_island(), s_.free_buffer.work);
        if (guards_energy_) s_.guard.finish(model_, robots_, members_, s_.free_buffer.work);
        return;
    }
    const auto moved_well = [&](std::uint32_t m) {
        return is_plausible(robots_[m].state->q) && is_plausible(robots_[m].state->v);
    };
    if (s_.look.may_push_out() && std::ranges::all_of(members_, moved_well))
        s_.look.push_out(robots_, model_);
    if (!s_.bonds.empty() && std::ranges::all_of(members_, moved_well)) close_bonds();
    if (!s_.anchored)
        if (const Vec3 moment = late_moment(s_) - s_.gained_moment; moment != Vec3{})
            turn_island(model_, robots_, members_, moment, s_.free_buffer.work);
    if (guards_energy_) s_.guard.finish(model_, robots_, members_, s_.free_buffer.work);
}

/// Robots are put back onto their bonds; where nothing pushes the island from outside, its momentum stays.
void ContactIsland::close_bonds() {
    RobotWork& buffer = s_.free_buffer.work;
    const Vec3 origin = robots_[members_[0]].origin;
    const auto sums = [&] { return sum_robots(model_, robots_, members_, origin, buffer); };
    const Spatial before = s_.anchored ? Spatial{} : sums().momentum;
    s_.bond_projection.close(robots_, s_.bonds);
    if (s_.anchored) return;
    const BodySums after = sums();
    add_momentum(robots_, members_, after, before - after.momentum, origin);
}

void ContactIsland::put_to_sleep() {
    settle_island(model_, robots_, members_, s_.contacts, s_.surfaces, s_.bonds, s_.free_buffer.work);
}

}  // namespace roboss
