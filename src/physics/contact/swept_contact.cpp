// See swept_contact.h.
#include "physics/contact/swept_contact.h"

#include <algorithm>
#include <cmath>

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
    return type.free_base && type.nv == 6 && type.bodies[0].mass > 0 &&
           norm_squared(robot.bodies[0].velocity.angular) > kSlow * kSlow;
}

/// I^-1 b by Cramer's rule; 0 if I is singular.
Vec3 solve(const Mat3& I, const Vec3& b) {
    const Vec3 c0 = cross(I.r1, I.r2), c1 = cross(I.r2, I.r0), c2 = cross(I.r0, I.r1);
    const double determinant = dot(I.r0, c0);
    return determinant > 0 ? (c0 * b.x + c1 * b.y + c2 * b.z) * (1.0 / determinant) : Vec3{};
}

/// The centre of mass flies straight; w' = I^-1 (I w x w) in the body's axes (Euler).
Course free_course(const Mechanics<double>& robot, std::size_t number) {
    const BodyShape& shape = robot.type->shapes[number];
    const Transform& X = robot.shapes[number].X_WS;
    const BodyWork& body = robot.bodies[0];
    const Mat3 &R = body.X_WB.R, &I = robot.type->bodies[0].inertia_C;
    const Vec3& w_W = body.velocity.angular;
    const Vec3 w = transpose_times(R, w_W), centre = body.X_WB * robot.type->bodies[0].p_BC;
    const Vec3 rate = solve(I, cross(I * w, w));
    const Vec3 curve = solve(I, cross(I * rate, w) + cross(I * w, rate)) + cross(w, rate);
    return {&shape.shape,
            X,
            centre,
            w_W,
            body.velocity.linear + cross(w_W, centre - robot.origin),
            {},
            turning_speed<double>(shape.shape, X.R, w_W),
            R * rate,
            R * curve,
            {}};
}

bool is_fast(const Course& a, const Course& b, double dt) {
    const Vec3 v = a.velocity(a.X.p, 0) - b.velocity(b.X.p, 0);
    return (norm(v) + a.turning + b.turning) * dt > kFastDisplacement;
}

}  // namespace

Course course_of(const Mechanics<double>& robot, std::size_t number) {
    const BodyShape& shape = robot.type->shapes[number];
    const Transform& X = robot.shapes[number].X_WS;
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
    if (turns_freely(robot)) return free_course(robot, number);
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
