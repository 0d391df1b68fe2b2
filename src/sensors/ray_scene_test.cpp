// The ray scene against a brute-force oracle that knows no tree, and its rules about who is seen.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/noise.h"
#include "sensors/ray_shape.h"
#include "sensors/readings.h"
#include "sensors/test_draws.h"
#include "sensors/test_model.h"

namespace roboss {
namespace {

using namespace sensors_test;

constexpr double kNone = std::numeric_limits<double>::infinity();

/// Random poses and shapes, too.
class SceneDraws : public Draws {
  public:
    using Draws::Draws;
    Pose pose(double half) { return {in_cube(half), exponential(direction() * between(0, 3))}; }
    Shape shape() {
        const auto kind = static_cast<ShapeKind>(1 + static_cast<int>(between(0, 4)));
        return {kind,
                {between(0.05, 2), between(0.05, 2), between(0.05, 2)},
                between(0.05, 1),
                between(0.05, 1.5)};
    }
};

double cast_one(RayScene& scene, const RayScene::Ray& ray) {
    double distance = 0;
    scene.cast({&ray, 1}, {&distance, 1});
    return distance;
}

/// The nearest of all shapes, each asked, body poses of the cart worked out by hand.
double oracle(const Model& model, const std::vector<RobotState>& states, const RayScene::Ray& ray) {
    double nearest = kNone;
    for (const StaticShape& fixed : model.statics)
        nearest = std::fmin(nearest, ray_distance(fixed.shape, fixed.X_WS, ray.origin_W, ray.direction_W));
    for (std::size_t i = 0; i < states.size(); ++i) {
        const Transform X_WB = to_transform(base_pose(states[i]));
        const Transform X_WWheel = X_WB * Transform{Mat3::identity(), {0.5, 0, 0}};
        const auto& shapes = model.types[0].shapes;
        nearest = std::fmin(nearest, ray_distance(shapes[0].shape, X_WB, ray.origin_W, ray.direction_W));
        nearest = std::fmin(nearest, ray_distance(shapes[1].shape, X_WWheel, ray.origin_W, ray.direction_W));
    }
    return nearest <= ray.max_range ? nearest : kNone;
}

/// Compares many rays with the oracle; returns how many hit anything.
int compare_with_oracle(std::uint64_t seed, const Vec3& far_away, double half) {
    SceneDraws draws(seed);
    auto model = model_of(cart_type(), 40);
    const auto place = [&] {
        Pose X = draws.pose(half);
        X.p += far_away;
        return X;
    };
    for (int i = 0; i < 60; ++i) add_static(*model, draws.shape(), to_transform(place()));
    std::vector<RobotState> states;
    for (int i = 0; i < 40; ++i) states.push_back(cart_at(place()));
    std::vector<const RobotState*> pointers;
    for (const RobotState& state : states) pointers.push_back(&state);
    RayScene scene(model);
    scene.update(pointers);
    int hits = 0;
    for (int i = 0; i < 3000; ++i) {
        const RayScene::Ray ray{
            far_away + draws.in_cube(1.5 * half), draws.direction(), draws.between(0.1, 4 * half), {}, {}};
        const double expected = oracle(*model, states, ray), got = cast_one(scene, ray);
        if (expected < kNone) hits += 1;
        if (expected == kNone) {
            EXPECT_EQ(got, kNone) << "seed " << seed << " ray " << i;
        } else {
            EXPECT_NEAR(got, expected, 1e-12 * (1 + norm(far_away))) << "seed " << seed << " ray " << i;
        }
    }
    return hits;
}

TEST(RayScene, AgreesWithAskingEveryShape) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) EXPECT_GT(compare_with_oracle(seed, {}, 6), 300);
}

TEST(RayScene, AgreesWithAskingEveryShapeInAWideThinWorld) {
    for (std::uint64_t seed = 11; seed <= 14; ++seed) EXPECT_GT(compare_with_oracle(seed, {}, 12), 20);
}

TEST(RayScene, AgreesWithAskingEveryShapeFarFromTheOrigin) {
    for (std::uint64_t seed = 21; seed <= 24; ++seed)
        EXPECT_GT(compare_with_oracle(seed, {4e5, -3e5, 100}, 6), 300);
}

TEST(RayScene, AxisParallelRaysAlongFacesAreFound) {
    auto model = model_of(cart_type(), 0);
    for (int i = 0; i < 50; ++i)
        add_static(*model, {ShapeKind::kBox, {0.5, 0.5, 0.5}, 0, 0}, {Mat3::identity(), {3.0 * i, 0, 0}});
    RayScene scene(model);
    scene.update({});
    for (int i = 0; i < 50; ++i) {
        EXPECT_EQ(cast_one(scene, {{3.0 * i, 0.5, 10}, {0, 0, -1}, 100, {}, {}}), 9.5);  // on the face's edge
        EXPECT_EQ(cast_one(scene, {{3.0 * i, 0, -10}, {0, 0, 1}, 100, {}, {}}), 9.5);
        EXPECT_EQ(cast_one(scene, {{3.0 * i + 1, 0, -10}, {0, 0, 1}, 100, {}, {}}), kNone);
    }
}

TEST(RayScene, AHitAtTheLastMillimetreOfTheRangeCounts) {
    auto model = model_of(cart_type(), 0);
    add_static(*model, {ShapeKind::kBox, {0.5, 0.5, 0.5}, 0, 0}, {Mat3::identity(), {10, 0, 0}});
    RayScene scene(model);
    scene.update({});
    EXPECT_EQ(cast_one(scene, {{0, 0, 0}, {1, 0, 0}, 9.5, {}, {}}), 9.5);
    EXPECT_EQ(cast_one(scene, {{0, 0, 0}, {1, 0, 0}, 9.499999, {}, {}}), kNone);
}

TEST(RayScene, PlanesReachEverywhere) {
    auto model = model_of(cart_type(), 0);
    add_static(*model, {ShapeKind::kPlane, {}, 0, 0}, {});
    RayScene scene(model);
    scene.update({});
    EXPECT_DOUBLE_EQ(cast_one(scene, {{1e6, -1e6, 3}, {0.8, 0, -0.6}, 100, {}, {}}), 5.0);
    EXPECT_EQ(cast_one(scene, {{1e6, -1e6, 3}, {0, 0, -1}, 2, {}, {}}), kNone);
}

TEST(RayScene, TheCarryingLinkIsNotSeenButTheRestOfTheRobotIs) {
    auto model = model_of(cart_type(), 2);
    const RobotState first = cart_at({}), second = cart_at({{0, 5, 0}, {}});
    const RobotState* states[] = {&first, &second};
    RayScene scene(model);
    scene.update(states);
    const RobotId self(std::size_t{0}), other(std::size_t{1});
    const LinkId cart(std::size_t{0}), wheel(std::size_t{2});
    const Vec3 ahead{1, 0, 0};
    EXPECT_DOUBLE_EQ(cast_one(scene, {{0, 0, 0}, ahead, 10, self, cart}), 0.4);   // own wheel
    EXPECT_DOUBLE_EQ(cast_one(scene, {{0, 0, 0}, ahead, 10, self, wheel}), 0.2);  // own cart, from inside
    EXPECT_DOUBLE_EQ(cast_one(scene, {{0, 0, 0}, ahead, 10, other, cart}),
                     0.2);  // the other's link of that number
    EXPECT_DOUBLE_EQ(cast_one(scene, {{0, 0, 0}, {0, 1, 0}, 10, self, cart}), 4.9);
}

TEST(RayScene, ShapesFollowTheirRobots) {
    auto model = model_of(cart_type(), 1);
    RobotState state = cart_at({{5, 0, 0}, {}});
    const RobotState* states[] = {&state};
    RayScene scene(model);
    for (int step = 0; step < 100; ++step) {
        set_base_pose(state, {{5.0 + step, 0, 0}, {}});
        scene.update(states);
        EXPECT_DOUBLE_EQ(cast_one(scene, {{0, 0, 0}, {1, 0, 0}, 1000, {}, {}}), 4.8 + step);
    }
}

}  // namespace
}  // namespace roboss
