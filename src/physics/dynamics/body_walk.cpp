// See body_walk.h.
#include "physics/dynamics/body_walk.h"

#include "physics/dynamics/dynamics.h"

namespace roboss {

bool BodyWalk::shares(const RobotType& type) {
    if (team_.size() == 1 || type.elimination.empty()) return false;
    branches_.lay_out(type);
    return true;
}

void BodyWalk::place(const RobotType& type, std::span<const double> q, RobotWork& work) {
    if (!shares(type)) return forward_kinematics<double>(type, q, work);
    const Transform X_WR = start_placing<double>(type, q, work);
    branches_.walk_to_tips(team_, [&](std::size_t b) { place_body<double>(type, X_WR, q, b, work); });
}

void BodyWalk::move(const RobotType& type, std::span<const double> v, RobotWork& work) {
    if (!shares(type)) return forward_velocities<double>(type, v, work);
    branches_.walk_to_tips(team_, [&](std::size_t b) { move_body<double>(type, v, b, work); });
}

}  // namespace roboss
