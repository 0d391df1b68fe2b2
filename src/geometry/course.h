// The motion of a shape during a tick: its body keeps its angular velocity and the acceleration of its
// origin. That is the motion of the step itself for a free body, and off by the third power of the tick for
// bodies on joints.
#pragma once

#include "geometry/turning_speed.h"
#include "math/quat.h"

namespace roboss {

struct Course {
    const Shape* shape = nullptr;
    Transform X;                        // of the shape at the beginning of the tick
    Vec3 origin;                        // of the body at the beginning
    Vec3 angular, linear, accelerated;  // of the body: rad/s; of its origin: m/s, m/s^2
    double turning = 0;                 // turning_speed

    bool rests() const { return angular == Vec3{} && linear == Vec3{} && accelerated == Vec3{}; }
    /// Displacement of the body's origin at time t.
    Vec3 shift(double t) const { return linear * t + accelerated * (0.5 * t * t); }
    Transform at(double t) const {
        if (t == 0 || rests()) return X;
        const Mat3 R = to_matrix(exponential(angular * t));
        return {R * X.R, origin + shift(t) + R * (X.p - origin)};
    }
    /// Velocity at time t of the material point that is at p then.
    Vec3 velocity(const Vec3& p, double t) const {
        return linear + accelerated * t + cross(angular, p - origin - shift(t));
    }
    /// Acceleration of the shape's centre, at most.
    double bend() const {
        if (rests()) return 0;
        return norm(cross(angular, cross(angular, X.p - origin))) + norm(accelerated);
    }
    /// The same motion seen from a frame at rest.
    Course seen_from(const Transform& X_WF) const {
        const Transform X_FW = inverse(X_WF);
        return {shape,  X_FW * X, X_FW * origin, X_FW.R * angular, X_FW.R * linear, X_FW.R * accelerated,
                turning};
    }
};

inline Course resting_course(const Shape& shape, const Transform& X) {
    return {&shape, X, X.p, {}, {}, {}, 0};
}

}  // namespace roboss
