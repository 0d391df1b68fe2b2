// See reflected_inertia.h.
#include "mjcf/reflected_inertia.h"

namespace roboss::mjcf {

double reflected_inertia(Robots& robots, const Tree::JointPlace& place) {
    const Tree& tree = robots.tree();
    const JointPart& joint = tree.bodies[place.body].joints[place.joint];
    std::vector<Pose> X_JB(tree.bodies.size());  // of the bodies that the joint carries, in the joint's frame
    std::vector<char> carried(tree.bodies.size(), 0);
    carried[place.body] = 1;
    X_JB[place.body] = {-joint.pos, {}};
    double sum = robots.joint_of(place)->axes.front().armature;
    for (std::size_t b = place.body; b < tree.bodies.size(); ++b) {
        const std::size_t parent = tree.bodies[b].parent;
        if (b != place.body && carried[parent]) carried[b] = 1, X_JB[b] = X_JB[parent] * tree.bodies[b].X_PB;
        if (!carried[b]) continue;
        const LinkSpec& link = robots.link_of(b);
        const Vec3 u = joint.axis.xyz;
        if (joint.motion == JointMotion::kSlide) {
            sum += link.mass;
            continue;
        }
        const Vec3 across = cross(u, X_JB[b] * link.p_LC), turned = rotate(conjugate(X_JB[b].q), u);
        sum += link.mass * dot(across, across) + dot(turned, link.inertia_C * turned);
    }
    return sum;
}

}  // namespace roboss::mjcf
