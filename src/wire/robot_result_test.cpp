#include "wire/robot_result.h"

#include <gtest/gtest.h>

namespace roboss {
namespace {

TEST(RobotResult, KeepsPositionAndVelocityToAHundredth) {
    const Box32 swept{{-1, 2, 0}, {3, 2.5, 0}};
    const auto centre = unpack_position(pack_position({0.1, 2.4, 0}, swept), swept);
    EXPECT_NEAR(centre[0], 0.1, 4 / 509.0);
    EXPECT_NEAR(centre[1], 2.4, 0.5 / 509.0);
    EXPECT_EQ(centre[2], 0);
    const auto velocity = unpack_velocity(pack_velocity({1.5, -0.3, 1e-3}));
    EXPECT_EQ(velocity[0], 1.5f);
    EXPECT_NEAR(velocity[1], -0.3, 0.3 / 128);
    EXPECT_NEAR(velocity[2], 1e-3, 1e-3 / 128);
}

TEST(RobotResult, ABoxWithoutEndHasItsMiddleAtTheOrigin) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const Box32 everywhere{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
    const auto centre = unpack_position(pack_position({5, 5, 5}, everywhere), everywhere);
    EXPECT_EQ(centre, (std::array<float, 3>{}));
}

}  // namespace
}  // namespace roboss
