// See body_solver.h.
#include "physics/bodies/body_solver.h"

#include <algorithm>
#include <cmath>

#include "physics/bodies/body_points.h"
#include "physics/contact/friction_bounds.h"
#include "physics/solver/newton.h"

namespace roboss {
namespace {

/// Friction bounds are updated once the balance is this good. Coarser than newton::kRoughly: the sweeps
/// already show which contacts stick and which slide.
constexpr double kBoundsFrom = 1e-2;
constexpr double kSticking = 0.998;  // of the squared friction bound: beyond, a sweep says that it slides
constexpr double kRounding = newton::kRounding<double>;

constexpr std::size_t kPile = 32;  // bodies: from here on sweeps may settle what moves

/// Sweeps from which Newton's method starts. Impulses spread through few bodies a sweep. In a large part
/// twelve sweeps cost as much as an iteration; in a small one, which leaves lanes empty, three.
int sweeps_to_start(std::size_t bodies) {
    if (bodies < 4) return 4;
    if (bodies < 32) return bodies < 8 ? 8 : bodies < 16 ? 12 : 24;
    return bodies < 64 ? 40 : 80;
}

}  // namespace

bool BodySolver::solve(const BodyPart& part, std::vector<double>& v, SolveReport& report, const Team& team) {
    const Accuracy& accuracy = part.problem.accuracy;
    island_.team = team;
    position_ = part.problem.position;
    iterations_ = 0, swept_ = analysed_ = false;
    take(part, v);
    fill_ = sweeps_may_settle(accuracy) ? find_fill() : Fill::kLittle;
    SolveMethod method = SolveMethod::kBodiesSweeps;
    bool balances = position_ ? settle_displacement(part) : settle_velocities(accuracy);
    if (!balances) {
        prepare_factor();
        balances = position_ && displace();
        method = balances ? SolveMethod::kBodiesActiveSet : SolveMethod::kBodiesNewton;
        balances = balances || iterate(accuracy);
    }
    report = {iterations_, residual_, method};
    if (balances) give(part, v);
    return balances;
}

void BodySolver::take_body(const Mechanics<double>& robot, const double* v, FreeBody& body) const {
    const double* mass = robot.mass_matrix.data();  // packed, the lower triangle
    body.mass = {}, body.impulse = body.v = body.lightness = {};
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j <= i; ++j)
            body.mass.row[i].x[j] = body.mass.row[j].x[i] = mass[i * (i + 1) / 2 + j];
        body.lightness.x[i] = 1.0 / body.mass.row[i].x[i];
        body.impulse.x[i] = robot.impulse[i], body.v.x[i] = v[i];
    }
}

void BodySolver::take_point(const BodyPart& part, const ContactRow& row, BodyPoint& p) const {
    const ContactColumns& columns = part.problem.rows.columns;
    p = {};
    const auto side = [&](std::size_t first, Six& n, Six& t1, Six& t2) {
        std::copy_n(columns.n.data() + first, 6, n.x);
        std::copy_n(columns.t1.data() + first, 6, t1.x);
        std::copy_n(columns.t2.data() + first, 6, t2.x);
        const std::uint32_t robot = part.robot_of[static_cast<std::size_t>(columns.dof[first])];
        return static_cast<int>(local_[robot]);
    };
    p.a = side(row.first, p.n_a, p.t1_a, p.t2_a);
    if (row.last > row.first + 6) p.b = side(row.first + 6, p.n_b, p.t1_b, p.t2_b);
    p.sticks = row.sticks;
    BoundedRow normal = row.normal;
    if (position_) aim_at_displacement(normal);
    p.target_n = normal.target;
    p.target_1 = row.slip.target_1, p.target_2 = row.slip.target_2;
    p.stiffness_n = 1.0 / normal.compliance, p.stiffness_t = 1.0 / row.slip.compliance;
    p.coefficient = row.slip.coefficient, p.bound = row.slip.bound;
    p.swept_n = row.normal.impulse;
    if (position_) p.f_1 = row.slip.impulse_1, p.f_2 = row.slip.impulse_2;
}

void BodySolver::take(const BodyPart& part, const std::vector<double>& v) {
    const IslandSolver::Problem& problem = part.problem;
    BodyIsland& s = island_;
    s.bodies.resize(part.members.size()), s.points.resize(part.contacts.size());
    local_.resize(problem.robots.size());
    s.for_bodies([&](std::size_t b) {
        const std::uint32_t robot = part.members[b];
        local_[robot] = static_cast<std::uint32_t>(b);
        take_body(*problem.robots[robot], v.data() + problem.offsets[robot], s.bodies[b]);
    });
    s.for_points(
        [&](std::size_t c) { take_point(part, problem.rows.contacts[part.contacts[c]], s.points[c]); });
    if (s.team.size() > 1) s.ends.sort(s.bodies.size(), s.points);
    kernel_.take_velocities(s);
}

/// The matrix of Newton's method, with no contact in it yet.
void BodySolver::prepare_factor() {
    BodyIsland& s = island_;
    if (!analysed_) s.order.analyse(s.bodies.size(), s.points);
    analysed_ = true;
    if (s.team.size() > 1) s.tasks.plan(s.order, s.team.size());
    s.kept_diagonal.resize(s.bodies.size()), s.diagonal.resize(s.bodies.size());
    s.pivot_factors.resize(s.bodies.size());
    for (std::size_t b = 0; b < s.bodies.size(); ++b) s.kept_diagonal[b] = s.bodies[b].mass;
    s.kept_upper.assign(s.order.edges(), SixBlock{});
    s.upper.resize(s.order.edges()), s.lower.resize(s.order.edges());
}

/// Much in a deep pile, little in a stack or a low wall. Begins the analysis of the factor, and ends it if
/// there is little. Of a pile with the contacts of the last deep one nothing is analysed: a tick solves for
/// velocities, then for displacements.
Fill BodySolver::find_fill() {
    constexpr std::size_t kLargePile = 256, kMostUpdates = 100;  // bodies; updates of blocks, by body
    const std::size_t bodies = island_.bodies.size();
    if (bodies < kLargePile) return Fill::kLittle;
    const auto joins_as = [](const BodyPoint& p, const Joined& last) {
        return p.a == last.a && p.b == last.b;
    };
    if (bodies == deep_bodies_ && std::ranges::equal(island_.points, deep_joined_, joins_as))
        return Fill::kMuch;
    analysed_ = island_.order.analyse(bodies, island_.points, kMostUpdates * bodies);
    if (analysed_) return Fill::kLittle;
    deep_bodies_ = bodies;
    deep_joined_.clear();
    for (const BodyPoint& p : island_.points) deep_joined_.push_back({p.a, p.b});
    return Fill::kMuch;
}

void BodySolver::keep_start() {
    v_start_.clear(), start_bounds_.clear();
    for (const FreeBody& body : island_.bodies) v_start_.push_back(body.v);
    for (const BodyPoint& p : island_.points) start_bounds_.push_back(p.bound);
}

void BodySolver::return_to_start() {
    for (std::size_t b = 0; b < island_.bodies.size(); ++b) island_.bodies[b].v = v_start_[b];
    for (std::size_t c = 0; c < island_.points.size(); ++c) island_.points[c].bound = start_bounds_[c];
    kernel_.take_velocities(island_);
    residual_ = kernel_.balance(island_);
}

/// One Newton step with the curvatures and impulses as they are. False, and back to the start, if the balance
/// there is no better.
bool BodySolver::take_first_step() {
    const double before = residual_;
    kernel_.set_gradient(island_);
    if (kernel_.find_step(island_, false, 0)) {
        kernel_.move(island_, 1);
        ++iterations_;
        residual_ = kernel_.balance(island_);
        if (residual_ <= before) return true;
    }
    return_to_start();
    return false;
}

/// Velocities and impulses from those that the contacts carried last, and friction bounds to match; for the
/// displacement from those of the velocities, whose friction bounds stay. Back to the start (keep_start()) if
/// they found no numbers.
SweepReport BodySolver::sweep(const SweepPlan& plan) {
    island_.bounds_stay = position_;
    for (BodyPoint& p : island_.points) {
        p.f_n = p.swept_n;
        if (position_) continue;
        p.f_1 = p.target_1 * p.stiffness_t, p.f_2 = p.target_2 * p.stiffness_t;
        const double bound = p.coefficient * p.f_n, size2 = p.f_1 * p.f_1 + p.f_2 * p.f_2;
        if (size2 > bound * bound) p.f_1 *= bound / std::sqrt(size2), p.f_2 *= bound / std::sqrt(size2);
    }
    const SweepReport report = kernel_.sweep(island_, plan);
    double sum = 0;
    for (const FreeBody& body : island_.bodies)
        for (std::size_t i = 0; i < 6; ++i) sum += body.v.x[i];
    swept_ = std::isfinite(sum);
    if (!swept_) {
        return_to_start();
        return {};
    }
    kernel_.take_velocities(island_);
    if (position_) return report;
    for (BodyPoint& p : island_.points) p.bound = p.coefficient * p.swept_n;
    return report;
}

/// What the sweeps found is the solution; momentum balances.
void BodySolver::take_swept() {
    for (BodyPoint& p : island_.points) {
        p.f_n = p.swept_n, p.f_1 = p.swept_1, p.f_2 = p.swept_2;
        p.d_n = p.swept_n > 0 ? p.stiffness_n : 0;
    }
    residual_ = kernel_.set_gradient(island_);
}

/// The velocities by sweeps, if these are the solution.
bool BodySolver::settle_velocities(const Accuracy& accuracy) {
    const std::size_t bodies = island_.bodies.size();
    residual_ = kernel_.balance(island_);
    if (bodies == 1 || residual_ <= newton::kRoughly) return false;
    const int most = sweeps_to_start(bodies);
    keep_start();
    const SweepReport report =
        sweep(bodies >= kPile ? pile_plan(accuracy, most, fill_) : SweepPlan{.most = most});
    if (!swept_ || !(report.settled || fill_ == Fill::kMuch)) return false;
    take_swept();
    iterations_ += report.iterations();
    return true;
}

/// Likewise the displacement of a pile, with a tighter tolerance where a point is left deep.
bool BodySolver::settle_displacement(const BodyPart& part) {
    constexpr int kRounds = 3;
    SweepPlan plan = pile_plan(part.problem.accuracy, 1, fill_);
    if (island_.bodies.size() < kPile || !sweeps_may_settle(part.problem.accuracy)) return false;
    if (fill_ == Fill::kLittle && hardly_moves()) return false;
    keep_start();
    bool settled = true;
    for (int round = 0; round < kRounds && settled; ++round) {
        const SweepReport report = sweep(plan);
        iterations_ += report.iterations();
        settled = report.settled;
        if (settled && keeps_apart()) {
            take_swept();
            return true;
        }
        plan.tighten(1e-2);
    }
    if (swept_ && fill_ == Fill::kMuch) {
        take_swept();
        return true;
    }
    if (swept_) return_to_start();
    swept_ = false;
    for (std::size_t c = 0; c < island_.points.size(); ++c)
        island_.points[c].swept_n = part.problem.rows.contacts[part.contacts[c]].normal.impulse;
    return false;
}

/// A quick look at whether SweepProgress would find too little motion.
bool BodySolver::hardly_moves() const {
    constexpr double kLittle = 1e-3;
    double motion = 0, impulses = 0;
    for (const BodyPoint& p : island_.points) {
        const double lightness = island_.bodies[static_cast<std::size_t>(p.a)].lightness.x[3];
        motion += (p.u_n * p.u_n + p.u_1 * p.u_1 + p.u_2 * p.u_2) / lightness;
        impulses += p.swept_n * p.swept_n * lightness;
    }
    return motion < kLittle * impulses;
}

/// No point is left much deeper than its contact asks for: the second look would find it.
bool BodySolver::keeps_apart() const {
    constexpr double kMost = 5e-3;  // m/s: a hundredth of a millimetre in 2 ms
    return std::ranges::all_of(island_.points, [](const BodyPoint& p) {
        return p.target_n - p.u_n - p.swept_n / p.stiffness_n < kMost;
    });
}

/// A first step to where the bodies would be if every contact did what the sweeps say. False if that is no
/// better than where the solve began, where we then are.
bool BodySolver::start_from_sweeps() {
    island_.for_points([&](std::size_t k) { set_curvature(island_.points[k]); });
    for (BodyPoint& p : island_.points) {
        p.d_n = p.f_n = 0;
        if (p.swept_n > 0) push(p);
        const double size2 = p.swept_1 * p.swept_1 + p.swept_2 * p.swept_2,
                     speed2 = p.u_1 * p.u_1 + p.u_2 * p.u_2, bound2 = p.bound * p.bound;
        if (!(p.bound > 0))
            p.f_1 = p.f_2 = 0;
        else if (size2 < kSticking * bound2 || speed2 * p.stiffness_t * p.stiffness_t <= bound2)
            stick(p);
        else
            p.f_1 = -p.bound * p.u_1 / std::sqrt(speed2), p.f_2 = -p.bound * p.u_2 / std::sqrt(speed2);
    }
    return take_first_step();
}

/// Likewise if every contact that stuck in the last tick stuck again.
void BodySolver::start_from_sticking() {
    if (std::ranges::none_of(island_.points, &BodyPoint::sticks)) return;
    keep_start();
    island_.for_points([&](std::size_t k) { set_curvature(island_.points[k]); });
    for (BodyPoint& p : island_.points)
        if (p.sticks) push(p), stick(p);
    take_first_step();
}

void BodySolver::start() {
    if (swept_ ? start_from_sweeps() : residual_ <= newton::kRoughly) return;
    start_from_sticking();
}

/// Balance with friction bounds that fit the normal impulses.
double BodySolver::balance_tied() {
    island_.for_points([&](std::size_t k) {
        BodyPoint& p = island_.points[k];
        p.bound = p.coefficient * std::max(0.0, (p.target_n - p.u_n) * p.stiffness_n);
    });
    return kernel_.balance(island_);
}

/// Newton::solve_coupled. Steps are shortened until the balance gets better.
bool BodySolver::solve_coupled(const Accuracy& accuracy) {
    constexpr int kStepsMax = 12, kHalvings = 3;
    constexpr double kProgress = 0.3;  // of the residual, in a whole step, at least
    keep_start();
    residual_ = balance_tied();
    for (int i = 0; i < kStepsMax && residual_ > accuracy.tolerance; ++i) {
        island_.for_points([&](std::size_t k) { set_curvature(island_.points[k]); });
        const bool slides = couple_bounds(island_.points);
        if (!kernel_.find_step(island_, slides, newton::may_lack(residual_))) break;
        ++iterations_;
        const double before = residual_;
        kernel_.move(island_, 1);
        residual_ = balance_tied();
        double alpha = 1;
        const auto improves = [&] { return residual_ <= (1 - kProgress * alpha) * before; };
        for (int h = 0; h < kHalvings && !improves(); ++h) {
            alpha *= 0.5;
            kernel_.move(island_, -alpha);
            residual_ = balance_tied();
        }
        if (!improves()) break;
    }
    if (residual_ <= accuracy.tolerance) return true;
    return_to_start();
    return false;
}

/// Newton::line_search.
double BodySolver::line_search(double at_start, double at_end) {
    double low = -1, high = 0, s_low = at_start, s_high = at_end;
    for (int i = 0; i < 20 && s_high < 0; ++i) {
        low = high, s_low = s_high, high = 2 * high + 1;
        s_high = kernel_.slope_beyond(island_, high);
    }
    int side = 0;  // of the last point: -1 below the root
    for (int i = 0; i < 60; ++i) {
        const double share = i % 3 == 2 ? 0.5 : s_low / (s_low - s_high);
        const double fraction = low + (high - low) * share;
        const double s = kernel_.slope_beyond(island_, fraction);
        if (std::fabs(s) <= -0.05 * at_start) return fraction;
        if (s < 0) {
            low = fraction, s_low = s;
            if (side < 0) s_high *= 0.5;
            side = -1;
        } else {
            high = fraction, s_high = s;
            if (side > 0) s_low *= 0.5;
            side = 1;
        }
    }
    return low > -1 ? low : high;
}

/// Newton::take_step.
void BodySolver::take_step() {
    constexpr double kGoodEnough = 0.3;
    const double at_start = kernel_.slope(island_);
    kernel_.move(island_, 1);
    residual_ = kernel_.balance(island_);
    const double at_end = kernel_.slope(island_);
    if (!(at_start < 0) || std::fabs(at_end) <= -kGoodEnough * at_start) return;
    kernel_.move(island_, line_search(at_start, at_end));
    residual_ = kernel_.balance(island_);
}

/// friction::update_bounds.
double BodySolver::update_bounds() {
    const double error = friction_error();
    for (BodyPoint& p : island_.points)
        if (p.coefficient != 0)
            friction::update_bound(p.coefficient * p.f_n, p.bound, p.bound_error, p.relaxation);
    return error;
}

/// What friction would change by if its bounds fitted the normal impulses, relative to the largest of these.
double BodySolver::friction_error() const {
    double largest = 0, change = 0;
    for (const BodyPoint& p : island_.points) {
        largest = std::max(largest, p.f_n);
        if (p.coefficient != 0) change = std::max(change, friction_change(p));
    }
    return largest > 0 ? change / largest : 0;
}

/// Newton::iterate; beyond that, friction bounds are checked once more when momentum balances.
bool BodySolver::iterate(const Accuracy& accuracy) {
    constexpr int kCoupledTries = 3, kChecks = 10;
    // Iterations cost little here, next to the sweeps over joints that a part is left to in the end.
    constexpr int kPatience = 3;
    start();
    int bound_updates = 0, coupled_tries = 0, stalls = 0, checks = 0;
    bool settled = position_;
    double best = 1;
    for (int i = 0;; ++i) {
        if (residual_ <= kBoundsFrom) {
            if (!settled && coupled_tries < kCoupledTries) {
                ++coupled_tries;
                if (solve_coupled(accuracy)) return true;
            }
            if (!settled) {
                settled = update_bounds() <= accuracy.friction_tolerance ||
                          ++bound_updates >= accuracy.friction_max;
                residual_ = kernel_.balance(island_);
            }
            stalls = settled && residual_ <= kRounding && residual_ > 0.9 * best ? stalls + 1 : 0;
            best = settled ? std::min(best, residual_) : 1;
            if (settled && (residual_ <= accuracy.tolerance || stalls >= 3)) {
                if (position_ || checks == kChecks || friction_error() <= accuracy.friction_tolerance)
                    return true;
                settled = false, stalls = 0, best = 1;
                // Every other check gets one more series of coupled steps.
                coupled_tries = ++checks % 2 == 0 ? kCoupledTries : kCoupledTries - 1;
                continue;
            }
        }
        if (i >= kPatience * accuracy.newton_max) return residual_ <= newton::kRoughly && settled;
        if (!std::isfinite(residual_)) return false;
        island_.for_points([&](std::size_t k) { set_curvature(island_.points[k]); });
        if (!kernel_.find_step(island_, false, newton::may_lack(residual_))) return false;
        take_step();
        ++iterations_;
    }
}

/// Velocities and rows, as IslandSolver leaves them.
void BodySolver::give(const BodyPart& part, std::vector<double>& v) const {
    const IslandSolver::Problem& problem = part.problem;
    island_.for_bodies([&](std::size_t b) {
        std::copy_n(island_.bodies[b].v.x, 6, v.data() + problem.offsets[part.members[b]]);
    });
    island_.for_points([&](std::size_t c) {
        const BodyPoint& p = island_.points[c];
        ContactRow& row = problem.rows.contacts[part.contacts[c]];
        row.normal.target = p.target_n, row.normal.stiffness = p.stiffness_n;
        row.normal.u = p.u_n, row.normal.impulse = p.f_n, row.normal.d = p.d_n;
        row.slip.stiffness = p.stiffness_t, row.slip.bound = p.bound;
        row.slip.u_1 = p.u_1, row.slip.u_2 = p.u_2;
        row.slip.impulse_1 = p.f_1, row.slip.impulse_2 = p.f_2;
    });
}

}  // namespace roboss
