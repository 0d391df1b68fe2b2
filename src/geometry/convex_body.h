// Any bounded convex shape, or one triangle, as the general narrow phase sees it: a core (point, segment,
// polytope, cylinder, ellipsoid) plus a ball of some radius round it; its support function, the kinks of that
// function near a direction, and the feature that lies furthest along a direction.
#pragma once

#include <array>
#include <optional>

#include "geometry/convex_hull.h"
#include "geometry/fixed_list.h"
#include "geometry/narrow.h"

namespace roboss::narrow {

/// The edges that are nearly perpendicular to a direction, and the face normals that are nearly along it.
struct NearFeatures {
    FixedList<Vec3, 16> edges;   // unit, W
    FixedList<Vec3, 8> normals;  // unit, W, outward

    void add_edge(const Vec3& e) {
        if (!edges.full()) edges.push_back(e);
    }
    void add_normal(const Vec3& n) {
        if (!normals.full()) normals.push_back(n);
    }
};

/// A feature of a core as a polygon in W: one point, a line (two), or a face (more, counter-clockwise seen
/// from outside). Parts name points and the edges that follow them; 16 bits.
struct Feature {
    static constexpr std::size_t kMaxPoints = 16;
    std::size_t count = 0;
    FixedList<Vec3, kMaxPoints> points;
    std::array<std::uint32_t, kMaxPoints> part;
    std::array<std::uint32_t, kMaxPoints> edge_part;
    std::uint32_t face_part = 0;
    Vec3 n;  // of a face: unit, outward

    bool is_face() const { return count > 2; }
    void add(const Vec3& p, std::uint32_t name, std::uint32_t edge_name) {
        points.push_back(p);
        part[count] = name;
        edge_part[count++] = edge_name;
    }
};

class ConvexBody {
  public:
    /// Of a sphere, box, cylinder, capsule, ellipsoid or hull; both must outlive the body.
    explicit ConvexBody(const Posed& posed);
    /// A triangle in W; its normal looks to where its corners go round counter-clockwise.
    ConvexBody(const std::array<Vec3, 3>& corners, const Vec3& n);

    const Vec3& centre() const { return centre_; }
    double ball() const { return ball_; }
    bool curved() const { return core_ == Core::kCylinder || core_ == Core::kEllipsoid; }
    double size() const { return size_; }          // the smallest, for tolerances, m
    double inradius() const { return inradius_; }  // of the core

    /// The core's point furthest along d (any length but zero), from the centre.
    Vec3 support(const Vec3& d) const;
    /// d . support(d).
    double reach(const Vec3& d) const;
    /// The core's point closest to a point outside of it; none for an ellipsoid, a hull and a triangle.
    std::optional<Vec3> closest_to(const Vec3& p) const;
    /// Axes of straight edges and lines, and of rims, so that the support point jumps where d is
    /// perpendicular to one; those of a hull are too many and are left out.
    FixedList<Vec3, 3> kinks() const;
    bool is_round() const { return core_ == Core::kPoint; }
    bool is_hull() const { return core_ == Core::kHull; }
    /// True if the feature along any direction is a single point.
    bool is_pointed() const { return core_ == Core::kPoint || core_ == Core::kEllipsoid; }
    NearFeatures near(const Vec3& d, double sine) const;
    /// Adds the second derivatives of the support function at the unit vector d along the tangents t1, t2;
    /// false where it has none.
    bool add_curvature(const Vec3& d, const Vec3& t1, const Vec3& t2, double& h11, double& h12,
                       double& h22) const;

    /// The feature furthest along d that may meet a face: always a face of a polytope, its best at the
    /// furthest corner; a cylinder's cap as an octagon, or its line.
    Feature feature(const Vec3& d) const;
    /// The normal of feature(d) if that is a face, else zero.
    Vec3 face_normal(const Vec3& d) const;
    /// The edge furthest along the unit vector d if one is perpendicular to it to within the sine
    /// `tolerance`, else the point.
    Feature line(const Vec3& d, double tolerance) const;

  private:
    enum class Core { kPoint, kSegment, kBox, kCylinder, kEllipsoid, kHull, kTriangle };

    void near_hull(const Vec3& d, double sine, NearFeatures& found) const;
    Feature hull_face(const Vec3& d) const;
    Feature hull_line(const Vec3& d, double tolerance) const;
    Feature round_line(const Vec3& d, double tolerance) const;
    Feature cap(bool upper, const Vec3& d) const;
    Feature box_face(const Vec3& d) const;
    Feature box_line(const Vec3& d, double tolerance) const;
    Feature triangle_line(const Vec3& d, double tolerance) const;

    Core core_ = Core::kPoint;
    const Posed* posed_ = nullptr;
    Vec3 centre_;
    double ball_ = 0, size_ = 0, inradius_ = 0;
    std::array<Vec3, 3> corners_;  // of a triangle, W
    Vec3 normal_;
};

}  // namespace roboss::narrow
