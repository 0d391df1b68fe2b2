// The laser range finder: a fan (or grid) of rays, then noise, then the sensor's range and resolution.
#include <cmath>
#include <limits>
#include <vector>

#include "core/fixed_math.h"
#include "physics/dynamics/kinematics.h"
#include "sensors/infinity.h"
#include "sensors/readings.h"
#include "sensors/sensor_noise.h"

namespace roboss {
namespace {

/// Beam directions of one axis: `count` angles from min to max, both included; a single beam points along
/// min.
std::vector<SinCos> beams(int count, double min_angle, double max_angle) {
    std::vector<SinCos> directions;
    directions.reserve(static_cast<std::size_t>(count));
    const double step = count > 1 ? (max_angle - min_angle) / (count - 1) : 0.0;
    for (int i = 0; i < count; ++i) directions.push_back(fixed_sincos(min_angle + step * i));
    return directions;
}

double measured(double distance, const LaserSpec& spec, const SensorQuery& query, std::uint64_t beam) {
    if (distance > spec.range_max) return kInfinity;
    if (distance < spec.range_min) return -kInfinity;
    const double noisy = rounded_to(noisy_value(distance, spec.noise, query, 0, beam), spec.range_resolution);
    return std::fmin(std::fmax(noisy, spec.range_min), spec.range_max);
}

}  // namespace

Result<LaserReading> read(const LaserSpec& spec, const SensorQuery& query) {
    const SensorInfo& info = query.info();
    const Transform X_WS = link_pose(query.type(), query.state, info.link) * to_transform(info.spec.X_LS);

    std::vector<RayScene::Ray> rays;
    const std::vector<SinCos> columns = beams(spec.samples, spec.min_angle, spec.max_angle);
    for (const SinCos& up : beams(spec.vertical_samples, spec.vertical_min_angle, spec.vertical_max_angle))
        for (const SinCos& left : columns)
            rays.push_back({X_WS.p, X_WS.R * Vec3{up.cos * left.cos, up.cos * left.sin, up.sin},
                            spec.range_max, query.robot, info.link});
    LaserReading reading{spec.samples, spec.vertical_samples, std::vector<double>(rays.size()), query.tick};
    query.sources.ray_scene().cast(rays, reading.ranges);

    for (std::size_t i = 0; i < rays.size(); ++i)
        reading.ranges[i] = measured(reading.ranges[i], spec, query, i);
    return reading;
}

}  // namespace roboss
