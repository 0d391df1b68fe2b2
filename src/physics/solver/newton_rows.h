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

template <class T>
struct Expected {
    MaskOf<T> some{false};    // a contact carried a load
    MaskOf<T> slides{false};  // one whose friction is tied to its normal impulse slides
};

/// The disc of a loaded contact: it sticks, or slides in the direction of its velocity. `tied`: its bound
/// follows the normal impulse, as it stands in `normal`.
template <class T>
MaskOf<T> expect_friction(const BoundedRowT<T>& normal, const MaskOf<T>& loaded, const MaskOf<T>& stuck,
                          bool tied, FrictionDiscT<T>& disc) {
    using std::sqrt;
    const T speed = sqrt(disc.u_1 * disc.u_1 + disc.u_2 * disc.u_2);
    const MaskOf<T> rubs = loaded & (disc.bound > T(0)), slides = rubs & (!stuck) & is_sliding(disc, speed),
                    sticks = rubs & !slides;
    disc.d_11 = select(sticks, disc.stiffness, disc.d_11);
    disc.d_22 = select(sticks, disc.stiffness, disc.d_22);
    disc.d_12 = select(sticks, T(0), disc.d_12);
    disc.impulse_1 = select(sticks, -disc.u_1 * disc.stiffness, disc.impulse_1);
    disc.impulse_2 = select(sticks, -disc.u_2 * disc.stiffness, disc.impulse_2);
    if (!tied || !any(slides)) return false;
    const T share = T(-disc.coefficient) / select(slides, speed, T(1)), impulse = share * normal.impulse,
            change = share * normal.d;
    disc.impulse_1 = select(slides, impulse * disc.u_1, disc.impulse_1);
    disc.impulse_2 = select(slides, impulse * disc.u_2, disc.impulse_2);
    disc.d_1n = select(slides, change * disc.u_1, disc.d_1n);
    disc.d_2n = select(slides, change * disc.u_2, disc.d_2n);
    return slides;
}

/// Curvatures and impulses as if every contact that carried a load in the last tick did so again, and stuck
/// or slid as it did then. The velocities of the last tick are a bad witness of that: a hard row takes the
/// least of them for parting, or for sliding. `tied`: friction bounds follow the normal impulses.
template <class T>
Expected<T> expect_loads(IslandRowsT<T>& rows, bool tied) {
    Expected<T> expected;
    for (ContactRowT<T>& row : rows.contacts) {
        if (!any(row.loaded)) continue;
        expected.some = expected.some | row.loaded;
        BoundedRowT<T>& normal = row.normal;
        normal.d = select(row.loaded, normal.stiffness, normal.d);
        normal.impulse = select(row.loaded, (normal.target - normal.u) * normal.stiffness, normal.impulse);
        FrictionDiscT<T>& slip = row.slip;
        if constexpr (std::is_same_v<T, double>) {
            if (slip_disc::slips(slip)) {
                if (!row.sticks) continue;
                const slip_disc::Sym2 d = slip_disc::inverse(slip_disc::compliance(slip));
                const slip_disc::Plane t = slip_disc::times(d, {slip.u_1, slip.u_2});
                slip.d_11 = d.xx, slip.d_12 = d.xy, slip.d_22 = d.yy;
                slip.impulse_1 = -t.x, slip.impulse_2 = -t.y;
                continue;
            }
        }
        expected.slides = expected.slides | expect_friction(normal, row.loaded, row.sticks, tied, slip);
    }
    return expected;
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
