// Sutherland and Hodgman's polygon clipping ("Reentrant Polygon Clipping", 1974), in the reference face's
// coordinates. Each polygon edge carries the name of the line it lies on, so a vertex is known by the two
// lines that meet there.
#include "geometry/box_face.h"

#include <algorithm>

namespace roboss::narrow {
namespace {

constexpr double kMergeFraction = 1e-4;  // of the smallest half size: points closer than that are one
constexpr double kBorderFraction =
    1e-7;  // how far outside the border a face still touches when nothing is inside
constexpr std::uint32_t kReferenceLine = 4;  // lines 0 .. 3 are incident edges, 4 .. 7 reference edges

struct Vertex {
    double x = 0, y = 0, z = 0;
    std::uint32_t line = 0;  // that the edge to the next vertex lies on
};

struct Polygon {
    int count = 0;
    std::array<Vertex, 12> v;

    void add(const Vertex& vertex) {
        if (count < 12) v[static_cast<std::size_t>(count++)] = vertex;
    }
    const Vertex& operator[](int i) const { return v[static_cast<std::size_t>(i)]; }
};

Vertex between(const Vertex& a, const Vertex& b, double da, double db, std::uint32_t line) {
    const double t = da / (da - db);
    return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t, line};
}

/// Keeps the part where sign * (x or y) <= half. The coordinate and the line follow from `reference_edge`.
void clip_edge(Polygon& polygon, std::uint32_t reference_edge, double half) {
    const bool on_y = reference_edge == 0 || reference_edge == 2;
    const double sign = reference_edge == 0 || reference_edge == 3 ? 1.0 : -1.0;
    const auto beyond = [&](const Vertex& v) { return sign * (on_y ? v.y : v.x) - half; };
    bool outside = false;
    for (int i = 0; i < polygon.count; ++i) outside |= beyond(polygon[i]) > 0.0;
    if (!outside) return;
    Polygon kept;
    for (int i = 0; i < polygon.count; ++i) {
        const Vertex& a = polygon[i];
        const Vertex& b = polygon[i + 1 == polygon.count ? 0 : i + 1];
        const double da = beyond(a), db = beyond(b);
        if (da <= 0.0) kept.add(a);
        if (da <= 0.0 && db > 0.0) kept.add(between(a, b, da, db, kReferenceLine + reference_edge));
        if (da > 0.0 && db <= 0.0 && db < da) kept.add(between(a, b, da, db, a.line));
    }
    polygon = kept;
}

/// The corner between the reference edges p and q (either order), or 4 when they do not meet in one.
std::uint32_t corner_between(std::uint32_t p, std::uint32_t q) {
    if ((p + 1) % 4 == q) return q;
    if ((q + 1) % 4 == p) return p;
    return 4;
}

struct Corners {
    std::array<Vertex, 4> v;

    std::size_t near(double x, double y, double tolerance) const {
        for (std::size_t i = 0; i < 4; ++i) {
            if (std::fabs(v[i].x - x) <= tolerance && std::fabs(v[i].y - y) <= tolerance) return i;
        }
        return 4;
    }
};

Corners incident_corners(const BoxFace& reference, const BoxFace& incident) {
    const auto local = [&](const Vec3& d) {
        return Vec3{dot(reference.ex, d), dot(reference.ey, d), dot(reference.n, d)};
    };
    const Vec3 c = local(incident.centre - reference.centre);
    const Vec3 x = local(incident.ex) * incident.hx, y = local(incident.ey) * incident.hy;
    const auto vertex = [](const Vec3& p, std::uint32_t line) { return Vertex{p.x, p.y, p.z, line}; };
    return {{vertex(c + x + y, 0), vertex(c - x + y, 1), vertex(c - x - y, 2), vertex(c + x - y, 3)}};
}

/// Names a polygon vertex: a box corner where one is within half the tolerance for merging, else the two
/// edges that cross.
ClippedPoint name_point(const BoxFace& reference, const BoxFace& incident, const Corners& incident_at,
                        const Corners& reference_at, std::uint32_t line_before, const Vertex& v,
                        double tolerance) {
    ClippedPoint point{v.x, v.y, v.z, kFacePart, kFacePart};
    if (const std::size_t i = incident_at.near(v.x, v.y, 0.5 * tolerance); i < 4) {
        point.part = incident.corner_part(i);
        return point;
    }
    std::size_t corner = reference_at.near(v.x, v.y, 0.5 * tolerance);
    if (line_before >= kReferenceLine && v.line >= kReferenceLine) {
        corner = corner_between(line_before - kReferenceLine, v.line - kReferenceLine);
    }
    if (corner < 4) {
        point.reference_part = reference.corner_part(corner);
        return point;
    }
    const std::uint32_t own = line_before < kReferenceLine ? line_before : v.line;
    const std::uint32_t other = line_before < kReferenceLine ? v.line : line_before;
    point.part = incident.edge_part_after(own % 4);
    point.reference_part = reference.edge_part_after(other % 4);
    return point;
}

/// Appends the point, or merges it with one that is the same to within `tolerance` (the deeper position
/// stays).
void merge(ClippedFace& out, const ClippedPoint& point, double tolerance) {
    for (int i = 0; i < out.count; ++i) {
        ClippedPoint& other = out.points[static_cast<std::size_t>(i)];
        if (std::fabs(other.x - point.x) > tolerance || std::fabs(other.y - point.y) > tolerance) continue;
        if (point.gap < other.gap) other.x = point.x, other.y = point.y, other.gap = point.gap;
        if (point.part < other.part ||
            (point.part == other.part && point.reference_part < other.reference_part)) {
            other.part = point.part;
            other.reference_part = point.reference_part;
        }
        return;
    }
    if (out.count < 8) out.points[static_cast<std::size_t>(out.count++)] = point;
}

/// Drops crossings that lie on the straight line between their neighbours: two edges that almost coincide
/// cross wherever rounding says, and the points beside carry the same support.
void remove_straight(ClippedFace& face, double tolerance) {
    const auto at = [&](int i) -> ClippedPoint& { return face.points[static_cast<std::size_t>(i)]; };
    for (int i = 0; i < face.count && face.count > 2;) {
        const ClippedPoint &p = at(i), &a = at(i == 0 ? face.count - 1 : i - 1),
                           &b = at(i + 1 == face.count ? 0 : i + 1);
        const double dx = b.x - a.x, dy = b.y - a.y;
        const double across = dx * (p.y - a.y) - dy * (p.x - a.x);
        const bool is_crossing = p.part != kFacePart && p.reference_part != kFacePart;
        if (!is_crossing || across * across > tolerance * tolerance * (dx * dx + dy * dy)) {
            ++i;
            continue;
        }
        for (int k = i; k + 1 < face.count; ++k) at(k) = at(k + 1);
        --face.count;
    }
}

}  // namespace

BoxFace::BoxFace(const Posed& box, std::size_t axis, bool upper) : k(axis), side(upper ? 1 : 0) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const Vec3 across = box.axis(k);
    n = upper ? across : -across;
    centre = box.X.p + n * box.shape.half[k];
    ex = box.axis(i);
    ey = box.axis(j);
    hx = box.shape.half[i];
    hy = box.shape.half[j];
}

namespace {

std::size_t axis_most_along(const Vec3& d) {
    const double x = std::fabs(d.x), y = std::fabs(d.y), z = std::fabs(d.z);
    return z >= x && z >= y ? 2 : y >= x ? 1 : 0;
}

BoxFace face_along(const Posed& box, const Vec3& d_B) {
    const std::size_t k = axis_most_along(d_B);
    return {box, k, d_B[k] > 0.0};
}

}  // namespace

BoxFace::BoxFace(const Posed& box, const Vec3& d) : BoxFace(face_along(box, transpose_times(box.X.R, d))) {}

std::uint32_t BoxFace::corner_part(std::size_t corner) const {
    const std::uint32_t sx = corner == 0 || corner == 3 ? 1 : 0, sy = corner < 2 ? 1 : 0;
    return side << k | sx << (k + 1) % 3 | sy << (k + 2) % 3;
}

std::uint32_t BoxFace::edge_part_after(std::size_t corner) const {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    switch (corner) {
        case 0:
            return edge_part(i, 1, side);  // y = +hy, along ex
        case 1:
            return edge_part(j, side, 0);  // x = -hx, along ey
        case 2:
            return edge_part(i, 0, side);  // y = -hy
        default:
            return edge_part(j, side, 1);  // x = +hx
    }
}

namespace {

ClippedFace clip_exactly(const BoxFace& reference, const BoxFace& incident, double tolerance) {
    const Corners incident_at = incident_corners(reference, incident);
    const double hx = reference.hx, hy = reference.hy;
    const Corners reference_at{{Vertex{hx, hy}, Vertex{-hx, hy}, Vertex{-hx, -hy}, Vertex{hx, -hy}}};
    ClippedFace out;
    const bool inside = std::all_of(incident_at.v.begin(), incident_at.v.end(), [&](const Vertex& v) {
        return std::fabs(v.x) <= hx && std::fabs(v.y) <= hy;
    });
    if (inside) {  // the common case: a box on a large one
        for (std::size_t i = 0; i < 4; ++i) {
            const Vertex& v = incident_at.v[i];
            out.points[i] = {v.x, v.y, v.z, incident.corner_part(i), kFacePart};
        }
        out.count = 4;
        return out;
    }
    Polygon polygon;
    for (const Vertex& v : incident_at.v) polygon.add(v);
    for (std::uint32_t edge = 0; edge < 4; ++edge) clip_edge(polygon, edge, edge % 2 == 0 ? hy : hx);

    for (int i = 0; i < polygon.count; ++i) {
        const std::uint32_t line_before = polygon[i == 0 ? polygon.count - 1 : i - 1].line;
        merge(out,
              name_point(reference, incident, incident_at, reference_at, line_before, polygon[i], tolerance),
              tolerance);
    }
    remove_straight(out, tolerance);
    return out;
}

}  // namespace

ClippedFace clip(const BoxFace& reference, const BoxFace& incident) {
    const double size = std::min(std::min(reference.hx, reference.hy), std::min(incident.hx, incident.hy));
    const ClippedFace clipped = clip_exactly(reference, incident, kMergeFraction * size);
    if (clipped.count > 0) return clipped;
    BoxFace wider = reference;
    wider.hx += kBorderFraction * size;
    wider.hy += kBorderFraction * size;
    return clip_exactly(wider, incident, kMergeFraction * size);
}

void add_clipped(const BoxFace& reference, const ClippedFace& clipped, bool reference_is_first, double margin,
                 Manifold& out) {
    out.n_W = reference_is_first ? -reference.n : reference.n;
    for (int i = 0; i < clipped.count; ++i) {
        const ClippedPoint& c = clipped.points[static_cast<std::size_t>(i)];
        if (c.gap > margin) continue;
        const Vec3 p_W =
            reference.centre + (reference.ex * c.x + reference.ey * c.y) + reference.n * (0.5 * c.gap);
        out.add(
            p_W, c.gap,
            reference_is_first ? feature_of(c.reference_part, c.part) : feature_of(c.part, c.reference_part));
    }
}

}  // namespace roboss::narrow
