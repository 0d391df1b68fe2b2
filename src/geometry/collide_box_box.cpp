// Box against box: separating axes (Gottschalk, Lin, Manocha, "OBBTree", 1996) choose the normal, then face
// is clipped against face, or the two crossing edges give one point. Along an edge-edge normal that almost is
// a face's normal the face is clipped too (the gap differs in second order of the angle only), so a stack
// never rests on a single point.
#include <algorithm>
#include <limits>

#include "geometry/box_face.h"

namespace roboss::narrow {
namespace {

constexpr double kAlmostParallel = 0.9998;  // cosine of the angle (1.1 degrees) below which a face takes over

struct Axis {
    double separation = -1e300;
    Vec3 n_A;  // unit, in the frame of the first box, from the second to the first
    std::size_t
        i = 0,
        j = 0;  // face: axis i of box j (0 first, 1 second); edge: axis i of the first, j of the second
};

/// The second box seen from the first, and the absolute rotation.
struct Relative {
    Vec3 a, b;  // half edges
    Mat3 R;     // R_AB
    Mat3 size;  // |R_AB|
    Vec3 p_A;   // from the second box's centre to the first's
    Vec3 p_B;

    Relative(const Posed& first, const Posed& second) : a(first.shape.half), b(second.shape.half) {
        R = transpose(first.X.R) * second.X.R;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3& r = R.row(i);
            size.row(i) = {std::fabs(r.x), std::fabs(r.y), std::fabs(r.z)};
        }
        p_A = transpose_times(first.X.R, first.X.p - second.X.p);
        p_B = transpose_times(R, p_A);
    }
};

/// False as soon as an axis separates by more than the margin.
bool test_faces(const Relative& r, double margin, std::array<Axis, 2>& best) {
    for (std::size_t i = 0; i < 3; ++i) {
        const double s = std::fabs(r.p_A[i]) - (r.a[i] + dot(r.size.row(i), r.b));
        if (s > margin) return false;
        if (s <= best[0].separation) continue;
        Vec3 n;
        n[i] = r.p_A[i] < 0.0 ? -1.0 : 1.0;
        best[0] = {s, n, i, 0};
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const double s = std::fabs(r.p_B[i]) - (r.b[i] + dot(r.size.col(i), r.a));
        if (s > margin) return false;
        if (s <= best[1].separation) continue;
        best[1] = {s, r.p_B[i] < 0.0 ? -r.R.col(i) : r.R.col(i), i, 1};
    }
    return true;
}

bool test_edges(const Relative& r, double margin, Axis& best) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            // n = e_i x b_j in the first box's frame: only the components i1 and i2 differ from zero.
            const double n1 = -r.R(i2, j), n2 = r.R(i1, j);
            const double length_squared = n1 * n1 + n2 * n2;
            if (length_squared < 1e-6) continue;  // parallel edges: the faces cover it
            const double along = r.p_A[i1] * n1 + r.p_A[i2] * n2;
            const double reach = r.a[i1] * r.size(i2, j) + r.a[i2] * r.size(i1, j) + r.b[j1] * r.size(i, j2) +
                                 r.b[j2] * r.size(i, j1);
            const double excess = std::fabs(along) - reach;
            if (excess <= 0.0 && best.separation >= 0.0) continue;
            const double length = std::sqrt(length_squared);
            const double s = excess / length;
            if (s > margin) return false;
            if (s <= best.separation) continue;
            const double scale = along < 0.0 ? -1.0 / length : 1.0 / length;
            Vec3 n;
            n[i1] = n1 * scale;
            n[i2] = n2 * scale;
            best = {s, n, i, j};
        }
    }
    return true;
}

double deepest(const ClippedFace& clipped) {
    double gap = std::numeric_limits<double>::infinity();
    for (int i = 0; i < clipped.count; ++i)
        gap = std::min(gap, clipped.points[static_cast<std::size_t>(i)].gap);
    return gap;
}

/// Clips the other box's face against face `axis` of box `owner` (0 first, 1 second). False, and nothing
/// added, when the deepest point of the result is further than `gap_max`: then the faces do not meet where
/// the boxes are closest.
bool add_face_contact(const Posed& first, const Posed& second, const Axis& axis, double gap_max,
                      double margin, Manifold& out) {
    const bool of_first = axis.j == 0;
    const Vec3 n_W = first.X.R * axis.n_A;
    const Posed& owner = of_first ? first : second;
    const Vec3 outward = of_first ? -n_W : n_W;
    const BoxFace reference(owner, axis.i, dot(owner.axis(axis.i), outward) > 0.0);
    const ClippedFace clipped = clip(reference, BoxFace(of_first ? second : first, -reference.n));
    if (!(deepest(clipped) <= gap_max)) return false;
    add_clipped(reference, clipped, of_first, margin, out);
    return true;
}

/// The face whose normal is most along n.
Axis face_most_along(const Relative& r, const Vec3& n_A, double& cosine) {
    Axis best;
    cosine = 0.0;
    const Vec3 n_B = transpose_times(r.R, n_A);
    for (std::size_t j = 0; j < 2; ++j) {
        const Vec3& n = j == 0 ? n_A : n_B;
        for (std::size_t i = 0; i < 3; ++i) {
            if (std::fabs(n[i]) <= cosine) continue;
            cosine = std::fabs(n[i]);
            best = {0.0, n_A, i, j};
        }
    }
    return best;
}

/// One point of an edge: its middle, its direction and its number.
struct Edge {
    Vec3 middle, direction;
    double half = 0;
    std::uint32_t part = 0;

    /// The edge along axis i that lies furthest along d (given in the box's frame).
    Edge(const Posed& box, std::size_t i, const Vec3& d) : direction(box.axis(i)), half(box.shape.half[i]) {
        const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        const bool up1 = d[i1] > 0.0, up2 = d[i2] > 0.0;
        const Vec3 side1 = box.axis(i1) * box.shape.half[i1], side2 = box.axis(i2) * box.shape.half[i2];
        middle = box.X.p + (up1 ? side1 : -side1) + (up2 ? side2 : -side2);
        part = edge_part(i, up1 ? 1 : 0, up2 ? 1 : 0);
    }
};

/// The one point where two edges cross; false when the lines are closest beyond the edges' ends and the boxes
/// apart.
bool add_edge_contact(const Posed& first, const Posed& second, const Relative& r, const Axis& axis,
                      Manifold& out) {
    const Edge a(first, axis.i, -axis.n_A), b(second, axis.j, transpose_times(r.R, axis.n_A));
    const Vec3 d = b.middle - a.middle;
    const double c = dot(a.direction, b.direction), da = dot(d, a.direction), db = dot(d, b.direction);
    const double determinant = 1.0 - c * c;
    const double s = (da - c * db) / determinant, t = (c * da - db) / determinant;
    if (!(std::fabs(s) <= a.half && std::fabs(t) <= b.half)) return false;
    const Vec3 on_a = a.middle + a.direction * s, on_b = b.middle + b.direction * t;
    out.n_W = first.X.R * axis.n_A;
    out.add((on_a + on_b) * 0.5, axis.separation, feature_of(a.part, b.part));
    return true;
}

}  // namespace

void box_box(const Posed& a, const Posed& b, double margin, Manifold& out) {
    const Relative r(a, b);
    std::array<Axis, 2> faces;
    if (!test_faces(r, margin, faces)) return;
    const double face_separation = std::max(faces[0].separation, faces[1].separation);
    Axis edge;
    edge.separation = face_separation;
    if (!test_edges(r, margin, edge)) return;

    // Ties go to a face before an edge pair and to the first box before the second: the choice must not
    // flicker.
    const double size =
        std::min(std::min(r.a.x, std::min(r.a.y, r.a.z)), std::min(r.b.x, std::min(r.b.y, r.b.z)));
    const double tie = 1e-6 * size;
    if (edge.separation <= face_separation + std::max(tie, 1e-3 * std::fabs(face_separation))) {
        const Axis& face = faces[1].separation > faces[0].separation + tie ? faces[1] : faces[0];
        const double gap_max = face_separation > 0.0 ? face_separation + tie : margin;
        if (add_face_contact(a, b, face, gap_max, margin, out)) return;
    } else {
        double cosine = 0.0;
        const Axis close = face_most_along(r, edge.n_A, cosine);
        const double gap_max = edge.separation + 1e-3 * std::fabs(edge.separation) + tie;
        if (cosine > kAlmostParallel && add_face_contact(a, b, close, gap_max, margin, out)) return;
        if (add_edge_contact(a, b, r, edge, out)) return;
    }
    convex_convex(a, b, margin, out);  // apart and closest at a corner, or too degenerate for fixed axes
}

}  // namespace roboss::narrow
