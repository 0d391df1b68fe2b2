// What every row does, whatever it stands for: its impulse at a velocity, and products with the rows'
// Jacobian. For the solver's files only.
#pragma once

#include <cmath>
#include <span>

#include "physics/rows.h"

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

template <class T>
Along<T> along(const ContactColumnsT<T>& columns, std::size_t first, std::size_t last,
               const std::vector<T>& x) {
    Along<T> sum;
    for (std::size_t c = first; c < last; ++c) {
        const T& xi = x[static_cast<std::size_t>(columns.dof[c])];
        sum.n += columns.n[c] * xi, sum.t1 += columns.t1[c] * xi, sum.t2 += columns.t2[c] * xi;
    }
    return sum;
}

template <class T>
void add(const ContactColumnsT<T>& columns, std::size_t first, std::size_t last, const Along<T>& impulse,
         std::vector<T>& y) {
    for (std::size_t c = first; c < last; ++c)
        y[static_cast<std::size_t>(columns.dof[c])] +=
            columns.n[c] * impulse.n + columns.t1[c] * impulse.t1 + columns.t2[c] * impulse.t2;
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
