// The rows as Newton's method sees them: impulses and curvatures at the present velocities, and slopes along
// a step. Over T: see newton.h.
#pragma once

#include <cmath>

#include "core/wide.h"
#include "physics/solver/row_math.h"

namespace roboss::newton {

/// Velocities along the rows := what set_steps has left.
template <class T>
void take_velocities(IslandRowsT<T>& rows) {
    for_each_bounded(rows, [](BoundedRowT<T>& row) { row.u = row.du; });
    for_each_disc(rows, [](FrictionDiscT<T>& disc) {
        disc.u_1 = disc.du_1 - disc.target_1, disc.u_2 = disc.du_2 - disc.target_2;
    });
}

/// Impulses of all rows at the present velocities.
template <class T>
void update_impulses(IslandRowsT<T>& rows) {
    for_each_bounded(rows, [](BoundedRowT<T>& row) { row.impulse = impulse_at(row, row.u); });
    for_each_disc(rows, [](FrictionDiscT<T>& disc) {
        if (disc.coefficient == 0) return;
        const TangentialT<T> t = impulse_at(disc, disc.u_1, disc.u_2, disc.bound);
        disc.impulse_1 = t.t1, disc.impulse_2 = t.t2;
    });
}

template <class T>
struct DiscCurvature {
    T d_11{}, d_12{}, d_22{};
    friend DiscCurvature select(const MaskOf<T>& m, const DiscCurvature& a, const DiscCurvature& b) {
        return {select(m, a.d_11, b.d_11), select(m, a.d_12, b.d_12), select(m, a.d_22, b.d_22)};
    }
};

template <class T>
[[gnu::always_inline]] inline DiscCurvature<T> curvature_of(const FrictionDiscT<T>& disc) {
    using std::sqrt;
    if constexpr (std::is_same_v<T, double>) {
        if (slip_disc::slips(disc)) {
            const auto at = slip_disc::solve(disc, {disc.u_1, disc.u_2}, disc.bound);
            const slip_disc::Sym2 d = slip_disc::curvature(at);
            return {d.xx, d.xy, d.yy};
        }
    }
    const T speed = sqrt(disc.u_1 * disc.u_1 + disc.u_2 * disc.u_2);
    return either(
        is_sliding(disc, speed),
        [&] {  // sliding: only turning the direction changes the impulse
            const T inverse = T(1) / speed;
            const T s = disc.bound * inverse, e1 = disc.u_1 * inverse, e2 = disc.u_2 * inverse;
            return DiscCurvature<T>{s * (T(1) - e1 * e1), -s * e1 * e2, s * (T(1) - e2 * e2)};
        },
        [&] {
            return DiscCurvature<T>{disc.stiffness, T(0), disc.stiffness};
        });
}

/// The rows' share of the Hessian at the present velocities.
template <class T>
void set_curvatures(IslandRowsT<T>& rows) {
    for_each_bounded(
        rows, [](BoundedRowT<T>& row) { row.d = select(is_between_bounds(row), row.stiffness, T(0)); });
    for_each_disc(rows, [](FrictionDiscT<T>& disc) {
        disc.d_1n = disc.d_2n = 0;
        const DiscCurvature<T> d = either(
            disc.bound > T(0), [&] { return curvature_of(disc); }, [] { return DiscCurvature<T>{}; });
        disc.d_11 = d.d_11, disc.d_12 = d.d_12, disc.d_22 = d.d_22;
    });
}

/// Curvatures and impulses as if what stuck in the last tick stuck again. The velocities of the last tick are
/// a bad witness of that, for a hard row takes the least of them for sliding. True where anything stuck.
template <class T>
MaskOf<T> expect_sticking(IslandRowsT<T>& rows) {
    MaskOf<T> some = false;
    for (ContactRowT<T>& row : rows.contacts) {
        const MaskOf<T>& sticks = row.sticks;
        if (!any(sticks)) continue;
        BoundedRowT<T>& normal = row.normal;
        normal.d = select(sticks, normal.stiffness, normal.d);
        normal.impulse = select(sticks, (normal.target - normal.u) * normal.stiffness, normal.impulse);
        FrictionDiscT<T>& slip = row.slip;
        if constexpr (std::is_same_v<T, double>) {
            if (slip_disc::slips(slip)) {
                const slip_disc::Sym2 d = slip_disc::inverse(slip_disc::compliance(slip));
                const slip_disc::Plane t = slip_disc::times(d, {slip.u_1, slip.u_2});
                slip.d_11 = d.xx, slip.d_12 = d.xy, slip.d_22 = d.yy;
                slip.impulse_1 = -t.x, slip.impulse_2 = -t.y;
                some = true;
                continue;
            }
        }
        slip.d_11 = select(sticks, slip.stiffness, slip.d_11);
        slip.d_22 = select(sticks, slip.stiffness, slip.d_22);
        slip.d_12 = select(sticks, T(0), slip.d_12);
        slip.impulse_1 = select(sticks, -slip.u_1 * slip.stiffness, slip.impulse_1);
        slip.impulse_2 = select(sticks, -slip.u_2 * slip.stiffness, slip.impulse_2);
        some = some | sticks;
    }
    return some;
}

/// Minus the derivative of the rows' potentials along the step, at `alpha` of it.
template <class T>
T row_slope(IslandRowsT<T>& rows, const T& alpha) {
    T s = 0;
    for_each_bounded(rows, [&](BoundedRowT<T>& row) { s += force_along(row, alpha); });
    for_each_disc(rows, [&](FrictionDiscT<T>& disc) {
        if (disc.coefficient != 0) s += force_along(disc, alpha);
    });
    return s;
}

}  // namespace roboss::newton
