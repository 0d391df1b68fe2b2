// Lines of boxes (edges), cylinders (on the side) and capsules (the core moved out to the surface).
#include "geometry/support_line.h"

#include <algorithm>
#include <limits>

namespace roboss::narrow {
namespace {

SupportLine box_line(const Posed& box, const Vec3& d, double tolerance) {
    const Vec3 along = transpose_times(box.X.R, d);
    std::size_t flat = 0;
    for (std::size_t i = 1; i < 3; ++i) {
        if (std::fabs(along[i]) < std::fabs(along[flat])) flat = i;
    }
    const bool is_edge = std::fabs(along[flat]) <= tolerance;
    SupportLine line;
    line.middle = box.X.p;
    std::uint32_t corner = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 half = box.axis(i) * box.shape.half[i];
        if (is_edge && i == flat) {
            line.half = half;
        } else {
            line.middle += along[i] > 0.0 ? half : -half;
            corner |= (along[i] > 0.0 ? 1u : 0u) << i;
        }
    }
    line.part0 = line.part1 = line.part = corner;
    if (is_edge) {
        line.part1 = corner | 1u << flat;
        line.part = edge_part(flat, corner >> (flat + 1) % 3 & 1u, corner >> (flat + 2) % 3 & 1u);
    }
    return line;
}

SupportLine round_line(const Posed& shape, const Vec3& d, double tolerance) {
    const bool cylinder = shape.shape.kind == ShapeKind::kCylinder;
    const Vec3 u = shape.axis(2);
    const double along = dot(d, u);
    Vec3 outward = d;
    if (cylinder) {
        const Vec3 radial = d - u * along;
        const double length = norm(radial);
        outward = length > 1e-12 ? radial / length : shape.axis(0);
    }
    const Vec3 surface = shape.X.p + outward * shape.shape.radius;
    const Vec3 half = u * shape.shape.half_length;
    if (std::fabs(along) <= tolerance) return {surface, half, 0, 1, kLine};
    const std::uint32_t end = along > 0.0 ? 1 : 0;
    const std::uint32_t part = cylinder ? kRim : end;
    return {surface + (along > 0.0 ? half : -half), {}, part, part, part};
}

std::uint32_t part_at(const SupportLine& line, double parameter) {
    constexpr double kEnd = 1.0 - 1e-4;
    return parameter >= kEnd ? line.part1 : parameter <= -kEnd ? line.part0 : line.part;
}

}  // namespace

SupportLine support_line(const Posed& shape, const Vec3& d, double tolerance) {
    return shape.shape.kind == ShapeKind::kBox ? box_line(shape, d, tolerance)
                                               : round_line(shape, d, tolerance);
}

LineParameters closest_parameters(const SupportLine& a, const SupportLine& b) {
    const Vec3 r = a.middle - b.middle;
    const double aa = norm_squared(a.half), bb = norm_squared(b.half), ab = dot(a.half, b.half);
    const double ar = dot(a.half, r), br = dot(b.half, r);
    const double determinant = aa * bb - ab * ab;
    LineParameters p;
    if (determinant > 1e-14 * aa * bb) p.s = std::clamp((ab * br - bb * ar) / determinant, -1.0, 1.0);
    if (bb > 0.0) {
        p.t = (ab * p.s + br) / bb;
        if (std::fabs(p.t) <= 1.0 && determinant > 1e-14 * aa * bb) return p;
        p.t = std::clamp(p.t, -1.0, 1.0);
    }
    if (aa > 0.0) p.s = std::clamp((ab * p.t - ar) / aa, -1.0, 1.0);
    return p;
}

bool common_part(const SupportLine& a, const SupportLine& b, double width,
                 std::array<LineParameters, 2>& ends) {
    constexpr double kParallel = 0.01;  // sine of the angle
    const double aa = norm_squared(a.half), bb = norm_squared(b.half), ab = dot(a.half, b.half);
    const double shorter = std::min(aa, bb);
    if (shorter == 0.0) return false;
    const double sine_squared = norm_squared(cross(a.half, b.half)) / (aa * bb);
    if (sine_squared > kParallel * kParallel || sine_squared * shorter > width * width) return false;
    // b's ends in a's parameter
    const double middle = dot(b.middle - a.middle, a.half) / aa, reach = std::fabs(ab) / aa;
    const double low = std::max(-1.0, middle - reach), high = std::min(1.0, middle + reach);
    if (!(high - low > 1e-4)) return false;
    const double slope = ab / bb, shift = dot(a.middle - b.middle, b.half) / bb;
    const auto on_b = [&](double s) { return std::clamp(shift + slope * s, -1.0, 1.0); };
    ends = {LineParameters{low, on_b(low)}, LineParameters{high, on_b(high)}};
    return true;
}

TouchingLines find_touching(const LinePair& pair) {
    const SupportLine& a = pair.a;
    SupportLine b = pair.b;
    b.middle += pair.n * pair.gap;
    const auto touches = [&](const LineParameters& p) {
        const Vec3 d = (a.middle + a.half * p.s) - (b.middle + b.half * p.t);
        return norm(d - pair.n * dot(pair.n, d)) <= pair.width;
    };
    TouchingLines found;
    if (common_part(a, b, pair.width, found.at) && touches(found.at[0]) && touches(found.at[1])) {
        found.count = 2;
        return found;
    }
    found.at[0] = closest_parameters(a, b);
    found.count = touches(found.at[0]) ? 1 : 0;
    return found;
}

double add_lines(const LinePair& pair, double margin, Manifold& out) {
    const SupportLine &a = pair.a, &b = pair.b;
    const TouchingLines found = find_touching(pair);
    double smallest = std::numeric_limits<double>::infinity();
    if (found.count == 0) return smallest;
    out.n_W = pair.n;
    for (std::size_t i = 0; i < found.count; ++i) {
        const LineParameters& p = found.at[i];
        const Vec3 on_a = a.middle + a.half * p.s, on_b = b.middle + b.half * p.t;
        const double gap = dot(pair.n, on_a - on_b);
        smallest = std::min(smallest, gap);
        if (gap <= margin) out.add((on_a + on_b) * 0.5, gap, feature_of(part_at(a, p.s), part_at(b, p.t)));
    }
    return smallest;
}

}  // namespace roboss::narrow
