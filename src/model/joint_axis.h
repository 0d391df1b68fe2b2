// The axes of a robot's joints as columns of arrays: what languages with arrays, and programs, count joints
// by.
#pragma once

#include <string>
#include <vector>

#include "model/model.h"

namespace roboss {

/// One axis of a joint: a column of the arrays of joints.
struct JointAxis {
    JointId joint;     ///< of the robots' type
    int axis = 0;      ///< which of its axes, from 0
    std::string name;  ///< the joint's; with several axes "NAME:0", "NAME:1" ...
};

/// Each axis of each joint that moves, in the order of the file; those of joints that close loops, too.
inline std::vector<JointAxis> axes_of_joints(const RobotType& type) {
    std::vector<JointAxis> axes;
    for (std::size_t j = 0; j < type.joints.size(); ++j) {
        const Joint& joint = type.joints[j];
        for (int axis = 0; axis < joint.nv; ++axis)
            axes.push_back(
                {JointId(j), axis, joint.nv == 1 ? joint.name : joint.name + ":" + std::to_string(axis)});
    }
    return axes;
}

}  // namespace roboss
