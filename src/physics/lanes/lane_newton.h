// Newton's method for a few robots in lanes. Each lane takes the course of solver/newton.h at its own pace:
// in each round all that are not done take one step, coupled or not, and each lane keeps where in the method
// it stands. Whatever a lane does not do is computed for it too, and not taken. Everything that is computed
// from velocities and friction bounds may be computed again for lanes that wait: it comes out the same.
//
// Floats have no digits to spare: see newton_base.h.
#pragma once

#include <vector>

#include "physics/solver/newton_base.h"
#include "physics/solver/tree_hessian.h"

namespace roboss {

/// Yes in the lanes whose bits are set.
template <class T>
MaskOf<T> mask_of(unsigned bits) {
    if constexpr (std::is_same_v<MaskOf<T>, bool>) {
        return (bits & 1u) != 0;
    } else {
        typename MaskOf<T>::Vector lanes{};
        for (std::size_t i = 0; i < kLanesOf<T>; ++i) lanes[i] = (bits >> i & 1u) != 0 ? -1 : 0;
        return MaskOf<T>(lanes);
    }
}

template <class T>
class LaneNewton : public NewtonBase<T, TreeHessian<T>> {
  public:
    using Mask = MaskOf<T>;

    /// Solves for the lanes `wanted`; the others keep their velocities. Returns those that are solved.
    Mask solve(const SolveProblem<T>& p, const Mask& wanted, std::vector<T>& v, SolveReportT<T>& report);

  private:
    using Base = NewtonBase<T, TreeHessian<T>>;
    using Base::balance, Base::breakpoints_, Base::find_step, Base::mv_, Base::m_step_, Base::n_, Base::plan_;
    using Base::set_gradient, Base::slope, Base::slope_beyond, Base::step_, Base::times_mass;

    /// Velocities of some lanes to go back to. Those along rows follow from them; floats keep them, too.
    struct Place {
        std::vector<T> v, mv, u;
    };

    void start_course(const SolveProblem<T>& p, const Mask& wanted);
    void start_as_expected(const SolveProblem<T>& p, std::vector<T>& v, SolveReportT<T>& report);
    void decide(const SolveProblem<T>& p, std::vector<T>& v, SolveReportT<T>& report);
    Mask begin_coupled(const SolveProblem<T>& p, const Mask& at_head, const std::vector<T>& v,
                       SolveReportT<T>& report);
    Mask check_friction(const SolveProblem<T>& p, const Mask& balanced, std::vector<T>& v,
                        SolveReportT<T>& report);
    void give_up(const SolveProblem<T>& p, const Mask& some, std::vector<T>& v, SolveReportT<T>& report);
    void take_step(const SolveProblem<T>& p, std::vector<T>& v, SolveReportT<T>& report);
    void judge_coupled(const SolveProblem<T>& p, const Mask& moved, std::vector<T>& v,
                       SolveReportT<T>& report);
    T line_search(const SolveProblem<T>& p, const Mask& some, const T& at_start, const T& at_end);
    void move(const SolveProblem<T>& p, const Mask& some, const T& alpha, std::vector<T>& v);
    void keep(const SolveProblem<T>& p, const Mask& some, const std::vector<T>& v, Place& place);
    void go_back(const SolveProblem<T>& p, const Mask& some, const Place& place, std::vector<T>& v);
    void return_to_checked(const SolveProblem<T>& p, const Mask& some, std::vector<T>& v,
                           SolveReportT<T>& report);
    static void hold_curvatures(IslandRowsT<T>& rows, const Mask& some);
    static void count(const Mask& some, T& counter) { counter = select(some, counter + T(1), counter); }
    static void set(const Mask& some, const T& value, T& x) { x = select(some, value, x); }
    void finish(const Mask& some) { going_ = going_ & !some, solved_ = solved_ | some; }

    // Where each lane stands: not done; done and solved; among coupled steps, or just after such that failed.
    Mask going_{false}, solved_{false}, coupled_{false}, failed_{false};
    Mask settled_{false};  // friction bounds stay as they are
    bool stays_settled_ = false;
    T turns_{}, far_{}, bound_updates_{}, stalls_{}, coupled_tries_{}, coupled_steps_{},
        checks_{};  // counted
    T best_{}, before_{}, checked_error_{};
    Place start_, checked_;
    std::vector<T> bounds_now_, bounds_checked_;
};

template <class T>
MaskOf<T> LaneNewton<T>::solve(const SolveProblem<T>& p, const Mask& wanted, std::vector<T>& v,
                               SolveReportT<T>& report) {
    constexpr int kRounds = 40;  // what takes longer, a robot by itself does cheaper
    start_course(p, wanted);
    start_as_expected(p, v, report);
    for (int round = 0; round < kRounds; ++round) {
        decide(p, v, report);
        if (!any(going_)) break;
        take_step(p, v, report);
    }
    return solved_;
}

template <class T>
void LaneNewton<T>::start_course(const SolveProblem<T>& p, const Mask& wanted) {
    going_ = wanted, solved_ = coupled_ = failed_ = Mask(false);
    stays_settled_ = p.position || p.rows.contacts.empty();
    settled_ = stays_settled_;
    turns_ = far_ = bound_updates_ = stalls_ = coupled_tries_ = coupled_steps_ = checks_ = T(0);
    best_ = T(1), before_ = checked_error_ = T(0);
}

/// Newton::start_as_expected.
template <class T>
void LaneNewton<T>::start_as_expected(const SolveProblem<T>& p, std::vector<T>& v, SolveReportT<T>& report) {
    report.residual = balance(p);
    if (p.rows.contacts.empty()) return;
    Mask some = going_ & !(report.residual <= T(newton::kRoughly));
    if (!any(some)) return;
    newton::set_curvatures(p.rows);
    some = some & newton::expect_sticking(p.rows);
    if (any(some)) {
        keep(p, some, v, start_);
        set_gradient(p);
        hold_curvatures(p.rows, some);
        find_step(p, false);
        move(p, some, T(1), v);
        count(some, report.iterations);
    }
    const T before = report.residual;
    report.residual = balance(p);
    const Mask worse = some & !(report.residual <= before);
    if (!any(worse)) return;
    go_back(p, worse, start_, v);
    report.residual = balance(p);
}

/// What Newton::iterate and solve_coupled decide between two steps, for each lane: whether it is done, and
/// else which kind of step is next.
template <class T>
void LaneNewton<T>::decide(const SolveProblem<T>& p, std::vector<T>& v, SolveReportT<T>& report) {
    Mask asks = going_ & !coupled_;
    const Mask has_no_friction = p.rows.contacts.empty();
    while (any(asks)) {
        const Mask near = has_no_friction | failed_ | (report.residual <= T(plan_.couple_from));
        asks = asks & !begin_coupled(p, asks & near, v, report);
        const Mask here = asks & near, updates = here & !settled_;
        failed_ = failed_ & !asks;
        if (any(updates)) {
            const Mask agrees = friction::update_bounds(p.rows, updates) <= newton::friction_tolerance(p);
            count(updates & !agrees, bound_updates_);
            settled_ = settled_ | (updates & (agrees | (bound_updates_ >= T(p.accuracy.friction_max))));
            report.residual = balance(p);
        }
        const Mask stalls = settled_ & (report.residual <= T(newton::kRounding<T>)) &
                            (report.residual > newton::kStalled * best_);
        set(here, select(stalls, stalls_ + T(1), T(0)), stalls_);
        set(here, select(settled_, smaller(best_, report.residual), T(1)), best_);
        const Mask balanced =
            here & settled_ &
            ((report.residual <= newton::tolerance(p)) | (stalls_ >= T(newton::kStallsMax)));
        asks = asks & !balanced;
        const Mask again = any(balanced) ? check_friction(p, balanced, v, report) : Mask(false);
        count(asks & (report.residual > T(newton::kFar)), far_);
        const Mask gives_up =
            asks & ((far_ > T(newton::far_max(p, plan_))) | (turns_ >= T(p.accuracy.newton_max)));
        if (any(gives_up)) give_up(p, gives_up, v, report);
        count((asks & !gives_up) | again, turns_);
        asks = again;
    }
}

/// Lanes that may begin coupled steps do, unless they are there; returns them.
template <class T>
MaskOf<T> LaneNewton<T>::begin_coupled(const SolveProblem<T>& p, const Mask& at_head, const std::vector<T>& v,
                                       SolveReportT<T>& report) {
    const Mask begins = at_head & !failed_ & !settled_ & (coupled_tries_ < T(newton::kCoupledTries));
    if (!any(begins)) return begins;
    count(begins, coupled_tries_);
    set(begins, T(0), coupled_steps_);
    keep(p, begins, v, start_);
    friction::tie_bounds(p.rows, begins);
    report.residual = balance(p);
    const Mask there = begins & (report.residual <= newton::tolerance(p));
    finish(there);
    coupled_ = coupled_ | (begins & !there);
    return begins;
}

/// Lanes whose momentum balances are done if friction does, or if it was checked often enough. Returns the
/// others, which go on.
template <class T>
MaskOf<T> LaneNewton<T>::check_friction(const SolveProblem<T>& p, const Mask& balanced, std::vector<T>& v,
                                        SolveReportT<T>& report) {
    if (stays_settled_) return finish(balanced), Mask(false);
    const T error = friction::bound_error(p.rows).relative();
    const Mask agrees = balanced & (error <= newton::friction_tolerance(p));
    finish(agrees);
    const Mask misses = balanced & !agrees;
    if (!any(misses)) return misses;
    const Mask better = misses & (equal(checks_, T(0)) | (error < checked_error_));
    set(better, error, checked_error_);
    keep(p, better, v, checked_);
    friction::keep_bounds(p.rows, bounds_now_);
    bounds_checked_.resize(bounds_now_.size());
    for (std::size_t i = 0; i < bounds_now_.size(); ++i) set(better, bounds_now_[i], bounds_checked_[i]);
    const Mask last = misses & equal(checks_, T(plan_.checks)), again = misses & !last;
    if (any(last)) return_to_checked(p, last, v, report);
    settled_ = settled_ & !again;
    set(again, T(0), stalls_), set(again, T(1), best_);
    count(again, checks_);
    const Mask even = equal(checks_, T(2)) | equal(checks_, T(4));
    set(again, select(even, T(newton::kCoupledTries), T(newton::kCoupledTries - 1)), coupled_tries_);
    return again;
}

/// After too many steps.
template <class T>
void LaneNewton<T>::give_up(const SolveProblem<T>& p, const Mask& some, std::vector<T>& v,
                            SolveReportT<T>& report) {
    const Mask checked = some & (checks_ > T(0));
    going_ = going_ & !some;
    solved_ = solved_ | (some & !checked & (report.residual <= T(newton::kRoughly)));
    if (any(checked)) return_to_checked(p, checked, v, report);
}

/// One step of all that are not done.
template <class T>
void LaneNewton<T>::take_step(const SolveProblem<T>& p, std::vector<T>& v, SolveReportT<T>& report) {
    before_ = report.residual;
    newton::set_curvatures(p.rows);
    Mask slides = false;
    if (any(coupled_)) slides = coupled_ & friction::couple_bounds(p.rows, coupled_);
    // What is computed for those that are done does not matter: where all others are coupled, so may they be.
    const Mask good = find_step(p, any(slides) ? slides | !going_ : slides);
    const Mask moved = going_ & (good | !slides), plain = going_ & !coupled_;
    const T at_start = slope();
    move(p, moved, T(1), v);
    count(moved, report.iterations);
    if (any(coupled_)) friction::tie_bounds(p.rows, coupled_ & moved);
    report.residual = balance(p);
    if (any(plain)) {
        const T at_end = slope();
        const Mask searches = plain & !newton::is_good_enough(at_start, at_end);
        if (any(searches)) {
            move(p, searches, line_search(p, searches, at_start, at_end), v);
            report.residual = balance(p);
        }
    }
    if (any(coupled_)) judge_coupled(p, moved, v, report);
}

/// Whether coupled steps end, by the one that was taken last.
template <class T>
void LaneNewton<T>::judge_coupled(const SolveProblem<T>& p, const Mask& moved, std::vector<T>& v,
                                  SolveReportT<T>& report) {
    count(coupled_, coupled_steps_);
    const Mask there = coupled_ & moved & (report.residual <= newton::tolerance(p));
    const Mask improves = moved & (report.residual <= T(1 - plan_.progress) * before_) &
                          (coupled_steps_ < T(plan_.coupled_steps));
    failed_ = coupled_ & !there & !improves;
    coupled_ = coupled_ & !there & !failed_;
    finish(there);
    if (!any(failed_)) return;
    go_back(p, failed_, start_, v);
    newton::update_impulses(p.rows);
}

/// Newton::line_search for some lanes.
template <class T>
T LaneNewton<T>::line_search(const SolveProblem<T>& p, const Mask& some, const T& at_start, const T& at_end) {
    T low = -1, high = 0, s_low = at_start, s_high = at_end;
    Mask open = some & (s_high < T(0));
    for (int i = 0; i < newton::kExtensions && any(open); ++i) {
        set(open, high, low), set(open, s_high, s_low), set(open, T(2) * high + T(1), high);
        set(open, slope_beyond(p, high), s_high);
        open = open & (s_high < T(0));
    }
    breakpoints_.find(p.rows, low, high, s_low, s_high);
    T root = 0, side = 0;  // side: of the last point: -1 below the root
    open = some;
    for (int i = 0; i < newton::kSearches && any(open); ++i) {
        const T fraction = low + (high - low) * newton::share_to_try(i, s_low, s_high);
        const T s = breakpoints_.slope(fraction);
        const Mask found = open & (magnitude(s) <= newton::kRootShare * at_start), below = s < T(0);
        set(found, fraction, root);
        open = open & !found;
        set(below & (side < T(0)), 0.5 * s_high, s_high), set((!below) & (side > T(0)), 0.5 * s_low, s_low);
        set(below, fraction, low), set(below, s, s_low);
        set(!below, fraction, high), set(!below, s, s_high);
        side = select(below, T(-1), T(1));
    }
    return select(open, select(low > T(-1), low, high), root);
}

/// v += alpha * step for some lanes, with all that depends on it linearly.
template <class T>
void LaneNewton<T>::move(const SolveProblem<T>& p, const Mask& some, const T& alpha, std::vector<T>& v) {
    const auto go = [&](T& x, const T& dx) { x = select(some, x + alpha * dx, x); };
    for (std::size_t i = 0; i < n_; ++i) go(v[i], step_[i]), go(mv_[i], m_step_[i]);
    for_each_bounded(p.rows, [&](BoundedRowT<T>& row) { go(row.u, row.du); });
    for_each_disc(p.rows, [&](FrictionDiscT<T>& disc) { go(disc.u_1, disc.du_1), go(disc.u_2, disc.du_2); });
}

template <class T>
void LaneNewton<T>::keep(const SolveProblem<T>& p, const Mask& some, const std::vector<T>& v, Place& place) {
    place.v.resize(n_), place.mv.resize(n_);
    for (std::size_t i = 0; i < n_; ++i) set(some, v[i], place.v[i]), set(some, mv_[i], place.mv[i]);
    if constexpr (kIsFloat<T>) {
        place.u.resize(p.rows.joints.size() + 3 * p.rows.contacts.size());
        T* u = place.u.data();
        for_each_bounded(p.rows, [&](BoundedRowT<T>& row) { set(some, row.u, *u++); });
        for_each_disc(p.rows,
                      [&](FrictionDiscT<T>& disc) { set(some, disc.u_1, *u++), set(some, disc.u_2, *u++); });
    }
}

template <class T>
void LaneNewton<T>::go_back(const SolveProblem<T>& p, const Mask& some, const Place& place,
                            std::vector<T>& v) {
    for (std::size_t i = 0; i < n_; ++i) set(some, place.v[i], v[i]), set(some, place.mv[i], mv_[i]);
    if constexpr (kIsFloat<T>) {
        const T* u = place.u.data();
        for_each_bounded(p.rows, [&](BoundedRowT<T>& row) { set(some, *u++, row.u); });
        for_each_disc(p.rows,
                      [&](FrictionDiscT<T>& disc) { set(some, *u++, disc.u_1), set(some, *u++, disc.u_2); });
    } else {
        set_steps(p.rows, v);
        for_each_bounded(p.rows, [&](BoundedRowT<T>& row) { set(some, row.du, row.u); });
        for_each_disc(p.rows, [&](FrictionDiscT<T>& disc) {
            set(some, disc.du_1 - disc.target_1, disc.u_1), set(some, disc.du_2 - disc.target_2, disc.u_2);
        });
    }
}

/// Momentum balanced there, and friction missed its tolerance by the least. These lanes are done.
template <class T>
void LaneNewton<T>::return_to_checked(const SolveProblem<T>& p, const Mask& some, std::vector<T>& v,
                                      SolveReportT<T>& report) {
    go_back(p, some, checked_, v);
    friction::set_bounds(p.rows, bounds_checked_, some);
    if constexpr (!kIsFloat<T>) {
        times_mass(p, v, m_step_);
        for (std::size_t i = 0; i < n_; ++i) set(some, m_step_[i], mv_[i]);
    }
    report.residual = balance(p);
    finish(some);
}

/// Of the other lanes, the matrix keeps what it holds.
template <class T>
void LaneNewton<T>::hold_curvatures(IslandRowsT<T>& rows, const Mask& some) {
    for_each_bounded(rows, [&](BoundedRowT<T>& row) { set(!some, row.d_held, row.d); });
    for_each_disc(rows, [&](FrictionDiscT<T>& disc) {
        set(!some, disc.held_11, disc.d_11), set(!some, disc.held_12, disc.d_12);
        set(!some, disc.held_22, disc.d_22);
    });
}

}  // namespace roboss
