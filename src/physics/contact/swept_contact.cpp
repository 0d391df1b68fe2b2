// See swept_contact.h.
#include "physics/contact/swept_contact.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/dynamics/fast_turning.h"
#include "physics/dynamics/lone_body.h"

namespace roboss {
namespace {

constexpr double kSamePlane = 0.9999;  // cosine

double approach_of(const Course& a, const Course& b, const Vec3& n, const Vec3& p) {
    return -dot(n, a.velocity(p, 0) - b.velocity(p, 0));
}

/// A lone body whose angular velocity changes by itself.
bool turns_freely(const Mechanics<double>& robot) {
    constexpr double kSlow = 1;  // rad/s
    const RobotType& type = *robot.type;
    return is_free_body(type) && type.bodies[0].mass > 0 &&
           norm_squared(robot.bodies[0].velocity.angular) > kSlow * kSlow;
}

/// I^-1 b by Cramer's rule; 0 if I is singular.
Vec3 solve(const Mat3& I, const Vec3& b) {
    const Vec3 c0 = cross(I.r1, I.r2), c1 = cross(I.r2, I.r0), c2 = cross(I.r0, I.r1);
    const double determinant = dot(I.r0, c0);
    return determinant > 0 ? (c0 * b.x + c1 * b.y + c2 * b.z) * (1.0 / determinant) : Vec3{};
}

/// The moment of inertia across the axis of a body of revolution, whose mass is so distributed that the axis
/// of the shape is its own; 0 for others.
double moment_across_axis(const Body& body, const BodyShape& shape) {
    constexpr double kSame = 1e-9;
    const ShapeKind kind = shape.shape.kind;
    if (kind != ShapeKind::kCylinder && kind != ShapeKind::kCapsule) return 0;
    const Mat3& I = body.inertia_C;
    const Vec3 axis = shape.X_BS.R.col(2), along = I * axis, arm = shape.X_BS.p - body.p_BC;
    const double axial = dot(axis, along), trace = I.r0.x + I.r1.y + I.r2.z, across = 0.5 * (trace - axial);
    const auto differs = [&](const Vec3& row, double unit_x, double unit_y, double unit_z, double part) {
        const Vec3 even = Vec3{unit_x, unit_y, unit_z} * across + axis * ((axial - across) * part);
        return norm(row - even) > kSame * trace;
    };
    if (differs(I.r0, 1, 0, 0, axis.x) || differs(I.r1, 0, 1, 0, axis.y) || differs(I.r2, 0, 0, 1, axis.z))
        return 0;
    return norm(cross(arm, axis)) <= kSame * bounding_radius(shape.shape) ? across : 0;
}

/// The centre of mass flies straight; w' = I^-1 (I w x w) in the body's axes (Euler). The axis of a top turns
/// about its angular momentum, evenly, however fast it spins about the axis itself: that moves no point of
/// the surface outwards and is left out where the turn is large.
Course free_course(const Mechanics<double>& robot, std::size_t number, const Spatial& velocity, double dt) {
    const BodyShape& shape = robot.type->shapes[number];
    const Transform X = shape_pose(robot, number);
    const BodyWork& body = robot.bodies[0];
    const Body& info = robot.type->bodies[0];
    const Mat3 &R = body.X_WB.R, &I = info.inertia_C;
    const Vec3& w_W = velocity.angular;
    const Vec3 w = transpose_times(R, w_W), centre = body.X_WB * info.p_BC, spin = I * w;
    Course course{&shape.shape,
                  X,
                  centre,
                  w_W,
                  velocity.linear + cross(w_W, centre - robot.origin),
                  {},
                  turning_speed<double>(shape.shape, X.R, w_W),
                  {},
                  {},
                  {}};
    const double across = is_large_turn(*robot.type, w_W, dt) ? moment_across_axis(info, shape) : 0;
    if (across > 0) {
        course.angular = R * spin * (1 / across);
        return course;
    }
    const Vec3 rate = solve(I, cross(spin, w));
    const Vec3 curve = solve(I, cross(I * rate, w) + cross(spin, rate)) + cross(w, rate);
    course.angular_rate = R * rate, course.angular_curve = R * curve;
    return course;
}

bool is_fast(const Course& a, const Course& b, double dt) {
    const Vec3 v = a.velocity(a.X.p, 0) - b.velocity(b.X.p, 0);
    return (norm(v) + a.turning + b.turning) * dt > kFastDisplacement;
}

}  // namespace

Course course_of(const Mechanics<double>& robot, std::size_t number, double dt) {
    if (robot.type->shapes[number].body < 0 || !turns_freely(robot)) return steady_course_of(robot, number);
    return free_course(robot, number, robot.bodies[0].velocity, dt);
}

Course shifted_course_of(const Mechanics<double>& robot, std::size_t number, const Spatial& solved,
                         double dt) {
    if (robot.type->shapes[number].body < 0 || !turns_freely(robot)) return steady_course_of(robot, number);
    Course course = free_course(robot, number, solved, dt);
    const Vec3 centre = course.origin - robot.origin;
    const Spatial& all = robot.bodies[0].velocity;
    course.linear = all.linear + cross(all.angular, centre);
    const Vec3 extra = all.angular - solved.angular;
    if (extra == Vec3{}) return course;
    const Vec3 free = course.turn(dt), turned = logarithm(exponential(extra * dt) * exponential(free));
    const double angle = norm(turned);
    const Vec3 round = angle > 0 ? turned * (2 * std::numbers::pi / angle) : Vec3{};
    const double rounds =
        angle > 0 ? std::round(dot(free + extra * dt - turned, turned) / (2 * std::numbers::pi * angle)) : 0;
    course.angular = (turned + round * rounds) * (1 / dt);
    course.angular_rate = course.angular_curve = {};
    course.turning = turning_speed<double>(*course.shape, course.X.R, course.angular);
    return course;
}

Course steady_course_of(const Mechanics<double>& robot, std::size_t number) {
    const BodyShape& shape = robot.type->shapes[number];
    const Transform X = shape_pose(robot, number);
    if (shape.body < 0 && robot.type->kinematic)
        return {&shape.shape,
                X,
                robot.origin,
                robot.base.angular,
                robot.base.linear,
                {},
                turning_speed<double>(shape.shape, X.R, robot.base.angular),
                {},
                {},
                {}};
    if (shape.body < 0 || robot.bodies.empty()) return resting_course(shape.shape, X);
    const BodyWork& body = robot.bodies[static_cast<std::size_t>(shape.body)];
    const Vec3 arm = body.X_WB.p - robot.origin, &w = body.velocity.angular;
    const Vec3 linear = body.velocity.linear + cross(w, arm);
    const Vec3 accelerated = body.bias.linear + cross(body.bias.angular, arm) + cross(w, linear);
    return {&shape.shape, X,  body.X_WB.p, w, linear, accelerated, turning_speed<double>(shape.shape, X.R, w),
            {},           {}, {}};
}

SweptPair sweep(const Course& a, const Course& b, double dt, double margin, Manifold& m) {
    const double gap = least_gap(m);
    double blow = 0;
    bool reaches = false;
    for (int i = 0; i < m.count; ++i) {
        const ContactPoint& p = m.points[static_cast<std::size_t>(i)];
        const double displacement = approach_of(a, b, m.n_W, p.p_W) * dt;
        blow = std::max(blow, displacement);
        reaches |= displacement > p.gap;
    }
    if (gap <= kNearly && blow <= kBlow) return {};
    const bool fast = is_fast(a, b, dt);
    if (!reaches && !fast) return {};
    Manifold met = m;
    const auto t = time_of_impact(a, b, dt, kImpactGap, margin, met);
    if (!t) return {Meeting::kNone, 0};
    if (!fast) return {};
    m = met;
    return {Meeting::kInTick, *t};
}

void find_met(const Shape& shape, const Transform& X_WA, const TriangleSurface& surface,
              const Transform& X_WS, double margin, SweepBuffers& buffers) {
    std::vector<SurfaceContact>& points = buffers.there.points;
    collide_surface(shape, X_WA, surface, X_WS, margin, buffers.there);
    const auto is_met = [&](const SurfaceContact& c) {
        return std::ranges::any_of(points, [&](const SurfaceContact& near) {
            return near.gap <= kDeep && dot(near.n_W, c.n_W) > kSamePlane;
        });
    };
    const auto is_held = [&](const SurfaceContact& c) {
        return std::ranges::any_of(buffers.held, [&](const TouchedPlane& plane) {
            return dot(plane.n, c.n_W) > kSamePlane && std::fabs(dot(plane.n, c.p_W - plane.p)) <= kDeep;
        });
    };
    buffers.met.clear();
    std::ranges::copy_if(points, std::back_inserter(buffers.met),
                         [&](const SurfaceContact& c) { return is_met(c) && !is_held(c); });
}

SweptPair sweep(const Course& course, const TriangleSurface& surface, const Transform& X_WS, double dt,
                double margin, SweepBuffers& buffers) {
    buffers.met.clear();
    std::vector<SurfaceContact>& points = buffers.found.points;
    const Course still{};
    const auto displacement = [&](const SurfaceContact& c) {
        return approach_of(course, still, c.n_W, c.p_W) * dt;
    };
    const auto touches = [&](const SurfaceContact& c) {
        return c.gap <= kImpactGap || (c.gap <= kNearly && displacement(c) <= kBlow);
    };
    const auto reaches = [&](const SurfaceContact& c) { return !touches(c) && displacement(c) > c.gap; };
    const bool fast = is_fast(course, still, dt);
    if (!fast && std::ranges::none_of(points, reaches)) return {};
    buffers.held.clear();
    for (const SurfaceContact& c : points)
        if (touches(c)) buffers.held.push_back({c.n_W, c.p_W});
    const auto t =
        time_of_impact(course, surface, X_WS, dt, kImpactGap, margin, buffers.held, buffers.there.triangles);
    if (t && !fast) return {};
    if (t) {
        find_met(*course.shape, course.at(*t), surface, X_WS, margin, buffers);
        if (buffers.met.empty()) return {};  // only a plane of the beginning can hold it
    }
    std::erase_if(points, [&](const SurfaceContact& c) {
        const auto same = [&](const TouchedPlane& plane) { return dot(plane.n, c.n_W) > kSamePlane; };
        return !touches(c) && std::ranges::none_of(buffers.held, same);
    });
    return t ? SweptPair{Meeting::kInTick, *t} : SweptPair{Meeting::kNone, 0};
}

bool is_blow(std::span<const RobotWork> robots, const Contact& c, double dt) {
    const auto velocity = [&](int robot, int body) {
        if (robot < 0) return Vec3{};
        const RobotWork& work = robots[static_cast<std::size_t>(robot)];
        const Spatial& v = body < 0 ? work.base : work.bodies[static_cast<std::size_t>(body)].velocity;
        return v.linear + cross(v.angular, c.p_W - work.origin);
    };
    const Vec3 v = velocity(c.robot_a, c.body_a) - velocity(c.robot_b, c.body_b);
    return -dot(c.normal, v) * dt - std::max(c.gap, 0.0) > kBlow;
}

void take_back(const Course& a, const Course& b, double t, Contact& contact) {
    const Vec3 n = contact.normal, p = contact.p_W;
    const Vec3 pa = p - a.shift(t), pb = p - b.shift(t);
    const double approach = -dot(n, a.velocity(pa, 0) - b.velocity(pb, 0));
    contact.gap += std::max(approach, 0.0) * t;
    contact.p_W = pa, contact.shift_b = pb - pa;
    contact.time = t;
}

}  // namespace roboss
