// Quickhull (Barber, Dobkin, Huhdanpaa, "The Quickhull Algorithm for Convex Hulls", 1996) with a written
// order: facets in the order of their making, of equally far points the lexicographically largest (a corner,
// never the middle of an edge). Then coplanar facets are merged to faces.
#include <algorithm>
#include <limits>
#include <map>
#include <string>

#include "core/fixed_math.h"
#include "core/hash.h"
#include "geometry/convex_hull.h"

namespace roboss {
namespace {

constexpr double kFlat = 2e-7;  // of the size: what mesh files in single precision leave of a flat face
constexpr std::size_t kVerticesMax = 4096;
constexpr std::uint32_t kNone = 0xFFFFFFFFu;

struct Facet {
    std::array<std::uint32_t, 3> v{}, neighbour{};  // neighbour i lies across the edge from v[i] to v[i + 1]
    Vec3 n;
    double offset = 0, area = 0;
    std::vector<std::uint32_t> outside;
    bool alive = true;
};

bool lexicographically_before(const Vec3& a, const Vec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

class QuickHull {
  public:
    QuickHull(std::span<const Vec3> points, double tolerance) : points_(points), tolerance_(tolerance) {}

    bool build() {
        if (!start()) return false;
        for (std::uint32_t f = 0; f < facets.size(); ++f) {
            while (facets[f].alive && !facets[f].outside.empty()) {
                if (!expand(f)) return false;
            }
        }
        return true;
    }

    std::vector<Facet> facets;

  private:
    /// The index with the largest measure; of equals the lexicographically largest point.
    template <class Indices, class Measure>
    std::uint32_t furthest(const Indices& indices, Measure measure) const {
        std::uint32_t best = kNone;
        double most = -1e300;
        for (const std::uint32_t i : indices) {
            const double x = measure(points_[i]);
            const bool equal = best != kNone && std::fabs(x - most) <= 0.1 * tolerance_;
            if (best == kNone || (equal ? lexicographically_before(points_[best], points_[i]) : x > most))
                most = x, best = i;
        }
        return best;
    }

    bool start() {
        std::vector<std::uint32_t> all(points_.size());
        for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
        std::uint32_t a = 0;
        for (const std::uint32_t i : all) {
            if (lexicographically_before(points_[i], points_[a])) a = i;
        }
        const Vec3 p = points_[a];
        const std::uint32_t b = furthest(all, [&](const Vec3& x) { return norm(x - p); });
        const double length = norm(points_[b] - p);
        if (!(length > 4.0 * tolerance_)) return false;
        const Vec3 u = (points_[b] - p) / length;
        const std::uint32_t c = furthest(all, [&](const Vec3& x) { return norm(cross(u, x - p)); });
        const Vec3 across = cross(u, points_[c] - p);
        if (!(norm(across) > 4.0 * tolerance_)) return false;
        const Vec3 n = normalized(across);
        const std::uint32_t d = furthest(all, [&](const Vec3& x) { return std::fabs(dot(n, x - p)); });
        const double height = dot(n, points_[d] - p);
        if (!(std::fabs(height) > 4.0 * tolerance_)) return false;
        const std::uint32_t s = height < 0.0 ? b : c, t = height < 0.0 ? c : b;
        add_facet(a, s, t, {1, 2, 3});
        add_facet(a, d, s, {3, 2, 0});
        add_facet(s, d, t, {1, 3, 0});
        add_facet(t, d, a, {2, 1, 0});
        for (const std::uint32_t i : all) give(i, 0, 4);
        return true;
    }

    void add_facet(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                   const std::array<std::uint32_t, 3>& neighbour) {
        Facet facet;
        facet.v = {a, b, c};
        facet.neighbour = neighbour;
        const Vec3 normal = cross(points_[b] - points_[a], points_[c] - points_[a]);
        facet.area = norm(normal);
        if (facet.area > 0.0) facet.n = normal / facet.area;
        facet.offset = dot(facet.n, points_[a]);
        facets.push_back(std::move(facet));
    }

    double height(const Facet& facet, std::uint32_t point) const {
        return dot(facet.n, points_[point]) - facet.offset;
    }

    /// Hands a point to the facet of [first, last) that it lies furthest above, if any.
    void give(std::uint32_t point, std::uint32_t first, std::uint32_t last) {
        double most = tolerance_;
        std::uint32_t best = kNone;
        for (std::uint32_t f = first; f < last; ++f) {
            const double h = height(facets[f], point);
            if (h > most) most = h, best = f;
        }
        if (best != kNone) facets[best].outside.push_back(point);
    }

    /// Adds the point furthest above the facet to the hull; false when rounding has torn the horizon.
    bool expand(std::uint32_t seed) {
        const std::uint32_t p =
            furthest(facets[seed].outside, [&](const Vec3& x) { return dot(facets[seed].n, x); });
        std::vector<std::uint32_t> visible{seed}, orphans;
        facets[seed].alive = false;
        struct Ridge {
            std::uint32_t a, b, beyond;
        };
        std::vector<Ridge> horizon;
        for (std::size_t i = 0; i < visible.size(); ++i) {
            const Facet& facet = facets[visible[i]];
            orphans.insert(orphans.end(), facet.outside.begin(), facet.outside.end());
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t other = facet.neighbour[k];
                if (!facets[other].alive) continue;
                if (height(facets[other], p) > tolerance_) {
                    facets[other].alive = false;
                    visible.push_back(other);
                } else {
                    horizon.push_back({facet.v[k], facet.v[(k + 1) % 3], other});
                }
            }
        }
        // A facet that was found visible after its edge had been taken for the horizon.
        std::erase_if(horizon, [&](const Ridge& r) { return !facets[r.beyond].alive; });
        const auto first = static_cast<std::uint32_t>(facets.size());
        std::map<std::uint32_t, std::uint32_t> starting, ending;
        for (const Ridge& r : horizon) {
            const auto number = static_cast<std::uint32_t>(facets.size());
            if (!starting.emplace(r.a, number).second || !ending.emplace(r.b, number).second) return false;
            add_facet(r.a, r.b, p, {r.beyond, kNone, kNone});
            Facet& beyond = facets[r.beyond];
            for (std::size_t k = 0; k < 3; ++k) {
                if (beyond.v[k] == r.b && beyond.v[(k + 1) % 3] == r.a) beyond.neighbour[k] = number;
            }
        }
        for (std::uint32_t f = first; f < facets.size(); ++f) {
            const auto next = starting.find(facets[f].v[1]);
            const auto last = ending.find(facets[f].v[0]);
            if (next == starting.end() || last == ending.end()) return false;
            facets[f].neighbour[1] = next->second;
            facets[f].neighbour[2] = last->second;
        }
        for (const std::uint32_t f : visible) facets[f].outside = {};
        for (const std::uint32_t point : orphans) {
            if (point != p) give(point, first, static_cast<std::uint32_t>(facets.size()));
        }
        return first < facets.size();
    }

    std::span<const Vec3> points_;
    double tolerance_;
};

/// Groups of coplanar facets; returns the group of each facet (kNone: dead).
std::vector<std::uint32_t> merge_coplanar(std::span<const Vec3> points, const std::vector<Facet>& facets,
                                          double tolerance, std::uint32_t& groups) {
    std::vector<std::uint32_t> by_area, group(facets.size(), kNone);
    for (std::uint32_t f = 0; f < facets.size(); ++f) {
        if (facets[f].alive) by_area.push_back(f);
    }
    std::stable_sort(by_area.begin(), by_area.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return facets[a].area > facets[b].area; });
    groups = 0;
    for (const std::uint32_t seed : by_area) {
        if (group[seed] != kNone) continue;
        const Facet& plane = facets[seed];
        std::vector<std::uint32_t> members{seed};
        group[seed] = groups;
        for (std::size_t i = 0; i < members.size(); ++i) {
            for (const std::uint32_t other : facets[members[i]].neighbour) {
                if (group[other] != kNone) continue;
                const Facet& facet = facets[other];
                const bool flat = std::all_of(facet.v.begin(), facet.v.end(), [&](std::uint32_t v) {
                    return std::fabs(dot(plane.n, points[v]) - plane.offset) <= tolerance;
                });
                // A sliver's normal is noise.
                const bool sliver = facet.area <= tolerance * norm(points[facet.v[1]] - points[facet.v[0]]) ||
                                    facet.area <= tolerance * norm(points[facet.v[2]] - points[facet.v[0]]);
                if (!flat || !(sliver || dot(facet.n, plane.n) > 0.9)) continue;
                group[other] = groups;
                members.push_back(other);
            }
        }
        ++groups;
    }
    return group;
}

/// The outlines of the groups, without the points that only two groups share.
std::vector<std::vector<std::uint32_t>> outlines(const std::vector<Facet>& facets,
                                                 const std::vector<std::uint32_t>& group,
                                                 std::uint32_t groups) {
    std::vector<std::map<std::uint32_t, std::uint32_t>> next(groups);
    std::map<std::uint32_t, std::vector<std::uint32_t>> around;
    for (std::uint32_t f = 0; f < facets.size(); ++f) {
        if (group[f] == kNone) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            auto& at = around[facets[f].v[k]];
            if (std::find(at.begin(), at.end(), group[f]) == at.end()) at.push_back(group[f]);
            if (group[facets[f].neighbour[k]] != group[f])
                next[group[f]][facets[f].v[k]] = facets[f].v[(k + 1) % 3];
        }
    }
    std::vector<std::vector<std::uint32_t>> loops;
    for (const auto& step : next) {
        if (step.empty()) continue;
        std::vector<std::uint32_t> loop;
        std::uint32_t at = step.begin()->first;
        for (std::size_t i = 0; i < step.size(); ++i) {
            if (around[at].size() >= 3) loop.push_back(at);
            const auto onward = step.find(at);
            if (onward == step.end()) break;
            at = onward->second;
        }
        if (loop.size() >= 3) loops.push_back(std::move(loop));
    }
    return loops;
}

void add_faces(std::span<const Vec3> points, const std::vector<std::vector<std::uint32_t>>& loops,
               ConvexHull& hull) {
    std::map<std::uint32_t, std::uint32_t> number;
    for (const auto& loop : loops)
        for (const std::uint32_t v : loop) number.emplace(v, 0);
    for (auto& [point, vertex] : number) {
        vertex = static_cast<std::uint32_t>(hull.vertices.size());
        hull.vertices.push_back(points[point]);
    }
    for (const auto& loop : loops) {
        ConvexHull::Face face;
        face.first = static_cast<std::uint32_t>(hull.face_vertices.size());
        face.count = static_cast<std::uint32_t>(loop.size());
        for (const std::uint32_t v : loop) hull.face_vertices.push_back(number.at(v));
        hull.faces.push_back(face);
    }
}

/// Twice the area of a loop as a vector (Newell).
Vec3 area_vector(const ConvexHull& hull, const ConvexHull::Face& face) {
    const Vec3& p = hull.vertices[hull.face_vertices[face.first]];
    Vec3 sum;
    for (std::uint32_t k = 1; k + 1 < face.count; ++k) {
        sum += cross(hull.vertices[hull.face_vertices[face.first + k]] - p,
                     hull.vertices[hull.face_vertices[face.first + k + 1]] - p);
    }
    return sum;
}

void centre(ConvexHull& hull) {
    const Vec3 inside = hull.vertices[0];
    double six_volumes = 0;
    Vec3 moment;
    for (const ConvexHull::Face& face : hull.faces) {
        const Vec3 p = hull.vertices[hull.face_vertices[face.first]] - inside;
        for (std::uint32_t k = 1; k + 1 < face.count; ++k) {
            const Vec3 q = hull.vertices[hull.face_vertices[face.first + k]] - inside;
            const Vec3 r = hull.vertices[hull.face_vertices[face.first + k + 1]] - inside;
            const double v = dot(p, cross(q, r));
            six_volumes += v;
            moment += (p + q + r) * (0.25 * v);
        }
    }
    hull.volume = six_volumes / 6.0;
    hull.centroid = inside + moment / six_volumes;
    for (Vec3& v : hull.vertices) v -= hull.centroid;
}

void measure(ConvexHull& hull) {
    hull.inradius = 1e300;
    for (ConvexHull::Face& face : hull.faces) {
        face.n = normalized(area_vector(hull, face));
        face.offset = -1e300;
        for (std::uint32_t k = 0; k < face.count; ++k)
            face.offset =
                std::max(face.offset, dot(face.n, hull.vertices[hull.face_vertices[face.first + k]]));
        hull.inradius = std::min(hull.inradius, face.offset);
    }
    Hash hash;
    for (const Vec3& v : hull.vertices) {
        hull.radius = std::max(hull.radius, norm(v));
        hash.add(v.x), hash.add(v.y), hash.add(v.z);
    }
    hull.hash = hash.value();
    hull.cells.build(hull.vertices);
}

/// Edges from the loops; false unless each has two faces and the whole is a ball (Euler).
bool connect(ConvexHull& hull) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
    hull.face_edges.resize(hull.face_vertices.size());
    for (std::uint32_t f = 0; f < hull.faces.size(); ++f) {
        const ConvexHull::Face& face = hull.faces[f];
        for (std::uint32_t k = 0; k < face.count; ++k) {
            const std::uint32_t a = hull.face_vertices[face.first + k];
            const std::uint32_t b = hull.face_vertices[face.first + (k + 1) % face.count];
            const auto [entry, is_new] =
                known.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(hull.edges.size()));
            if (is_new) {
                const std::uint32_t low = std::min(a, b), high = std::max(a, b);
                hull.edges.push_back(
                    {low, high, kNone, kNone, normalized(hull.vertices[high] - hull.vertices[low])});
            }
            ConvexHull::Edge& edge = hull.edges[entry->second];
            std::uint32_t& side = a < b ? edge.left : edge.right;
            if (side != kNone) return false;
            side = f;
            hull.face_edges[face.first + k] = entry->second;
        }
    }
    std::vector<std::vector<std::uint32_t>> edges_at(hull.vertices.size()), faces_at(hull.vertices.size());
    for (std::uint32_t e = 0; e < hull.edges.size(); ++e) {
        if (hull.edges[e].left == kNone || hull.edges[e].right == kNone) return false;
        edges_at[hull.edges[e].a].push_back(e);
        edges_at[hull.edges[e].b].push_back(e);
    }
    for (std::uint32_t f = 0; f < hull.faces.size(); ++f)
        for (std::uint32_t k = 0; k < hull.faces[f].count; ++k)
            faces_at[hull.face_vertices[hull.faces[f].first + k]].push_back(f);
    for (std::size_t v = 0; v < hull.vertices.size(); ++v) {
        if (edges_at[v].size() != faces_at[v].size()) return false;
        hull.vertex_first.push_back(static_cast<std::uint32_t>(hull.vertex_edges.size()));
        hull.vertex_edges.insert(hull.vertex_edges.end(), edges_at[v].begin(), edges_at[v].end());
        hull.vertex_faces.insert(hull.vertex_faces.end(), faces_at[v].begin(), faces_at[v].end());
    }
    hull.vertex_first.push_back(static_cast<std::uint32_t>(hull.vertex_edges.size()));
    return hull.vertices.size() + hull.faces.size() == hull.edges.size() + 2;
}

}  // namespace

Result<ConvexHull> build_hull(std::span<const Vec3> points) {
    if (points.size() < 4)
        return Error{"a convex hull needs at least four points, not " + std::to_string(points.size()),
                     "Give a solid body."};
    Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    for (const Vec3& p : points) {
        if (!is_finite(p) || norm(p) > 1e9)
            return Error{"a point is not finite or beyond all sizes", "Correct it."};
        low = {fixed_min(low.x, p.x), fixed_min(low.y, p.y), fixed_min(low.z, p.z)};
        high = {fixed_max(high.x, p.x), fixed_max(high.y, p.y), fixed_max(high.z, p.z)};
    }
    const double tolerance = kFlat * norm(high - low);
    QuickHull quick(points, tolerance);
    const Error flat{"the points lie in one plane (or nearly): their hull has no volume",
                     "Give a solid body, or a box of the thickness that is meant."};
    if (!(tolerance > 0) || !quick.build()) return flat;
    // Merging may fail on slivers only; then triangles do as well, with a wider meaning of flat first.
    for (const double merge : {4.0 * tolerance, 40.0 * tolerance, -1.0}) {
        ConvexHull hull;
        std::uint32_t groups = 0;
        const auto group = merge_coplanar(points, quick.facets, merge, groups);
        const auto loops = outlines(quick.facets, group, groups);
        if (loops.size() < 4) continue;
        add_faces(points, loops, hull);
        if (hull.vertices.size() > kVerticesMax)
            return Error{"the hull has " + std::to_string(hull.vertices.size()) + " corners, more than " +
                             std::to_string(kVerticesMax),
                         "Give a coarser mesh for the collision."};
        centre(hull);
        if (!connect(hull) || !(hull.volume > 0)) continue;
        measure(hull);
        if (hull.inradius > 0) return hull;
    }
    return flat;
}

HullParts parts_of(const ConvexHull& hull) {
    HullParts parts{hull.vertices, {}, hull.face_vertices, hull.centroid, hull.volume};
    for (const ConvexHull::Face& face : hull.faces) parts.loop_sizes.push_back(face.count);
    return parts;
}

namespace {

/// Loops of at least three corners that exist, one after the other, covering face_vertices.
bool loops_fit(const HullParts& parts) {
    std::size_t corners = 0;
    for (const std::uint32_t size : parts.loop_sizes) {
        if (size < 3 || size > parts.face_vertices.size() - corners) return false;
        for (std::uint32_t k = 0; k < size; ++k) {
            const std::uint32_t a = parts.face_vertices[corners + k];
            if (a >= parts.vertices.size() || a == parts.face_vertices[corners + (k + 1) % size])
                return false;
        }
        corners += size;
    }
    return corners == parts.face_vertices.size();
}

}  // namespace

Result<ConvexHull> join_hull(HullParts parts) {
    const Error broken{"the parts of a convex hull do not close to a convex body", ""};
    const bool finite = std::all_of(parts.vertices.begin(), parts.vertices.end(),
                                    [](const Vec3& v) { return is_finite(v) && norm(v) < 1e9; });
    if (!finite || !is_finite(parts.centroid) || !(parts.volume > 0 && parts.volume < 1e30)) return broken;
    if (parts.vertices.size() > kVerticesMax || parts.vertices.size() < 4 || !loops_fit(parts)) return broken;
    ConvexHull hull;
    hull.vertices = std::move(parts.vertices);
    hull.face_vertices = std::move(parts.face_vertices);
    hull.centroid = parts.centroid;
    hull.volume = parts.volume;
    std::uint32_t first = 0;
    for (const std::uint32_t size : parts.loop_sizes) {
        hull.faces.push_back({{}, 0, first, size});
        first += size;
    }
    if (!connect(hull)) return broken;
    for (std::size_t v = 0; v < hull.vertices.size(); ++v)
        if (hull.vertex_first[v + 1] - hull.vertex_first[v] < 3) return broken;
    measure(hull);
    if (!(hull.inradius > 0)) return broken;
    return hull;
}

}  // namespace roboss
