// Everything is cut exactly: a disc is cut in its own plane by the sides of the prism over the face, so no
// step assumes that two faces are nearly parallel (but for disc against disc, whose crossings are those of
// the untilted circles).
#include "geometry/face_region.h"

#include <algorithm>
#include <limits>

#include "geometry/cylinder_rim.h"

namespace roboss::narrow {
namespace {

constexpr double kMergeFraction = 1e-4;  // of the smaller size: points closer than that are one
constexpr double kBorderFraction =
    1e-7;  // how far outside the border a face still touches when nothing is inside

double smallest_side(const Posed& s) {
    switch (s.shape.kind) {
        case ShapeKind::kBox:
            return std::min(s.shape.half.x, std::min(s.shape.half.y, s.shape.half.z));
        case ShapeKind::kCylinder:
            return s.shape.radius;
        default:
            return std::max(s.shape.radius, s.shape.half_length);
    }
}

/// A disc or rectangle seen from the face: centre and the two spanning vectors, in the face's coordinates.
struct Span {
    Vec3 c, a, b;

    /// Coordinates (alpha, beta) of the point of this plane over (x, y); the planes must not be
    /// perpendicular.
    void coordinates(double x, double y, double& alpha, double& beta) const {
        const double dx = x - c.x, dy = y - c.y, determinant = a.x * b.y - a.y * b.x;
        alpha = (dx * b.y - dy * b.x) / determinant;
        beta = (a.x * dy - a.y * dx) / determinant;
    }
    bool upright() const { return std::fabs(a.x * b.y - a.y * b.x) < 1e-6 * norm(a) * norm(b); }
    Vec3 at(double alpha, double beta) const { return c + a * alpha + b * beta; }
};

ClippedPoint point(const Vec3& p, std::uint32_t part, std::uint32_t reference_part) {
    return {p.x, p.y, p.z, part, reference_part};
}

/// Cuts the parameter range [t0, t1] of p + d t by the outline; edge0 and edge1 name the rectangle's sides
/// that cut.
struct Cut {
    double t0 = 0, t1 = 1;
    std::uint32_t edge0 = kFacePart, edge1 = kFacePart;
    bool empty = false;

    void side(double p, double d, double half, std::uint32_t edge) {  // keep p + d t <= half
        if (d == 0.0) {
            empty |= p > half;
        } else if (const double t = (half - p) / d; d > 0.0) {
            if (t < t1) t1 = t, edge1 = edge;
        } else if (t > t0) {
            t0 = t, edge0 = edge;
        }
    }
    void disc(const Vec3& p, const Vec3& d, double radius) {
        const double a = d.x * d.x + d.y * d.y, b = p.x * d.x + p.y * d.y;
        const double c = p.x * p.x + p.y * p.y - radius * radius;
        if (a < 1e-20 * radius * radius) {
            empty |= c > 0.0;
            return;
        }
        const double discriminant = b * b - a * c;
        empty |= discriminant < 0.0;
        if (empty) return;
        const double root = std::sqrt(discriminant);
        if ((-b - root) / a > t0) t0 = (-b - root) / a, edge0 = kRim;
        if ((root - b) / a < t1) t1 = (root - b) / a, edge1 = kRimLeft;
    }
};

Cut cut(const FaceRegion& face, const Vec3& p, const Vec3& d) {
    Cut c;
    if (face.round) {
        c.disc(p, d, face.hx);
    } else {
        c.side(p.x, d.x, face.hx, face.edge_at(false, true));
        c.side(-p.x, -d.x, face.hx, face.edge_at(false, false));
        c.side(p.y, d.y, face.hy, face.edge_at(true, true));
        c.side(-p.y, -d.y, face.hy, face.edge_at(true, false));
    }
    c.empty |= c.t0 > c.t1;
    return c;
}

/// A straight line (a lying cylinder's or a capsule's) from p to q, `lift` above which its surface begins.
void add_line(const FaceRegion& face, const Vec3& p, const Vec3& q, double lift, Candidates& out) {
    const Vec3 d = q - p;
    const Cut c = cut(face, p, d);
    if (c.empty) return;
    const Vec3 down{0, 0, lift};
    const bool whole0 = c.t0<kMergeFraction, whole1 = c.t1> 1.0 - kMergeFraction;
    out.add(point(p + d * c.t0 - down, whole0 ? 0 : kLine, whole0 ? kFacePart : c.edge0));
    out.add(point(p + d * c.t1 - down, whole1 ? 1 : kLine, whole1 ? kFacePart : c.edge1));
}

/// Rim of an incident disc (radius folded into a and b) against the sides of a rectangular face.
void add_rim_crossings(const FaceRegion& face, const Span& disc, std::uint32_t end, Candidates& out) {
    for (int k = 0; k < 4; ++k) {
        const bool along_y = k >= 2, positive = k % 2 == 0;
        const double a = along_y ? disc.a.y : disc.a.x, b = along_y ? disc.b.y : disc.b.x;
        const double half = along_y ? face.hy : face.hx;
        const double level = (positive ? half : -half) - (along_y ? disc.c.y : disc.c.x);
        const double squared = a * a + b * b, rest = squared - level * level;
        if (rest <= 0.0) continue;
        const double root = std::sqrt(rest);
        for (std::uint32_t which = 0; which < 2; ++which) {
            const double r = which == 0 ? root : -root;
            const Vec3 p = disc.at((a * level - b * r) / squared, (b * level + a * r) / squared);
            const double across = along_y ? p.x : p.y, limit = along_y ? face.hx : face.hy;
            if (std::fabs(across) > limit) continue;
            out.add(point(p, kRimCrossing + 2 * end + which, face.edge_at(along_y, positive)));
        }
    }
}

/// Moves (alpha, beta) along the disc's rim until it lies over the face's rim; false when it does not get
/// there.
bool slide_to_rim(const Span& disc, double radius, double& alpha, double& beta) {
    constexpr int kSteps = 8;
    for (int i = 0; i < kSteps; ++i) {
        const double length = std::sqrt(alpha * alpha + beta * beta);
        alpha /= length;
        beta /= length;
        const Vec3 p = disc.at(alpha, beta),
                   along = disc.b * alpha - disc.a * beta;  // derivative by the angle
        const double excess = p.x * p.x + p.y * p.y - radius * radius,
                     slope = 2.0 * (p.x * along.x + p.y * along.y);
        if (std::fabs(excess) <= 1e-13 * radius * radius) return true;
        if (std::fabs(slope) < 1e-9 * radius * radius) return false;
        const double turn = -excess / slope, a = alpha;
        alpha -= beta * turn;
        beta += a * turn;
    }
    return false;
}

/// The crossings of the face's circle and the incident disc's ellipse, from those of the untilted circles.
void add_circle_crossings(const FaceRegion& face, const Span& disc, double radius, std::uint32_t end,
                          Candidates& out) {
    const double d_squared = disc.c.x * disc.c.x + disc.c.y * disc.c.y;
    if (d_squared < 1e-8 * radius * radius) return;
    const double along = (d_squared + face.hx * face.hx - radius * radius) / (2.0 * d_squared);
    const double rest = face.hx * face.hx / d_squared - along * along;
    if (rest <= 0.0) return;
    for (std::uint32_t which = 0; which < 2; ++which) {
        const double side = which == 0 ? std::sqrt(rest) : -std::sqrt(rest);
        double alpha = 0, beta = 0;
        disc.coordinates(along * disc.c.x - side * disc.c.y, along * disc.c.y + side * disc.c.x, alpha, beta);
        if (!slide_to_rim(disc, face.hx, alpha, beta)) continue;
        out.add(point(disc.at(alpha, beta), kRimCrossing + 2 * end + which,
                      kRimCrossing + 2 * face.end() + which));
    }
}

/// The face's own corners (rectangle) or rim points (disc) that lie under the incident disc or rectangle.
template <class Inside>
void add_reference_points(const FaceRegion& face, const Span& span, const Vec3& other_normal,
                          std::uint32_t other_part, Inside inside, Candidates& out) {
    if (span.upright()) return;
    const auto add = [&](double x, double y, std::uint32_t part) {
        double alpha = 0, beta = 0;
        span.coordinates(x, y, alpha, beta);
        if (inside(alpha, beta)) out.add(point(span.at(alpha, beta), other_part, part));
    };
    if (face.round) {
        std::uint32_t part = kRimPoint + 4 * face.end();
        for (const Vec3& radial : rim_directions(face.owner, other_normal)) {
            add(dot(face.ex, radial) * face.hx, dot(face.ey, radial) * face.hx, part++);
        }
        return;
    }
    const std::uint32_t side = static_cast<std::uint32_t>(face.upper) << face.axis;
    for (std::uint32_t c = 0; c < 4; ++c) {
        const bool px = (c & 1u) != 0, py = (c & 2u) != 0;
        add(px ? face.hx : -face.hx, py ? face.hy : -face.hy,
            side | (c & 1u) << (face.axis + 1) % 3 | (c >> 1) << (face.axis + 2) % 3);
    }
}

void add_disc(const FaceRegion& face, const Posed& cylinder, double tolerance, Candidates& out) {
    const double r = cylinder.shape.radius, l = cylinder.shape.half_length;
    const Vec3 u = cylinder.axis(2);
    const bool upper = dot(u, face.n) < 0.0;  // the end that looks at the face
    const std::uint32_t end = upper ? 1 : 0;
    const std::array<Vec3, 4> radial = rim_directions(cylinder, face.n);
    const Span disc{face.local(cylinder.X.p + u * (upper ? l : -l)), face.local_vector(radial[0]) * r,
                    face.local_vector(radial[1]) * r};
    // Stacked cans of one size: rounding must not take points off the common rim.
    const double border = face.round && std::fabs(dot(u, face.n)) > 0.9998 ? tolerance : 0.0;
    int inside_count = 0;
    for (std::uint32_t i = 0; i < 4; ++i) {
        const double alpha = i == 0 ? 1.0 : i == 2 ? -1.0 : 0.0, beta = i == 1 ? 1.0 : i == 3 ? -1.0 : 0.0;
        const Vec3 p = disc.at(alpha, beta);
        if (face.clearance(p.x, p.y) < -border) continue;
        out.add(point(p, kRimPoint + 4 * end + i, kFacePart));
        ++inside_count;
    }
    if (inside_count == 4 && (face.round || face.clearance(disc.c.x, disc.c.y) >= r)) return;
    const auto inside = [](double alpha, double beta) { return alpha * alpha + beta * beta <= 1.0; };
    add_reference_points(face, disc, upper ? u : -u, kCap + end, inside, out);
    if (face.round) {
        add_circle_crossings(face, disc, r, end, out);
    } else {
        add_rim_crossings(face, disc, end, out);
    }
}

/// A box's nearest face over a cap.
void add_box_face(const FaceRegion& face, const Posed& box, Candidates& out) {
    const BoxFace incident(box, -face.n);
    const Span span{face.local(incident.centre), face.local_vector(incident.ex) * incident.hx,
                    face.local_vector(incident.ey) * incident.hy};
    const std::array<Vec3, 4> corner{span.at(1, 1), span.at(-1, 1), span.at(-1, -1), span.at(1, -1)};
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3& p = corner[i];
        const bool inside = face.clearance(p.x, p.y) >= 0.0;
        if (inside) out.add(point(p, incident.corner_part(i), kCap + face.end()));
        const Vec3 d = corner[(i + 1) % 4] - p;
        const Cut c = cut(face, p, d);
        if (c.empty) continue;
        const std::uint32_t edge = incident.edge_part_after(i);
        if (c.t0 > 0.0) out.add(point(p + d * c.t0, edge, kRimCrossing + 2 * face.end()));
        if (c.t1 < 1.0) out.add(point(p + d * c.t1, edge, kRimCrossing + 2 * face.end() + 1));
    }
    const auto inside = [](double alpha, double beta) {
        return std::fabs(alpha) <= 1.0 && std::fabs(beta) <= 1.0;
    };
    add_reference_points(face, span, incident.n, kFacePart, inside, out);
}

void add_cylinder(const FaceRegion& face, const Posed& cylinder, double tolerance, Candidates& out) {
    const Vec3 u = cylinder.axis(2);
    const double rise = dot(u, face.n);
    if (rise * rise > 0.5) return add_disc(face, cylinder, tolerance, out);
    const Vec3 down = u * rise - face.n;
    const Vec3 line = cylinder.X.p + down * (cylinder.shape.radius / norm(down));
    const Vec3 half = u * cylinder.shape.half_length;
    add_line(face, face.local(line - half), face.local(line + half), 0.0, out);
}

}  // namespace

void Candidates::add(const ClippedPoint& candidate) {
    for (std::size_t i = 0; i < count_; ++i) {
        ClippedPoint& p = points_[i];
        if (std::fabs(p.x - candidate.x) > tolerance_ || std::fabs(p.y - candidate.y) > tolerance_) continue;
        if (candidate.gap < p.gap) p.x = candidate.x, p.y = candidate.y, p.gap = candidate.gap;
        return;
    }
    if (count_ < points_.size()) points_[count_++] = candidate;
}

void Candidates::reduce() {
    constexpr std::size_t kKept = 8;
    if (count_ <= kKept) return;
    const auto begin = points_.begin();
    const auto end = begin + static_cast<long>(count_);
    std::iter_swap(begin,
                   std::min_element(begin, end, [](const auto& p, const auto& q) { return p.gap < q.gap; }));
    for (std::size_t kept = 1; kept < kKept; ++kept) {
        std::size_t furthest = kept;
        double furthest_squared = -1.0;
        for (std::size_t i = kept; i < count_; ++i) {
            double nearest = std::numeric_limits<double>::infinity();
            for (std::size_t j = 0; j < kept; ++j) {
                const double dx = points_[i].x - points_[j].x, dy = points_[i].y - points_[j].y;
                nearest = std::min(nearest, dx * dx + dy * dy);
            }
            if (nearest > furthest_squared) furthest_squared = nearest, furthest = i;
        }
        std::swap(points_[kept], points_[furthest]);
    }
    count_ = kKept;
}

double Candidates::deepest() const {
    double gap = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count_; ++i) gap = std::min(gap, points_[i].gap);
    return gap;
}

FaceRegion::FaceRegion(const Posed& shape, std::size_t across, const Vec3& d) : owner(shape), axis(across) {
    const Vec3 normal = shape.axis(axis);
    upper = dot(normal, d) > 0.0;
    n = upper ? normal : -normal;
    ex = shape.axis((axis + 1) % 3);
    ey = shape.axis((axis + 2) % 3);
    round = shape.shape.kind == ShapeKind::kCylinder;
    hx = round ? shape.shape.radius : shape.shape.half[(axis + 1) % 3];
    hy = round ? shape.shape.radius : shape.shape.half[(axis + 2) % 3];
    centre = shape.X.p + n * (round ? shape.shape.half_length : shape.shape.half[axis]);
}

double FaceRegion::clearance(double x, double y) const {
    if (round) return hx - std::sqrt(x * x + y * y);
    return std::min(hx - std::fabs(x), hy - std::fabs(y));
}

std::uint32_t FaceRegion::edge_at(bool along_y, bool positive) const {
    const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
    const std::uint32_t sign = positive ? 1 : 0;
    return along_y ? edge_part(i, sign, end()) : edge_part(j, end(), sign);
}

namespace {

Candidates points_inside(const FaceRegion& face, const Posed& other, double tolerance) {
    Candidates out(tolerance);
    switch (other.shape.kind) {
        case ShapeKind::kBox:
            if (face.round) {
                add_box_face(face, other, out);
            } else {
                const ClippedFace clipped =
                    clip(BoxFace(face.owner, face.axis, face.upper), BoxFace(other, -face.n));
                for (int i = 0; i < clipped.count; ++i) out.add(clipped.points[static_cast<std::size_t>(i)]);
            }
            break;
        case ShapeKind::kCylinder:
            add_cylinder(face, other, tolerance, out);
            break;
        case ShapeKind::kCapsule: {
            const Vec3 half = other.axis(2) * other.shape.half_length;
            add_line(face, face.local(other.X.p - half), face.local(other.X.p + half), other.shape.radius,
                     out);
            break;
        }
        default:
            break;
    }
    out.reduce();
    return out;
}

}  // namespace

Candidates points_over(const FaceRegion& face, const Posed& other) {
    const double size = std::min(smallest_side(face.owner), smallest_side(other));
    const Candidates inside = points_inside(face, other, kMergeFraction * size);
    if (inside.count() > 0) return inside;
    FaceRegion wider = face;
    wider.hx += kBorderFraction * size;
    wider.hy += kBorderFraction * size;
    return points_inside(wider, other, kMergeFraction * size);
}

}  // namespace roboss::narrow
