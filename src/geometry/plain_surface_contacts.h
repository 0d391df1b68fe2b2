// Contacts of a body with single triangles found by the general routines alone, as a measure for
// collide_surface: each triangle is clipped against the body's feature as a polygon, and every direction is
// searched at ridges.
#pragma once

#include <algorithm>
#include <vector>

#include "geometry/closest_point.h"
#include "geometry/collide_general.h"
#include "geometry/collide_surface.h"

namespace roboss::test {

using namespace narrow;

inline constexpr double kPlainRidge = -1e-6, kTops = 1e-6, kUpright = 0.9, kShallow = 0.05, kBorder = 2e-6,
                        kMerge = 1e-4, kFar = 1e-9;
inline constexpr std::uint32_t kFace = 6, kAnywhere = 0xFFFFF;

class PlainCollider {
  public:
    /// Adds to out.candidates what counts, and to out.deep faces that a thin body may have gone through,
    /// which count if nothing else holds it.
    PlainCollider(const ConvexBody& body, const TriangleSurface& surface, double margin, SurfaceContacts& out)
        : body_(body), surface_(surface), margin_(margin), out_(out) {}

    void collide(std::uint32_t number) {
        number_ = number;
        triangle_ = surface_.triangle(number);
        double height = dot(triangle_.n, body_.centre() - triangle_.v[0]);
        if (height < 0.0 && !surface_.is_ground()) {
            if (surface_.sides() == SurfaceSides::kSolid) return;
            turn_over();
            height = -height;
        }
        const Vec3& n = triangle_.n;
        const double s_face = height - body_.reach(-n) - body_.ball();
        if (s_face > margin_) return;
        Feature face;
        face.n = n;
        face.face_part = kFace;
        for (std::uint32_t k = 0; k < 3; ++k) face.add(triangle_.v[k], k, 3 + k);
        const ClippedFeature over =
            clip_over(face, body_.feature(-n), body_.ball(), kBorder * body_.size(), kMerge * body_.size());
        const bool shallow = s_face > -kShallow * body_.size();
        const bool ridge = std::any_of(triangle_.fold.begin(), triangle_.fold.end(),
                                       [](double fold) { return fold < kPlainRidge; });
        const bool over_it = !over.points.empty() && over.deepest() <= s_face + 1e-6 * body_.size();
        if ((shallow && (!ridge || over_it)) || height < 0.0) return add_face(over, out_.candidates);
        collide_ridge(over, shallow);
    }

  private:
    /// The sheet seen from its other side.
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

    /// True only if the body is further than the margin; quick, and mostly true where it is.
    bool is_far() const {
        const Vec3 away = body_.centre() - closest_point(triangle_.v, body_.centre());
        const double distance = norm(away), enough = margin_ + body_.ball();
        return distance > 0.0 && distance - body_.reach(away / -distance) > enough + kFar;
    }

    void collide_ridge(const ClippedFeature& over, bool shallow) {
        if (is_far()) return;
        const ConvexBody sheet(triangle_.v, triangle_.n);
        const Separation best = best_separation(body_, sheet, margin_ + body_.ball());
        if (best.s > margin_ + body_.ball()) return;
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

    /// True if the surface, not only this triangle, ends along d here.
    bool is_own_normal(const ConvexBody& sheet, const Vec3& d) const {
        const double along = dot(d, triangle_.n);
        if (along < -kTops) return false;
        if (along > 1.0 - 1e-12) return true;
        const Feature top = sheet.line(d, kTops);
        if (top.count == 2) {
            const std::size_t edge = top.edge_part[0] - 3;
            if (triangle_.fold[edge] == SurfaceTriangle::kBorder) return true;
            const Vec3 across = triangle_.beyond[edge] - triangle_.v[edge];
            return triangle_.fold[edge] < kPlainRidge && dot(d, across) <= kTops * norm(across);
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
        const std::uint32_t place = triangle_part == kFace ? kAnywhere : number_;
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

/// The candidates of all triangles, as SurfaceContacts::candidates before they are reduced; in the surface's
/// frame.
inline std::vector<SurfaceContact> plain_contacts(const Shape& shape, const Transform& X_SA,
                                                  const TriangleSurface& surface, double margin) {
    SurfaceContacts work;
    const Posed posed{shape, X_SA};
    const ConvexBody body(posed);
    for (std::uint32_t t = 0; t < surface.triangle_count(); ++t)
        PlainCollider(body, surface, margin, work).collide(t);
    return work.candidates;
}

}  // namespace roboss::test
