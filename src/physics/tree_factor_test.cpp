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
    DofPaths paths;
    std::vector<double> lower, upper;

    Example(unsigned seed, std::size_t n, bool symmetric) {
        std::mt19937 random(seed);
        const auto number = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
        std::vector<int> parent;
        for (std::size_t i = 0; i < n; ++i)
            parent.push_back(i == 0 ? -1 : static_cast<int>(random() % (i + 1)) - 1);
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

TEST(TreeFactor, AMatrixWithoutPositivePivotsIsRefused) {
    Example e(3, 4, false);
    e.lower[0] = -1;
    EXPECT_FALSE(tree_factor_general(e.paths, e.lower.data(), e.upper.data()));
}

}  // namespace
}  // namespace roboss
