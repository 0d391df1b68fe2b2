// Factorisation of a tree's matrix without fill-in (LTDL, Featherstone 2008, section 6.5), in a fixed order
// of operations. Matrices are packed by paths (DofPaths): A(i, path(i)[k]) stands at row(i) + k.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

#include "core/lanes.h"
#include "model/dof_paths.h"
#include "physics/dynamics/free_base_tree.h"
#include "physics/dynamics/tree_path.h"

namespace roboss {
/// y = A x for a symmetric matrix; x and y do not overlap.
template <class T>
void tree_times(const DofPaths& paths, const T* a, const T* __restrict x, T* __restrict y) {
    if constexpr (std::is_same_v<T, double>)
        if (free_base::begins(paths)) return free_base::times(paths, a, x, y);
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const T* row = a + paths.row(i);
        const std::size_t above = paths.length(i) - 1;
        // later rows add their share
        y[i] = row[above] * x[i] + path::dot_and_add(row, paths.path(i), 0, above, x, x[i], y);
    }
}

/// Rows and columns of locked degrees of freedom (none: empty) become those of the identity.
inline void lock_rows(const DofPaths& paths, std::span<const char> locked, double* a) {
    if (locked.empty()) return;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        double* row = a + paths.row(i);
        const std::size_t above = paths.length(i) - 1;
        for (std::size_t k = 0; k < above; ++k)
            if (locked[i] || locked[static_cast<std::size_t>(paths.path(i)[k])]) row[k] = 0;
        if (locked[i]) row[above] = 1;
    }
}

/// A = L^T D L in place: D's reciprocals on the diagonal, L below it.
template <class T>
void tree_factor(const DofPaths& paths, T* a) {
    if constexpr (std::is_same_v<T, double>)
        if (free_base::begins(paths)) return free_base::factor(paths, a);
    for (std::size_t k = paths.size(); k-- > 0;) {
        T* row_k = a + paths.row(k);
        const int* path = paths.path(k);
        const std::size_t above = paths.length(k) - 1;
        const T inverse = T(1) / row_k[above];
        row_k[above] = inverse;
        for (std::size_t m = above; m-- > 0;) {
            T* __restrict row = a + paths.row(static_cast<std::size_t>(path[m]));
            const T l = row_k[m] * inverse;
            for (std::size_t j = 0; j <= m; ++j) row[j] -= l * row_k[j];
            row_k[m] = l;
        }
    }
}

/// x := A^-1 x with the factor of tree_factor.
template <class T>
void tree_solve(const DofPaths& paths, const T* a, T* x) {
    if constexpr (std::is_same_v<T, double>)
        if (free_base::begins(paths)) return free_base::solve(paths, a, x);
    const std::size_t n = paths.size();
    for (std::size_t i = n; i-- > 0;)
        path::subtract(a + paths.row(i), paths.path(i), 0, paths.length(i) - 1, x[i], x);
    for (std::size_t i = 0; i < n; ++i)
        x[i] = x[i] * a[paths.diagonal(i)] -
               path::dot(a + paths.row(i), paths.path(i), 0, paths.length(i) - 1, x);
}

/// The same for a matrix that is not symmetric, on the same pattern: `lower` holds A(i, j) and `upper` A(j,
/// i) (the diagonal in `lower`). No pivoting: false for the lanes in which a pivot is zero. A negative one is
/// no harm: where friction grows with the normal impulse, the matrix is far from a positive one.
template <class T>
MaskOf<T> tree_factor_general(const DofPaths& paths, T* lower, T* upper) {
    constexpr bool kOne = std::is_same_v<T, double>;
    const bool on_base = kOne && free_base::begins(paths);
    MaskOf<T> good = true;
    for (std::size_t k = paths.size(); k-- > 0;) {
        T* row = lower + paths.row(k);     // A(k, j)
        T* column = upper + paths.row(k);  // A(j, k)
        const int* path = paths.path(k);
        const std::size_t above = paths.length(k) - 1;
        good = good & ((row[above] > T(0)) | (row[above] < T(0)));  // nor not a number
        if (!any(good)) return good;
        const T inverse = T(1) / row[above];
        row[above] = inverse;
        for (std::size_t j = 0; j < above; ++j) column[j] *= inverse;
        const std::size_t first = on_base && k >= 6 ? 6 : 0;
        for (std::size_t m = above; m-- > first;) {
            const std::size_t start = paths.row(static_cast<std::size_t>(path[m]));
            T* __restrict below = lower + start;
            T* __restrict beside = upper + start;
            const T l = column[m], r = row[m];
            for (std::size_t j = 0; j <= m; ++j) below[j] -= l * row[j];
            for (std::size_t j = 0; j < m; ++j) beside[j] -= column[j] * r;
        }
        if constexpr (kOne)
            if (first == 6)
                free_base::subtract_triangle(row, column, lower),
                    free_base::subtract_triangle<1>(column, row, upper);
    }
    return good;
}

template <class T>
void tree_solve_general(const DofPaths& paths, const T* lower, const T* upper, T* x) {
    const std::size_t n = paths.size();
    for (std::size_t i = n; i-- > 0;)
        path::subtract(upper + paths.row(i), paths.path(i), 0, paths.length(i) - 1, x[i], x);
    for (std::size_t i = 0; i < n; ++i) {
        const T* row = lower + paths.row(i);
        const std::size_t above = paths.length(i) - 1;
        x[i] = (x[i] - path::dot(row, paths.path(i), 0, above, x)) * row[above];
    }
}

}  // namespace roboss
