// What every row does, whatever it stands for: its impulse at a velocity. For the solver's files only.
#pragma once

#include <algorithm>
#include <cmath>

#include "physics/rows.h"

namespace roboss {

inline double impulse_at(const BoundedRow& row, double u) {
    return std::clamp((row.target - u) * row.stiffness, row.low, row.high);
}

struct Tangential {
    double t1 = 0, t2 = 0;
};

/// `u_1`, `u_2`: velocity minus target.
inline Tangential impulse_at(const FrictionDisc& disc, double u_1, double u_2, double bound) {
    const double t1 = -u_1 * disc.stiffness, t2 = -u_2 * disc.stiffness;
    const double size2 = t1 * t1 + t2 * t2;
    if (size2 <= bound * bound) return {t1, t2};
    const double cut = bound / std::sqrt(size2);
    return {t1 * cut, t2 * cut};
}

/// All bounded rows, in their canonical order.
template <class Function>
void for_each_bounded(IslandRows& rows, Function&& f) {
    for (JointRow& row : rows.joints) f(row);
    for (CouplingRow& row : rows.couplings) f(row);
    for (ContactRow& row : rows.contacts) f(row.normal);
    for (AngularRow& row : rows.angulars) f(row.spin);
}

/// All friction discs, in their canonical order.
template <class Function>
void for_each_disc(IslandRows& rows, Function&& f) {
    for (ContactRow& row : rows.contacts) f(row.slip);
    for (AngularRow& row : rows.angulars) f(row.roll);
}

/// y += J^T impulses
void add_impulses(const IslandRows& rows, std::span<double> y);
/// du = J x
void set_steps(IslandRows& rows, std::span<const double> x);

}  // namespace roboss
