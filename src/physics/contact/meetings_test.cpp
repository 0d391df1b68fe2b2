// The sieve against every pair, for boxes of all sizes and places.
#include "physics/contact/meetings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

namespace roboss {
namespace {

TEST(Meetings, AreThoseOfEveryPair) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        std::mt19937 random(seed);
        const auto number = [&] { return static_cast<double>(random()) / 4294967296.0; };
        const std::size_t count = 1 + seed % 80;
        const double room = 0.5 + number() * 30, huge = seed % 7 == 0 ? 1e300 : 2;
        std::vector<Aabb> boxes;
        for (std::size_t i = 0; i < count; ++i) {
            const double half = i == 3 ? huge : 0.01 + number();
            Aabb box;
            box.include(Vec3{room * (number() - 0.5), room * (number() - 0.5), 0.1 * number()});
            boxes.push_back(box.inflated(half));
        }
        UnionFind expected, found, few;
        expected.reset(count), found.reset(count), few.reset(count);
        std::vector<std::uint32_t> all;
        for (std::uint32_t i = 0; i < count; ++i) all.push_back(i);
        for (std::uint32_t i = 0; i < count; ++i)
            for (std::uint32_t j = 0; j < i; ++j)
                if (overlaps(boxes[i], boxes[j])) expected.unite(i, j);
        Meetings meetings;
        meetings.join(boxes, all, found);
        meetings.join(boxes, std::span(all).first(1), few);
        for (std::uint32_t i = 0; i < count; ++i) {
            EXPECT_EQ(found.find(i), expected.find(i)) << "seed " << seed;
            EXPECT_EQ(few.find(i) == few.find(0), expected.find(i) == expected.find(0)) << "seed " << seed;
        }
    }
}

TEST(BoxStrips, GiveEveryPairOnce) {
    constexpr double kInfinity = Aabb::kInfinity;
    for (unsigned seed = 0; seed < 100; ++seed) {
        std::mt19937 random(seed);
        const auto number = [&] { return static_cast<double>(random()) / 4294967296.0; };
        std::vector<Aabb> boxes;
        for (unsigned i = 0; i < 2 + seed % 60; ++i) {
            Aabb box;
            box.include(Vec3{20 * number() - 10, 20 * number() - 10, number()});
            boxes.push_back(box.inflated(0.1 + number()));
        }
        if (seed % 3 == 1)
            boxes[0] = {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
        if (seed % 3 == 2) boxes[1].max.y = kInfinity;
        std::vector<std::pair<std::uint32_t, std::uint32_t>> expected, found;
        for (std::uint32_t i = 0; i < boxes.size(); ++i)
            for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
                if (overlaps(boxes[i], boxes[j])) expected.emplace_back(i, j);
        BoxStrips strips;
        strips.for_each_overlap(
            boxes, [&](std::uint32_t i, std::uint32_t j) { found.push_back(std::minmax(i, j)); });
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, expected) << "seed " << seed;
    }
}

}  // namespace
}  // namespace roboss
