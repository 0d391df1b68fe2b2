// The straight edge or line of a shape that lies furthest in a direction, for contacts without a face: two
// crossing or parallel lines, a line and a point, two points.
#pragma once

#include "geometry/face_region.h"

namespace roboss::narrow {

struct SupportLine {
    Vec3 middle, half;  // the line runs from middle - half to middle + half; a point: half = 0
    std::uint32_t part0 = 0, part1 = 0, part = 0;  // of the two ends, of the line between
};

/// The feature of `shape` furthest along the unit vector d: a line when one is perpendicular to d to within
/// the sine `tolerance`, else a point.
SupportLine support_line(const Posed& shape, const Vec3& d, double tolerance);

/// Parameters in [-1, 1] of the closest points of two lines (Ericson, "Real-Time Collision Detection",
/// section 5.1.9).
struct LineParameters {
    double s = 0, t = 0;
};
LineParameters closest_parameters(const SupportLine& a, const SupportLine& b);

/// The two ends of the common part of two almost parallel lines; false when they are not parallel or have
/// none.
bool common_part(const SupportLine& a, const SupportLine& b, double width,
                 std::array<LineParameters, 2>& ends);

/// Two lines that touch once `b` has been moved by `gap` along `n`.
struct LinePair {
    SupportLine a, b;
    Vec3 n;
    double gap = 0;
    double width = 0;  // sideways distance below which they count as touching
};

/// Where they touch: at one place, at the two ends of the stretch along which they run side by side, or,
/// where they pass each other sideways by more than the width, nowhere.
struct TouchingLines {
    std::array<LineParameters, 2> at;
    std::size_t count = 0;
};
TouchingLines find_touching(const LinePair& pair);

/// Adds the contact of two lines (two points when they run side by side), gaps measured along n. Returns the
/// smallest gap; infinity, and nothing added, when the lines pass each other sideways by more than the width.
double add_lines(const LinePair& pair, double margin, Manifold& out);

}  // namespace roboss::narrow
