// The sonar: the nearest hit of rays that fill its cone, ring by ring.
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/fixed_math.h"
#include "physics/dynamics/kinematics.h"
#include "sensors/infinity.h"
#include "sensors/readings.h"

namespace roboss {
namespace {

constexpr double kSpacing = kPi / 90;  // rad between neighbours, at most
constexpr int kRingsLeast = 4;         // in a narrow cone

/// Unit vectors about -z up to `opening` rad off it; the last ring lies on the cone.
std::vector<Vec3> directions(double opening) {
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

}  // namespace

Result<SonarReading> read(const SonarSpec& sonar, const SensorQuery& query) {
    const SensorInfo& info = query.info();
    const Transform X_WS = link_pose(query.type(), query.state, info.link) * to_transform(info.spec.X_LS);
    const double opening = sonar.geometry == "sphere" ? kPi : fixed_atan2(sonar.radius, sonar.range_max);
    std::vector<RayScene::Ray> rays;
    for (const Vec3& direction : directions(opening))
        rays.push_back({X_WS.p, X_WS.R * direction, sonar.range_max, query.robot, info.link});
    std::vector<double> distances(rays.size());
    query.sources.ray_scene().cast(rays, distances);
    SonarReading reading;
    reading.range = *std::ranges::min_element(distances);
    if (reading.range > sonar.range_max) reading.range = kInfinity;
    if (reading.range < sonar.range_min) reading.range = -kInfinity;
    return reading;
}

}  // namespace roboss
