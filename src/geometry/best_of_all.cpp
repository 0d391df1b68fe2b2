// See best_of_all.h.
#include "geometry/best_of_all.h"

#include <algorithm>

#include "geometry/support_line.h"

namespace roboss::narrow {
namespace {

/// A line across n, from the point where it touches up to `clearance` to both sides.
struct TouchingLine {
    Vec3 direction;  // unit; zero for a point
    double clearance = 0;
};

TouchingLine line_at(const SupportLine& line, double parameter) {
    const double half = norm(line.half);
    if (!(half > 0.0)) return {};
    return {line.half / half, half * std::max(0.0, 1.0 - std::fabs(parameter))};
}

/// What the disc of a cylinder sweeps along the line is an oblique cylinder with the cross section of an
/// ellipse of half axes r and r k, k the cosine between the disc's axis and the line. A ball of radius d that
/// touches it from inside fits everywhere if d is at most the ellipse's smallest radius of curvature, r k^2
/// (Blaschke's rolling theorem). Along the line the disc moves by at most 2 d / k within the ball.
bool holds_ball(const Posed& cylinder, const TouchingLine& line, double depth) {
    const double k = std::fabs(dot(cylinder.axis(2), line.direction));
    return depth <= cylinder.shape.radius * k * k && 2.0 * depth <= line.clearance * k;
}

}  // namespace

/// The disc and its mirror image span an oblique cylinder, which is wide enough for the ball.
bool holds_ball(const ConvexSum& sum, const Separation& best, double clearance) {
    const double depth = -best.s, height = sum.reach(best.n);
    const Vec3 aside = sum.centre() - best.n * dot(best.n, sum.centre());
    return depth <= height && depth * (1.0 + 2.0 * norm(aside) / height) <= clearance;
}

bool is_best_of_all(const Posed& a, const Posed& b, const ConvexSum& sum, const Separation& best) {
    constexpr double kAcross = 1e-7;  // sine
    const LinePair lines{support_line(a, -best.n, kAcross), support_line(b, best.n, kAcross), best.n,
                         best.s - ball_of(a.shape) - ball_of(b.shape), 1e-8 * sum.scale()};
    const TouchingLines found = find_touching(lines);
    if (found.count == 0) return false;
    if (best.s >= 0.0) return true;
    LineParameters at = found.at[0];
    if (found.count == 2) at = {0.5 * (at.s + found.at[1].s), 0.5 * (at.t + found.at[1].t)};
    const TouchingLine of_a = line_at(lines.a, at.s), of_b = line_at(lines.b, at.t);
    const double depth = -best.s;
    for (const Posed* shape : {&a, &b})
        if (shape->shape.kind == ShapeKind::kCylinder &&
            (holds_ball(*shape, of_a, depth) || holds_ball(*shape, of_b, depth)))
            return true;
    const double sine = norm(cross(of_a.direction, of_b.direction));
    return holds_ball(sum, best, std::min(of_a.clearance, of_b.clearance) * sine);
}

}  // namespace roboss::narrow
