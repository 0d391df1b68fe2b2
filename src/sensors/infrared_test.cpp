// The infrared sensor before a wall, and the response of Khepera's.
#include <gtest/gtest.h>

#include <cmath>

#include "sensors/infinity.h"
#include "sensors/test_model.h"

namespace roboss {
namespace {

using namespace sensors_test;

/// A wall whose face is `distance` ahead of the cart's mast, where the sensor is.
InfraredReading before_a_wall(const InfraredSpec& spec, double distance, double yaw = 0, Tick tick = 0) {
    RobotType type = cart_type();
    add_sensor(type, 1, sensor("ir", spec, {{}, from_rpy(0, 0, yaw)}));
    const auto model = model_of(type, 1);
    add_static(*model, {ShapeKind::kBox, {1, 5, 5}, 0, 0}, {Mat3::identity(), {1 + distance, 0, 1}});
    const RobotState state = cart_at({});
    return read_as<InfraredReading>(model, {&state}, 0, tick);
}

TEST(Infrared, SeesTheNearestSurfaceInItsConeAlongX) {
    InfraredSpec spec;
    spec.range_max = 0.5, spec.opening_angle = 0.4;
    EXPECT_NEAR(before_a_wall(spec, 0.3).range, 0.3, 1e-12);
    EXPECT_EQ(before_a_wall(spec, 0.3).value, before_a_wall(spec, 0.3).range);
    // turned by 0.5 rad: the rim of the cone, 0.3 rad off the wall's normal, is nearest
    EXPECT_NEAR(before_a_wall(spec, 0.3, 0.5).range, 0.3 / std::cos(0.3), 1e-3);  // rays are 2 degrees apart
    EXPECT_EQ(before_a_wall(spec, 0.6).range, kInfinity);
    EXPECT_EQ(before_a_wall(spec, 0.6).value, kInfinity);
    spec.opening_angle = 0;
    EXPECT_NEAR(before_a_wall(spec, 0.3, 0.5).range, 0.3 / std::cos(0.5), 1e-12) << "a single ray";
}

TEST(Infrared, KheperasCurveFallsFromTenBitsToNothing) {
    InfraredSpec spec;
    spec.response = "khepera", spec.range_max = 0.1, spec.opening_angle = 0;
    EXPECT_EQ(before_a_wall(spec, 0.005).value, 1023) << "saturated";
    for (const double d : {0.02, 0.035, 0.06})
        EXPECT_EQ(before_a_wall(spec, d).value, std::floor(1100 * std::exp(-(d - 0.01) / 0.025) + 0.5)) << d;
    EXPECT_EQ(before_a_wall(spec, 0.2).value, 0);
    spec.noise.stddev = 30;
    double sum = 0;
    bool varies = false;
    for (Tick tick = 0; tick < 2000; ++tick) {
        const double value = before_a_wall(spec, 0.035, 0, tick).value;
        varies |= value != before_a_wall(spec, 0.035, 0, 0).value;
        EXPECT_EQ(value, std::floor(value));
        sum += value / 2000;
    }
    EXPECT_TRUE(varies);
    EXPECT_NEAR(sum, 1100 * std::exp(-1.0), 4 * 30 / std::sqrt(2000.0));
}

TEST(Infrared, OfParametersThatMeasureNothingSaysWhy) {
    InfraredSpec spec;
    std::vector<SensorProblem> problems;
    spec.check(problems);
    EXPECT_TRUE(problems.empty());
    spec.range_max = 0, spec.opening_angle = 7, spec.response = "loud";
    spec.check(problems);
    EXPECT_EQ(problems.size(), 3u);
}

}  // namespace
}  // namespace roboss
