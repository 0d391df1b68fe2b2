// Boxes: they grow by what they include, touching counts as overlapping, and nothing is in the empty one.
#include "math/aabb.h"

#include <gtest/gtest.h>

namespace roboss {
namespace {

Aabb box(const Vec3& min, const Vec3& max) {
    Aabb b;
    b.include(min);
    b.include(max);
    return b;
}

TEST(Aabb, StartsEmptyAndOverlapsNothing) {
    const Aabb nothing;
    EXPECT_TRUE(nothing.empty());
    EXPECT_FALSE(overlaps(nothing, box({-1, -1, -1}, {1, 1, 1})));
    EXPECT_FALSE(overlaps(nothing, nothing));
}

TEST(Aabb, GrowsByPointsAndBoxesOnly) {
    Aabb b = box({0, 0, 0}, {1, 1, 1});
    b.include(Vec3{0.5, -2, 0.5});
    b.include(box({0, 0, 3}, {0.1, 0.1, 4}));
    b.include(Aabb{});
    EXPECT_EQ(b.min, (Vec3{0, -2, 0}));
    EXPECT_EQ(b.max, (Vec3{1, 1, 4}));
    EXPECT_EQ(b.centre(), (Vec3{0.5, -0.5, 2}));
}

TEST(Aabb, TouchingCountsAsOverlapping) {
    const Aabb a = box({0, 0, 0}, {1, 1, 1});
    EXPECT_TRUE(overlaps(a, box({1, 0, 0}, {2, 1, 1})));
    EXPECT_TRUE(overlaps(a, box({1, 1, 1}, {2, 2, 2})));
}

TEST(Aabb, ApartOnOneAxisIsApart) {
    const Aabb a = box({0, 0, 0}, {1, 1, 1});
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const double way : {-1.5, 1.5}) {
            Vec3 shift;
            shift[axis] = way;
            EXPECT_FALSE(overlaps(a, box(a.min + shift, a.max + shift)));
            EXPECT_FALSE(overlaps(box(a.min + shift, a.max + shift), a));
        }
    }
}

TEST(Aabb, InflatesByTheMarginOnEverySide) {
    const Aabb b = box({0, 0, 0}, {1, 1, 1}).inflated(0.25);
    EXPECT_EQ(b.min, (Vec3{-0.25, -0.25, -0.25}));
    EXPECT_EQ(b.max, (Vec3{1.25, 1.25, 1.25}));
}

}  // namespace
}  // namespace roboss
