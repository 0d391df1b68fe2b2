// See coarse_bound.h.
#include "physics/contact/coarse_bound.h"

#include <algorithm>
#include <cmath>

#include "model/joint_motion.h"
#include "physics/dynamics/robot_work.h"

namespace roboss {
namespace {

constexpr double kRounding = 1e-6;  // m and relative: the exact box is computed in another way

/// What joints add to the robot's reach and to the speed of its points.
struct JointShare {
    double slid = 0;     // m: slides beyond their limits
    double turning = 0;  // rad/s, all joints together
    double sliding = 0;  // m/s
};

JointShare joint_share(const RobotType& type, const RobotState& state) {
    JointShare share;
    for (const Body& body : type.bodies) {
        if (body.joint == JointKind::kFree) continue;
        const JointTraits& traits = joint_traits(body.joint);
        const double displacement = std::fabs(slide_of(body));
        for (int k = 0; k < body.nv; ++k) {
            const double rate = std::fabs(state.v[static_cast<std::size_t>(body.v_index + k)]);
            if (traits.turns) share.turning += rate;
            if (traits.slides) share.sliding += displacement * rate;
        }
        if (!traits.slides) continue;
        const Dof& dof = type.dofs[static_cast<std::size_t>(body.v_index - type.base_nv())];
        const double q = std::fabs(state.q[static_cast<std::size_t>(body.q_index)]);
        share.slid += displacement * std::max(0.0, q - std::max(std::fabs(dof.lower), std::fabs(dof.upper)));
    }
    return share;
}

}  // namespace

Aabb coarse_bound(const RobotType& type, const RobotState& state, double dt) {
    const ReachSphere& sphere = type.reach_sphere;
    const JointShare joints = joint_share(type, state);
    const double reach = sphere.radius + joints.slid;
    // A point within reach of the centre, and a shape's own turning about its centre (place_shapes). Where
    // the base moves, the centre is its origin.
    double speed = joints.sliding + 3.0 * reach * joints.turning;
    if (type.free_base) {
        const std::vector<double>& v = state.v;
        speed += norm(Vec3{v[3], v[4], v[5]}) + 2.0 * reach * norm(Vec3{v[0], v[1], v[2]});
    }
    if (type.kinematic) {
        const Spatial base = base_velocity(type, state);
        speed += norm(base.linear) + 2.0 * reach * norm(base.angular);
    }
    const double half = (reach + kBaseMargin + dt * speed) * (1.0 + kRounding) + kRounding;
    Vec3 centre{state.q[0], state.q[1], state.q[2]};
    if (!(sphere.centre == Vec3{})) centre += rotate(base_pose(state).q, sphere.centre);
    Aabb box;
    box.include(centre);
    return box.inflated(half);
}

}  // namespace roboss
