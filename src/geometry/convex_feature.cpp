// The features of a convex body along a direction, as polygons.
#include <algorithm>

#include "geometry/convex_body.h"
#include "geometry/cylinder_rim.h"
#include "geometry/support_line.h"

namespace roboss::narrow {

Feature ConvexBody::feature(const Vec3& d) const {
    switch (core_) {
        case Core::kBox:
            return box_face(d);
        case Core::kHull:
            return hull_face(d);
        case Core::kTriangle: {
            Feature f;
            const bool flipped = dot(d, normal_) < 0.0;
            f.n = flipped ? -normal_ : normal_;
            f.face_part = 6;
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t i = flipped ? 2 - k : k;
                f.add(corners_[i], i, flipped ? 3 + (i + 2) % 3 : 3 + i);
            }
            return f;
        }
        case Core::kCylinder: {
            const double along = dot(d, posed_->axis(2));
            if (along * along > 0.5 * norm_squared(d)) return cap(along > 0.0, d);
            return round_line(d, 1.0);
        }
        default:
            return line(d, 1.0);
    }
}

Vec3 ConvexBody::face_normal(const Vec3& d) const {
    switch (core_) {
        case Core::kBox:
            return BoxFace(*posed_, d).n;
        case Core::kHull: {
            const ConvexHull& hull = *posed_->shape.hull;
            const Vec3 d_S = transpose_times(posed_->X.R, d);
            return posed_->X.R * hull.faces[hull.face_along(d_S, hull.furthest(d_S))].n;
        }
        case Core::kTriangle:
            return dot(d, normal_) < 0.0 ? -normal_ : normal_;
        case Core::kCylinder: {
            const Vec3 u = posed_->axis(2);
            const double along = dot(d, u);
            if (along * along > 0.5 * norm_squared(d)) return along > 0.0 ? u : -u;
            return {};
        }
        default:
            return {};
    }
}

Feature ConvexBody::line(const Vec3& d, double tolerance) const {
    switch (core_) {
        case Core::kBox:
            return box_line(d, tolerance);
        case Core::kHull:
            return hull_line(d, tolerance);
        case Core::kTriangle:
            return triangle_line(d, tolerance);
        case Core::kCylinder:
        case Core::kSegment:
            return round_line(d, tolerance);
        default: {
            Feature f;
            f.add(centre_ + support(d), 0, 0);
            return f;
        }
    }
}

Feature ConvexBody::round_line(const Vec3& d, double tolerance) const {
    Feature f;
    const Vec3 u = posed_->axis(2), half = u * posed_->shape.half_length;
    const double along = dot(d, u);
    Vec3 side;
    if (core_ == Core::kCylinder) {
        const Vec3 radial = d - u * along;
        const double length = norm(radial);
        side = (length > 1e-12 ? radial / length : posed_->axis(0)) * posed_->shape.radius;
    }
    if (std::fabs(along) <= tolerance) {
        f.add(centre_ + side - half, 0, kLine);
        f.add(centre_ + side + half, 1, kLine);
    } else {
        f.add(centre_ + side + (along < 0.0 ? -half : half),
              core_ == Core::kCylinder ? kRim
              : along < 0.0            ? 0
                                       : 1,
              kLine);
    }
    return f;
}

Feature ConvexBody::cap(bool upper, const Vec3& d) const {
    constexpr double kDiagonal = 0.70710678118654752;
    Feature f;
    const Vec3 u = posed_->axis(2);
    const double r = posed_->shape.radius, l = posed_->shape.half_length;
    const Vec3 middle = centre_ + u * (upper ? l : -l);
    const std::array<Vec3, 4> rim = rim_directions(*posed_, -normalized(d));
    const std::uint32_t end = upper ? 1 : 0;
    f.n = upper ? u : -u;
    f.face_part = kCap + end;
    for (std::uint32_t k = 0; k < 8; ++k) {
        const std::uint32_t i = upper ? k : (8 - k) % 8;  // counter-clockwise about n
        const std::uint32_t quarter = i / 2, edge = 72 + 8 * end + (upper ? i : (i + 7) % 8);
        if (i % 2 == 0) {
            f.add(middle + rim[quarter] * r, kRimPoint + 4 * end + quarter, edge);
        } else {
            f.add(middle + (rim[quarter] + rim[(quarter + 1) % 4]) * (kDiagonal * r), 64 + 4 * end + quarter,
                  edge);
        }
    }
    return f;
}

Feature ConvexBody::box_face(const Vec3& d) const {
    const BoxFace face(*posed_, d);
    const bool flipped = face.side == 0;  // then ex x ey looks inward
    const Vec3 x = face.ex * face.hx, y = face.ey * face.hy;
    const std::array<Vec3, 4> corner{face.centre + x + y, face.centre - x + y, face.centre - x - y,
                                     face.centre + x - y};
    Feature f;
    f.n = face.n;
    f.face_part = kFacePart;
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t i = flipped ? 3 - k : k;
        f.add(corner[i], face.corner_part(i), face.edge_part_after(flipped ? (i + 3) % 4 : i));
    }
    return f;
}

Feature ConvexBody::box_line(const Vec3& d, double tolerance) const {
    const SupportLine line = support_line(*posed_, d, tolerance);
    Feature f;
    if (norm_squared(line.half) > 0.0) {
        f.add(line.middle - line.half, line.part0, line.part);
        f.add(line.middle + line.half, line.part1, line.part);
    } else {
        f.add(line.middle, line.part, line.part);
    }
    return f;
}

Feature ConvexBody::hull_face(const Vec3& d_W) const {
    const ConvexHull& hull = *posed_->shape.hull;
    const Vec3 d = transpose_times(posed_->X.R, d_W);
    const std::uint32_t vertex = hull.furthest(d);
    const std::uint32_t number = hull.face_along(d, vertex);
    const ConvexHull::Face& face = hull.faces[number];
    const auto vertex_count = static_cast<std::uint32_t>(hull.vertices.size());
    const auto edge_count = static_cast<std::uint32_t>(hull.edges.size());
    Feature f;
    f.n = posed_->X.R * face.n;
    f.face_part = (vertex_count + edge_count + number) & 0xFFFFu;
    // A face of very many corners is thinned out evenly, from the furthest one on.
    const auto kept = std::min(face.count, static_cast<std::uint32_t>(Feature::kMaxPoints));
    std::uint32_t first = 0;
    while (kept < face.count && hull.face_vertices[face.first + first] != vertex) ++first;
    for (std::uint32_t k = 0; k < kept; ++k) {
        const std::uint32_t i = face.first + (first + k * face.count / kept) % face.count;
        f.add(posed_->X * hull.vertices[hull.face_vertices[i]], hull.face_vertices[i] & 0xFFFFu,
              (vertex_count + hull.face_edges[i]) & 0xFFFFu);
    }
    return f;
}

Feature ConvexBody::hull_line(const Vec3& d_W, double tolerance) const {
    const ConvexHull& hull = *posed_->shape.hull;
    const Vec3 d = transpose_times(posed_->X.R, d_W);
    const std::uint32_t vertex = hull.furthest(d);
    double flattest = tolerance;
    std::uint32_t best = 0xFFFFFFFFu;
    for (std::uint32_t k = hull.vertex_first[vertex]; k < hull.vertex_first[vertex + 1]; ++k) {
        const double along = std::fabs(dot(d, hull.edges[hull.vertex_edges[k]].direction));
        if (along < flattest || (along == flattest && best == 0xFFFFFFFFu))
            flattest = along, best = hull.vertex_edges[k];
    }
    Feature f;
    const auto vertex_count = static_cast<std::uint32_t>(hull.vertices.size());
    if (best == 0xFFFFFFFFu) {
        f.add(posed_->X * hull.vertices[vertex], vertex, vertex);
    } else {
        const ConvexHull::Edge& edge = hull.edges[best];
        const std::uint32_t name = (vertex_count + best) & 0xFFFFu;
        f.add(posed_->X * hull.vertices[edge.a], edge.a, name);
        f.add(posed_->X * hull.vertices[edge.b], edge.b, name);
    }
    return f;
}

Feature ConvexBody::triangle_line(const Vec3& d, double tolerance) const {
    std::array<double, 3> height{dot(d, corners_[0]), dot(d, corners_[1]), dot(d, corners_[2])};
    const std::uint32_t top = height[0] >= height[1] && height[0] >= height[2] ? 0
                              : height[1] >= height[2]                         ? 1
                                                                               : 2;
    const std::uint32_t next = (top + 1) % 3, last = (top + 2) % 3;
    const double fall_next = (height[top] - height[next]) / norm(corners_[next] - corners_[top]);
    const double fall_last = (height[top] - height[last]) / norm(corners_[last] - corners_[top]);
    Feature f;
    if (std::min(fall_next, fall_last) > tolerance) {
        f.add(corners_[top], top, top);
    } else if (fall_next <= fall_last) {
        f.add(corners_[top], top, 3 + top);
        f.add(corners_[next], next, 3 + top);
    } else {
        f.add(corners_[last], last, 3 + last);
        f.add(corners_[top], top, 3 + last);
    }
    return f;
}

}  // namespace roboss::narrow
