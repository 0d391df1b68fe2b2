// See onboard_kinds/apply_joint_force.h.
#include "onboard/controllers.h"

namespace roboss {

void run(const ApplyJointForceSpec&, OnboardContext& c) {
    c.push_joint(0, c.command(0)[0]);
}

}  // namespace roboss
