// See submerged.h. In the shape's frame the part is that with n.x < d, n a unit vector.
#include "geometry/submerged.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/fixed_math.h"
#include "geometry/convex_hull.h"

namespace roboss {
namespace {

/// Sphere about the origin: z^2 integrates to the cap.
Submerged part_of_sphere(double r, const Vec3& n, double d) {
    const double t = std::clamp(d, -r, r), rest = r * r - t * t;
    return {kPi * (2 * r * r * r / 3 + t * (r * r - t * t / 3)), n * (-0.25 * kPi * rest * rest)};
}

/// An ellipsoid is a sphere that was stretched.
Submerged part_of_ellipsoid(const Vec3& radii, const Vec3& n, double d) {
    const Vec3 stretched{radii.x * n.x, radii.y * n.y, radii.z * n.z};
    const double length = norm(stretched), scale = radii.x * radii.y * radii.z;
    const Submerged unit = part_of_sphere(1, stretched * (1 / length), d / length);
    const Vec3& m = unit.moment;
    return {unit.volume * scale, Vec3{radii.x * m.x, radii.y * m.y, radii.z * m.z} * scale};
}

/// Sums the tetrahedra between a point on the plane and what lies below of a solid's faces: the cut itself
/// lies in the plane and adds nothing.
class FaceCutter {
  public:
    FaceCutter(const Vec3& n, double d) : n_(n), d_(d), apex_(n * d) {}

    /// A corner of the loop round a face, counter-clockwise seen from outside.
    void add(const Vec3& corner) {
        const double height = dot(n_, corner) - d_;
        if (count_++ == 0) {
            start_ = corner, start_height_ = height;
        } else {
            go(corner, height);
        }
        last_ = corner, last_height_ = height;
        if (count_ == 1 && height <= 0) emit(corner);
    }
    void end_face() {
        if (count_ > 0) go(start_, start_height_);
        count_ = emitted_ = 0;
    }
    Submerged sum() const { return sum_; }

  private:
    /// Along an edge from the last corner.
    void go(const Vec3& corner, double height) {
        if ((last_height_ <= 0) != (height <= 0))
            emit(last_ + (corner - last_) * (last_height_ / (last_height_ - height)));
        if (height <= 0) emit(corner);
    }
    /// A corner of the part of the face that lies below.
    void emit(const Vec3& p) {
        if (emitted_++ == 0) {
            first_ = p;
        } else if (emitted_ > 2) {
            const Vec3 a = first_ - apex_, b = previous_ - apex_, c = p - apex_;
            const double volume = dot(a, cross(b, c)) / 6;
            sum_.volume += volume;
            sum_.moment += (apex_ + (a + b + c) * 0.25) * volume;
        }
        previous_ = p;
    }

    Vec3 n_;
    double d_;
    Vec3 apex_, start_, last_, first_, previous_;
    double start_height_ = 0, last_height_ = 0;
    int count_ = 0, emitted_ = 0;
    Submerged sum_;
};

Submerged part_of_box(const Vec3& half, const Vec3& n, double d) {
    // corner k: bit i set: the positive side of axis i
    static constexpr std::array<std::array<unsigned, 4>, 6> kFaces{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    FaceCutter cutter(n, d);
    for (const auto& face : kFaces) {
        for (const unsigned k : face)
            cutter.add({(k & 1u) != 0 ? half.x : -half.x, (k & 2u) != 0 ? half.y : -half.y,
                        (k & 4u) != 0 ? half.z : -half.z});
        cutter.end_face();
    }
    return cutter.sum();
}

Submerged part_of_hull(const ConvexHull& hull, const Vec3& n, double d) {
    FaceCutter cutter(n, d);
    for (const ConvexHull::Face& face : hull.faces) {
        for (std::uint32_t k = 0; k < face.count; ++k)
            cutter.add(hull.vertices[hull.face_vertices[face.first + k]]);
        cutter.end_face();
    }
    return cutter.sum();
}

/// Antiderivatives of c, x c and x^2 c with c = sqrt(r^2 - x^2).
struct DiscIntegrals {
    double one = 0, x = 0, xx = 0;

    static DiscIntegrals at(double r, double x) {
        const double c = std::sqrt(std::max(r * r - x * x, 0.0));
        const double area = 0.5 * (x * c + r * r * fixed_atan2(x, c));
        return {area, -c * c * c / 3, 0.25 * (r * r * area - x * c * c * c)};
    }
    friend DiscIntegrals operator-(const DiscIntegrals& a, const DiscIntegrals& b) {
        return {a.one - b.one, a.x - b.x, a.xx - b.xx};
    }
};

/// n in a plane through the shape's z axis: its part along z, and that across with its direction.
struct Tilt {
    double along = 0, across = 0;
    Vec3 direction{1, 0, 0};
};

Tilt tilt_of(const Vec3& n) {
    constexpr double kLeast = 1e-14;
    Tilt tilt;
    tilt.along = n.z;
    tilt.across = std::sqrt(n.x * n.x + n.y * n.y);
    if (tilt.across > kLeast)
        tilt.direction = Vec3{n.x, n.y, 0} * (1 / tilt.across);
    else
        tilt.across = kLeast;
    return tilt;
}

/// Volume and moments along x and z of a part of a cylinder, halved.
struct StripSums {
    double volume = 0, x = 0, z = 0;
};

/// Strips at x with 2 c across, filled from -L to a - b x.
StripSums wide_strips(double r, double L, double a, double b, double x1, double x2) {
    const DiscIntegrals cut = DiscIntegrals::at(r, x2) - DiscIntegrals::at(r, x1);
    return {(a + L) * cut.one - b * cut.x, (a + L) * cut.x - b * cut.xx,
            0.5 * ((a * a - L * L) * cut.one - 2 * a * b * cut.x + b * b * cut.xx)};
}

/// The same where they are few: differences of the integrals would lose digits. Gauss and Legendre's rule of
/// six points over x = r sin(phi); `from`, `to`: where the strips are filled to L and to -L.
StripSums narrow_strips(double r, double L, double from, double to, double x1, double x2) {
    constexpr double kPlace[] = {0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
    constexpr double kWeight[] = {0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
    if (!(to > from) || !(x2 > x1)) return {};
    const double a = fixed_asin(x1 / r), b = fixed_asin(x2 / r);
    StripSums sums;
    for (std::size_t k = 0; k < 6; ++k) {
        const double place = (k < 3 ? 1 : -1) * kPlace[k % 3];
        const SinCos at = fixed_sincos(0.5 * (a + b) + 0.5 * (b - a) * place);
        const double x = r * at.sin, z = std::clamp(L - 2 * L * (x - from) / (to - from), -L, L);
        const double c = 0.5 * (b - a) * kWeight[k % 3] * r * r * at.cos * at.cos;  // c dx
        sums.volume += c * (z + L), sums.x += c * x * (z + L), sums.z += 0.5 * c * (z * z - L * L);
    }
    return sums;
}

/// A cylinder from -L to L along z: at x across, it is filled up to z = (d - across x) / along.
Submerged part_of_cylinder(double r, double L, const Vec3& n, double d) {
    constexpr double kNarrow = 0.05;  // of the radius
    const Tilt tilt = tilt_of(n);
    const double nx = tilt.across, nz = std::fabs(tilt.along), side = tilt.along < 0 ? -1.0 : 1.0;
    const double from = (d - nz * L) / nx, to = (d + nz * L) / nx;
    const double x1 = std::clamp(from, -r, r), x2 = std::clamp(to, -r, r);
    const DiscIntegrals full = DiscIntegrals::at(r, x1) - DiscIntegrals::at(r, -r);
    const StripSums cut = x2 - x1 < kNarrow * r ? narrow_strips(r, L, from, to, x1, x2)
                                                : wide_strips(r, L, d / nz, nx / nz, x1, x2);
    return {4 * L * full.one + 2 * cut.volume,
            tilt.direction * (4 * L * full.x + 2 * cut.x) + Vec3{0, 0, 2 * side * cut.z}};
}

/// Volume and moments along n and along m, at right angles to it, of a part of a half ball.
struct HalfBallPart {
    double volume = 0, n = 0, m = 0;
};

/// Slices t n of the half ball z > 0 from t1 to t2 that are whole discs.
HalfBallPart whole_discs(double r, double t1, double t2) {
    if (!(t2 > t1)) return {};
    const auto at = [r](double t) {
        return HalfBallPart{kPi * t * (r * r - t * t / 3), kPi * t * t * (0.5 * r * r - 0.25 * t * t), 0};
    };
    const HalfBallPart a = at(t1), b = at(t2);
    return {b.volume - a.volume, b.n - a.n, 0};
}

/// Antiderivatives over the slices t = r across s, s = sin(phi), which are segments of discs: the half ball's
/// flat side cuts them. By parts from V = int A dt, A = R^2 theta + r^2 along s c with R^2 = r^2 (1 -
/// (across s)^2) and theta = atan2(c, -along s).
HalfBallPart cut_discs(double r, double along, double across, double s, double c) {
    const double phi = fixed_atan2(s, c), theta = fixed_atan2(c, -along * s);
    const double aa = across * across;
    const double slope = along < 0 ? -fixed_atan2(across * c, -along) : fixed_atan2(across * c, along);
    const double sin_4 = 4 * s * c * (1 - 2 * s * s), sin_2 = 2 * s * c;
    HalfBallPart part;
    const double p = s * (1 - aa * s * s / 3);
    part.volume =
        r * r * r * (across * (p * theta + along * c / 3 - along * c * c * c / 3) + 2.0 / 3 * slope);
    const double q = s * s * (0.5 - 0.25 * aa * s * s);
    const double inner =
        q * theta - 0.25 * along * (0.5 * phi - 0.5 * s * c) + along * (phi / 8 - sin_4 / 32);
    part.n = r * r * r * r * (aa * inner - 0.25 * (fixed_atan2(along * s, c) - along * phi));
    part.m = 2.0 / 3 * r * r * r * r * across * (0.375 * phi + 0.25 * sin_2 + sin_4 / 32);
    return part;
}

/// The half ball z > 0 about the origin.
Submerged part_of_half_ball(double r, const Vec3& n, double d) {
    Tilt tilt = tilt_of(n);
    if (std::fabs(tilt.along) < 1e-18) tilt.along = 1e-18;
    const double rim = r * tilt.across, top = std::clamp(d, -r, r);
    HalfBallPart sum = tilt.along > 0 ? whole_discs(r, rim, top) : whole_discs(r, -r, std::min(-rim, top));
    if (top > -rim) {
        const double s = std::min(top / rim, 1.0);
        const double c = s < 1 ? std::sqrt((1 - s) * (1 + s)) : 0.0;
        const HalfBallPart a = cut_discs(r, tilt.along, tilt.across, -1, 0),
                           b = cut_discs(r, tilt.along, tilt.across, s, c);
        sum.volume += b.volume - a.volume, sum.n += b.n - a.n, sum.m += b.m - a.m;
    }
    const Vec3 m = Vec3{0, 0, tilt.across} - tilt.direction * tilt.along;
    return {sum.volume, n * sum.n + m * sum.m};
}

/// Adds a part about a point that stands at z in the shape's frame; `side` -1: mirrored at z = 0.
void add_part(const Submerged& part, double side, double z, Submerged& sum) {
    sum.volume += part.volume;
    sum.moment += Vec3{part.moment.x, part.moment.y, side * part.moment.z + z * part.volume};
}

Submerged part_of_capsule(double r, double L, const Vec3& n, double d) {
    Submerged sum = part_of_cylinder(r, L, n, d);
    add_part(part_of_half_ball(r, n, d - n.z * L), 1, L, sum);
    add_part(part_of_half_ball(r, {n.x, n.y, -n.z}, d + n.z * L), -1, -L, sum);
    return sum;
}

Submerged part_below(const Shape& shape, const Vec3& n, double d) {
    switch (shape.kind) {
        case ShapeKind::kSphere:
            return part_of_sphere(shape.radius, n, d);
        case ShapeKind::kBox:
            return part_of_box(shape.half, n, d);
        case ShapeKind::kCylinder:
            return part_of_cylinder(shape.radius, shape.half_length, n, d);
        case ShapeKind::kCapsule:
            return part_of_capsule(shape.radius, shape.half_length, n, d);
        case ShapeKind::kEllipsoid:
            return part_of_ellipsoid(shape.half, n, d);
        case ShapeKind::kHull:
            return part_of_hull(*shape.hull, n, d);
        default:
            return {};
    }
}

}  // namespace

double solid_volume(const Shape& shape) {
    const double disc = kPi * shape.radius * shape.radius;
    switch (shape.kind) {
        case ShapeKind::kSphere:
            return 4.0 / 3 * disc * shape.radius;
        case ShapeKind::kBox:
            return 8 * shape.half.x * shape.half.y * shape.half.z;
        case ShapeKind::kCylinder:
            return 2 * disc * shape.half_length;
        case ShapeKind::kCapsule:
            return disc * (2 * shape.half_length + 4.0 / 3 * shape.radius);
        case ShapeKind::kEllipsoid:
            return 4.0 / 3 * kPi * shape.half.x * shape.half.y * shape.half.z;
        case ShapeKind::kHull:
            return shape.hull->volume;
        default:
            return 0;
    }
}

Submerged submerged_part(const Shape& shape, const Transform& X_WS, double height) {
    const double d = height - X_WS.p.z, radius = bounding_radius(shape);
    if (d >= radius) return {solid_volume(shape), {}};
    if (d <= -radius || !std::isfinite(radius)) return {};
    const Submerged part = part_below(shape, X_WS.R.r2, d);
    return {part.volume, X_WS.R * part.moment};
}

}  // namespace roboss
