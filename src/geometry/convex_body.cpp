// Support functions and their kinks. Parts: those of face_region.h for boxes and cylinders (the octagon of a
// cap: rim points 2 .. 9 and 64 .. 71, its sides 72 .. 87); hulls: vertices, then edges, then faces;
// triangles: corners 0 .. 2, edges 3 .. 5, face 6.
#include "geometry/convex_body.h"

#include <algorithm>

namespace roboss::narrow {
namespace {

Vec3 sided(const Vec3& d, const Vec3& half) {
    return {d.x < 0.0 ? -half.x : half.x, d.y < 0.0 ? -half.y : half.y, d.z < 0.0 ? -half.z : half.z};
}

Vec3 scaled(const Vec3& a, const Vec3& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}

double smallest(const Vec3& v) {
    return std::min(v.x, std::min(v.y, v.z));
}

}  // namespace

ConvexBody::ConvexBody(const Posed& posed) : posed_(&posed), centre_(posed.X.p) {
    const Shape& s = posed.shape;
    switch (s.kind) {
        case ShapeKind::kSphere:
            ball_ = size_ = s.radius;
            break;
        case ShapeKind::kCapsule:
            core_ = Core::kSegment;
            ball_ = size_ = s.radius;
            break;
        case ShapeKind::kBox:
            core_ = Core::kBox;
            size_ = inradius_ = smallest(s.half);
            break;
        case ShapeKind::kCylinder:
            core_ = Core::kCylinder;
            size_ = inradius_ = std::min(s.radius, s.half_length);
            break;
        case ShapeKind::kEllipsoid:
            core_ = Core::kEllipsoid;
            size_ = inradius_ = smallest(s.half);
            break;
        default:
            core_ = Core::kHull;
            size_ = inradius_ = s.hull->inradius;
    }
}

ConvexBody::ConvexBody(const std::array<Vec3, 3>& corners, const Vec3& n)
    : core_(Core::kTriangle),
      centre_((corners[0] + corners[1] + corners[2]) / 3.0),
      corners_(corners),
      normal_(n) {
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) longest = std::max(longest, norm(corners[(i + 1) % 3] - corners[i]));
    size_ = norm(cross(corners[1] - corners[0], corners[2] - corners[0])) / longest;
}

Vec3 ConvexBody::support(const Vec3& d_W) const {
    if (core_ == Core::kPoint) return {};
    if (core_ == Core::kTriangle) {
        const double a = dot(d_W, corners_[0]), b = dot(d_W, corners_[1]), c = dot(d_W, corners_[2]);
        return corners_[a >= b && a >= c ? 0 : b >= c ? 1 : 2] - centre_;
    }
    const Mat3& R = posed_->X.R;
    const Shape& s = posed_->shape;
    const Vec3 d = transpose_times(R, d_W);
    switch (core_) {
        case Core::kSegment:
            return R.col(2) * (d.z < 0.0 ? -s.half_length : s.half_length);
        case Core::kBox:
            return R * sided(d, s.half);
        case Core::kCylinder: {
            const double radial = std::sqrt(d.x * d.x + d.y * d.y);
            const double scale = radial > 1e-12 * std::fabs(d.z) ? s.radius / radial : 0.0;
            return R * Vec3{d.x * scale, d.y * scale, d.z < 0.0 ? -s.half_length : s.half_length};
        }
        case Core::kEllipsoid: {
            const Vec3 stretched = scaled(d, s.half);
            return R * (scaled(stretched, s.half) / norm(stretched));
        }
        default:
            return R * s.hull->vertices[s.hull->furthest(d)];
    }
}

double ConvexBody::reach(const Vec3& d_W) const {
    if (core_ == Core::kPoint) return 0;
    if (core_ == Core::kTriangle || core_ == Core::kHull) return dot(d_W, support(d_W));
    const Shape& s = posed_->shape;
    const Vec3 d = transpose_times(posed_->X.R, d_W);
    switch (core_) {
        case Core::kBox:
            return std::fabs(d.x) * s.half.x + std::fabs(d.y) * s.half.y + std::fabs(d.z) * s.half.z;
        case Core::kCylinder:
            return std::sqrt(d.x * d.x + d.y * d.y) * s.radius + std::fabs(d.z) * s.half_length;
        case Core::kEllipsoid:
            return norm(scaled(d, s.half));
        default:
            return std::fabs(d.z) * s.half_length;
    }
}

std::optional<Vec3> ConvexBody::closest_to(const Vec3& p_W) const {
    if (core_ == Core::kPoint) return centre_;
    if (core_ == Core::kTriangle || core_ == Core::kHull || core_ == Core::kEllipsoid) return {};
    const Shape& s = posed_->shape;
    const Vec3 p = transpose_times(posed_->X.R, p_W - centre_);
    const auto within = [](double x, double most) { return std::clamp(x, -most, most); };
    Vec3 on{0, 0, within(p.z, core_ == Core::kBox ? s.half.z : s.half_length)};
    if (core_ == Core::kBox) on.x = within(p.x, s.half.x), on.y = within(p.y, s.half.y);
    if (core_ == Core::kCylinder) {
        const double radial = std::sqrt(p.x * p.x + p.y * p.y),
                     scale = radial > s.radius ? s.radius / radial : 1;
        on.x = p.x * scale, on.y = p.y * scale;
    }
    if (on == p) return {};
    return centre_ + posed_->X.R * on;
}

FixedList<Vec3, 3> ConvexBody::kinks() const {
    FixedList<Vec3, 3> axes;
    if (core_ == Core::kBox)
        for (std::size_t i = 0; i < 3; ++i) axes.push_back(posed_->axis(i));
    if (core_ == Core::kCylinder || core_ == Core::kSegment) axes.push_back(posed_->axis(2));
    return axes;
}

NearFeatures ConvexBody::near(const Vec3& d, double sine) const {
    NearFeatures found;
    const double cosine = std::sqrt(1.0 - sine * sine);
    if (core_ == Core::kTriangle) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 e = normalized(corners_[(i + 1) % 3] - corners_[i]);
            if (std::fabs(dot(d, e)) < sine) found.add_edge(e);
        }
        if (std::fabs(dot(d, normal_)) > cosine) found.add_normal(dot(d, normal_) < 0.0 ? -normal_ : normal_);
    } else if (core_ == Core::kHull) {
        near_hull(d, sine, found);
    } else if (core_ == Core::kBox || core_ == Core::kCylinder || core_ == Core::kSegment) {
        for (std::size_t i = core_ == Core::kBox ? 0 : 2; i < 3; ++i) {
            const Vec3 axis = posed_->axis(i);
            const double along = dot(d, axis);
            if (std::fabs(along) < sine) found.add_edge(axis);
            if (std::fabs(along) > cosine && core_ != Core::kSegment)
                found.add_normal(along < 0.0 ? -axis : axis);
        }
    }
    return found;
}

void ConvexBody::near_hull(const Vec3& d_W, double sine, NearFeatures& found) const {
    const ConvexHull& hull = *posed_->shape.hull;
    const Mat3& R = posed_->X.R;
    const Vec3 d = transpose_times(R, d_W);
    const double cosine = std::sqrt(1.0 - sine * sine);
    const std::uint32_t vertex = hull.furthest(d);
    for (std::uint32_t k = hull.vertex_first[vertex]; k < hull.vertex_first[vertex + 1]; ++k) {
        const ConvexHull::Face& face = hull.faces[hull.vertex_faces[k]];
        if (dot(d, face.n) > cosine) {
            found.add_normal(R * face.n);
            for (std::uint32_t i = face.first; i < face.first + std::min(face.count, 8u); ++i) {
                const ConvexHull::Edge& edge = hull.edges[hull.face_edges[i]];
                if (edge.a != vertex && edge.b != vertex && std::fabs(dot(d, edge.direction)) < sine)
                    found.add_edge(R * edge.direction);
            }
        }
        const ConvexHull::Edge& edge = hull.edges[hull.vertex_edges[k]];
        if (std::fabs(dot(d, edge.direction)) < sine) found.add_edge(R * edge.direction);
    }
}

bool ConvexBody::add_curvature(const Vec3& d, const Vec3& t1, const Vec3& t2, double& h11, double& h12,
                               double& h22) const {
    if (core_ == Core::kCylinder) {
        const Vec3 side = cross(posed_->axis(2), d);
        const double q_squared = norm_squared(side);
        if (q_squared < 1e-16) return false;
        const double curvature = posed_->shape.radius / (q_squared * std::sqrt(q_squared));
        const double m1 = dot(t1, side), m2 = dot(t2, side);
        h11 += curvature * m1 * m1, h12 += curvature * m1 * m2, h22 += curvature * m2 * m2;
    } else if (core_ == Core::kEllipsoid) {
        const Vec3& r = posed_->shape.half;
        const auto stretched = [&](const Vec3& v) { return scaled(transpose_times(posed_->X.R, v), r); };
        const Vec3 m = stretched(d), m1 = stretched(t1), m2 = stretched(t2);
        const double h = norm(m);
        const double x1 = dot(m, m1) / h, x2 = dot(m, m2) / h;
        h11 += (dot(m1, m1) - x1 * x1) / h;
        h12 += (dot(m1, m2) - x1 * x2) / h;
        h22 += (dot(m2, m2) - x2 * x2) / h;
    }
    return true;
}

}  // namespace roboss::narrow
