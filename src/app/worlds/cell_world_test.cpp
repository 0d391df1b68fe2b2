// The generated cells: what stands in a cell fits its measures, and wrong options give nothing.
#include "app/worlds/cell_world.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/worlds/cell_layout.h"
#include "model/model.h"
#include "sdf/load_world.h"

namespace roboss {
namespace {

TEST(CellWorld, NoCellsAndAnUnknownGripperAreEmpty) {
    EXPECT_EQ(cell_sdf({0, "fingers"}), "");
    EXPECT_EQ(cell_sdf({1001, "fingers"}), "");
    EXPECT_EQ(cell_sdf({1, "tongs"}), "");
}

TEST(CellWorld, TwelveCellsLoadWithoutAFindingAndHaveAnArmEach) {
    for (const char* gripper : {"fingers", "suction"}) {
        Diagnostics diagnostics;
        const auto world = load_world_text(cell_sdf({12, gripper}), "cells.sdf", {}, diagnostics);
        const auto model = world ? compile(*world, {}, diagnostics) : nullptr;
        for (const Diagnostic& finding : diagnostics.items()) ADD_FAILURE() << to_text(finding);
        ASSERT_TRUE(model);
        EXPECT_TRUE(model->find_robot("arm_11"));
        EXPECT_EQ(model->robots.size(), 12u * (2 + arm_cell::kBoxes));  // arm, feed belt, boxes
    }
}

TEST(CellWorld, BoxesOnTheRackDoNotTouch) {
    for (int i = 0; i < arm_cell::kBoxes; ++i)
        for (int k = 0; k < i; ++k) {
            const arm_cell::Place a = arm_cell::rack_place(i), b = arm_cell::rack_place(k);
            EXPECT_GT(std::hypot(a.x - b.x, a.y - b.y), 0.11)
                << i << ' ' << k;  // the longest diagonal is 10.8 cm
        }
}

}  // namespace
}  // namespace roboss
