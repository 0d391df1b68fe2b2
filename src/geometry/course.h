// The motion of a shape during a tick. A lone body's origin has a constant acceleration and its angular
// velocity changes as that of a body that turns freely: the error is of the fourth power of the tick. On
// joints that move freely the course is a cubic between two ends (course_between): of the fourth power too,
// and exact at the ends. On other joints the angular velocity is constant: of the second power.
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
    Vec3 jerk;                          // of the body's origin, m/s^3

    bool rests() const {
        return angular == Vec3{} && linear == Vec3{} && accelerated == Vec3{} && angular_rate == Vec3{};
    }
    /// Displacement of the body's origin at time t.
    Vec3 shift(double t) const { return (linear + (accelerated * 0.5 + jerk * (t / 6)) * t) * t; }
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
        return linear + (accelerated + jerk * (0.5 * t)) * t + cross(spin, p - origin - shift(t));
    }
    /// Speed that rotation adds to the surface until `dt`, at most.
    double most_turning(double dt) const {
        if (angular_rate == Vec3{}) return turning;
        return turning + (norm(angular_rate) + 0.5 * norm(angular_curve) * dt) * dt * bounding_radius(*shape);
    }
    /// Acceleration of the shape's centre until `dt`, at most.
    double bend(double dt) const {
        if (rests()) return 0;
        const Vec3 arm = X.p - origin;
        return norm(cross(angular, cross(angular, arm)) + cross(angular_rate, arm)) + norm(accelerated) +
               norm(jerk) * dt;
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
                X_FW.R * angular_curve,
                X_FW.R * jerk};
    }
};

inline Course resting_course(const Shape& shape, const Transform& X) {
    return {&shape, X, X.p, {}, {}, {}, 0, {}, {}, {}};
}

/// Pose of a body, and the velocity of its origin.
struct BodyMotion {
    Transform X;
    Vec3 angular, linear;
};

/// The course of a shape at X_WS whose body has these poses and velocities at the beginning and the end of
/// the tick. It turns by less than pi.
inline Course course_between(const Shape& shape, const Transform& X_WS, const BodyMotion& from,
                             const BodyMotion& to, double dt, double turning) {
    const Vec3 &v0 = from.linear, &v1 = to.linear, &w0 = from.angular, &w1 = to.angular;
    const Vec3 mean = (to.X.p - from.X.p) * (1 / dt);
    // turn(dt) and the angular velocity at dt are two linear equations for rate and curve; without the curve:
    // rate - u x rate = b, with the solution (b + u x b + u (u . b)) / (1 + u^2).
    const Vec3 turned = logarithm(to_quat(to.X.R * transpose(from.X.R))), u = w0 * (0.5 * dt);
    const Vec3 b = (turned * (1 / dt) - (w0 * 2.0 + w1) * (1.0 / 3)) * (6 / dt);
    const Vec3 rate = (b + cross(u, b) + u * dot(u, b)) * (1 / (1 + norm_squared(u)));
    return {&shape,
            X_WS,
            from.X.p,
            w0,
            v0,
            (mean * 6.0 - v0 * 4.0 - v1 * 2.0) * (1 / dt),
            turning,
            rate,
            (w1 - w0 - rate * dt) * (2 / (dt * dt)),
            ((v0 + v1) * 6.0 - mean * 12.0) * (1 / (dt * dt))};
}

}  // namespace roboss
