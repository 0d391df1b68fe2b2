// One feature clipped against the prism over a face: the contact points of two polygons, with their parts,
// and the choice of at most eight of many.
#pragma once

#include <span>

#include "geometry/convex_body.h"
#include "geometry/fixed_list.h"

namespace roboss::narrow {

/// A point of the incident feature over the reference face.
struct OverFace {
    Vec3 p;  // of the incident core, W
    double gap = 0;
    std::uint32_t part = 0, reference_part = 0;
};

struct ClippedFeature {
    static constexpr std::size_t kMaxPoints = 2 * Feature::kMaxPoints;
    FixedList<OverFace, kMaxPoints> points;

    double deepest() const;  // smallest gap; infinity: no point
};

/// `ball`: of the incident core; gaps are along the face's normal. Points up to `border` beside the face
/// still count as over it; points closer together than `merge` are one.
ClippedFeature clip_over(const Feature& face, const Feature& incident, double ball, double border,
                         double merge);

/// Leaves the deepest point and the outermost in seven directions of the plane across n: returns their
/// numbers in ascending order. The outermost hold still where the deepest is noise.
struct Chosen {
    std::size_t count = 0;
    std::array<std::size_t, 8> number{};
};
Chosen choose_points(std::span<const Vec3> points, std::span<const double> gaps, const Vec3& n);

}  // namespace roboss::narrow
