#include "core/similar.h"

#include <gtest/gtest.h>

namespace roboss {
namespace {

using Names = std::vector<std::string>;

TEST(Similar, AWordWithAFewWrongLettersFindsItsName) {
    EXPECT_EQ(similar_to("lef_wheel", {"base", "left_wheel", "right_wheel"}), "left_wheel");
    EXPECT_EQ(similar_to("lfet", {"left", "lift"}), "left");  // swapped neighbours are one mistake
    EXPECT_EQ(similar_to("gripper", {"base", "left_wheel"}), "");
}

TEST(Similar, LongNamesAreOrderedByTheLettersThatTheyShare) {
    const Names topics{"/clock", "/world/w/model/a/scan", "/lidar", "/lidar/points"};
    EXPECT_EQ(most_alike("/lidar/point", topics, 2), (Names{"/lidar/points", "/lidar"}));
    EXPECT_EQ(most_alike("/model/a/scan", topics, 1), (Names{"/world/w/model/a/scan"}));
}

TEST(Similar, NoMoreNamesAreFoundThanThereAre) {
    EXPECT_EQ(most_alike("x", {"a"}, 3), (Names{"a"}));
    EXPECT_TRUE(most_alike("x", {}, 3).empty());
}

}  // namespace
}  // namespace roboss
