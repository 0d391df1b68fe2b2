// Typed ids: ordered by their number, and never one kind for another.
#include "core/types.h"

#include <gtest/gtest.h>

#include <type_traits>

namespace roboss {
namespace {

TEST(Id, KindsDoNotMix) {
    static_assert(!std::is_convertible_v<RobotId, LinkId>);
    static_assert(!std::is_constructible_v<RobotId, LinkId>);
    static_assert(!std::is_convertible_v<unsigned, RobotId>);
    EXPECT_EQ(RobotId(7u).index(), 7u);
}

TEST(Id, IsInvalidUntilSetAndSortsBehindEveryValidOne) {
    EXPECT_FALSE(RobotId().valid());
    EXPECT_TRUE(RobotId(0u).valid());
    EXPECT_LT(RobotId(1u), RobotId(2u));
    EXPECT_LT(RobotId(0xFFFFFFFEu), RobotId());
}

}  // namespace
}  // namespace roboss
