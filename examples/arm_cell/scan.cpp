#include "scan.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <roboss/app/worlds/cell_layout.h>
#include "core/fixed_math.h"

namespace arm_cell {
namespace {

constexpr double kLeastHeight = 0.02;  // m: what rises as much above the belt belongs to a box
constexpr double kGap = 0.03;          // m: a gap along the belt parts two boxes
constexpr std::size_t kFewestPoints = 150;
constexpr double kEdge = 0.015;  // m: nearer to the edge of the field, a box may be cut off

struct Point {
    double x = 0, y = 0, z = 0;
};

/// Points above the belt, in the order of the beams: x ascends.
std::vector<Point> points_above(std::span<const double> ranges) {
    std::vector<Point> points;
    const double field = roboss::fixed_atan2(kScannerField, kScannerHeight - kBeltTop);
    const auto angle = [&](int beam) { return field * (2.0 * beam / (kScannerBeams - 1) - 1); };
    for (int row = 0; row < kScannerBeams; ++row)
        for (int column = 0; column < kScannerBeams; ++column) {
            const double range = ranges[static_cast<std::size_t>(row * kScannerBeams + column)];
            if (!std::isfinite(range)) continue;
            // Beam (cos e cos a, cos e sin a, sin e) of a sensor whose x points down and whose z points along
            // the belt.
            const double e = angle(row), a = angle(column), flat = range * roboss::fixed_cos(e);
            const Point point{kScannerX + range * roboss::fixed_sin(e),
                              kBeltAside + flat * roboss::fixed_sin(a),
                              kScannerHeight - flat * roboss::fixed_cos(a)};
            if (point.z > kBeltTop + kLeastHeight) points.push_back(point);
        }
    return points;
}

}  // namespace

std::optional<SeenBox> find_box(std::span<const double> ranges) {
    std::vector<Point> points = points_above(ranges);
    std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.x > b.x; });
    std::size_t count = std::min<std::size_t>(1, points.size());
    while (count < points.size() && points[count - 1].x - points[count].x < kGap) ++count;
    if (count < kFewestPoints) return std::nullopt;
    points.resize(count);
    double top = 0;
    for (const Point& point : points) top += point.z / static_cast<double>(count);
    // Sides of the box that the outer beams meet lie below its top.
    std::erase_if(points, [&](const Point& point) { return point.z < top - 0.01; });
    if (points.front().x > kScannerX + kScannerField - kEdge ||
        points.back().x < kScannerX - kScannerField + kEdge)
        return std::nullopt;
    double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    const double share = 1.0 / static_cast<double>(points.size());
    for (const Point& point : points) x += share * point.x, y += share * point.y;
    for (const Point& point : points) {
        const double dx = point.x - x, dy = point.y - y;
        xx += dx * dx, xy += dx * dy, yy += dy * dy;
    }
    // The axis of the larger second moment is the longer side.
    return SeenBox{x, y, top, 0.5 * roboss::fixed_atan2(2 * xy, xx - yy)};
}

}  // namespace arm_cell
