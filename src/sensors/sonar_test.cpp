// The sonar against distances that are easy to compute.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sensors/test_model.h"

namespace roboss {
namespace {

using namespace sensors_test;

constexpr double kNothing = std::numeric_limits<double>::infinity();

/// Turns the sensor's -z to the robot's x.
const Quat kAlongX{std::sqrt(0.5), 0, -std::sqrt(0.5), 0};

/// A cart at the origin with a sonar on its mast (1 m above it) that looks along x, and another cart, a box
/// of 0.4 x 0.2 x 0.1 m.
double heard(const SonarSpec& spec, const Pose& other, const Quat& turn = kAlongX) {
    RobotType type = cart_type();
    add_sensor(type, 1, sensor("sonar", spec, {{}, turn}));
    const auto model = model_of(type, 2);
    const RobotState own = cart_at({}), state = cart_at(other);
    return read_as<SonarReading>(model, {&own, &state}, 0).range;
}

SonarSpec cone(double radius) {
    SonarSpec spec;
    spec.range_min = 0.1, spec.range_max = 5, spec.radius = radius;
    return spec;
}

TEST(Sonar, HearsTheNearestSurfaceInItsCone) {
    EXPECT_NEAR(heard(cone(1), {{2, 0, 1}, {}}), 1.8, 1e-9) << "the face ahead, head on";
    EXPECT_EQ(heard(cone(1), {{-2, 0, 1}, {}}), kNothing) << "behind";
    // A corner aside: its edge is at x = 1.8, y = 0.2; the cone is 0.36 m wide there.
    EXPECT_NEAR(heard(cone(1), {{2, 0.3, 1}, {}}), std::hypot(1.8, 0.2), 1e-2);
    EXPECT_EQ(heard(cone(0.4), {{2, 0.3, 1}, {}}), kNothing) << "beside a narrow cone";
    EXPECT_EQ(heard(cone(1), {{6, 0, 1}, {}}), kNothing) << "too far";
    EXPECT_EQ(heard(cone(1), {{0.25, 0, 1}, {}}), -kNothing) << "nearer than the least range";
}

TEST(Sonar, LooksDownItsZAxis) {
    // The own cart is below the mast; its wheel, half a metre ahead, is 0.9 m below the sensor.
    EXPECT_NEAR(heard(cone(5), {{0, 9, 0}, {}}, {}), 0.95, 1e-9) << "the own cart's top";
    EXPECT_EQ(heard(cone(1), {{0, 0, 0.4}, {}}, {0, 1, 0, 0}), kNothing) << "turned over: nothing above";
}

TEST(Sonar, ASlopeIsNearestWhereItMeetsTheCone) {
    // A plate tilted by 45 degrees, whose near face is at distance d: a cone of half angle a hears
    // d / cos(45 degrees - a).
    constexpr double kThick = 0.05, kAhead = 2, kHalfAngle = 0.3;
    RobotType type = cart_type();
    type.shapes[0].shape.half = {kThick, 1, 1};
    add_sensor(type, 1, sensor("sonar", cone(5 * std::tan(kHalfAngle)), {{0, 0, 5}, kAlongX}));
    const RobotState own = cart_at({}),
                     plate = cart_at({{kAhead, 0, 6}, {std::cos(kPi / 8), 0, std::sin(kPi / 8), 0}});
    const double range = read_as<SonarReading>(model_of(type, 2), {&own, &plate}, 0).range;
    const double expected = (kAhead * std::sqrt(0.5) - kThick) / std::cos(0.25 * kPi - kHalfAngle);
    EXPECT_NEAR(range, expected, 5e-3 * expected);
}

TEST(Sonar, ASphereHearsAllAround) {
    SonarSpec spec = cone(0);
    spec.geometry = "sphere";
    EXPECT_NEAR(heard(spec, {{0, -0.6, 1}, {}}), 0.5, 1e-3);
    EXPECT_NEAR(heard(spec, {{0, 9, 1}, {}}), 0.95, 1e-3) << "the own cart below";
}

TEST(Sonar, OfParametersThatMeasureNothingSaysWhy) {
    std::vector<SensorProblem> problems;
    SonarSpec spec;
    spec.geometry = "cube", spec.range_max = 0, spec.radius = -1;
    spec.check(problems);
    EXPECT_EQ(problems.size(), 3U);
}

}  // namespace
}  // namespace roboss
