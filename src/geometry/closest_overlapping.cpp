// The polytope lies inside the sum, so its largest facet separation bounds the answer from above, and every
// support direction tried bounds it from below; facets are expanded until the two meet or the fixed storage
// is full.
#include <algorithm>

#include "geometry/closest_direction.h"
#include "geometry/fixed_list.h"

namespace roboss::narrow {
namespace {

constexpr std::size_t kVerticesMax = 120;
constexpr std::size_t kFacesMax = 2 * kVerticesMax + 64;
constexpr std::size_t kEdgesMax = 256;

using Number = std::uint16_t;  // of a vertex

struct Face {
    std::array<Number, 3> v{};
    Vec3 n;
    double offset = 0;  // n.x = offset on the face
    double s = -1e300;  // separation of the sum's centre from the face's plane
};

template <class Sum>
class Polytope {
  public:
    explicit Polytope(const Sum& sum) : sum_(sum) {}

    bool start(const Vec3& n) { return Sum::kSymmetric ? start_octahedron(n) : start_tetrahedron(n); }

    const Face& best_face() const {
        return *std::max_element(faces_.begin(), faces_.end(),
                                 [](const Face& a, const Face& b) { return a.s < b.s; });
    }

    /// Takes the point into the hull; false when the storage is full or the point changes nothing.
    bool expand(const Vec3& x) {
        if (vertices_.full() || faces_.size() + 64 > kFacesMax) return false;
        edges_.clear();
        const double visible = 1e-13 * sum_.inradius();
        for (std::size_t i = 0; i < faces_.size();) {
            if (dot(faces_[i].n, x) - faces_[i].offset <= visible) {
                ++i;
                continue;
            }
            const auto v = faces_[i].v;
            if (edges_.size() + 3 > kEdgesMax) return false;
            toggle_edge(v[0], v[1]);
            toggle_edge(v[1], v[2]);
            toggle_edge(v[2], v[0]);
            faces_[i] = faces_.back();
            faces_.pop_back();
        }
        if (edges_.empty() || faces_.size() + edges_.size() > kFacesMax) return false;
        const auto number = static_cast<Number>(vertices_.size());
        vertices_.push_back(x);
        for (const auto& edge : edges_) add_face(edge[0], edge[1], number);
        return true;
    }

  private:
    /// Three pairs of opposite support points; false when the sum is flat.
    bool start_octahedron(const Vec3& n) {
        Vec3 t1, t2;
        const Vec3 a = sum_.support(n);
        const double length = norm(a);
        if (!(length > 0.0)) return false;
        tangents(a / length, t1, t2);
        const Vec3 b = sum_.support(t1);
        const Vec3 across = cross(a, b);
        const double area = norm(across);
        if (!(area > 0.0)) return false;
        const Vec3 c = sum_.support(across / area);  // cross(a, b).c > 0
        for (const Vec3& v : {a, b, c, -a, -b, -c}) vertices_.push_back(v);
        for (std::uint32_t k = 0; k < 8; ++k) {
            const Number x = (k & 1u) != 0 ? 3 : 0, y = (k & 2u) != 0 ? 4 : 1, z = (k & 4u) != 0 ? 5 : 2;
            const bool even = ((k & 1u) + (k >> 1 & 1u) + (k >> 2)) % 2 == 0;
            even ? add_face(x, y, z) : add_face(x, z, y);
        }
        return true;
    }

    /// Four support points; false when the sum is flat. The sum's centre may lie outside: then the facet that
    /// looks at it is expanded first.
    bool start_tetrahedron(const Vec3& n) {
        const Vec3 a = sum_.support(n), b = sum_.support(-n);
        const double length = norm(a - b);
        if (!(length > 0.0)) return false;
        const auto furthest = [&](const Vec3& d) {
            const Vec3 up = sum_.support(d), down = sum_.support(-d);
            return std::fabs(dot(d, up - a)) >= std::fabs(dot(d, down - a)) ? up : down;
        };
        Vec3 t1, t2;
        tangents((a - b) / length, t1, t2);
        Vec3 c = furthest(t1);
        if (norm(cross(b - a, c - a)) <= 1e-6 * length * length) c = furthest(t2);
        const Vec3 across = cross(b - a, c - a);
        const double area = norm(across);
        if (!(area > 1e-12 * length * length)) return false;
        const Vec3 d = furthest(across / area);
        const double height = dot(across / area, d - a);
        if (!(std::fabs(height) > 1e-12 * length)) return false;
        for (const Vec3& v : {a, height < 0.0 ? b : c, height < 0.0 ? c : b, d}) vertices_.push_back(v);
        add_face(0, 1, 2), add_face(0, 3, 1), add_face(1, 3, 2), add_face(2, 3, 0);
        return true;
    }

    void add_face(Number a, Number b, Number c) {
        Face face{{a, b, c}, {}, 0, -1e300};
        const Vec3 normal = cross(vertices_[b] - vertices_[a], vertices_[c] - vertices_[a]);
        const double length = norm(normal);
        if (length > 1e-14 * sum_.inradius() * sum_.inradius()) {
            face.n = normal / length;
            face.offset = dot(face.n, vertices_[a]);
            face.s = dot(face.n, sum_.centre()) - face.offset;
        }
        faces_.push_back(face);
    }

    /// Keeps the edges that only one of the removed faces has: the horizon.
    void toggle_edge(Number a, Number b) {
        for (auto& edge : edges_) {
            if (edge[0] == b && edge[1] == a) {
                edge = edges_.back();
                return edges_.pop_back();
            }
        }
        edges_.push_back({a, b});
    }

    const Sum& sum_;
    FixedList<Vec3, kVerticesMax> vertices_;
    FixedList<Face, kFacesMax> faces_;
    FixedList<std::array<Number, 2>, kEdgesMax> edges_;
};

}  // namespace

template <class Sum>
Separation closest_overlapping(const Sum& sum, const Separation& start) {
    Separation best = start;
    Polytope<Sum> polytope(sum);
    if (!polytope.start(start.n)) return best;
    const double gap = sum.overlap_gap() * sum.scale();
    while (true) {
        const Face face = polytope.best_face();
        if (face.s <= best.s + gap) return best;
        const Touching found = sum.touching(face.n);
        if (found.s > best.s) best = found;
        if (face.s <= best.s + gap || !polytope.expand(found.support)) return best;
    }
}

template <class Sum>
Separation closest_direction(const Sum& sum, const Separation& start, double enough) {
    const ClosestApart apart = closest_apart(sum, start, enough);
    if (apart.best.s > enough) return apart.best;
    const Separation best = sum.polished(apart.best);
    if (!apart.overlap) return best;
    const Separation deeper = closest_overlapping(sum, best);
    return deeper.s > best.s ? sum.polished(deeper) : best;
}

template Separation closest_overlapping(const ConvexSum&, const Separation&);
template Separation closest_overlapping(const GeneralSum&, const Separation&);
template Separation closest_direction(const ConvexSum&, const Separation&, double);
template Separation closest_direction(const GeneralSum&, const Separation&, double);

}  // namespace roboss::narrow
