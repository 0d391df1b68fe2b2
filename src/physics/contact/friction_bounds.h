// Friction bounds follow the normal impulses: in steps between Newton's, or together with the velocities.
#pragma once

#include "physics/solver/row_math.h"

namespace roboss {
namespace friction {

/// Moves a friction bound towards what the normal impulse allows. Where more friction means less pressure the
/// plain update swings for ever between two values, so a swing that hardly shrinks halves the step.
template <class T>
void update_bound(const T& wanted, T& bound, T& last_error, T& relaxation) {
    constexpr double kSlowest = 0.05, kRecovery = 1.2;
    const T error = wanted - bound;
    const MaskOf<T> swings = (error * last_error < T(0)) & (magnitude(error) > 0.8 * magnitude(last_error));
    relaxation = select(swings, larger(0.5 * relaxation, T(kSlowest)), smaller(kRecovery * relaxation, T(1)));
    last_error = error;
    bound += relaxation * error;
}

/// Change of the disc's impulse if its bound became that of the normal impulse.
template <class T>
T disc_change(const FrictionDiscT<T>& disc, const T& normal_impulse) {
    if (disc.coefficient == 0) return 0;
    const T wanted = disc.coefficient * normal_impulse;
    const TangentialT<T> before = impulse_at(disc, disc.u_1, disc.u_2, disc.bound);
    const TangentialT<T> after = impulse_at(disc, disc.u_1, disc.u_2, wanted);
    return magnitude(after.t1 - before.t1) + magnitude(after.t2 - before.t2);
}

/// How much friction would change if all bounds became those of the normal impulses, relative to the largest
/// normal impulse (moments are compared by the radius that their coefficient is).
template <class T>
struct BoundError {
    T largest{}, change{};

    void add(const ContactRowT<T>& row) {
        largest = larger(largest, row.normal.impulse);
        change = larger(change, disc_change(row.slip, row.normal.impulse));
    }
    /// `normal_impulse`: of its contact.
    void add(const AngularRowT<T>& row, const T& normal_impulse) {
        if (row.torsional > 0)
            change =
                larger(change, magnitude(row.torsional * normal_impulse - row.spin.high) / T(row.torsional));
        if (row.roll.coefficient > 0)
            change = larger(change, disc_change(row.roll, normal_impulse) / T(row.roll.coefficient));
    }
    T relative() const { return select(largest > T(0), change / largest, T(0)); }
};

template <class T>
BoundError<T> bound_error(const IslandRowsT<T>& rows) {
    BoundError<T> error;
    for (const ContactRowT<T>& row : rows.contacts) error.add(row);
    for (const AngularRowT<T>& row : rows.angulars) error.add(row, rows.contacts[row.contact].normal.impulse);
    return error;
}

template <class T>
void update_disc(FrictionDiscT<T>& disc, const T& normal_impulse) {
    if (disc.coefficient == 0) return;
    update_bound(disc.coefficient * normal_impulse, disc.bound, disc.bound_error, disc.relaxation);
}

/// All friction bounds follow the normal impulses; returns their error before that.
template <class T>
T update_bounds(IslandRowsT<T>& rows) {
    BoundError<T> error;
    for (ContactRowT<T>& row : rows.contacts) {
        error.add(row);
        update_disc(row.slip, row.normal.impulse);
    }
    for (AngularRowT<T>& row : rows.angulars) {
        const T normal = rows.contacts[row.contact].normal.impulse;
        error.add(row, normal);
        if (row.torsional > 0) {
            update_bound(row.torsional * normal, row.spin.high, row.spin_error, row.spin_relaxation);
            row.spin.low = -row.spin.high;
        }
        if (row.roll.coefficient > 0) update_disc(row.roll, normal);
    }
    return error.relative();
}

/// All friction bounds, and back.
template <class T>
void keep_bounds(IslandRowsT<T>& rows, std::vector<T>& bounds) {
    bounds.clear();
    for_each_disc(rows, [&](FrictionDiscT<T>& disc) { bounds.push_back(disc.bound); });
    for (const AngularRowT<T>& row : rows.angulars) bounds.push_back(row.spin.high);
}
template <class T>
void set_bounds(IslandRowsT<T>& rows, const std::vector<T>& bounds) {
    std::size_t at = 0;
    for_each_disc(rows, [&](FrictionDiscT<T>& disc) { disc.bound = bounds[at++]; });
    for (AngularRowT<T>& row : rows.angulars) row.spin.high = bounds[at++], row.spin.low = -row.spin.high;
}

/// Every friction bound as the normal impulse says: normal_of(c) of contact c.
template <class T, class NormalOf>
void fit_bounds(IslandRowsT<T>& rows, const NormalOf& normal_of) {
    for (std::size_t c = 0; c < rows.contacts.size(); ++c)
        rows.contacts[c].slip.bound = rows.contacts[c].slip.coefficient * normal_of(c);
    for (AngularRowT<T>& row : rows.angulars) {
        const T impulse = normal_of(row.contact);
        row.roll.bound = row.roll.coefficient * impulse;
        row.spin.high = row.torsional * impulse, row.spin.low = -row.spin.high;
    }
}

/// The same of the normal impulses at the present velocity.
template <class T>
void tie_bounds(IslandRowsT<T>& rows) {
    fit_bounds(rows, [&](std::size_t c) {
        const BoundedRowT<T>& normal = rows.contacts[c].normal;
        return impulse_at(normal, normal.u);
    });
}

/// Derivatives of sliding friction by the normal velocity; true where anything slides.
template <class T>
MaskOf<T> couple_bounds(IslandRowsT<T>& rows) {
    using std::sqrt;
    MaskOf<T> slides = false;
    for (ContactRowT<T>& row : rows.contacts) {
        FrictionDiscT<T>& disc = row.slip;
        const MaskOf<T> pressed = (!equal(row.normal.d, T(0))) & (disc.bound > T(0));
        if (!any(pressed)) continue;
        if constexpr (std::is_same_v<T, double>) {
            if (slip_disc::slips(disc)) {
                const auto at = slip_disc::solve(disc, {disc.u_1, disc.u_2}, disc.bound);
                if (!at.bounded) continue;
                const slip_disc::Plane by = slip_disc::by_bound(at, disc.bound);
                const double share = disc.coefficient * row.normal.d;
                disc.d_1n = share * by.x, disc.d_2n = share * by.y;
                slides = true;
                continue;
            }
        }
        const T speed = sqrt(disc.u_1 * disc.u_1 + disc.u_2 * disc.u_2);
        const MaskOf<T> here = pressed & is_sliding(disc, speed);
        if (!any(here)) continue;
        const T share = -disc.coefficient * row.normal.d / speed;
        disc.d_1n = select(here, share * disc.u_1, disc.d_1n);
        disc.d_2n = select(here, share * disc.u_2, disc.d_2n);
        slides = slides | here;
    }
    return slides;
}

}  // namespace friction
}  // namespace roboss
