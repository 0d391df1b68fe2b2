#include "fuzz/swept.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/collide.h"
#include "math/quat.h"
#include "world/joint_kind.h"

namespace roboss::fuzz {
namespace {

Transform between(const Transform& a, const Transform& b, double share) {
    const Quat qa = to_quat(a.R);
    Quat qb = to_quat(b.R);
    if (qa.w * qb.w + qa.x * qb.x + qa.y * qb.y + qa.z * qb.z < 0) qb = {-qb.w, -qb.x, -qb.y, -qb.z};
    const auto mix = [&](double x, double y) { return x + share * (y - x); };
    return {to_matrix(normalized(Quat{mix(qa.w, qb.w), mix(qa.x, qb.x), mix(qa.y, qb.y), mix(qa.z, qb.z)})),
            a.p + (b.p - a.p) * share};
}

/// No point of a shape of that radius moves further, with a little to spare for the arc.
double travel(const Transform& a, const Transform& b, double radius) {
    constexpr double kArc = 1.1;
    const Mat3 turn = transpose(a.R) * b.R;
    const double cosine = std::clamp(0.5 * (turn(0, 0) + turn(1, 1) + turn(2, 2) - 1), -1.0, 1.0);
    return norm(b.p - a.p) + kArc * std::acos(cosine) * radius;
}

double gap(const Shape& a, const Transform& X_WA, const Shape& b, const Transform& X_WB) {
    constexpr double kFar = 1e6;
    const Manifold m = collide(a, X_WA, b, X_WB, kFar);
    double least = kFar;
    for (int i = 0; i < m.count; ++i) least = std::fmin(least, m.points[static_cast<std::size_t>(i)].gap);
    return least;
}

}  // namespace

double SweptDistance::width(const Shape& shape) {
    switch (shape.kind) {
        case ShapeKind::kSphere:
        case ShapeKind::kCapsule:
            return 2 * shape.radius;
        case ShapeKind::kCylinder:
            return 2 * std::fmin(shape.radius, shape.half_length);
        case ShapeKind::kBox:
        case ShapeKind::kEllipsoid:
            return 2 * std::fmin(shape.half.x, std::fmin(shape.half.y, shape.half.z));
        case ShapeKind::kPlane:
            return std::numeric_limits<double>::infinity();
        default:
            return 0.02;  // hulls of these tests
    }
}

SweptDistance::SweptDistance(const Model& model, std::vector<Shape> stand_ins) : model_(model) {
    for (std::size_t r = 0; r < model.robots.size(); ++r)
        for (const BodyShape& s : model.type_of(RobotId(r)).shapes)
            shapes_.push_back({s.shape, model.robots[r].family, bounding_radius(s.shape)});
    for (std::size_t i = 0; i < model.statics.size(); ++i) {
        const StaticShape& s = model.statics[i];
        const Shape shape = s.shape.kind == ShapeKind::kSurface ? stand_ins.at(i) : s.shape;
        shapes_.push_back({shape, 0xFFFFFFFFu, bounding_radius(shape)});
        fixed_.push_back(s.X_WS);
    }
}

void SweptDistance::add(const std::vector<RobotState>& states) {
    Sample sample;
    for (std::size_t r = 0; r < states.size(); ++r) {
        const RobotType& type = model_.type_of(RobotId(r));
        forward_kinematics<double>(type, states[r].q, work_);
        for (const BodyShape& s : type.shapes)
            sample.push_back(s.body < 0 ? to_transform(base_pose(states[r])) * s.X_BS
                                        : work_.bodies[static_cast<std::size_t>(s.body)].X_WB * s.X_BS);
    }
    sample.insert(sample.end(), fixed_.begin(), fixed_.end());
    samples_.push_back(std::move(sample));
}

void SweptDistance::add_between(const std::vector<RobotState>& from, const std::vector<RobotState>& to,
                                int samples) {
    std::vector<RobotState> now = from;
    for (int i = 0; i <= samples; ++i) {
        const double share = static_cast<double>(i) / samples;
        for (std::size_t r = 0; r < now.size(); ++r) {
            const std::vector<double>&a = from[r].q, &b = to[r].q;
            for (std::size_t k = 0; k < a.size(); ++k) now[r].q[k] = a[k] + share * (b[k] - a[k]);
            const RobotType& type = model_.type_of(RobotId(r));
            const auto turn = [&](std::size_t k) {  // quaternions: the shorter way around
                const double cosine =
                    a[k] * b[k] + a[k + 1] * b[k + 1] + a[k + 2] * b[k + 2] + a[k + 3] * b[k + 3];
                for (std::size_t j = k; j < k + 4; ++j)
                    now[r].q[j] = a[j] + share * ((cosine < 0 ? -b[j] : b[j]) - a[j]);
                const Quat q =
                    normalized(Quat{now[r].q[k], now[r].q[k + 1], now[r].q[k + 2], now[r].q[k + 3]});
                now[r].q[k] = q.w, now[r].q[k + 1] = q.x, now[r].q[k + 2] = q.y, now[r].q[k + 3] = q.z;
            };
            turn(3);
            for (const Body& body : type.bodies)
                if (body.joint == JointKind::kBall) turn(static_cast<std::size_t>(body.q_index));
        }
        add(now);
    }
}

void SweptDistance::search(const Placed& a, const Placed& b, const Transform from[2], const Transform to[2]) {
    if (least_ < enough_) return;
    const double way = travel(from[0], to[0], a.radius) + travel(from[1], to[1], b.radius);
    const Transform middle[2] = {between(from[0], to[0], 0.5), between(from[1], to[1], 0.5)};
    const double radii = a.radius + b.radius;
    if (std::isfinite(radii) && norm(middle[0].p - middle[1].p) - radii - 0.5 * way > least_) return;
    const double now = gap(a.shape, middle[0], b.shape, middle[1]);
    if (now < least_) least_ = now, width_ = std::fmin(width(a.shape), width(b.shape));
    if (now - 0.5 * way >= least_ - resolution_ || way < resolution_) return;
    search(a, b, from, middle);
    search(a, b, middle, to);
}

double SweptDistance::least_gap(double enough, double resolution) {
    enough_ = enough, resolution_ = resolution;
    least_ = std::numeric_limits<double>::infinity(), width_ = 0;
    const std::size_t moving = shapes_.size() - fixed_.size();
    for (std::size_t i = 0; i < moving; ++i)
        for (std::size_t j = i + 1; j < shapes_.size(); ++j) {
            if (shapes_[i].family == shapes_[j].family) continue;
            for (std::size_t k = 0; k + 1 < samples_.size(); ++k) {
                const Transform from[2] = {samples_[k][i], samples_[k][j]};
                const Transform to[2] = {samples_[k + 1][i], samples_[k + 1][j]};
                search(shapes_[i], shapes_[j], from, to);
            }
        }
    return least_;
}

}  // namespace roboss::fuzz
