// Box, cylinder and capsule against each other. First the natural directions: they separate most far pairs at
// once, and when the best is a face's normal and the points over that face prove it to be the best of all,
// the contact is done. Otherwise the closest direction is searched, and the contact built from the features
// that meet along it.
#include <algorithm>

#include "geometry/best_of_all.h"
#include "geometry/closest_direction.h"
#include "geometry/cylinder_rim.h"
#include "geometry/support_line.h"

namespace roboss::narrow {
namespace {

constexpr double kAlmostParallel = 0.9998;  // cosine of the angle (1.1 degrees) below which a face takes over
constexpr double kAlmostFlat = 0.02;        // the same for lines, sine

/// The face of a box or cylinder whose normal is most along d.
struct FaceChoice {
    bool of_first = true;
    std::size_t axis = 2;
    double cosine = 0;
};

FaceChoice face_along(const Posed& a, const Posed& b, const Vec3& d) {
    FaceChoice best;
    for (const bool of_first : {true, false}) {
        const Posed& s = of_first ? a : b;
        if (s.shape.kind == ShapeKind::kCapsule) continue;
        for (std::size_t i = s.shape.kind == ShapeKind::kBox ? 0 : 2; i < 3; ++i) {
            const double cosine = std::fabs(dot(s.axis(i), d));
            if (cosine > best.cosine + 1e-9) best = {of_first, i, cosine};
        }
    }
    return best;
}

struct FaceContact {
    FaceRegion face;
    Candidates points;

    FaceContact(const Posed& a, const Posed& b, const FaceChoice& choice, const Vec3& n)
        : face(choice.of_first ? a : b, choice.axis, choice.of_first ? -n : n),
          points(points_over(face, choice.of_first ? b : a)) {}

    void write(bool of_first, double margin, Manifold& out) const {
        out.n_W = of_first ? -face.n : face.n;
        for (std::size_t i = 0; i < points.count(); ++i) {
            const ClippedPoint& p = points[i];
            if (p.gap > margin) continue;
            const Vec3 p_W = face.centre + (face.ex * p.x + face.ey * p.y) + face.n * (0.5 * p.gap);
            out.add(p_W, p.gap,
                    of_first ? feature_of(p.reference_part, p.part) : feature_of(p.part, p.reference_part));
        }
    }

    /// Radius of a disc of the sum's facet round the point that touches: the clearance inside the face's
    /// outline of a point (or the mean of all points) that is as deep as the deepest.
    double clearance(double tolerance) const {
        const double deep = points.deepest() + tolerance;
        double best = -1.0, x = 0.0, y = 0.0;
        int deep_count = 0;
        for (std::size_t i = 0; i < points.count(); ++i) {
            if (points[i].gap > deep) continue;
            best = std::max(best, face.clearance(points[i].x, points[i].y));
            x += points[i].x;
            y += points[i].y;
            ++deep_count;
        }
        return deep_count == 0 ? best : std::max(best, face.clearance(x / deep_count, y / deep_count));
    }
};

/// How far the deepest of a cap's four points may lie above its rim's deepest point (see rim_directions).
double rim_slack(const Posed& a, const Posed& b, const Vec3& n) {
    double slack = 0.0;
    for (const Posed* s : {&a, &b}) {
        if (s->shape.kind != ShapeKind::kCylinder) continue;
        const double tilt = norm(cross(s->axis(2), n));
        if (tilt < kTilted) slack += 0.3 * s->shape.radius * tilt;
    }
    return slack;
}

/// Whether no direction separates better than the face's (best_of_all.h).
bool is_proven(const ConvexSum& sum, const Separation& best, const FaceContact& contact, double balls,
               double slack) {
    const double tolerance = 1e-7 * sum.scale() + slack;
    if (contact.points.deepest() > best.s - balls + tolerance) return false;
    return best.s >= 0.0 || holds_ball(sum, best, contact.clearance(10.0 * tolerance));
}

/// The best of all directions, from a good one; any of those that separate by more than `enough`.
Separation best_of_all(const Posed& a, const Posed& b, const ConvexSum& sum, const Separation& start,
                       double enough) {
    const Separation guess = sum.at_kink(start);
    if (guess.s > enough || (guess.s > start.s - 1e-8 * sum.scale() && is_best_of_all(a, b, sum, guess)))
        return guess;
    const Separation best = sum.polished(start);
    if (best.s > enough || is_best_of_all(a, b, sum, best)) return best;
    return closest_direction(sum, best, enough);
}

void write_features(const Posed& a, const Posed& b, const ConvexSum& sum, const Separation& best,
                    double margin, Manifold& out) {
    const double gap = best.s - ball_of(a.shape) - ball_of(b.shape);
    const double gap_max = gap + 1e-3 * std::fabs(gap) + 1e-6 * sum.scale() + rim_slack(a, b, best.n);
    const FaceChoice choice = face_along(a, b, best.n);
    if (choice.cosine > kAlmostParallel) {
        const FaceContact contact(a, b, choice, best.n);
        if (contact.points.deepest() <= gap_max) return contact.write(choice.of_first, margin, out);
    }
    for (const double tolerance : {kAlmostFlat, 1e-6}) {
        const LinePair lines{support_line(a, -best.n, tolerance), support_line(b, best.n, tolerance), best.n,
                             gap, 1e-3 * sum.scale()};
        out.count = 0;
        if (add_lines(lines, margin, out) <= gap_max && out.count > 0) return;
    }
    // Features between the classes, such as a line along the border of a face: the gap is exact, and the
    // place is that of the closest points once the first shape has been lifted off.
    const ConvexSum lifted = sum.moved(best.n * (sum.scale() - best.s));
    const ClosestApart apart = closest_apart(lifted, {best.n, sum.scale()}, 1e300);
    const Vec3 on_a = a.X.p - apart.first - best.n * ball_of(a.shape);
    out.count = 0;
    out.n_W = best.n;
    out.add(on_a - best.n * (0.5 * gap), gap,
            feature_of(support_line(a, -best.n, 1e-6).part, support_line(b, best.n, 1e-6).part));
}

}  // namespace

void convex_convex(const Posed& a, const Posed& b, double margin, Manifold& out) {
    const ConvexSum sum(a, b);
    const double balls = ball_of(a.shape) + ball_of(b.shape), enough = margin + balls;
    Separation best = sum.best_natural(enough);
    if (best.s > enough) return;
    const FaceChoice choice = face_along(a, b, best.n);
    if (choice.cosine > 1.0 - 1e-12) {
        const FaceContact contact(a, b, choice, best.n);
        if (is_proven(sum, best, contact, balls, rim_slack(a, b, best.n)))
            return contact.write(choice.of_first, margin, out);
    }
    best = best_of_all(a, b, sum, best, enough);
    if (best.s > enough) return;
    write_features(a, b, sum, best, margin, out);
}

}  // namespace roboss::narrow
