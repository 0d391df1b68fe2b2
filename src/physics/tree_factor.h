// Factorisation of a tree's matrix without fill-in (LTDL, Featherstone 2008, section 6.5), in a fixed order
// of operations. Matrices are packed by paths (DofPaths): A(i, path(i)[k]) stands at row(i) + k.
#pragma once

#include <cstddef>

#include "core/lanes.h"
#include "model/dof_paths.h"

namespace roboss {
namespace path {

/// sum of row[k] * x[path[k]], k < count, in two interleaved halves: half the latency.
template <class T>
T dot(const T* row, const int* path, std::size_t count, const T* x) {
    T even = 0, odd = 0;
    std::size_t k = 0;
    for (; k + 1 < count; k += 2) even += row[k] * x[path[k]], odd += row[k + 1] * x[path[k + 1]];
    if (k < count) even += row[k] * x[path[k]];
    return even + odd;
}

/// x[path[k]] -= row[k] * s, k < count
template <class T>
void subtract(const T* row, const int* path, std::size_t count, const T& s, T* x) {
    for (std::size_t k = 0; k < count; ++k) x[path[k]] -= row[k] * s;
}

}  // namespace path

/// y = A x for a symmetric matrix; x and y do not overlap.
template <class T>
void tree_times(const DofPaths& paths, const T* a, const T* __restrict x, T* __restrict y) {
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const T* row = a + paths.row(i);
        const int* path = paths.path(i);
        const std::size_t above = paths.length(i) - 1;
        const T x_i = x[i];
        T even = 0, odd = 0;  // as path::dot
        const auto take = [&](std::size_t k, T& sum) {
            y[path[k]] += row[k] * x_i;
            sum += row[k] * x[path[k]];
        };
        std::size_t k = 0;
        for (; k + 1 < above; k += 2) take(k, even), take(k + 1, odd);
        if (k < above) take(k, even);
        y[i] = row[above] * x_i + (even + odd);  // later rows add their share
    }
}

/// A = L^T D L in place: D's reciprocals on the diagonal, L below it.
template <class T>
void tree_factor(const DofPaths& paths, T* a) {
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
    const std::size_t n = paths.size();
    for (std::size_t i = n; i-- > 0;)
        path::subtract(a + paths.row(i), paths.path(i), paths.length(i) - 1, x[i], x);
    for (std::size_t i = 0; i < n; ++i)
        x[i] =
            x[i] * a[paths.diagonal(i)] - path::dot(a + paths.row(i), paths.path(i), paths.length(i) - 1, x);
}

/// The same for a matrix that is not symmetric, on the same pattern: `lower` holds A(i, j) and `upper` A(j,
/// i) (the diagonal in `lower`). No pivoting: false for the lanes in which a pivot is not positive.
template <class T>
MaskOf<T> tree_factor_general(const DofPaths& paths, T* lower, T* upper) {
    MaskOf<T> good = true;
    for (std::size_t k = paths.size(); k-- > 0;) {
        T* row = lower + paths.row(k);     // A(k, j)
        T* column = upper + paths.row(k);  // A(j, k)
        const int* path = paths.path(k);
        const std::size_t above = paths.length(k) - 1;
        good = good & (row[above] > T(0));
        if (!any(good)) return good;
        const T inverse = T(1) / row[above];
        row[above] = inverse;
        for (std::size_t j = 0; j < above; ++j) column[j] *= inverse;
        for (std::size_t m = above; m-- > 0;) {
            const std::size_t start = paths.row(static_cast<std::size_t>(path[m]));
            T* __restrict below = lower + start;
            T* __restrict beside = upper + start;
            const T l = column[m], r = row[m];
            for (std::size_t j = 0; j <= m; ++j) below[j] -= l * row[j];
            for (std::size_t j = 0; j < m; ++j) beside[j] -= column[j] * r;
        }
    }
    return good;
}

template <class T>
void tree_solve_general(const DofPaths& paths, const T* lower, const T* upper, T* x) {
    const std::size_t n = paths.size();
    for (std::size_t i = n; i-- > 0;)
        path::subtract(upper + paths.row(i), paths.path(i), paths.length(i) - 1, x[i], x);
    for (std::size_t i = 0; i < n; ++i) {
        const T* row = lower + paths.row(i);
        x[i] = (x[i] - path::dot(row, paths.path(i), paths.length(i) - 1, x)) * row[paths.length(i) - 1];
    }
}

}  // namespace roboss
