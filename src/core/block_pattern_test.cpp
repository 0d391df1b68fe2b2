#include "core/block_pattern.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace roboss {
namespace {

std::vector<std::pair<int, int>> random_links(std::size_t nodes, std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<std::pair<int, int>> links;
    for (std::size_t k = 0; k < count; ++k)
        links.emplace_back(static_cast<int>(random() % nodes), static_cast<int>(random() % nodes));
    return links;
}

/// Fronts hold all that the elimination of their nodes, one by one, couples; children come first.
TEST(BlockPattern, FrontsHoldTheFill) {
    BlockPattern pattern;
    for (unsigned seed = 0; seed < 40; ++seed) {
        const std::size_t count = 3 + seed;
        const auto links = random_links(count, 2 * count, seed);
        pattern.analyse(count, links);
        ASSERT_EQ(pattern.size(), count);
        std::vector<std::set<std::size_t>> near(count);
        for (const auto& [a, b] : links) {
            const std::size_t p = pattern.position(static_cast<std::size_t>(a)),
                              q = pattern.position(static_cast<std::size_t>(b));
            if (p != q) near[p].insert(q), near[q].insert(p);
        }
        for (std::size_t k = 0; k < count; ++k) {
            EXPECT_EQ(pattern.position(pattern.node(k)), k);
            const BlockPattern::Front& front = pattern.fronts()[pattern.front_of(k)];
            const auto ends = pattern.ends_of(front);
            std::set<std::size_t> held(ends.begin(), ends.end());
            for (std::size_t own = k + 1; own < front.last; ++own) held.insert(own);
            for (const std::size_t u : near[k]) {
                if (u < k) continue;
                EXPECT_TRUE(held.contains(u)) << seed << ": " << k << " and " << u;
                for (const std::size_t w : near[k])
                    if (w > k && w != u) near[u].insert(w);
            }
        }
        for (std::size_t f = 0; f < pattern.fronts().size(); ++f)
            for (const std::size_t child : pattern.children_of(pattern.fronts()[f])) {
                EXPECT_LT(child, f);
                EXPECT_EQ(pattern.fronts()[child].parent, static_cast<int>(f));
            }
    }
}

/// A clique is one front, and so is the separator of a grid.
TEST(BlockPattern, JoinsNodesWithTheSameEnds) {
    std::vector<std::pair<int, int>> links;
    for (int a = 0; a < 9; ++a)
        for (int b = 0; b < a; ++b) links.emplace_back(a, b);
    BlockPattern pattern;
    pattern.analyse(9, links);
    EXPECT_EQ(pattern.fronts().size(), 1U);
    const std::uint64_t stamp = pattern.stamp();
    pattern.analyse(9, links);
    EXPECT_NE(pattern.stamp(), stamp);
}

}  // namespace
}  // namespace roboss
