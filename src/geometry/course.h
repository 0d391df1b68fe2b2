// The motion of a shape during a tick: the acceleration of its body's origin is constant, and its angular
// velocity changes as that of a lone body that turns freely; on joints it is constant. The error is of the
// fourth power of the tick for a lone body, and of the third for bodies on joints.
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
    Vec3 angular_rate, angular_curve;   // rad/s^2, rad/s^3: derivatives of `angular` at the beginning

    bool rests() const { return angular == Vec3{} && linear == Vec3{} && accelerated == Vec3{}; }
    /// Displacement of the body's origin at time t.
    Vec3 shift(double t) const { return linear * t + accelerated * (0.5 * t * t); }
    /// Rotation vector at time t (Magnus expansion: Hairer, Lubich, Wanner 2006, IV.7).
    Vec3 turn(double t) const {
        const Vec3 third = angular_curve * (1.0 / 6) - cross(angular, angular_rate) * (1.0 / 12);
        return (angular + (angular_rate * 0.5 + third * t) * t) * t;
    }
    Transform at(double t) const {
        if (t == 0 || rests()) return X;
        const Mat3 R = to_matrix(exponential(turn(t)));
        return {R * X.R, origin + shift(t) + R * (X.p - origin)};
    }
    /// Velocity at time t of the material point that is at p then.
    Vec3 velocity(const Vec3& p, double t) const {
        const Vec3 spin = angular + (angular_rate + angular_curve * (0.5 * t)) * t;
        return linear + accelerated * t + cross(spin, p - origin - shift(t));
    }
    /// Speed that rotation adds to the surface until `dt`, at most.
    double most_turning(double dt) const {
        if (angular_rate == Vec3{}) return turning;
        return turning + (norm(angular_rate) + 0.5 * norm(angular_curve) * dt) * dt * bounding_radius(*shape);
    }
    /// Acceleration of the shape's centre, at most.
    double bend() const {
        if (rests()) return 0;
        const Vec3 arm = X.p - origin;
        return norm(cross(angular, cross(angular, arm)) + cross(angular_rate, arm)) + norm(accelerated);
    }
    /// The same motion seen from a frame at rest.
    Course seen_from(const Transform& X_WF) const {
        const Transform X_FW = inverse(X_WF);
        return {shape,
                X_FW * X,
                X_FW * origin,
                X_FW.R * angular,
                X_FW.R * linear,
                X_FW.R * accelerated,
                turning,
                X_FW.R * angular_rate,
                X_FW.R * angular_curve};
    }
};

inline Course resting_course(const Shape& shape, const Transform& X) {
    return {&shape, X, X.p, {}, {}, {}, 0, {}, {}};
}

}  // namespace roboss
