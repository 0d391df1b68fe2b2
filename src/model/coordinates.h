// Coordinates of a robot: how velocities move them, and where they put the bodies.
#pragma once

#include <span>
#include <vector>

#include "math/spatial.h"
#include "model/model.h"

namespace roboss {

/// Turns the quaternion at q[i] by a rotation vector.
template <class T>
void turn(std::span<T> q, std::size_t i, const Vec3T<T>& rotation) {
    const QuatT<T> x = normalized(exponential(rotation) * QuatT<T>{q[i], q[i + 1], q[i + 2], q[i + 3]});
    q[i] = x.w, q[i + 1] = x.x, q[i + 2] = x.y, q[i + 3] = x.z;
}

/// q := q moved by dt * v; rotations exactly by the rotation vector dt * w. Over T: one robot, or a few in
/// lanes.
template <class T>
void advance_coordinates(const RobotType& type, std::span<const T> v, double dt, std::span<T> q) {
    const auto rotation = [&](std::size_t k) { return Vec3T<T>{v[k], v[k + 1], v[k + 2]} * T(dt); };
    for (const Body& body : type.bodies) {
        const auto i = static_cast<std::size_t>(body.q_index);
        const auto k = static_cast<std::size_t>(body.v_index);
        if (body.joint == JointKind::kFree) {
            for (std::size_t a = 0; a < 3; ++a) q[a] += dt * v[k + 3 + a];
            turn(q, 3, rotation(k));
        } else if (body.joint == JointKind::kBall) {
            turn(q, i, rotation(k));
        } else {
            q[i] += dt * v[k];
        }
    }
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
