// The signed distance of two convex shapes as one function of a direction. All our shapes are symmetric about
// their centres, so for a unit normal n the gap along n is s(n) = n.c - h(n): c goes from the second centre
// to the first, h is the support function of the sum of both shapes (segments and discs; a capsule's ball is
// added by the caller). The signed distance is the largest s(n), apart or penetrating; every s(n) is a lower
// bound of it.
#pragma once

#include <array>

#include "geometry/narrow.h"

namespace roboss::narrow {

struct Separation {
    Vec3 n;  // unit, from the second shape to the first
    double s = -1e300;
};

/// A separation and the point of the sum furthest along its direction.
struct Touching : Separation {
    Vec3 support;
    Vec3 first;  // the first shape's share of it
};

class ConvexSum {
  public:
    static constexpr bool kSymmetric = true;
    ConvexSum(const Posed& first, const Posed& second);

    const Vec3& centre() const { return centre_; }
    double inradius() const { return inradius_; }  // lower bound of the sum's
    double scale() const { return scale_; }        // smallest size of either shape: what tolerances refer to
    // Gaps between the bounds at which the searches stop, of the distance and size; polishing does the rest.
    double apart_gap() const { return 1e-6; }
    double overlap_gap() const { return 1e-6; }
    double reach(const Vec3& n) const;  // h(n), n need not be a unit vector
    Vec3 support(const Vec3& n) const;
    ConvexSum moved(const Vec3& by) const;  // the first shape moved
    Separation separation(const Vec3& n) const { return {n, dot(n, centre_) - reach(n)}; }
    /// separation() and support() at once, bit for bit.
    Touching touching(const Vec3& n) const;

    /// The best of the directions in which flat facets of the sum can look (and some round ones), or the
    /// first that separates by more than `enough`.
    Separation best_natural(double enough) const;

    /// A guess at a nearby maximum: where two segments or more are nearly perpendicular to start.n, the best
    /// of their common normals; where one is, the best direction across it. May be worse than `start`.
    Separation at_kink(const Separation& start) const;

    /// Improves a nearby maximum to rounding: all combinations of features close to start.n, each by Newton's
    /// method on the sphere. Between equals the flatter one wins. The result is below start by rounding at
    /// most.
    Separation polished(const Separation& start) const;

  private:
    struct Disc {
        Vec3 axis;
        double radius = 0;
    };
    void add(const Posed& shape);
    double rounding() const;  // differences of s below it are noise
    /// Newton's method, perpendicular to the edge if one is given.
    Separation climb(const Vec3& start, const Vec3* edge) const;
    bool rises(const Vec3& n, const Vec3& d) const;  // s grows from n towards d or -d
    /// Segments nearly perpendicular to n; returns their number.
    std::size_t edges_across(const Vec3& n, std::array<Vec3, 6>& edges) const;
    /// The separation along a line's direction that is close to n, if it is better.
    void consider_flat(const Vec3& line, const Vec3& n, Separation& best) const;
    void climb_beside(const Vec3& n, const Vec3& d, const Vec3* edge, Separation& best) const;
    Separation better(const Separation& best, const Separation& found) const;

    Vec3 centre_;
    double inradius_ = 0, scale_ = 1e300;
    std::size_t segment_count_ = 0, disc_count_ = 0;
    std::size_t first_segments_ = 0, first_discs_ = 0;
    std::array<Vec3, 6> direction_;  // of the segments, unit
    std::array<double, 6> half_{};
    std::array<Disc, 2> discs_;
};

}  // namespace roboss::narrow
