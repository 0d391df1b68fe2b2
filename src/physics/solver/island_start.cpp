// Where IslandSolver starts in a pile of robots: velocities from sweeps, and the displacement by an active
// set method. physics/bodies has the same for free bodies.
#include <algorithm>
#include <cmath>

#include "physics/contact/friction_bounds.h"
#include "physics/solver/newton_rows.h"
#include "physics/solver/solver.h"

namespace roboss {
namespace {

constexpr double kSticking = 0.998;  // of the squared friction bound: beyond, a sweep says that it slides

/// Whether sweeps may settle the part, as they do with free bodies (decisions 0037, 0039): of robots without
/// motors any pile, for their joints have nothing to hold; else only large ones, where Newton's method is
/// costly.
bool may_settle(const SolveProblem<double>& p) {
    constexpr std::size_t kLarge = 16;  // robots
    const IslandRows& rows = p.rows;
    if (!rows.couplings.empty() || !sweeps_know_friction(rows)) return false;
    if (p.robots.size() >= kLarge) return true;
    return std::ranges::none_of(rows.joints, [](const JointRow& row) { return row.motor != nullptr; });
}

SweepPlan sweep_plan(const SolveProblem<double>& p) {
    constexpr double kStartTolerance = 1e-10;  // from there Newton's method mostly ends at its first try
    // Impulses spread through few robots a sweep.
    const int most = p.robots.size() < 16 ? 60 : 200;
    SweepPlan plan = may_settle(p) ? pile_plan(p.accuracy, most, Fill::kLittle) : SweepPlan{.most = most};
    plan.start_tolerance = kStartTolerance;
    return plan;
}

/// A part in which contacts mostly carry loads: it probably does what it did in the last tick.
bool hardly_moves(const IslandRows& rows) {
    constexpr double kLittle = 1e-2;  // of the squared impulses
    double motion = 0, impulses = 0;
    for (const ContactRow& row : rows.contacts) {
        const FrictionDisc& slip = row.slip;
        motion += (row.normal.u * row.normal.u + slip.u_1 * slip.u_1 + slip.u_2 * slip.u_2) /
                  row.inverse_effective_mass;
        impulses += row.normal.impulse * row.normal.impulse * row.inverse_effective_mass;
    }
    return motion < kLittle * impulses;
}

/// The impulse between the row's bounds, or at one of them.
void set_between(BoundedRow& row) {
    row.d = row.stiffness;
    row.impulse = (row.target - row.u) * row.stiffness;
}
void set_at(double bound, BoundedRow& row) {
    row.d = 0;
    row.impulse = bound;
}
void set_as_swept(double swept, BoundedRow& row) {
    if (swept > row.low && swept < row.high)
        set_between(row);
    else
        set_at(swept, row);
}

/// What friction does at a normal impulse that is swept.
void set_as_swept(const RowSweeps::ContactImpulse& swept, FrictionDisc& slip) {
    if (!(slip.bound > 0)) {
        slip.impulse_1 = slip.impulse_2 = 0;
        return;
    }
    if (slip_disc::slips(slip)) {
        const Tangential t = impulse_at(slip, slip.u_1, slip.u_2, slip.bound);
        slip.impulse_1 = t.t1, slip.impulse_2 = t.t2;
        return;
    }
    const double size2 = swept.t1 * swept.t1 + swept.t2 * swept.t2, bound2 = slip.bound * slip.bound,
                 speed2 = slip.u_1 * slip.u_1 + slip.u_2 * slip.u_2;
    if (size2 < kSticking * bound2 || speed2 * slip.stiffness * slip.stiffness <= bound2) {
        slip.d_11 = slip.d_22 = slip.stiffness, slip.d_12 = 0;
        slip.impulse_1 = -slip.u_1 * slip.stiffness, slip.impulse_2 = -slip.u_2 * slip.stiffness;
    } else {
        const double share = -slip.bound / std::sqrt(speed2);
        slip.impulse_1 = share * slip.u_1, slip.impulse_2 = share * slip.u_2;
    }
}

}  // namespace

/// Impulses and curvatures as the sweeps left each row, at the velocities that they found.
void IslandSolver::expect_swept(const Problem& p) {
    IslandRows& rows = p.rows;
    friction::fit_bounds(rows, [&](std::size_t c) { return sweeps_.contact(c).n; });
    newton::update_impulses(rows);
    newton::set_curvatures(rows);
    for (std::size_t r = 0; r < rows.joints.size(); ++r) set_as_swept(sweeps_.joint(r), rows.joints[r]);
    for (std::size_t r = 0; r < rows.couplings.size(); ++r)
        set_as_swept(sweeps_.coupling(r), rows.couplings[r]);
    for (std::size_t c = 0; c < rows.contacts.size(); ++c) {
        set_as_swept(sweeps_.contact(c).n, rows.contacts[c].normal);
        set_as_swept(sweeps_.contact(c), rows.contacts[c].slip);
    }
}

/// A step to where the robots would be if every row did what the sweeps say.
void IslandSolver::step_as_swept(const Problem& p, std::vector<double>& v, Report& report) {
    take_velocities(p, v);
    expect_swept(p);
    set_gradient(p);
    find_step(p, false);
    move(p, 1.0, v);
    report.iterations += 1;
    report.residual = balance(p);
}

/// A pile at rest: coupled steps of Newton's method from where every contact does what it did in the last
/// tick. False, and back to the start, if they do not end.
bool IslandSolver::continue_at_rest(const Problem& p, std::vector<double>& v, Report& report) {
    if (p.again || !hardly_moves(p.rows)) return false;
    Lockstep<double> alone;
    start_as_expected(p, alone, v, report);
    if (report.residual <= plan_.couple_from && solve_coupled(p, alone, v, report)) return true;
    return_to_beginning(p, v);
    return false;
}

void IslandSolver::keep_beginning(const Problem& p, const std::vector<double>& v) {
    v_beginning_ = v;
    friction::keep_bounds(p.rows, start_bounds_);
    carried_.clear();
    for (const ContactRow& row : p.rows.contacts) carried_.push_back(row.normal.impulse);
}

void IslandSolver::return_to_beginning(const Problem& p, std::vector<double>& v) {
    v = v_beginning_;
    take_velocities(p, v);
    friction::set_bounds(p.rows, start_bounds_);
    for (std::size_t c = 0; c < carried_.size(); ++c) p.rows.contacts[c].normal.impulse = carried_[c];
}

/// Sweeps, if they settle the part. Else coupled steps of Newton's method from where they ended. Where these
/// begin close to the balance and fail, few rows are other than they seem: a few sweeps from there settle
/// them. Where they cannot begin, the sweeps go on. In the end Newton's method from the friction bounds that
/// the sweeps found. None if momentum does not balance then.
std::optional<SolveMethod> IslandSolver::solve_by_sweeps(const Problem& p, std::vector<double>& v,
                                                         Report& report) {
    constexpr int kTries = 6, kLongMost = 3;  // of them, from so many series of sweeps
    constexpr int kFewSweeps = 20;
    Lockstep<double> alone;
    if (hessian_.couples() && continue_at_rest(p, v, report)) return SolveMethod::kAtRest;
    const SweepPlan plan = sweep_plan(p);
    const SweepReport swept = sweeps_.run(p, plan, v);
    if (swept.settled) {
        take_swept(p, v);
        report.iterations += swept.iterations();
        report.residual = 0;
        return SolveMethod::kSweeps;
    }
    for (int tries = 1, longs = 1; hessian_.couples(); ++tries) {
        step_as_swept(p, v, report);
        const bool is_close = report.residual <= plan_.couple_from;
        if (is_close && solve_coupled(p, alone, v, report)) return SolveMethod::kSweptNewton;
        if (tries == kTries || (!is_close && longs == kLongMost)) break;
        if (is_close)
            sweeps_.take_up(p, kFewSweeps, v);  // from the impulses at which Newton's method gave up
        else
            ++longs, sweeps_.go_on(p, plan.most, v);
    }
    // Sweeps that do not converge still tell the friction bounds better than anything else.
    step_as_swept(p, v, report);
    if (Newton::iterate(p, alone, v, report, false)) return SolveMethod::kSweptNewton;
    return std::nullopt;
}

/// The rows' compliances, times as soft as they are.
void IslandSolver::soften(IslandRows& rows, double softer) {
    const double* compliance = compliances_.data();
    const auto set = [&](auto& row) {
        row.compliance = softer * *compliance++;
        row.stiffness = 1 / row.compliance;
    };
    for_each_bounded(rows, set);
    for_each_disc(rows, set);
}

/// Newton's method on rows that are soft at first, and harder from round to round: few of them change sides
/// in a round, and friction bounds follow. After a round that fails the next one takes a shorter way from the
/// last that did not. In the end rows may stay a little softer than they are: momentum and friction are right
/// then, and what lies on the rows sinks in by that much more.
bool IslandSolver::harden(const Problem& p, std::vector<double>& v, Report& report) {
    constexpr double kSoftest = 1e5, kSoftEnough = 100, kLongest = 0.1, kShortest = 0.7;
    IslandRows& rows = p.rows;
    compliances_.clear();
    for_each_bounded(rows, [&](BoundedRow& row) { compliances_.push_back(row.compliance); });
    for_each_disc(rows, [&](FrictionDisc& disc) { compliances_.push_back(disc.compliance); });
    Lockstep<double> alone;
    double softer = kSoftest, solved_at = kSoftest, way = kLongest;
    while (softer != solved_at || softer == kSoftest) {
        soften(rows, softer);
        report.residual = balance(p);
        if (Newton::iterate(p, alone, v, report, p.position)) {
            solved_at = softer;
            keep_beginning(p, v);
        } else {
            if (softer == kSoftest) break;
            return_to_beginning(p, v);
            soften(rows, solved_at);
            report.residual = balance(p);
            way = std::sqrt(way);
            if (way > kShortest) break;
        }
        softer = std::max(1.0, solved_at * way);
    }
    soften(rows, 1);
    return solved_at <= kSoftEnough;
}

/// Where nothing finds a balance (limbs jammed between motors without bounds): sweeps from rest. Momentum is
/// then that of impulses within their bounds, although not all rows have what they ask for.
void IslandSolver::settle_for_sweeps(Problem p, std::vector<double>& v) {
    constexpr int kSweeps = 200;
    IslandRows& rows = p.rows;
    p.again = false;
    for (ContactRow& row : rows.contacts) row.normal.impulse = 0;
    sweeps_.run(p, {.most = kSweeps, .start_tolerance = 1e-12}, v);
    take_swept(p, v);
}

/// The impulses that the sweeps found, into the rows; torsional and rolling friction get none.
void IslandSolver::take_swept(const Problem& p, const std::vector<double>& v) {
    IslandRows& rows = p.rows;
    take_velocities(p, v);
    for_each_bounded(rows, [](BoundedRow& row) { row.impulse = 0; });
    for_each_disc(rows, [](FrictionDisc& disc) { disc.impulse_1 = disc.impulse_2 = 0; });
    for (std::size_t r = 0; r < rows.joints.size(); ++r) rows.joints[r].impulse = sweeps_.joint(r);
    for (std::size_t r = 0; r < rows.couplings.size(); ++r) rows.couplings[r].impulse = sweeps_.coupling(r);
    friction::fit_bounds(rows, [&](std::size_t c) { return sweeps_.contact(c).n; });
    for (std::size_t c = 0; c < rows.contacts.size(); ++c) {
        const RowSweeps::ContactImpulse& swept = sweeps_.contact(c);
        ContactRow& row = rows.contacts[c];
        row.normal.impulse = swept.n, row.slip.impulse_1 = swept.t1, row.slip.impulse_2 = swept.t2;
    }
}

/// Each round is the solution if the rows push that it started with and no others, with friction linear, as
/// it is at the solved velocities. False if the rounds do not tell which rows push; then all is as before.
bool IslandSolver::displace(const Problem& p, std::vector<double>& v, Report& report) {
    constexpr int kRoundsMax = 10;
    constexpr double kViolation = 1e-9;  // m/s or rad/s
    pushing_.clear();
    for_each_bounded(p.rows, [&](BoundedRow& row) {
        pushing_.push_back(row.impulse <= row.low    ? Pushing::kLow
                           : row.impulse >= row.high ? Pushing::kHigh
                                                     : Pushing::kBetween);
    });
    keep_start(p, v);
    for (int round = 0; round < kRoundsMax; ++round) {
        if (round > 0) return_to_start(p, v);
        newton::update_impulses(p.rows);
        newton::set_curvatures(p.rows);
        const Pushing* pushing = pushing_.data();
        for_each_bounded(p.rows, [&](BoundedRow& row) {
            const Pushing now = *pushing++;
            if (now == Pushing::kBetween)
                set_between(row);
            else
                set_at(now == Pushing::kLow ? row.low : row.high, row);
        });
        set_gradient(p);
        find_step(p, false);
        ++report.iterations;
        move(p, 1.0, v);
        bool changed = false;
        Pushing* at = pushing_.data();
        for_each_bounded(p.rows, [&](BoundedRow& row) {
            Pushing& now = *at++;
            const Pushing then = now;
            const double raw = (row.target - row.u) * row.stiffness, slack = kViolation * row.stiffness;
            if (now == Pushing::kBetween)
                now = raw < row.low ? Pushing::kLow : raw > row.high ? Pushing::kHigh : now;
            else if (now == Pushing::kLow ? raw > row.low + slack : raw < row.high - slack)
                now = Pushing::kBetween;
            changed |= now != then;
        });
        if (changed) continue;
        newton::update_impulses(p.rows);
        report.residual = 0;
        return true;
    }
    return_to_start(p, v);
    return false;
}

}  // namespace roboss
