// See cone.h.
#include "sensors/cone.h"

#include <algorithm>
#include <cmath>

#include "core/fixed_math.h"
#include "sensors/infinity.h"
#include "sensors/readings.h"

namespace roboss {
namespace {

constexpr double kSpacing = kPi / 90;  // rad between neighbours, at most
constexpr int kRingsLeast = 4;         // in a narrow cone

}  // namespace

std::vector<Vec3> cone_about_minus_z(double opening) {
    std::vector<Vec3> out{{0, 0, -1}};
    if (!(opening > 0)) return out;
    const int rings = std::max(kRingsLeast, static_cast<int>(std::ceil(opening / kSpacing)));
    const double spacing = opening / rings;
    for (int ring = 1; ring <= rings; ++ring) {
        const SinCos off = fixed_sincos(spacing * ring);
        const int count = std::max(1, static_cast<int>(std::ceil(2 * kPi * off.sin / spacing)));
        for (int i = 0; i < count; ++i) {
            const SinCos round = fixed_sincos(2 * kPi * i / count);
            out.push_back({off.sin * round.cos, off.sin * round.sin, -off.cos});
        }
    }
    return out;
}

double nearest_in(const std::vector<Vec3>& directions_S, double range_max, const SensorQuery& query) {
    const Transform X_WS = sensor_pose(query);
    std::vector<double> distances(directions_S.size());
    query.sources.ray_scene().cast({X_WS, range_max, query.robot, query.info().link}, directions_S, distances,
                                   {});
    const double nearest = *std::ranges::min_element(distances);
    return nearest > range_max ? kInfinity : nearest;
}

}  // namespace roboss
