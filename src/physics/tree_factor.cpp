// See tree_factor.h.
#include "physics/tree_factor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace roboss {

void tree_times(std::span<const int> parent, std::span<const double> a, const double* x, double* y) {
    const std::size_t n = parent.size();
    for (std::size_t i = 0; i < n; ++i) {
        const double* row = a.data() + i * n;
        double sum = row[i] * x[i];
        for (int j = parent[i]; j >= 0; j = parent[static_cast<std::size_t>(j)]) {
            const auto k = static_cast<std::size_t>(j);
            sum += row[k] * x[k];
            y[k] += row[k] * x[i];
        }
        y[i] = sum;  // later rows add their share above
    }
}

void tree_factor(std::span<const int> parent, std::span<double> a) {
    const std::size_t n = parent.size();
    for (std::size_t k = n; k-- > 0;) {
        double* row_k = a.data() + k * n;
        const double inverse = 1.0 / row_k[k];
        row_k[k] = inverse;
        for (int i = parent[k]; i >= 0; i = parent[static_cast<std::size_t>(i)]) {
            double* row_i = a.data() + static_cast<std::size_t>(i) * n;
            const double l = row_k[i] * inverse;
            for (int j = i; j >= 0; j = parent[static_cast<std::size_t>(j)]) row_i[j] -= l * row_k[j];
            row_k[i] = l;
        }
    }
}

void tree_solve(std::span<const int> parent, std::span<const double> a, double* x) {
    const std::size_t n = parent.size();
    for (std::size_t i = n; i-- > 0;)
        for (int j = parent[i]; j >= 0; j = parent[static_cast<std::size_t>(j)])
            x[j] -= a[i * n + static_cast<std::size_t>(j)] * x[i];
    for (std::size_t i = 0; i < n; ++i) x[i] *= a[i * n + i];
    for (std::size_t i = 0; i < n; ++i)
        for (int j = parent[i]; j >= 0; j = parent[static_cast<std::size_t>(j)])
            x[i] -= a[i * n + static_cast<std::size_t>(j)] * x[j];
}

bool tree_factor_general(std::span<const int> parent, std::span<double> lower, std::span<double> upper) {
    const std::size_t n = parent.size();
    for (std::size_t k = n; k-- > 0;) {
        double* row = lower.data() + k * n;     // A(k, j)
        double* column = upper.data() + k * n;  // A(j, k)
        if (!(row[k] > 0)) return false;
        const double inverse = 1.0 / row[k];
        row[k] = inverse;
        for (int i = parent[k]; i >= 0; i = parent[static_cast<std::size_t>(i)]) {
            const double l = column[i] * inverse, r = row[i];
            column[i] = l;
            double* below = lower.data() + static_cast<std::size_t>(i) * n;
            double* above = upper.data() + static_cast<std::size_t>(i) * n;
            below[i] -= l * r;
            for (int j = parent[static_cast<std::size_t>(i)]; j >= 0;
                 j = parent[static_cast<std::size_t>(j)]) {
                below[j] -= l * row[j];
                above[j] -= column[j] * inverse * r;
            }
        }
    }
    return true;
}

void tree_solve_general(std::span<const int> parent, std::span<const double> lower,
                        std::span<const double> upper, double* x) {
    const std::size_t n = parent.size();
    for (std::size_t i = n; i-- > 0;)
        for (int j = parent[i]; j >= 0; j = parent[static_cast<std::size_t>(j)])
            x[j] -= upper[i * n + static_cast<std::size_t>(j)] * x[i];
    for (std::size_t i = 0; i < n; ++i) {
        for (int j = parent[i]; j >= 0; j = parent[static_cast<std::size_t>(j)])
            x[i] -= lower[i * n + static_cast<std::size_t>(j)] * x[j];
        x[i] *= lower[i * n + i];
    }
}

}  // namespace roboss
