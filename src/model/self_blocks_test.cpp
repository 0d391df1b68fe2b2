// Pairs of shapes by pairs of bodies: none is lost, none comes twice, and each is where its bodies say.
#include "model/self_blocks.h"

#include <gtest/gtest.h>

#include <support/random.h>

#include "model/model.h"

namespace roboss::test {
namespace {

TEST(SelfBlocks, HoldEachPairOnceByItsBodies) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        Random random(seed);
        std::vector<BodyShape> shapes(2 + seed);
        for (BodyShape& shape : shapes) shape.body = static_cast<int>(random.uniform(0, 6)) - 1;
        std::vector<std::pair<int, int>> pairs;
        for (int a = 0; a < static_cast<int>(shapes.size()); ++a)
            for (int b = a + 1; b < static_cast<int>(shapes.size()); ++b)
                if (random.uniform(0, 1) < 0.7) pairs.emplace_back(a, b);
        const SelfBlocks found(shapes, pairs);
        std::vector<int> seen(pairs.size(), 0);
        std::size_t next = 0;
        for (const SelfBlocks::Block& block : found.blocks) {
            ASSERT_EQ(block.first, next);
            ASSERT_GT(block.count, 0u);
            for (; next < block.first + block.count; ++next) {
                const std::uint32_t i = found.pairs[next];
                ++seen[i];
                EXPECT_EQ(shapes[static_cast<std::size_t>(pairs[i].first)].body, block.body_a);
                EXPECT_EQ(shapes[static_cast<std::size_t>(pairs[i].second)].body, block.body_b);
                EXPECT_TRUE(next == block.first || found.pairs[next - 1] < i);
            }
        }
        EXPECT_EQ(next, pairs.size());
        for (const int count : seen) EXPECT_EQ(count, 1) << "seed " << seed;
    }
}

}  // namespace
}  // namespace roboss::test
