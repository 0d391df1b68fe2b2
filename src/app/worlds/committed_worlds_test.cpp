// Worlds in worlds/ that are generated are what their generators write.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "app/worlds/cell_world.h"
#include "app/worlds/city_world.h"
#include "app/worlds/joint_grid_world.h"
#include "app/worlds/soccer_world.h"
#include "app/worlds/spider_world.h"

namespace roboss {
namespace {

TEST(CommittedWorlds, AreWhatTheirGeneratorsWrite) {
    const struct {
        std::string name, kind, text;
    } worlds[] = {{"arm_cell.sdf", "cells", cell_sdf({})},
                  {"city.sdf", "city", city_sdf({})},
                  {"joint_grid.sdf", "joint-grid", joint_grid_sdf({})},
                  {"soccer.sdf", "soccer", soccer_sdf({})},
                  {"spider.sdf", "spiders", spider_sdf({})}};
    for (const auto& world : worlds) {
        std::ifstream file(ROBOSS_WORLDS "/" + world.name, std::ios::binary);
        const std::string committed{std::istreambuf_iterator<char>(file), {}};
        ASSERT_FALSE(committed.empty()) << world.name;
        EXPECT_TRUE(committed == world.text)
            << "make it again: roboss-world " << world.kind << " -o worlds/" << world.name;
    }
}

}  // namespace
}  // namespace roboss
