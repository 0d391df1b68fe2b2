// Triangle by triangle. Above a face whose edges are flat or valleys only the face's own normal counts. At a
// ridge the closest direction is searched, and counts only where no neighbour rises along it: else the
// neighbour is closer and speaks for itself.
#include "geometry/collide_surface.h"

#include <algorithm>

#include "geometry/closest_point.h"
#include "geometry/collide_general.h"
#include "geometry/over_triangle.h"
#include "geometry/ridge_direction.h"

namespace roboss {
namespace {

using namespace narrow;

constexpr double kTops = 1e-6;           // sine by which a neighbour may rise along a normal
constexpr double kUpright = 0.9;         // cosine
constexpr double kMerge = 1e-4;          // of the body's size
constexpr double kSameDirection = 0.98;  // cosine within which contacts are reduced together
constexpr std::uint32_t kAnywhere = 0xFFFFF;
constexpr double kDeeper = 1e-9;  // m
constexpr double kFar = 1e-9;     // m beyond the margin: more than rounding

class SurfaceCollider {
  public:
    /// Adds to out.candidates what counts, and to out.deep faces that a thin body may have gone through,
    /// which count if nothing else holds it.
    SurfaceCollider(const ConvexBody& body, const TriangleSurface& surface, double margin,
                    SurfaceContacts& out)
        : body_(body), surface_(surface), margin_(margin), out_(out) {}

    void collide(std::uint32_t number) {
        const SurfaceFace only_face = surface_.face(number);
        double height = dot(only_face.n, body_.centre() - only_face.v[0]);
        const bool below = height < 0.0;
        if (below && !surface_.is_ground() && surface_.sides() == SurfaceSides::kSolid) return;
        const bool turns = below && !surface_.is_ground();
        if (turns) height = -height;
        const Vec3 n = turns ? -only_face.n : only_face.n;
        const double s_face = height - body_.reach(-n) - body_.ball();
        if (s_face > margin_) return;
        number_ = number;
        const bool shallow = s_face > -kShallow * body_.size();
        take({only_face.v, only_face.n, {}, {}}, turns);
        if (height >= 0.0 && body_.is_round()) return collide_ball(turns);
        if (height >= 0.0 && is_far()) return;
        const ClippedFeature over = points_over();
        const bool over_it = !over.points.empty() && over.deepest() <= s_face + kLowest * body_.size();
        if (height < 0.0 || (shallow && over_it)) return add_face(over, out_.candidates);
        take(surface_.triangle(number), turns);  // only now its neighbours count
        const bool ridge = std::any_of(triangle_.fold.begin(), triangle_.fold.end(),
                                       [](double fold) { return fold < kRidgeFold; });
        if (shallow && !ridge) return add_face(over, out_.candidates);
        collide_ridge(over, shallow);
    }

  private:
    /// `turns`: the sheet is seen from its other side.
    void take(const SurfaceTriangle& triangle, bool turns) {
        triangle_ = triangle, turned_ = false;
        if (turns) turn_over();
    }

    void turn_over() {
        triangle_.n = -triangle_.n;
        std::swap(triangle_.v[1], triangle_.v[2]);
        std::swap(triangle_.beyond[0], triangle_.beyond[2]);
        std::swap(triangle_.fold[0], triangle_.fold[2]);
        for (double& fold : triangle_.fold)
            if (fold != SurfaceTriangle::kBorder) fold = -fold;
        turned_ = true;
    }

    std::size_t corner_of_surface(std::size_t k) const { return turned_ && k > 0 ? 3 - k : k; }

    ClippedFeature points_over() const { return narrow::points_over(body_, triangle_.v, triangle_.n); }

    /// True only if the body is further than the margin; quick, and mostly true where it is.
    bool is_far() const {
        const Vec3 away = body_.centre() - closest_point(triangle_.v, body_.centre());
        const double distance = norm(away), enough = margin_ + body_.ball();
        return distance > 0.0 && distance - body_.reach(away / -distance) > enough + kFar;
    }

    void collide_ridge(const ClippedFeature& over, bool shallow) {
        const double enough = margin_ + body_.ball();
        RidgeDirection found = ridge_direction(body_, triangle_, enough);
        if (found.across == Across::kApart) return;
        // Only the general search tells where the way out of what has sunk in is.
        if (found.best.s < body_.ball() - kShallow * body_.size()) found.across = Across::kUnknown;
        if (found.across == Across::kNeighbour && (shallow || surface_.is_ground() || over.points.empty()))
            return add_face(over, out_.candidates);
        if (found.across != Across::kRidge) {
            const std::optional<Separation> at_corner = corner_separation(body_, triangle_.v);
            const ConvexBody sheet(triangle_.v, triangle_.n);
            found.best = at_corner ? *at_corner : best_separation(body_, sheet, enough);
        }
        if (found.best.s <= enough) add_along(found.best, over, shallow);
    }

    /// A ball whose centre is above the face: the closest point of the triangle tells all.
    void collide_ball(bool turns) {
        if (const ClippedFeature over = points_over(); !over.points.empty())
            return add_face(over, out_.candidates);
        const Vec3 foot = closest_point(triangle_.v, body_.centre()), away = body_.centre() - foot;
        const double distance = norm(away), gap = distance - body_.ball();
        if (gap > margin_ || distance == 0.0) return;
        take(surface_.triangle(number_), turns);
        const ConvexBody sheet(triangle_.v, triangle_.n);
        const Vec3 n = away / distance;
        if (!is_own_normal(sheet, n)) return;
        const Feature top = sheet.line(n, kTops);
        add(foot + n * (0.5 * gap), n, gap, 0, top.count == 2 ? top.edge_part[0] : top.part[0],
            out_.candidates);
    }

    /// `best`: the way out of the triangle alone.
    void add_along(const Separation& best, const ClippedFeature& over, bool shallow) {
        const ConvexBody sheet(triangle_.v, triangle_.n);
        if (!is_own_normal(sheet, best.n)) {
            // Near the face's normal: the body is only deeper over a neighbour, it has not gone through.
            const bool held = shallow || surface_.is_ground() || dot(best.n, triangle_.n) > kUpright;
            if (best.s < body_.ball()) out_.pierced.push_back(triangle_.n);
            return add_face(over, held ? out_.candidates : out_.deep);
        }
        Manifold manifold;
        write_general(body_, sheet, best, margin_, manifold);
        for (int i = 0; i < manifold.count; ++i) {
            const ContactPoint& p = manifold.points[static_cast<std::size_t>(i)];
            add(p.p_W, manifold.n_W, p.gap, p.feature >> 16, p.feature & 0xFFFFu, out_.candidates);
        }
    }

    /// Whether the surface, not only this triangle, ends along d here.
    bool is_own_normal(const ConvexBody& sheet, const Vec3& d) const {
        const double along = dot(d, triangle_.n);
        if (along < -kTops) return false;
        if (along > 1.0 - 1e-12) return true;
        const Feature top = sheet.line(d, kTops);
        if (top.count == 2) {
            const std::size_t edge = top.edge_part[0] - 3;
            if (triangle_.fold[edge] == SurfaceTriangle::kBorder) return true;
            const Vec3 across = triangle_.beyond[edge] - triangle_.v[edge];
            return triangle_.fold[edge] < kRidgeFold && dot(d, across) <= kTops * norm(across);
        }
        return surface_.tops(number_, corner_of_surface(top.part[0]), d, kTops);
    }

    void add_face(const ClippedFeature& over, std::vector<SurfaceContact>& to) {
        const Vec3& n = triangle_.n;
        for (const OverFace& c : over.points) {
            if (c.gap <= margin_)
                add(c.p - n * (body_.ball() + 0.5 * c.gap), n, c.gap, c.part, c.reference_part, to);
        }
    }

    void add(const Vec3& p, const Vec3& n, double gap, std::uint32_t part, std::uint32_t triangle_part,
             std::vector<SurfaceContact>& to) {
        // A corner of the body keeps its name as it passes from triangle to triangle.
        const std::uint32_t place = triangle_part == kTriangleFace ? kAnywhere : number_;
        to.push_back({p, n, gap, place << 12 | (part & 0xFFu) << 4 | (triangle_part & 0xFu)});
    }

    const ConvexBody& body_;
    const TriangleSurface& surface_;
    double margin_;
    SurfaceContacts& out_;
    std::uint32_t number_ = 0;
    SurfaceTriangle triangle_;
    bool turned_ = false;
};

/// Takes the points of one cluster that count: at most 8, no two in one place.
void reduce_cluster(SurfaceContacts& work, double merge) {
    const std::vector<SurfaceContact>& cluster = work.cluster;
    if (cluster.size() == 1) return work.points.push_back(cluster.front());
    // Also where they are few: points on seams between the outermost ones would only come and go.
    work.positions.clear(), work.gaps.clear();
    for (const SurfaceContact& c : cluster) work.positions.push_back(c.p_W), work.gaps.push_back(c.gap);
    const Chosen chosen = choose_points(work.positions, work.gaps, cluster.front().n_W);
    const std::size_t first = work.points.size();
    for (std::size_t k = 0; k < chosen.count; ++k) {
        const SurfaceContact& c = cluster[chosen.number[k]];
        const auto known =
            std::find_if(work.points.begin() + static_cast<std::ptrdiff_t>(first), work.points.end(),
                         [&](const SurfaceContact& other) { return norm(other.p_W - c.p_W) <= merge; });
        if (known == work.points.end()) {
            work.points.push_back(c);
        } else if (c.gap < known->gap - kDeeper) {
            *known = c;
        }
    }
}

/// Groups the candidates by direction, in the order in which they were found.
void reduce(SurfaceContacts& work, double merge) {
    while (!work.candidates.empty()) {
        const Vec3 n = work.candidates.front().n_W;
        work.cluster.clear();
        std::size_t kept = 0;
        for (const SurfaceContact& c : work.candidates) {
            if (dot(c.n_W, n) > kSameDirection)
                work.cluster.push_back(c);
            else
                work.candidates[kept++] = c;
        }
        work.candidates.resize(kept);
        reduce_cluster(work, merge);
    }
}

/// A body thinner than it is deep, stuck through a face, is nearest to the outside sideways, where the
/// surface does not end. If nothing else holds it, the face does that it has gone through least: its centre
/// is still before it. A body that passes beside the surface and reaches behind it overlaps no face there.
void add_deep_faces(SurfaceContacts& work) {
    std::erase_if(work.deep, [&](const SurfaceContact& c) {
        return std::ranges::none_of(work.pierced,
                                    [&](const Vec3& n) { return dot(n, c.n_W) > kSameDirection; });
    });
    if (work.deep.empty()) return;
    const auto holds = [](const SurfaceContact& c) { return c.gap < 0.0; };
    if (std::any_of(work.candidates.begin(), work.candidates.end(), holds)) return;
    const auto depth_along = [&](const Vec3& n) {
        double depth = 0;
        for (const SurfaceContact& c : work.deep)
            if (dot(c.n_W, n) > kSameDirection) depth = std::max(depth, -c.gap);
        return depth;
    };
    Vec3 least = work.deep.front().n_W;
    double least_depth = depth_along(least);
    for (const SurfaceContact& c : work.deep)
        if (const double depth = depth_along(c.n_W); depth < least_depth) least = c.n_W, least_depth = depth;
    for (const SurfaceContact& c : work.deep)
        if (dot(c.n_W, least) > kSameDirection) work.candidates.push_back(c);
}

/// Equal names (parts beyond 8 bits, triangles beyond 20) are told apart by counting on.
void name_apart(std::vector<SurfaceContact>& points) {
    for (std::size_t i = 1; i < points.size(); ++i) {
        const auto taken = [&] {
            return std::any_of(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(i),
                               [&](const SurfaceContact& c) { return c.feature == points[i].feature; });
        };
        while (taken()) ++points[i].feature;
    }
}

}  // namespace

void collide_surface(const Shape& shape, const Transform& X_WA, const TriangleSurface& surface,
                     const Transform& X_WS, double margin, SurfaceContacts& out) {
    out.points.clear();
    out.candidates.clear();
    out.deep.clear(), out.pierced.clear();
    if (shape.kind == ShapeKind::kPlane || shape.kind == ShapeKind::kSurface) return;
    const Transform X_SA = inverse(X_WS) * X_WA;
    surface.query(bounds(shape, X_SA).inflated(margin), out.triangles);
    if (out.triangles.empty()) return;
    const Posed posed{shape, X_SA};
    const ConvexBody body(posed);
    for (const std::uint32_t number : out.triangles)
        SurfaceCollider(body, surface, margin, out).collide(number);
    add_deep_faces(out);
    reduce(out, kMerge * body.size());
    name_apart(out.points);
    for (SurfaceContact& c : out.points) c.p_W = X_WS * c.p_W, c.n_W = X_WS.R * c.n_W;
}

}  // namespace roboss
