// Sutherland and Hodgman, "Reentrant Polygon Clipping", 1974, with each side of the polygon named after the
// line it lies on, so that every corner of the result is named by what made it.
#include "geometry/clip_feature.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace roboss::narrow {
namespace {

constexpr double kDeeper = 1e-9;  // m: the deepest point counts when it is by that much

/// A corner of the polygon and the line from it to the next: an edge of the incident feature or of the face.
struct Corner {
    Vec3 p;
    std::uint32_t part = 0, reference_part = 0;
    std::uint32_t line = 0;
    bool of_face = false;  // the line
};

struct Polygon {
    FixedList<Corner, ClippedFeature::kMaxPoints> corners;

    void add(const Corner& corner) {
        if (!corners.full()) corners.push_back(corner);
    }
};

/// Across side k, as long as it.
Vec3 inward_of(const Feature& face, std::size_t k) {
    return cross(face.n, face.points[k + 1 < face.count ? k + 1 : 0] - face.points[k]);
}

/// True if all points of the feature are over the face.
bool is_all_over(const Feature& face, const Feature& incident) {
    for (std::size_t k = 0; k < face.count; ++k) {
        const Vec3 inward = inward_of(face, k);
        for (std::size_t i = 0; i < incident.count; ++i)
            if (!(dot(inward, incident.points[i] - face.points[k]) > 0)) return false;
    }
    return true;
}

struct Side {
    const Feature& face;
    std::size_t k;
    Vec3 origin, inward;
    double border;

    Side(const Feature& f, std::size_t number, double wide) : face(f), k(number), border(wide) {
        origin = f.points[k];
        const Vec3 across = inward_of(f, k);
        inward = across / norm(across);
    }
    double depth(const Vec3& p) const { return dot(inward, p - origin); }
    /// The crossing of the line from `from` (depth a) to q (depth b) with this side.
    Corner crossing(const Corner& from, const Vec3& q, double a, double b, const Feature& incident) const {
        Corner c;
        // A point in the border strip, just outside, is its own crossing.
        c.p = from.p + (q - from.p) * std::clamp(a / (a - b), 0.0, 1.0);
        if (a > b && a <= 0.0) c.p = from.p;
        if (b > a && b <= 0.0) c.p = q;
        if (!from.of_face) {
            c.part = from.line;
            c.reference_part = face.edge_part[k];
        } else {  // two lines of the face: its corner
            c.part = incident.face_part;
            c.reference_part =
                from.line == (k + 1) % face.count ? face.part[(k + 1) % face.count] : face.part[k];
        }
        return c;
    }
};

/// What is left of `polygon` inside the side goes to `out`.
void clip_side(const Polygon& polygon, const Side& side, const Feature& incident, Polygon& out) {
    out.corners.clear();
    const std::size_t count = polygon.corners.size();
    const double first = side.depth(polygon.corners[0].p);
    double b = first;
    for (std::size_t i = 0; i < count; ++i) {
        const bool is_last = i + 1 == count;
        const Corner& p = polygon.corners[i];
        const Corner& q = polygon.corners[is_last ? 0 : i + 1];
        const double a = b;
        b = is_last ? first : side.depth(q.p);
        const bool p_inside = a >= -side.border, q_inside = b >= -side.border;
        if (p_inside) out.add(p);
        if (p_inside == q_inside) continue;
        Corner c = side.crossing(p, q.p, a, b, incident);
        c.line = p_inside ? static_cast<std::uint32_t>(side.k) : p.line;
        c.of_face = p_inside ? true : p.of_face;
        out.add(c);
    }
}

/// Adds a point, or merges it with one closer than `merge`: the deeper place counts, and a corner's name
/// rather than a crossing's.
void add_point(const Feature& face, const OverFace& point, double merge, ClippedFeature& out) {
    const auto known = std::find_if(out.points.begin(), out.points.end(),
                                    [&](const OverFace& o) { return norm(o.p - point.p) <= merge; });
    if (known == out.points.end()) return out.points.push_back(point);
    if (point.gap < known->gap) known->p = point.p, known->gap = point.gap;
    if (point.reference_part == face.face_part && known->reference_part != face.face_part)
        known->part = point.part, known->reference_part = point.reference_part;
}

OverFace over(const Feature& face, const Vec3& p, double ball, std::uint32_t part,
              std::uint32_t reference_part) {
    return {p, dot(face.n, p - face.points[0]) - ball, part, reference_part};
}

void clip_polygon(const Feature& face, const Feature& incident, double ball, double border, double merge,
                  ClippedFeature& out) {
    if (is_all_over(face, incident)) {
        for (std::size_t i = 0; i < incident.count; ++i)
            add_point(face, over(face, incident.points[i], ball, incident.part[i], face.face_part), merge,
                      out);
        return;
    }
    std::array<Polygon, 2> polygons;
    Polygon *polygon = &polygons[0], *next = &polygons[1];
    for (std::uint32_t i = 0; i < incident.count; ++i)
        polygon->add({incident.points[i], incident.part[i], face.face_part, incident.edge_part[i], false});
    for (std::size_t k = 0; k < face.count && !polygon->corners.empty(); ++k) {
        clip_side(*polygon, Side(face, k, border), incident, *next);
        std::swap(polygon, next);
    }
    for (const Corner& c : polygon->corners)
        add_point(face, over(face, c.p, ball, c.part, c.reference_part), merge, out);
}

/// A line, or a point as a line without length.
void clip_line(const Feature& face, const Feature& incident, double ball, double border, double merge,
               ClippedFeature& out) {
    const std::size_t last = incident.count - 1;
    const Vec3 p = incident.points[0], d = incident.points[last] - p;
    double t0 = 0.0, t1 = 1.0;
    std::uint32_t edge0 = face.face_part, edge1 = face.face_part;
    for (std::size_t k = 0; k < face.count; ++k) {
        const Vec3 inward = inward_of(face, k), from = p - face.points[k];
        const double a = dot(inward, from), b = last == 0 ? a : dot(inward, from + d);
        if (a >= 0 && b >= 0) continue;
        const double strip = border * border * norm_squared(inward);  // depths are as long as the side here
        const bool p_outside = a < 0 && a * a > strip, q_outside = b < 0 && b * b > strip;
        if (p_outside && q_outside) return;
        if (!p_outside && !q_outside) continue;
        const double t = a > b && a <= 0.0 ? 0.0 : b > a && b <= 0.0 ? 1.0 : a / (a - b);
        if (a < b) {
            if (t > t0) t0 = t, edge0 = face.edge_part[k];
        } else if (t < t1) {
            t1 = t, edge1 = face.edge_part[k];
        }
    }
    if (t0 > t1) return;
    add_point(face, over(face, p + d * t0, ball, t0 > 0.0 ? incident.edge_part[0] : incident.part[0], edge0),
              merge, out);
    if (last == 0) return;
    add_point(face, over(face, p + d * t1, ball, t1 < 1.0 ? incident.edge_part[0] : incident.part[1], edge1),
              merge, out);
}

}  // namespace

double ClippedFeature::deepest() const {
    double gap = std::numeric_limits<double>::infinity();
    for (const OverFace& point : points) gap = std::min(gap, point.gap);
    return gap;
}

ClippedFeature clip_over(const Feature& face, const Feature& incident, double ball, double border,
                         double merge) {
    ClippedFeature out;
    if (incident.count <= 2) {
        clip_line(face, incident, ball, border, merge, out);
    } else {
        clip_polygon(face, incident, ball, border, merge, out);
    }
    return out;
}

Chosen choose_points(std::span<const Vec3> points, std::span<const double> gaps, const Vec3& n) {
    Chosen chosen;
    const auto take = [&](std::size_t i) {
        const auto end = chosen.number.begin() + static_cast<long>(chosen.count);
        if (std::find(chosen.number.begin(), end, i) == end) chosen.number[chosen.count++] = i;
    };
    std::size_t deepest = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
        if (gaps[i] < gaps[deepest]) deepest = i;
    Vec3 t1, t2;
    tangents(n, t1, t2);
    // Seven directions 2 pi / 7 apart, turned by a generic angle.
    constexpr double kDirections[7][2] = {{0.98006657784124163, 0.19866933079506122},
                                          {0.45573427905, 0.89011663765},
                                          {-0.41177640186, 0.91128777014},
                                          {-0.96921420107, 0.24621845254},
                                          {-0.79680951346, -0.60423058466},
                                          {-0.02438693216, -0.99970259455},
                                          {0.76638618, -0.64238}};
    for (const auto& direction : kDirections) {
        const Vec3 d = t1 * direction[0] + t2 * direction[1];
        std::size_t best = 0;
        double most = -1e300;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double x = dot(d, points[i]);
            if (x > most) most = x, best = i;
        }
        take(best);
    }
    const auto is_deeper = [&](std::size_t i) { return gaps[deepest] < gaps[i] - kDeeper; };
    const auto end = chosen.number.begin() + static_cast<long>(chosen.count);
    if (std::all_of(chosen.number.begin(), end, is_deeper)) take(deepest);
    std::sort(chosen.number.begin(), chosen.number.begin() + static_cast<long>(chosen.count));
    return chosen;
}

}  // namespace roboss::narrow
