// What every row does, whatever it stands for: its impulse at a velocity, and products with the rows'
// Jacobian. For the solver's files only.
#pragma once

#include <cmath>
#include <span>

#include "core/pair.h"
#include "physics/solver/rows.h"
#include "physics/solver/slip_disc.h"

namespace roboss {

template <class T>
[[gnu::always_inline]] inline T impulse_at(const BoundedRowT<T>& row, const T& u) {
    return clamped((row.target - u) * row.stiffness, row.low, row.high);
}

template <class T>
struct TangentialT {
    T t1{}, t2{};
    friend TangentialT select(const MaskOf<T>& m, const TangentialT& a, const TangentialT& b) {
        return {select(m, a.t1, b.t1), select(m, a.t2, b.t2)};
    }
};
using Tangential = TangentialT<double>;

/// `u_1`, `u_2`: velocity minus target.
template <class T>
[[gnu::always_inline]] inline TangentialT<T> impulse_at(const FrictionDiscT<T>& disc, const T& u_1,
                                                        const T& u_2, const T& bound) {
    using std::sqrt;
    if constexpr (std::is_same_v<T, double>) {
        if (slip_disc::slips(disc)) {
            const slip_disc::Plane t = slip_disc::solve(disc, {u_1, u_2}, bound).impulse;
            return {t.x, t.y};
        }
    }
    const T t1 = -u_1 * disc.stiffness, t2 = -u_2 * disc.stiffness;
    const T size2 = t1 * t1 + t2 * t2;
    return either(
        size2 > bound * bound,
        [&] {
            const T cut = bound / sqrt(size2);
            return TangentialT<T>{t1 * cut, t2 * cut};
        },
        [&] {
            return TangentialT<T>{t1, t2};
        });
}

/// Impulse along the row's step, at `fraction` of it.
template <class T>
T force_along(const BoundedRowT<T>& row, const T& fraction) {
    return impulse_at(row, row.u + fraction * row.du) * row.du;
}
template <class T>
TangentialT<T> impulse_along(const FrictionDiscT<T>& disc, const T& fraction) {
    return impulse_at(disc, disc.u_1 + fraction * disc.du_1, disc.u_2 + fraction * disc.du_2, disc.bound);
}
template <class T>
T force_of(const FrictionDiscT<T>& disc, const TangentialT<T>& t) {
    return t.t1 * disc.du_1 + t.t2 * disc.du_2;
}
template <class T>
T force_along(const FrictionDiscT<T>& disc, const T& fraction) {
    return force_of(disc, impulse_along(disc, fraction));
}

/// A row that just reaches its bound counts, in floats, as one that has not: what a float cannot tell apart
/// would else swing to and fro from step to step.
template <class T>
T beyond(const T& bound) {
    if constexpr (kIsFloat<T>)
        return bound * T(1.0001);
    else
        return bound;
}
template <class T>
MaskOf<T> is_between_bounds(const BoundedRowT<T>& row) {
    const T raw = (row.target - row.u) * row.stiffness;
    return (raw > beyond(row.low)) & (raw < beyond(row.high));
}
/// `speed`: of its velocity minus target.
template <class T>
MaskOf<T> is_sliding(const FrictionDiscT<T>& disc, const T& speed) {
    return speed > beyond(disc.bound * disc.compliance);
}

/// All bounded rows, in their canonical order.
template <class T, class Function>
void for_each_bounded(IslandRowsT<T>& rows, Function&& f) {
    for (JointRowT<T>& row : rows.joints) f(row);
    for (CouplingRowT<T>& row : rows.couplings) f(row);
    for (ContactRowT<T>& row : rows.contacts) f(row.normal);
    for (AngularRowT<T>& row : rows.angulars) f(row.spin);
}

/// All friction discs, in their canonical order.
template <class T, class Function>
void for_each_disc(IslandRowsT<T>& rows, Function&& f) {
    for (ContactRowT<T>& row : rows.contacts) f(row.slip);
    for (AngularRowT<T>& row : rows.angulars) f(row.roll);
}

namespace jacobian {

template <class T>
struct Along {
    T n{}, t1{}, t2{};
};

/// y += columns * a, of `count` columns with dofs one by one.
template <class T>
[[gnu::always_inline]] inline void add_run(const T* n, const T* t1, const T* t2, const Along<T>& a,
                                           std::size_t count, T* y) {
    for (std::size_t k = 0; k < count; ++k) y[k] += n[k] * a.n + t1[k] * a.t1 + t2[k] * a.t2;
}
[[gnu::always_inline]] inline void add_run(const double* n, const double* t1, const double* t2,
                                           const Along<double>& a, std::size_t count, double* y) {
    const auto sum = [&](std::size_t k) {
        return pair_at(n + k) * both(a.n) + pair_at(t1 + k) * both(a.t1) + pair_at(t2 + k) * both(a.t2);
    };
    if (count == 6) {  // a free base, mostly
        for (std::size_t k = 0; k < 6; k += 2) put(y + k, pair_at(y + k) + sum(k));
        return;
    }
    for (std::size_t k = 0; k + 1 < count; k += 2) put(y + k, pair_at(y + k) + sum(k));
    const std::size_t k = count - 1;
    if (count % 2 != 0) y[k] += n[k] * a.n + t1[k] * a.t1 + t2[k] * a.t2;
}

inline void add_run(const double* n, double a, std::size_t count, double* y) {
    for (std::size_t k = 0; k + 1 < count; k += 2) put(y + k, pair_at(y + k) + pair_at(n + k) * both(a));
    if (count % 2 != 0) y[count - 1] += n[count - 1] * a;
}

template <class T>
[[gnu::always_inline]] inline Along<T> along(const ContactColumnsT<T>& columns, std::size_t first,
                                             std::size_t last, const std::vector<T>& x) {
    Halves<T> n, t1, t2;
    for (std::size_t c = first; c < last;) {
        const T* xs = x.data() + columns.dof[c];
        const T *cn = columns.n.data() + c, *c1 = columns.t1.data() + c, *c2 = columns.t2.data() + c;
        if (columns.base[c]) {
            for (std::size_t k = 0; k < 6; k += 2)
                n.add(cn + k, xs + k), t1.add(c1 + k, xs + k), t2.add(c2 + k, xs + k);
            c += 6;
        } else {
            n.add_even(*cn * *xs), t1.add_even(*c1 * *xs), t2.add_even(*c2 * *xs);
            ++c;
        }
    }
    return {n.sum(), t1.sum(), t2.sum()};
}

template <class T>
[[gnu::always_inline]] inline void add(const ContactColumnsT<T>& columns, std::size_t first, std::size_t last,
                                       const Along<T>& impulse, std::vector<T>& y) {
    for (std::size_t c = first; c < last;) {
        T* ys = y.data() + columns.dof[c];
        const T *n = columns.n.data() + c, *t1 = columns.t1.data() + c, *t2 = columns.t2.data() + c;
        if (columns.base[c]) {
            add_run(n, t1, t2, impulse, 6, ys);
            c += 6;
        } else {
            *ys += *n * impulse.n + *t1 * impulse.t1 + *t2 * impulse.t2;
            ++c;
        }
    }
}

}  // namespace jacobian

/// y += J^T impulses
template <class T>
void add_impulses(const IslandRowsT<T>& rows, std::vector<T>& y) {
    for (const JointRowT<T>& row : rows.joints) y[static_cast<std::size_t>(row.dof)] += row.impulse;
    for (const CouplingRowT<T>& row : rows.couplings) {
        for (std::size_t c = row.first; c < row.last; ++c)
            y[static_cast<std::size_t>(rows.coupling_columns[c].dof)] +=
                rows.coupling_columns[c].j * row.impulse;
    }
    for (const ContactRowT<T>& row : rows.contacts)
        jacobian::add<T>(rows.columns, row.first, row.last,
                         {row.normal.impulse, row.slip.impulse_1, row.slip.impulse_2}, y);
    for (const AngularRowT<T>& row : rows.angulars)
        jacobian::add<T>(rows.columns, row.first, row.last,
                         {row.spin.impulse, row.roll.impulse_1, row.roll.impulse_2}, y);
}

/// du = J x
template <class T>
void set_steps(IslandRowsT<T>& rows, const std::vector<T>& x) {
    for (JointRowT<T>& row : rows.joints) row.du = x[static_cast<std::size_t>(row.dof)];
    for (CouplingRowT<T>& row : rows.couplings) {
        row.du = 0;
        for (std::size_t c = row.first; c < row.last; ++c)
            row.du += rows.coupling_columns[c].j * x[static_cast<std::size_t>(rows.coupling_columns[c].dof)];
    }
    for (ContactRowT<T>& row : rows.contacts) {
        const jacobian::Along<T> u = jacobian::along(rows.columns, row.first, row.last, x);
        row.normal.du = u.n, row.slip.du_1 = u.t1, row.slip.du_2 = u.t2;
    }
    for (AngularRowT<T>& row : rows.angulars) {
        const jacobian::Along<T> w = jacobian::along(rows.columns, row.first, row.last, x);
        row.spin.du = w.n, row.roll.du_1 = w.t1, row.roll.du_2 = w.t2;
    }
}

}  // namespace roboss
