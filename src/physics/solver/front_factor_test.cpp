// The sparse factor against a dense one: random graphs of groups, chains, stars, lone groups, empty groups.
#include "physics/solver/front_factor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace roboss {
namespace {

/// A random positive definite matrix of groups and cliques, dense and in fronts at the same time.
struct Example {
    std::vector<int> first{0}, heads, unknowns;
    std::vector<FrontFactor::Clique> cliques;
    std::vector<double> dense;
    FrontFactor fronts;
    std::size_t n = 0;

    double& at(int i, int j) { return dense[static_cast<std::size_t>(i) * n + static_cast<std::size_t>(j)]; }

    void add_clique(std::mt19937& random, int a, int b) {
        FrontFactor::Clique c{unknowns.size(), 0};
        for (int g : {a, b}) {
            if (g < 0) continue;
            for (int i = first[static_cast<std::size_t>(g) + 1]; i-- > first[static_cast<std::size_t>(g)];)
                if (random() % 3 != 0) unknowns.push_back(i);
        }
        c.last = unknowns.size();
        cliques.push_back(c);
    }

    void fill(std::mt19937& random, bool symmetric) {
        n = static_cast<std::size_t>(first.back());
        dense.assign(n * n, 0.0);
        for (std::size_t g = heads.size(); g + 1 < first.size(); ++g)
            heads.push_back(random() % 2 == 0 ? 0 : (first[g + 1] - first[g]) / 2);
        fronts.analyse(first, heads, unknowns, cliques);
        fronts.clear();
        const auto number = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
        for (std::size_t g = 0; g + 1 < first.size(); ++g)
            for (int i = first[g]; i < first[g + 1]; ++i) at(i, i) += 1, fronts.add(g, i, 1);
        for (std::size_t c = 0; c < cliques.size(); ++c) {
            if (cliques[c].first == cliques[c].last) continue;
            const FrontFactor::Place place = fronts.place(c);
            std::vector<double> j(cliques[c].last - cliques[c].first);
            for (double& x : j) x = number();
            for (std::size_t a = 0; a < j.size(); ++a) {
                for (std::size_t b = 0; b < j.size(); ++b) {
                    const double value = 9 * j[a] * j[b];
                    at(unknowns[cliques[c].first + a], unknowns[cliques[c].first + b]) += value;
                    if (place.local[b] >= place.local[a]) entry(place, a, b) += value;
                }
            }
        }
        fronts.begin_factor(symmetric);
        if (!symmetric) add_skew(random);
    }

    static double& entry(const FrontFactor::Place& place, std::size_t a, std::size_t b) {
        return place.matrix[static_cast<std::size_t>(place.local[a]) * place.stride +
                            static_cast<std::size_t>(place.local[b])];
    }

    void add_skew(std::mt19937& random) {
        for (std::size_t c = 0; c < cliques.size(); ++c) {
            if (cliques[c].first == cliques[c].last) continue;
            const FrontFactor::Place place = fronts.unsymmetric_place(c);
            const std::size_t count = cliques[c].last - cliques[c].first;
            for (std::size_t a = 0; a < count; ++a) {
                for (std::size_t b = 0; b < count; ++b) {
                    if (a == b) continue;
                    const double value = 0.3 * (static_cast<double>(random()) / 4294967296.0 - 0.5);
                    at(unknowns[cliques[c].first + a], unknowns[cliques[c].first + b]) += value;
                    entry(place, a, b) += value;
                }
            }
        }
    }

    /// Largest error of A x = b, x from the fronts.
    double error(std::mt19937& random) {
        std::vector<double> b(n), x;
        for (double& v : b) v = static_cast<double>(random()) / 4294967296.0;
        x = b;
        EXPECT_TRUE(fronts.solve(x));
        double worst = 0;
        for (std::size_t i = 0; i < n; ++i) {
            double sum = -b[i];
            for (std::size_t j = 0; j < n; ++j) sum += dense[i * n + j] * x[j];
            worst = std::max(worst, std::fabs(sum));
        }
        return worst;
    }
};

void expect_right_on_random_graphs(bool symmetric) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        std::mt19937 random(seed);
        Example e;
        const int groups = 1 + static_cast<int>(random() % 12);
        for (int g = 0; g < groups; ++g) e.first.push_back(e.first.back() + static_cast<int>(random() % 9));
        const int cliques = static_cast<int>(random() % 30);
        for (int c = 0; c < cliques; ++c) {
            const int a = static_cast<int>(random() % static_cast<unsigned>(groups));
            const int b = static_cast<int>(random() % static_cast<unsigned>(groups));
            e.add_clique(random, a, a == b ? -1 : b);
        }
        e.fill(random, symmetric);
        EXPECT_LE(e.error(random), 1e-9) << "seed " << seed;
    }
}

TEST(FrontFactor, SolvesRandomGraphsAsTheDenseMatrixSays) {
    expect_right_on_random_graphs(true);
}

TEST(FrontFactor, SolvesUnsymmetricGraphsAsTheDenseMatrixSays) {
    expect_right_on_random_graphs(false);
}

/// The example with random numbers, by these fronts.
std::vector<double> solve_with(FrontFactor& fronts, Example e, std::mt19937& random) {
    std::swap(e.fronts, fronts);
    e.fill(random, true);
    std::vector<double> x(e.n, 1.0);
    EXPECT_TRUE(e.fronts.solve(x));
    std::swap(e.fronts, fronts);
    return x;
}

TEST(FrontFactor, AReusedFactorGivesTheBitsOfAFreshOne) {
    const auto solve = [](FrontFactor& fronts, unsigned seed) {
        std::mt19937 random(seed);
        Example e;
        for (int g = 0; g < 5; ++g) e.first.push_back(e.first.back() + 6);
        for (int g = 0; g < 4; ++g) e.add_clique(random, g, g + 1);
        return solve_with(fronts, e, random);
    };
    FrontFactor reused;
    solve(reused, 1), solve(reused, 2);
    FrontFactor fresh;
    EXPECT_EQ(solve(reused, 3), solve(fresh, 3));
}

TEST(FrontFactor, AKnownPatternWithOtherNumbersGivesTheBitsOfAFreshOne) {
    Example e;
    e.heads = {6, 0, 6};
    for (int g = 0; g < 3; ++g) e.first.push_back(e.first.back() + 8);
    std::mt19937 pattern(1);
    for (int g = 0; g < 2; ++g) e.add_clique(pattern, g, g + 1);
    const auto solve = [&](FrontFactor& fronts, unsigned numbers) {
        std::mt19937 random(numbers);
        return solve_with(fronts, e, random);
    };
    FrontFactor known, fresh;
    solve(known, 1);
    EXPECT_TRUE(known.knows(e.first, e.heads, e.unknowns, e.cliques));
    EXPECT_EQ(solve(known, 2), solve(fresh, 2));
    const std::vector<int> other_heads{0, 0, 6};
    EXPECT_FALSE(known.knows(e.first, other_heads, e.unknowns, e.cliques));
}

}  // namespace
}  // namespace roboss
