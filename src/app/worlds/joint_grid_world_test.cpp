// The generated net of joints has a joint between all neighbours.
#include "app/worlds/joint_grid_world.h"

#include <gtest/gtest.h>

#include <string>

namespace roboss {
namespace {

int count(const std::string& text, const std::string& what) {
    int found = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
    return found;
}

TEST(JointGridWorld, JoinsAllNeighboursAndHangsOnTwoCorners) {
    const std::string net = joint_grid_sdf({4, 7});
    EXPECT_EQ(count(net, "<link "), 4 * 7);
    EXPECT_EQ(count(net, "<joint "), 3 * 7 + 4 * 6 + 2);
    EXPECT_EQ(count(net, "<parent>world</parent>"), 2);
    EXPECT_EQ(count(joint_grid_sdf({3, 1}), "<joint "), 2 + 1) << "a chain hangs on its one corner";
}

}  // namespace
}  // namespace roboss
