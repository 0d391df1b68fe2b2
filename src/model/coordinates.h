// Coordinates of a robot: how velocities move them, and where they put the bodies.
#pragma once

#include <span>
#include <vector>

#include "math/spatial.h"
#include "model/joint_motion.h"
#include "model/model.h"

namespace roboss {

/// q := q moved by dt * v; rotations exactly by the rotation vector dt * w. Over T: one robot, or a few in
/// lanes.
template <class T>
void advance_coordinates(const RobotType& type, std::span<const T> v, double dt, std::span<T> q) {
    for (const Body& body : type.bodies)
        visit_joint(body.joint,
                    [&](auto joint) { joint.advance(v.data() + body.v_index, dt, q.data() + body.q_index); });
}

/// Poses of all bodies and motion axes, about the base origin O in world axes.
struct TreePlacement {
    Vec3 origin;     // O, m, world
    Transform X_OR;  // base frame (fixed base)
    std::vector<Transform> X_OB;
    std::vector<Spatial> axes;  // one an entry of v
    const Transform& of(int body) const { return body < 0 ? X_OR : X_OB[static_cast<std::size_t>(body)]; }
};
void place_tree(const RobotType& type, std::span<const double> q, TreePlacement& placement);

/// Calls visit(place in v, sign) for the degrees of freedom that move body_b against body_a; what moves both
/// is left out.
template <class Visit>
void visit_between(const RobotType& type, int body_a, int body_b, Visit visit) {
    const auto last = [&](int b) {
        if (b < 0) return -1;
        const Body& body = type.bodies[static_cast<std::size_t>(b)];
        return body.v_index + body.nv - 1;
    };
    int i = last(body_a), j = last(body_b);
    while (i != j) {
        const bool of_a = i > j;
        int& later = of_a ? i : j;
        visit(static_cast<std::size_t>(later), of_a ? -1.0 : 1.0);
        later = type.dof_parent[static_cast<std::size_t>(later)];
    }
}

}  // namespace roboss
