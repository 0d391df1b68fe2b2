// Cells with an arm between two conveyors as an SDF 1.11 world: one for each arm, in rows of four.
#pragma once

#include <string>

namespace roboss {

struct CellOptions {
    int cells = 1;                    // 1 to 1000
    std::string gripper = "fingers";  // fingers: they hold by friction; suction: a cup that holds rigidly
};

/// Empty if there is no such gripper or the number is out of range.
std::string cell_sdf(const CellOptions& options);

}  // namespace roboss
