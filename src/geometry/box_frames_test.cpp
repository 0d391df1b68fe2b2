// Boxes of frames that are turned against each other: boxes that meet are never separated, and trees find all
// pairs.
#include "geometry/box_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include <support/random.h>

#include "geometry/bvh.h"

namespace roboss::test {
namespace {

Aabb random_box(Random& random, double size) {
    const Vec3 p = random.vector(1), q = random.vector(size);
    Aabb box;
    box.include(p), box.include(p + q);
    return box;
}

Transform random_pose(Random& random) {
    const Vec3 p = random.vector(1);
    return to_transform({p, random.rotation()});
}

Vec3 random_point(Random& random, const Aabb& box) {
    return {random.uniform(box.min.x, box.max.x), random.uniform(box.min.y, box.max.y),
            random.uniform(box.min.z, box.max.z)};
}

TEST(BoxFrames, BoxesWithPointsNearerThanTheMarginMeet) {
    int apart = 0;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        Random random(seed);
        const Transform X_WA = random_pose(random);
        Transform X_WB = random_pose(random);
        const Aabb a = random_box(random, 0.5), b = random_box(random, 0.5);
        const double margin = random.uniform(0, 0.3);
        apart += BoxFrames(X_WA, X_WB, margin).meet(a, b) ? 0 : 1;
        // Moved so that two of their points are as far apart as the margin.
        const Vec3 away = rotate(random.rotation(), {margin, 0, 0});
        X_WB.p += X_WA * random_point(random, a) + away - X_WB * random_point(random, b);
        EXPECT_TRUE(BoxFrames(X_WA, X_WB, margin).meet(a, b)) << "seed " << seed;
    }
    EXPECT_GT(apart, 1000);
}

TEST(BoxFrames, ATurnedBoxHoldsItsPoints) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        Random random(seed);
        const Transform X = random_pose(random);
        const Aabb box = random_box(random, 0.5), turned = turned_box(X, box).inflated(1e-12);
        for (int i = 0; i < 20; ++i) {
            Aabb both = turned;
            both.include(X * random_point(random, box));
            EXPECT_EQ(both, turned) << "seed " << seed;
        }
    }
}

TEST(BoxFrames, TreesFindThePairsThatAllAgainstAllFinds) {
    for (const std::size_t count : {1u, 3u, 5u, 40u, 200u}) {
        Random random(count);
        std::vector<Aabb> a, b;
        for (std::size_t i = 0; i < count; ++i) a.push_back(random_box(random, 0.1));
        for (std::size_t i = 0; i < 2 * count; ++i) b.push_back(random_box(random, 0.3));
        const BoxFrames frames(random_pose(random), random_pose(random), 0.05);
        std::vector<std::pair<std::uint32_t, std::uint32_t>> found, expected;
        Bvh::visit_pairs(
            Bvh(a), Bvh(b), [&](const Aabb& x, const Aabb& y) { return frames.meet(x, y); },
            [&](std::uint32_t i, std::uint32_t j) { found.emplace_back(i, j); });
        for (std::uint32_t i = 0; i < a.size(); ++i)
            for (std::uint32_t j = 0; j < b.size(); ++j)
                if (frames.meet(a[i], b[j])) expected.emplace_back(i, j);
        std::ranges::sort(found);
        EXPECT_EQ(found, expected);
    }
}

}  // namespace
}  // namespace roboss::test
