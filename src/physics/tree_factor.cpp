// See tree_factor.h.
#include "physics/tree_factor.h"

#include <cstddef>

namespace roboss {
namespace {

/// sum of row[k] * x[path[k]], k < count, in two interleaved halves: half the latency.
double dot_path(const double* row, const int* path, std::size_t count, const double* x) {
    double even = 0, odd = 0;
    std::size_t k = 0;
    for (; k + 1 < count; k += 2) even += row[k] * x[path[k]], odd += row[k + 1] * x[path[k + 1]];
    if (k < count) even += row[k] * x[path[k]];
    return even + odd;
}

/// x[path[k]] -= row[k] * s, k < count
void subtract_path(const double* row, const int* path, std::size_t count, double s, double* x) {
    for (std::size_t k = 0; k < count; ++k) x[path[k]] -= row[k] * s;
}

}  // namespace

void tree_times(const DofPaths& paths, std::span<const double> a, const double* x, double* y) {
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const double* row = a.data() + paths.row(i);
        const int* path = paths.path(i);
        const std::size_t above = paths.length(i) - 1;
        for (std::size_t k = 0; k < above; ++k) y[path[k]] += row[k] * x[i];
        y[i] = row[above] * x[i] + dot_path(row, path, above, x);  // later rows add their share above
    }
}

void tree_factor(const DofPaths& paths, std::span<double> a) {
    for (std::size_t k = paths.size(); k-- > 0;) {
        double* row_k = a.data() + paths.row(k);
        const int* path = paths.path(k);
        const std::size_t above = paths.length(k) - 1;
        const double inverse = 1.0 / row_k[above];
        row_k[above] = inverse;
        for (std::size_t m = above; m-- > 0;) {
            double* __restrict row = a.data() + paths.row(static_cast<std::size_t>(path[m]));
            const double l = row_k[m] * inverse;
            for (std::size_t j = 0; j <= m; ++j) row[j] -= l * row_k[j];
            row_k[m] = l;
        }
    }
}

void tree_solve(const DofPaths& paths, std::span<const double> a, double* x) {
    const std::size_t n = paths.size();
    for (std::size_t i = n; i-- > 0;)
        subtract_path(a.data() + paths.row(i), paths.path(i), paths.length(i) - 1, x[i], x);
    for (std::size_t i = 0; i < n; ++i)
        x[i] = x[i] * a[paths.diagonal(i)] -
               dot_path(a.data() + paths.row(i), paths.path(i), paths.length(i) - 1, x);
}

bool tree_factor_general(const DofPaths& paths, std::span<double> lower, std::span<double> upper) {
    for (std::size_t k = paths.size(); k-- > 0;) {
        double* row = lower.data() + paths.row(k);     // A(k, j)
        double* column = upper.data() + paths.row(k);  // A(j, k)
        const int* path = paths.path(k);
        const std::size_t above = paths.length(k) - 1;
        if (!(row[above] > 0)) return false;
        const double inverse = 1.0 / row[above];
        row[above] = inverse;
        for (std::size_t j = 0; j < above; ++j) column[j] *= inverse;
        for (std::size_t m = above; m-- > 0;) {
            const std::size_t start = paths.row(static_cast<std::size_t>(path[m]));
            double* __restrict below = lower.data() + start;
            double* __restrict beside = upper.data() + start;
            const double l = column[m], r = row[m];
            for (std::size_t j = 0; j <= m; ++j) below[j] -= l * row[j];
            for (std::size_t j = 0; j < m; ++j) beside[j] -= column[j] * r;
        }
    }
    return true;
}

void tree_solve_general(const DofPaths& paths, std::span<const double> lower, std::span<const double> upper,
                        double* x) {
    const std::size_t n = paths.size();
    for (std::size_t i = n; i-- > 0;)
        subtract_path(upper.data() + paths.row(i), paths.path(i), paths.length(i) - 1, x[i], x);
    for (std::size_t i = 0; i < n; ++i) {
        const double* row = lower.data() + paths.row(i);
        x[i] = (x[i] - dot_path(row, paths.path(i), paths.length(i) - 1, x)) * row[paths.length(i) - 1];
    }
}

}  // namespace roboss
