// A net of plates as an SDF 1.9 world: neighbours are joined by ball joints, so that each mesh of the net is
// a loop. One robot, of any size; it hangs on two corners. It starts as a bowl: where all joints lie in one
// plane, many conditions of the loops say the same, and the run goes wrong.
#pragma once

#include <string>

namespace roboss {

struct JointGridOptions {
    int rows = 6, columns = 6;
};

std::string joint_grid_sdf(const JointGridOptions& options);

}  // namespace roboss
