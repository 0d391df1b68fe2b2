// The tree against testing every box.
#include "geometry/bvh.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace roboss {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<std::uint32_t> brute_force(std::span<const Aabb> boxes, const Aabb& box) {
    std::vector<std::uint32_t> out;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        if (overlaps(boxes[i], box)) out.push_back(i);
    }
    return out;
}

struct RandomBoxes {
    std::mt19937_64 engine{7};

    double in(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine() >> 11) * 0x1p-53);
    }
    Aabb box(double world, double size) {
        const Vec3 p{in(-world, world), in(-world, world), in(-0.1 * world, 0.1 * world)};
        return {p, p + Vec3{in(0, size), in(0, size), in(0, size)}};
    }
};

TEST(Bvh, EmptyTreeFindsNothing) {
    std::vector<std::uint32_t> out{1, 2, 3};
    Bvh().query({{-1, -1, -1}, {1, 1, 1}}, out);
    EXPECT_TRUE(out.empty());
    Bvh(std::span<const Aabb>{}).query({{-1, -1, -1}, {1, 1, 1}}, out);
    EXPECT_TRUE(out.empty());
}

TEST(Bvh, OneItemIsFoundExactlyWhenItTouches) {
    const std::vector<Aabb> boxes{{{0, 0, 0}, {1, 1, 1}}};
    const Bvh bvh(boxes);
    std::vector<std::uint32_t> out;
    bvh.query({{1, 1, 1}, {2, 2, 2}}, out);
    EXPECT_EQ(out, std::vector<std::uint32_t>{0});
    bvh.query({{1.0000001, 0, 0}, {2, 2, 2}}, out);
    EXPECT_TRUE(out.empty());
}

TEST(Bvh, AgreesWithBruteForceIncludingInfiniteAndEmptyBoxes) {
    RandomBoxes random;
    for (std::size_t count : {2u, 3u, 5u, 17u, 300u}) {
        std::vector<Aabb> boxes;
        for (std::size_t i = 0; i < count; ++i) boxes.push_back(random.box(20, 4));
        boxes[count / 2] = {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
        boxes[count - 1] = {{-kInfinity, -kInfinity, 3}, {kInfinity, kInfinity, 4}};
        boxes.emplace_back();
        const Bvh bvh(boxes);
        std::vector<std::uint32_t> out;
        for (int i = 0; i < 300; ++i) {
            const Aabb query = random.box(25, 8);
            bvh.query(query, out);
            ASSERT_EQ(out, brute_force(boxes, query));
        }
        bvh.query({{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}}, out);
        EXPECT_EQ(out.size(), boxes.size() - 1);
    }
}

TEST(Bvh, AHundredThousandItemsAgreeWithBruteForce) {
    RandomBoxes random;
    std::vector<Aabb> boxes;
    for (int i = 0; i < 100000; ++i) boxes.push_back(random.box(1000, 5));
    const Bvh bvh(boxes);
    std::vector<std::uint32_t> out;
    for (int i = 0; i < 50; ++i) {
        const Aabb query = random.box(1000, 60);
        bvh.query(query, out);
        ASSERT_EQ(out, brute_force(boxes, query));
    }
}

TEST(Bvh, CoincidentBoxesAreAllFound) {
    const std::vector<Aabb> boxes(1000, Aabb{{0, 0, 0}, {1, 1, 1}});
    const Bvh bvh(boxes);
    std::vector<std::uint32_t> out;
    bvh.query({{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}}, out);
    EXPECT_EQ(out.size(), 1000u);
}

}  // namespace
}  // namespace roboss
