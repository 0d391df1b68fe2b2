// tree_factor.h for one robot with a free base: the six unknowns of the base begin every row, so they are
// taken two by two and stay in registers. All sums run in the order of tree_factor.h and give its bits.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#include "core/pair.h"
#include "model/dof_paths.h"
#include "physics/dynamics/tree_path.h"

namespace roboss::free_base {

/// True if these functions serve: the first six unknowns begin all later paths.
inline bool begins(const DofPaths& paths) {
    return paths.trunk() >= 6;
}

/// The base's part of a row or a vector.
struct Six {
    Pair a, b, c;

    explicit Six(const double* x) : a(pair_at(x)), b(pair_at(x + 2)), c(pair_at(x + 4)) {}
    void add(const Six& x, double s) { a += x.a * both(s), b += x.b * both(s), c += x.c * both(s); }
    void subtract(const Six& x, double s) { a -= x.a * both(s), b -= x.b * both(s), c -= x.c * both(s); }
    void put_to(double* x) const { put(x, a), put(x + 2, b), put(x + 4, c); }

    friend Six operator*(const Six& x, double s) {
        Six product = x;
        product.a *= both(s), product.b *= both(s), product.c *= both(s);
        return product;
    }
    friend Halves<double> dot(const Six& x, const Six& y) {
        Halves<double> sum;
        sum.halves += x.a * y.a, sum.halves += x.b * y.b, sum.halves += x.c * y.c;
        return sum;
    }
};

/// h[j] -= row[j] * s, j < kCount
template <std::size_t kCount>
[[gnu::always_inline]] inline void subtract_first(const double* row, double s, double* h) {
    for (std::size_t j = 0; j + 1 < kCount; j += 2) put(h + j, pair_at(h + j) - pair_at(row + j) * both(s));
    if constexpr (kCount % 2 != 0) h[kCount - 1] -= row[kCount - 1] * s;
}

/// h(m, j) -= row[j] * shares[m] in the base's triangle, j <= m, or j < m if it is `kStrict`.
template <std::size_t kStrict = 0>
[[gnu::always_inline]] inline void subtract_triangle(const double* row, const double* shares, double* h) {
    subtract_first<6 - kStrict>(row, shares[5], h + 15);
    subtract_first<5 - kStrict>(row, shares[4], h + 10);
    subtract_first<4 - kStrict>(row, shares[3], h + 6);
    subtract_first<3 - kStrict>(row, shares[2], h + 3);
    subtract_first<2 - kStrict>(row, shares[1], h + 1);
    subtract_first<1 - kStrict>(row, shares[0], h);
}

inline void times(const DofPaths& paths, const double* a, const double* __restrict x, double* __restrict y) {
    const auto row_times = [&](std::size_t i, std::size_t first, const Halves<double>& sum) {
        const double* row = a + paths.row(i);
        const std::size_t above = paths.length(i) - 1;
        y[i] = row[above] * x[i] + path::dot_and_add(row, paths.path(i), first, above, x, x[i], y, sum);
    };
    for (std::size_t i = 0; i < 6; ++i) row_times(i, 0, {});
    const Six x_base(x);
    Six y_base(y);
    for (std::size_t i = 6; i < paths.size(); ++i) {
        const Six row(a + paths.row(i));
        y_base.add(row, x[i]);
        row_times(i, 6, dot(row, x_base));
    }
    y_base.put_to(y);
}

/// Eliminates unknown k of the base, after all higher ones.
template <std::size_t k>
void factor_row(double* a) {
    double* row_k = a + k * (k + 1) / 2;
    const double inverse = 1.0 / row_k[k];
    row_k[k] = inverse;
    const auto eliminate = [&]<std::size_t m>(std::integral_constant<std::size_t, m>) {
        const double l = row_k[m] * inverse;
        subtract_first<m + 1>(row_k, l, a + m * (m + 1) / 2);
        row_k[m] = l;
    };
    [&]<std::size_t... i>(std::index_sequence<i...>) {
        (eliminate(std::integral_constant<std::size_t, k - 1 - i>{}), ...);
    }
    (std::make_index_sequence<k>{});
}

inline void factor(const DofPaths& paths, double* a) {
    for (std::size_t k = paths.size(); k-- > 6;) {
        double* row_k = a + paths.row(k);
        const int* path = paths.path(k);
        const std::size_t above = paths.length(k) - 1;
        const double inverse = 1.0 / row_k[above];
        row_k[above] = inverse;
        for (std::size_t m = above; m-- > 6;) {
            double* __restrict row = a + paths.row(static_cast<std::size_t>(path[m]));
            const double l = row_k[m] * inverse;
            subtract_first<6>(row_k, l, row);
            std::size_t j = 6;
            for (; j < m; j += 2) subtract_first<2>(row_k + j, l, row + j);
            if (j == m) row[j] -= row_k[j] * l;
            row_k[m] = l;
        }
        double shares[6];
        (Six(row_k) * inverse).put_to(shares);
        subtract_triangle(row_k, shares, a);
        Six(shares).put_to(row_k);
    }
    factor_row<5>(a), factor_row<4>(a), factor_row<3>(a), factor_row<2>(a), factor_row<1>(a),
        factor_row<0>(a);
}

inline void solve(const DofPaths& paths, const double* a, double* x) {
    Six base(x);
    for (std::size_t i = paths.size(); i-- > 6;) {
        base.subtract(Six(a + paths.row(i)), x[i]);
        path::subtract(a + paths.row(i), paths.path(i), 6, paths.length(i) - 1, x[i], x);
    }
    base.put_to(x);
    for (std::size_t i = 6; i-- > 0;) path::subtract(a + paths.row(i), paths.path(i), 0, i, x[i], x);
    const auto forward = [&](std::size_t i, std::size_t first, const Halves<double>& sum) {
        const double* row = a + paths.row(i);
        const std::size_t above = paths.length(i) - 1;
        x[i] = x[i] * row[above] - path::dot(row, paths.path(i), first, above, x, sum);
    };
    for (std::size_t i = 0; i < 6; ++i) forward(i, 0, {});
    const Six solved(x);
    for (std::size_t i = 6; i < paths.size(); ++i) forward(i, 6, dot(Six(a + paths.row(i)), solved));
}

}  // namespace roboss::free_base
