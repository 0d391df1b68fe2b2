// Shapes by bodies: none is lost, none comes twice; bodies with many have a tree that holds them.
#include "model/shape_groups.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <support/random.h>

#include "model/model.h"

namespace roboss::test {
namespace {

/// Balls on up to six bodies and the base; any two of different bodies may touch, but some pairs of bodies.
RobotType random_type(std::uint64_t seed) {
    Random random(seed);
    RobotType type;
    type.bodies.resize(6);
    type.shapes.resize(2 + 3 * seed);
    for (BodyShape& shape : type.shapes) {
        shape.body = static_cast<int>(random.uniform(0, 3)) * 2 - 1;
        shape.shape.kind = ShapeKind::kSphere;
        shape.shape.radius = random.uniform(0.01, 0.1);
        shape.X_BS.p = random.vector(0.5);
    }
    for (int a = 0; a < static_cast<int>(type.shapes.size()); ++a)
        for (int b = a + 1; b < static_cast<int>(type.shapes.size()); ++b) {
            const int ba = type.shapes[static_cast<std::size_t>(a)].body,
                      bb = type.shapes[static_cast<std::size_t>(b)].body;
            if (ba != bb && ba + bb != 2) type.self_pairs.emplace_back(a, b);
        }
    return type;
}

TEST(ShapeGroups, HoldEachShapeOnceByItsBody) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const RobotType type = random_type(seed);
        const ShapeGroups groups(type);
        std::vector<int> seen(type.shapes.size(), 0), among(type.shapes.size(), 0);
        for (int body = -1; body < 6; ++body) {
            EXPECT_TRUE(std::ranges::is_sorted(groups.of(body)));
            for (const std::uint32_t s : groups.of(body)) {
                ++seen[s];
                EXPECT_EQ(type.shapes[s].body, body);
            }
            EXPECT_EQ(groups.crowd(body) >= 0, groups.of(body).size() >= ShapeGroups::kCrowd)
                << "seed " << seed;
        }
        for (const std::uint32_t s : groups.loose) ++among[s];
        for (const ShapeCrowd& crowd : groups.crowds)
            for (const std::uint32_t s : crowd.shapes) ++among[s];
        EXPECT_EQ(seen, std::vector<int>(type.shapes.size(), 1));
        EXPECT_EQ(among, std::vector<int>(type.shapes.size(), 1));
    }
}

TEST(ShapeGroups, HoldEachPairOfBodiesThatMayTouchOnce) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const RobotType type = random_type(seed);
        const ShapeGroups groups(type);
        std::size_t pairs = 0;
        for (const auto& [a, b] : groups.self_bodies) {
            EXPECT_LT(a, b);
            pairs += groups.of(a).size() * groups.of(b).size();
        }
        EXPECT_EQ(pairs, type.self_pairs.size()) << "seed " << seed;
    }
}

TEST(ShapeGroups, ABodyWithAPlaneIsNoCrowd) {
    RobotType type;
    type.bodies.resize(1);
    type.shapes.resize(ShapeGroups::kCrowd);
    for (BodyShape& shape : type.shapes)
        shape.body = 0, shape.shape.kind = ShapeKind::kSphere, shape.shape.radius = 1;
    EXPECT_EQ(ShapeGroups(type).crowds.size(), 1u);
    type.shapes[3].shape.kind = ShapeKind::kPlane;
    const ShapeGroups groups(type);
    EXPECT_TRUE(groups.crowds.empty());
    EXPECT_EQ(groups.loose.size(), type.shapes.size());
}

}  // namespace
}  // namespace roboss::test
