// Rows of a tree's matrix, packed by paths (DofPaths), with vectors over all degrees of freedom.
#pragma once

#include <cstddef>

#include "core/pair.h"

namespace roboss::path {

/// sum + row[k] * x[path[k]], first <= k < count, in two interleaved halves: half the latency. `first` is
/// even.
template <class T>
[[gnu::always_inline]] inline T dot(const T* row, const int* path, std::size_t first, std::size_t count,
                                    const T* x, Halves<T> sum = {}) {
    std::size_t k = first;
    for (; k + 1 < count; k += 2) sum.add_even(row[k] * x[path[k]]), sum.add_odd(row[k + 1] * x[path[k + 1]]);
    if (k < count) sum.add_even(row[k] * x[path[k]]);
    return sum.sum();
}

/// The same sum of A x, while y[path[k]] += row[k] * s.
template <class T>
[[gnu::always_inline]] inline T dot_and_add(const T* row, const int* path, std::size_t first,
                                            std::size_t count, const T* __restrict x, const T& s,
                                            T* __restrict y, Halves<T> sum = {}) {
    const auto add = [&](std::size_t k) { y[path[k]] += row[k] * s; };
    std::size_t k = first;
    for (; k + 1 < count; k += 2) {
        add(k), add(k + 1);
        sum.add_even(row[k] * x[path[k]]), sum.add_odd(row[k + 1] * x[path[k + 1]]);
    }
    if (k < count) add(k), sum.add_even(row[k] * x[path[k]]);
    return sum.sum();
}

/// x[path[k]] -= row[k] * s, first <= k < count
template <class T>
[[gnu::always_inline]] inline void subtract(const T* row, const int* path, std::size_t first,
                                            std::size_t count, const T& s, T* x) {
    for (std::size_t k = first; k < count; ++k) x[path[k]] -= row[k] * s;
}

}  // namespace roboss::path
