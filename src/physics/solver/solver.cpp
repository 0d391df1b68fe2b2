// See solver.h.
#include "physics/solver/solver.h"

#include <algorithm>

namespace roboss {
namespace {

constexpr std::size_t kPile = 4;        // robots
constexpr std::size_t kDrivenPile = 9;  // robots with motors
constexpr newton::Plan kPilePlan{
    .far_max = 30, .coupled_steps = 12, .halvings = 3, .progress = 0.3, .checks = 10};

/// Robots that lean on each other: coupled steps are shortened.
constexpr newton::Plan kCrowdPlan{.halvings = 3, .progress = 0.3};

/// Where Newton's method would turn one row after the other. Motors hold few robots apart from a pile: most
/// of their wheels and feet do what they did in the last tick.
bool is_pile(const IslandSolver::Problem& p) {
    const auto is_motor = [](const JointRow& row) { return row.motor != nullptr; };
    const bool is_driven = std::ranges::any_of(p.rows.joints, is_motor);
    return p.robots.size() >= (is_driven ? kDrivenPile : kPile) && !p.rows.contacts.empty();
}

}  // namespace

/// Newton's method, and where many contacts stand between sticking and sliding the interior point method:
/// each Newton step would turn only one of them, for the potential of hard rows is all edges. The interior
/// point method goes through the middle, in a number of steps that hardly depends on the problem: once with
/// the bounds of the last tick, once with those that follow from it.
void IslandSolver::solve_any(const Problem& p, std::vector<double>& v, Report& report) {
    Lockstep<double> alone;
    const bool piled = is_pile(p);
    plan_ = piled ? kPilePlan : p.robots.size() > 1 ? kCrowdPlan : newton::Plan{};
    start(p, v);
    friction::keep_bounds(p.rows, start_bounds_);
    if (piled) {
        if (p.position ? displace(p, v, report) : solve_by_sweeps(p, v, report)) return;
        start_as_expected(p, alone, v, report);
        if (Newton::iterate(p, alone, v, report, p.position)) return;
    } else if (Newton::solve(p, alone, v, report)) {
        return;
    }
    friction::set_bounds(p.rows, start_bounds_);
    interior_point(p, v, report);
    if (p.position) return;
    friction::fit_bounds(p.rows, [&](std::size_t c) { return p.rows.contacts[c].normal.impulse; });
    if (Newton::solve(p, alone, v, report)) return;
    interior_point(p, v, report);
}

bool IslandSolver::solve_plainly(const Problem& p, std::vector<double>& v, SolveReport& report) {
    v_before_ = v, contacts_before_ = p.rows.contacts;
    Lockstep<double> alone;
    Report solved;
    plan_ = {};
    start(p, v);
    const bool balances = Newton::solve(p, alone, v, solved);
    report = {static_cast<int>(solved.iterations), solved.residual};
    if (balances && newton::meets_tolerances(p, solved.residual)) return true;
    v = v_before_, p.rows.contacts = contacts_before_;
    report.residual = 0;
    return false;
}

SolveReport IslandSolver::solve(const Problem& p, std::vector<double>& v) {
    constexpr double kUseless = 1e-2;       // of the residual
    constexpr double kWrongFriction = 0.5;  // relative to the largest normal impulse
    Report report;
    solve_any(p, v, report);
    const bool is_wrong = !p.position && p.robots.size() > 1 && sweeps_know_friction(p.rows) &&
                          friction::bound_error(p.rows).relative() > kWrongFriction;
    if (is_wrong || !(report.residual <= kUseless)) {
        settle_for_sweeps(p, v);
        set_gradient(p);
        report.residual = imbalance(p);
    }
    return {static_cast<int>(report.iterations), report.residual};
}

}  // namespace roboss
