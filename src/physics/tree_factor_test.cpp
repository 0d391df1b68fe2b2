// The factorisations on a tree against the dense product, symmetric and not.
#include "physics/tree_factor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace roboss {
namespace {

/// A random tree of n unknowns, and a matrix on its pattern: lower(i, j) and upper(j, i), j on i's path to
/// the root.
struct Example {
    std::vector<int> parent;
    std::vector<double> lower, upper;

    Example(unsigned seed, std::size_t n, bool symmetric) : lower(n * n), upper(n * n) {
        std::mt19937 random(seed);
        const auto number = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
        for (std::size_t i = 0; i < n; ++i) {
            parent.push_back(i == 0 ? -1 : static_cast<int>(random() % (i + 1)) - 1);
            for (int j = static_cast<int>(i); j >= 0; j = parent[static_cast<std::size_t>(j)]) {
                const std::size_t at = i * n + static_cast<std::size_t>(j);
                lower[at] = j == static_cast<int>(i) ? 5.0 + number() : number();
                upper[at] = symmetric ? lower[at] : number();
            }
        }
    }

    /// A x, where A's entries above the diagonal are those of `upper`.
    std::vector<double> times(const std::vector<double>& x) const {
        const std::size_t n = x.size();
        std::vector<double> y(n, 0.0);
        for (std::size_t i = 0; i < n; ++i) {
            y[i] += lower[i * n + i] * x[i];
            for (int j = parent[i]; j >= 0; j = parent[static_cast<std::size_t>(j)]) {
                const auto k = static_cast<std::size_t>(j);
                y[i] += lower[i * n + k] * x[k];
                y[k] += upper[i * n + k] * x[i];
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
                tree_times(e.parent, e.lower, wanted.data(), y.data());
                for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(y[i], x[i], 1e-13);
                tree_factor(e.parent, factor.lower);
                tree_solve(e.parent, factor.lower, x.data());
            } else {
                ASSERT_TRUE(tree_factor_general(e.parent, factor.lower, factor.upper));
                tree_solve_general(e.parent, factor.lower, factor.upper, x.data());
            }
            for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(x[i], wanted[i], 1e-11) << "seed " << seed;
        }
    }
}

TEST(TreeFactor, AMatrixWithoutPositivePivotsIsRefused) {
    Example e(3, 4, false);
    e.lower[0] = -1;
    EXPECT_FALSE(tree_factor_general(e.parent, e.lower, e.upper));
}

}  // namespace
}  // namespace roboss
