// Free bodies that slide without turning, along contacts that stay as they are: what moves them in a tick
// does not depend on where they are. Over T: one contact island, or a few of one body in lanes.
#pragma once

#include <span>

#include "physics/solver/rows.h"

namespace roboss {

/// `v`: of a free body.
template <class T>
MaskOf<T> hardly_turns(std::span<const T> v) {
    constexpr double kTurning = 1e-3;  // rad/s
    MaskOf<T> turns = false;
    for (std::size_t i = 0; i < 3; ++i) turns = turns | (magnitude(v[i]) > T(kTurning));
    return !turns;
}

/// True if every contact is hard and no normal velocity changes: nothing new touches, nothing lifts off.
template <class T>
MaskOf<T> contacts_are_steady(const IslandRowsT<T>& rows, std::span<const T> before, std::span<const T> v,
                              double dt) {
    constexpr double kNothing = 1e-10;  // m, in the displacement of a tick
    MaskOf<T> changes = false;
    for (const ContactRowT<T>& row : rows.contacts) {
        if (row.soft) return false;
        T change = 0;
        for (std::size_t k = row.first; k < row.last; ++k) {
            const auto dof = static_cast<std::size_t>(rows.columns.dof[k]);
            change += rows.columns.n[k] * (v[dof] - before[dof]);
        }
        changes = changes | (magnitude(change) * T(dt) > T(2 * kNothing));
    }
    return !changes;
}

}  // namespace roboss
