// What the step, the compiler and viewers ask of a motion besides its formulas; and what motions of one
// coordinate share.
#pragma once

#include <span>
#include <string_view>

#include "math/spatial.h"
#include "model/model.h"

namespace roboss {

struct JointTraits {
    std::string_view name{};     // the viewer's
    int nq = 1, nv = 1;          // coordinates, velocities
    std::string_view unit{};     // of the position along an axis: "rad" or "m"
    bool turns = false;          // a unit of velocity is a rad/s about its axis
    bool slides = false;         // the body's origin moves
    bool has_pitch = false;      // by Body::pitch per radian
    bool is_periodic = false;    // a full turn is no motion at all: the angle may be wrapped
    bool is_quaternion = false;  // its coordinates are w x y z of a rotation
    bool has_positions() const { return nq == nv; }  // a coordinate for each velocity, its integral
};

/// The quaternion that begins at q.
template <class T>
QuatT<T> get_quat(const T* q) {
    return {q[0], q[1], q[2], q[3]};
}
template <class T>
void put_quat(T* q, const QuatT<T>& x) {
    q[0] = x.w, q[1] = x.x, q[2] = x.y, q[3] = x.z;
}

/// Turns the quaternion at q by a rotation vector.
template <class T>
void turn_quat(T* q, const Vec3T<T>& rotation) {
    put_quat(q, normalized(exponential(rotation) * get_quat(q)));
}

/// dq/dt of the quaternion at q that turns at w.
template <class T>
void put_quat_rate(const T* q, const Vec3T<T>& w, T* rate) {
    const QuatT<T> r = QuatT<T>{T(0), w.x, w.y, w.z} * get_quat(q);
    put_quat(rate, QuatT<T>{T(0.5) * r.w, T(0.5) * r.x, T(0.5) * r.y, T(0.5) * r.z});
}

/// One coordinate, whose rate is the velocity. q, v: of this joint.
struct OneCoordinate {
    template <class T>
    static void advance(const T* v, double dt, T* q) {
        q[0] += dt * v[0];
    }
    template <class T>
    static void rate(const T* /*q*/, const T* v, T* rate) {
        rate[0] = v[0];
    }
    template <class T>
    static void normalise(T* /*q*/) {}
};

}  // namespace roboss
