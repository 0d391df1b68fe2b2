#include "core/minimum_degree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace roboss {
namespace {

/// A path: its ends go first, and nothing is coupled that was not.
TEST(MinimumDegree, APathHasNoFill) {
    MinimumDegree graph;
    graph.begin(6);
    for (int i = 0; i + 1 < 6; ++i) graph.join(i, i + 1), graph.join(i + 1, i);
    graph.eliminate();
    EXPECT_EQ(graph.order().front(), 0);
    EXPECT_EQ(graph.ends().size(), 5U);
}

/// Five nodes that are all coupled: 6 + 3 + 1 pairs.
TEST(MinimumDegree, GivesUpWhereTheFactorFillsUp) {
    MinimumDegree graph;
    for (const std::size_t most : {9U, 10U}) {
        graph.begin(5);
        for (int i = 0; i < 5; ++i)
            for (int k = 0; k < i; ++k) graph.join(i, k);
        EXPECT_EQ(graph.eliminate(most), most == 10);
    }
}

/// Against elimination on sets, node by node.
TEST(MinimumDegree, FillIsThatOfTheElimination) {
    std::mt19937 random(7);
    MinimumDegree graph;
    for (int round = 0; round < 20; ++round) {
        const int count = 5 + round;
        graph.begin(static_cast<std::size_t>(count));
        std::vector<std::set<int>> near(static_cast<std::size_t>(count));
        for (int e = 0; e < 2 * count; ++e) {
            const int a = static_cast<int>(random() % static_cast<unsigned>(count));
            const int b = static_cast<int>(random() % static_cast<unsigned>(count));
            if (a == b) continue;
            graph.join(a, b);
            near[static_cast<std::size_t>(a)].insert(b), near[static_cast<std::size_t>(b)].insert(a);
        }
        graph.eliminate();
        for (std::size_t k = 0; k < near.size(); ++k) {
            const int node = graph.order()[k];
            std::set<int>& ends = near[static_cast<std::size_t>(node)];
            const auto [first, last] = graph.ends_of(k);
            EXPECT_TRUE(std::equal(ends.begin(), ends.end(),
                                   graph.ends().begin() + static_cast<std::ptrdiff_t>(first),
                                   graph.ends().begin() + static_cast<std::ptrdiff_t>(last)));
            for (std::size_t i = k + 1; i < near.size(); ++i)
                EXPECT_LE(ends.size(), near[static_cast<std::size_t>(graph.order()[i])].size());
            for (const int a : ends) {
                near[static_cast<std::size_t>(a)].insert(ends.begin(), ends.end());
                near[static_cast<std::size_t>(a)].erase(a), near[static_cast<std::size_t>(a)].erase(node);
            }
        }
    }
}

}  // namespace
}  // namespace roboss
