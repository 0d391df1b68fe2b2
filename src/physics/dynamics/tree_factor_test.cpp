// The factorisations on a tree against the dense product, symmetric and not.
#include "physics/dynamics/tree_factor.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

namespace roboss {
namespace {

/// A random tree of n unknowns, and a matrix on its pattern: lower(i, j) and upper(j, i), j on i's path to
/// the root.
struct Example {
    DofPaths paths;
    std::vector<double> lower, upper;

    /// The first `trunk` unknowns are a chain that begins every later path.
    Example(unsigned seed, std::size_t n, bool symmetric, std::size_t trunk = 0) {
        std::mt19937 random(seed);
        const auto number = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
        std::vector<int> parent;
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t first = i < trunk ? i : trunk;  // of the possible parents, counted from 1
            parent.push_back(static_cast<int>(first + random() % (i + 1 - first)) - 1);
        }
        paths = DofPaths(parent);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t at = paths.row(i); at <= paths.diagonal(i); ++at) {
                lower.push_back(at == paths.diagonal(i) ? 5.0 + number() : number());
                upper.push_back(symmetric ? lower.back() : number());
            }
        }
    }

    /// A x, where A's entries above the diagonal are those of `upper`.
    std::vector<double> times(const std::vector<double>& x) const {
        std::vector<double> y(x.size(), 0.0);
        for (std::size_t i = 0; i < x.size(); ++i) {
            y[i] += lower[paths.diagonal(i)] * x[i];
            for (std::size_t k = 0; k + 1 < paths.length(i); ++k) {
                const auto j = static_cast<std::size_t>(paths.path(i)[k]);
                y[i] += lower[paths.row(i) + k] * x[j];
                y[j] += upper[paths.row(i) + k] * x[i];
            }
        }
        return y;
    }
};

TEST(TreeFactor, SolvesAsTheProductSays) {
    for (unsigned seed = 0; seed < 100; ++seed) {
        const std::size_t n = 1 + seed % 25;
        const std::vector<double> wanted(n, 0.7);
        for (const bool symmetric : {true, false}) {
            const Example e(seed, n, symmetric);
            Example factor = e;
            std::vector<double> x = e.times(wanted), y(n);
            if (symmetric) {
                tree_times(e.paths, e.lower.data(), wanted.data(), y.data());
                for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(y[i], x[i], 1e-13);
                tree_factor(e.paths, factor.lower.data());
                tree_solve(e.paths, factor.lower.data(), x.data());
            } else {
                ASSERT_TRUE(tree_factor_general(e.paths, factor.lower.data(), factor.upper.data()));
                tree_solve_general(e.paths, factor.lower.data(), factor.upper.data(), x.data());
            }
            for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(x[i], wanted[i], 1e-11) << "seed " << seed;
        }
    }
}

/// A number of no special form: so the general functions serve, whatever the tree.
struct OneLane {
    template <class Bits>
    static unsigned bits(const Bits& m) {
        return (m[0] != 0 ? 1U : 0U) | (m[1] != 0 ? 2U : 0U);
    }
};
using General = Lanes<double, 2, OneLane>;

std::vector<General> general(const std::vector<double>& x) {
    return {x.begin(), x.end()};
}

void expect_same_bits(const std::vector<double>& x, const std::vector<General>& y) {
    for (std::size_t i = 0; i < x.size(); ++i)
        EXPECT_EQ(std::bit_cast<std::uint64_t>(x[i]), std::bit_cast<std::uint64_t>(y[i][0])) << i;
}

TEST(TreeFactor, AFreeBaseGivesTheBitsOfAnyTree) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        const std::size_t n = 6 + seed % 20;
        for (const bool symmetric : {true, false}) {
            const Example e(seed, n, symmetric, 6);
            ASSERT_TRUE(free_base::begins(e.paths));
            std::vector<double> lower = e.lower, upper = e.upper, x(n), y(n);
            for (std::size_t i = 0; i < n; ++i) x[i] = 0.1 + 1.0 / static_cast<double>(i + 3);
            std::vector<General> general_lower = general(lower), general_upper = general(upper),
                                 general_x = general(x), general_y = general(y);
            tree_times(e.paths, lower.data(), x.data(), y.data());
            tree_times(e.paths, general_lower.data(), general_x.data(), general_y.data());
            expect_same_bits(y, general_y);
            if (symmetric) {
                tree_factor(e.paths, lower.data());
                tree_factor(e.paths, general_lower.data());
                tree_solve(e.paths, lower.data(), x.data());
                tree_solve(e.paths, general_lower.data(), general_x.data());
            } else {
                ASSERT_TRUE(tree_factor_general(e.paths, lower.data(), upper.data()));
                ASSERT_TRUE(any(tree_factor_general(e.paths, general_lower.data(), general_upper.data())));
                tree_solve_general(e.paths, lower.data(), upper.data(), x.data());
                tree_solve_general(e.paths, general_lower.data(), general_upper.data(), general_x.data());
            }
            expect_same_bits(lower, general_lower), expect_same_bits(upper, general_upper);
            expect_same_bits(x, general_x);
        }
    }
}

TEST(TreeFactor, TheTrunkBeginsEveryLaterPath) {
    EXPECT_EQ(DofPaths(std::vector<int>{-1, 0, 1, 2, 3, 4, 5, 5, 7}).trunk(), 6U) << "a free base with legs";
    EXPECT_EQ(DofPaths(std::vector<int>{-1, 0, 1, 2, 3, 4, 5, 6}).trunk(), 8U) << "a chain";
    EXPECT_EQ(DofPaths(std::vector<int>{-1, 0, 1, 0}).trunk(), 1U);
    EXPECT_EQ(DofPaths(std::vector<int>{-1, 0, -1}).trunk(), 0U) << "two roots";
}

TEST(TreeFactor, ANegativePivotIsNoHarm) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const std::size_t n = 2 + seed % 12;
        Example e(seed, n, false);
        e.lower[e.paths.diagonal(n - 1)] = -5;
        const std::vector<double> wanted(n, 0.7);
        std::vector<double> x = e.times(wanted);
        ASSERT_TRUE(tree_factor_general(e.paths, e.lower.data(), e.upper.data()));
        tree_solve_general(e.paths, e.lower.data(), e.upper.data(), x.data());
        for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(x[i], wanted[i], 1e-12);
    }
}

TEST(TreeFactor, AZeroPivotIsRefusedAndWhatIsNoNumber) {
    for (const double pivot : {0.0, std::nan("")}) {
        Example e(3, 4, false);
        e.lower[e.paths.diagonal(3)] = pivot;
        EXPECT_FALSE(tree_factor_general(e.paths, e.lower.data(), e.upper.data()));
    }
}

}  // namespace
}  // namespace roboss
