// Ellipsoids and hulls against each other and every other bounded shape.
#include "geometry/collide_general.h"

#include <algorithm>

#include "geometry/closest_direction.h"
#include "geometry/support_line.h"

namespace roboss::narrow {
namespace {

constexpr double kAlmostParallel = 0.9998;  // cosine of the angle (1.1 degrees) below which a face takes over
constexpr double kAlmostFlat = 0.02;        // the same for lines, sine
constexpr double kBorder = 1e-7, kMerge = 1e-4;  // of the smaller size

/// Names of a line's two ends and its middle, which add_lines knows as 0, 1 and 2.
struct NamedLine {
    SupportLine line;
    std::array<std::uint32_t, 3> parts{};

    NamedLine(const Feature& f, const Vec3& to_surface) {
        const Vec3 first = f.points[0], last = f.points[f.count - 1];
        line = {(first + last) * 0.5 + to_surface, (last - first) * 0.5, 0, 1, 2};
        parts = {f.part[0], f.part[f.count - 1], f.count == 1 ? f.part[0] : f.edge_part[0]};
    }
};

struct FaceChoice {
    bool of_first = true;
    double cosine = 0;
};

FaceChoice face_most_along(const ConvexBody& a, const ConvexBody& b, const Vec3& n) {
    FaceChoice best;
    for (const bool of_first : {true, false}) {
        const Vec3 normal = of_first ? a.face_normal(-n) : b.face_normal(n);
        const double cosine = of_first ? -dot(normal, n) : dot(normal, n);  // 0 if there is no face
        if (cosine > best.cosine + 1e-9) best = {of_first, cosine};
    }
    return best;
}

/// `face` is that of the first or the second body.
ClippedFeature over_face(const ConvexBody& a, const ConvexBody& b, bool of_first, const Feature& face,
                         double size) {
    const ConvexBody& other = of_first ? b : a;
    return clip_over(face, other.feature(-face.n), other.ball(), kBorder * size, kMerge * size);
}

void write_face(const ConvexBody& a, const ConvexBody& b, bool of_first, const Feature& face,
                const ClippedFeature& clipped, double margin, Manifold& out) {
    const double ball = (of_first ? b : a).ball();
    FixedList<Vec3, ClippedFeature::kMaxPoints> points;
    FixedList<double, ClippedFeature::kMaxPoints> gaps;
    FixedList<std::uint32_t, ClippedFeature::kMaxPoints> features;
    for (const OverFace& c : clipped.points) {
        if (c.gap > margin) continue;
        points.push_back(c.p - face.n * (ball + 0.5 * c.gap));
        features.push_back(of_first ? wide_feature(c.reference_part, c.part)
                                    : wide_feature(c.part, c.reference_part));
        gaps.push_back(c.gap);
    }
    out.n_W = of_first ? -face.n : face.n;
    if (points.size() <= static_cast<std::size_t>(Manifold::kMaxPoints)) {
        for (std::size_t i = 0; i < points.size(); ++i) out.add(points[i], gaps[i], features[i]);
        return;
    }
    const Chosen chosen = choose_points(points, gaps, out.n_W);
    for (std::size_t k = 0; k < chosen.count; ++k) {
        const std::size_t i = chosen.number[k];
        out.add(points[i], gaps[i], features[i]);
    }
}

/// How closely two lines must meet. Side by side, they give two points even when they are not quite parallel.
struct LineRule {
    double tolerance;  // sine, of what counts as a line
    double width;      // sideways, of the smaller size
    int count_min;
};
constexpr LineRule kLineRules[] = {{kAlmostFlat, 1e-3, 2}, {kAlmostFlat, 1e-8, 1}, {1e-6, 1e-8, 1}};

/// Two lines, a line and a point, or two points; false when they pass each other.
bool write_lines(const ConvexBody& a, const ConvexBody& b, const Separation& best, const LineRule& rule,
                 double gap_max, double margin, Manifold& out) {
    const double gap = best.s - a.ball() - b.ball();
    const NamedLine of_a(a.line(-best.n, rule.tolerance), best.n * -a.ball());
    const NamedLine of_b(b.line(best.n, rule.tolerance), best.n * b.ball());
    const LinePair lines{of_a.line, of_b.line, best.n, gap, rule.width * std::min(a.size(), b.size())};
    out.count = 0;
    if (add_lines(lines, margin, out) > gap_max || out.count < rule.count_min) return false;
    for (int i = 0; i < out.count; ++i) {
        std::uint32_t& f = out.points[static_cast<std::size_t>(i)].feature;
        f = wide_feature(of_a.parts[f >> 8], of_b.parts[f & 0xFFu]);
    }
    return true;
}

/// How far the corners of a cap's octagon may lie above the deepest point of its rim.
double cap_slack(const ConvexBody& a, const ConvexBody& b, const Vec3& n) {
    double slack = 0.0;
    for (const ConvexBody* s : {&a, &b}) {
        if (!s->curved()) continue;
        const Vec3 along = s == &a ? -n : n, normal = s->face_normal(along);
        if (normal == Vec3{}) continue;
        const double tilt = norm(cross(normal, n));
        if (!(tilt < 1e-4)) continue;
        const Feature cap = s->feature(along);
        slack += 0.3 * tilt * norm(cap.points[0] - cap.points[4]);
    }
    return slack;
}

}  // namespace

Separation best_separation(const ConvexBody& a, const ConvexBody& b, double enough) {
    const GeneralSum sum(a, b);
    const double distance = norm(sum.centre());
    Separation best = sum.separation(distance > 0.0 ? sum.centre() / distance : Vec3{0, 0, 1});
    if (best.s > enough) return best;
    for (const Vec3& n : {-a.face_normal(-best.n), b.face_normal(best.n)}) {
        if (norm_squared(n) < 0.5) continue;
        const Separation found = sum.separation(n);
        if (found.s > best.s) best = found;
    }
    if (best.s > enough) return best;
    return closest_direction(sum, best, enough);
}

void write_general(const ConvexBody& a, const ConvexBody& b, const Separation& best, double margin,
                   Manifold& out) {
    const double size = std::min(a.size(), b.size());
    const double gap = best.s - a.ball() - b.ball();
    const double gap_max = gap + 1e-3 * std::fabs(gap) + 1e-6 * size + cap_slack(a, b, best.n);
    const FaceChoice choice = face_most_along(a, b, best.n);
    if (choice.cosine > kAlmostParallel) {
        const Feature face = choice.of_first ? a.feature(-best.n) : b.feature(best.n);
        const ClippedFeature clipped = over_face(a, b, choice.of_first, face, size);
        if (clipped.deepest() <= gap_max)
            return write_face(a, b, choice.of_first, face, clipped, margin, out);
    }
    for (const LineRule& rule : kLineRules) {
        if (write_lines(a, b, best, rule, gap_max, margin, out)) return;
    }
    // As in convex_convex: the place of the closest points once the first shape has been lifted off.
    const GeneralSum sum(a, b);
    const GeneralSum lifted = sum.moved(best.n * (sum.scale() - best.s));
    const ClosestApart apart = closest_apart(lifted, {best.n, sum.scale()}, 1e300);
    const Vec3 on_a = a.centre() - apart.first - best.n * a.ball();
    out.count = 0;
    out.n_W = best.n;
    out.add(on_a - best.n * (0.5 * gap), gap,
            wide_feature(a.line(-best.n, 1e-6).part[0], b.line(best.n, 1e-6).part[0]));
}

void general_general(const Posed& first, const Posed& second, double margin, Manifold& out) {
    const ConvexBody a(first), b(second);
    const double enough = margin + a.ball() + b.ball();
    const Separation best = best_separation(a, b, enough);
    if (best.s <= enough) write_general(a, b, best, margin, out);
}

}  // namespace roboss::narrow
