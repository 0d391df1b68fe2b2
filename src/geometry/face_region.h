// A flat face (box face or cylinder cap) as a region of its plane, and the contact points that another
// shape's nearest feature (face, cap, line) leaves over it: corners of either inside the other and crossings
// of their outlines. Parts of a cylinder: 0 and 1 the ends of its line, 2 .. 5 and 6 .. 9 the rim points of
// the end at -z and +z, 10 .. 13 crossings of the rims with an outline (two an end), 14 and 15 the caps, 20 a
// rim, 21 the line. Of a capsule: 0, 1, 21.
#pragma once

#include "geometry/box_face.h"

namespace roboss::narrow {

inline constexpr std::uint32_t kRimPoint = 2, kRimCrossing = 10, kCap = 14, kRim = 20, kLine = 21,
                               kRimLeft = 22;

/// Up to 8 points from any number of candidates.
class Candidates {
  public:
    explicit Candidates(double tolerance) : tolerance_(tolerance) {}

    /// Points closer than the tolerance to an earlier one are merged with it (the deeper position stays).
    void add(const ClippedPoint& candidate);
    /// Leaves at most 8: the deepest, then always the one furthest from those taken.
    void reduce();
    double deepest() const;
    std::size_t count() const { return count_; }
    const ClippedPoint& operator[](std::size_t i) const { return points_[i]; }

  private:
    double tolerance_ = 0;
    std::size_t count_ = 0;
    std::array<ClippedPoint, 20> points_;
};

/// A face: rectangle or disc.
struct FaceRegion {
    Vec3 centre, n, ex, ey;  // in W; n outward
    double hx = 0, hy = 0;   // rectangle: half sizes; disc: both the radius
    bool round = false;
    const Posed& owner;
    std::size_t axis = 2;  // the owner's axis across the face
    bool upper = false;    // which of the two

    /// The face of a box across its axis `across`, or a cylinder's cap; on the side that looks along d.
    FaceRegion(const Posed& shape, std::size_t across, const Vec3& d);

    Vec3 local(const Vec3& p_W) const { return local_vector(p_W - centre); }
    Vec3 local_vector(const Vec3& d_W) const { return {dot(ex, d_W), dot(ey, d_W), dot(n, d_W)}; }
    /// How deep (x, y) lies inside the outline (negative: outside).
    double clearance(double x, double y) const;
    std::uint32_t end() const { return upper ? 1 : 0; }
    /// Number of the box edge at the end of ex or ey.
    std::uint32_t edge_at(bool along_y, bool positive) const;
};

/// Contact points of `other` (box, cylinder or capsule) over the face.
Candidates points_over(const FaceRegion& face, const Posed& other);

}  // namespace roboss::narrow
