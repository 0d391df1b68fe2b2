// The laser range finder: a fan (or grid) of rays, then noise, then the sensor's range and resolution.
#include <cmath>
#include <vector>

#include "core/fixed_math.h"
#include "sensors/infinity.h"
#include "sensors/laser_beams.h"
#include "sensors/readings.h"
#include "sensors/sensor_noise.h"

namespace roboss {
namespace {

std::vector<SinCos> sincos_of(const std::vector<double>& angles) {
    std::vector<SinCos> all;
    all.reserve(angles.size());
    for (const double angle : angles) all.push_back(fixed_sincos(angle));
    return all;
}

double measured(double distance, const LaserSpec& spec, const SensorNoise& noise, std::uint64_t beam) {
    if (distance > spec.range_max) return kInfinity;
    if (distance < spec.range_min) return -kInfinity;
    const double noisy = rounded_to(noise(distance, beam), spec.range_resolution);
    return fixed_min(fixed_max(noisy, spec.range_min), spec.range_max);
}

}  // namespace

std::vector<Vec3> laser_beams(const LaserSpec& laser) {
    std::vector<Vec3> beams;
    const std::vector<SinCos> columns = sincos_of(laser.column_angles());
    const std::vector<SinCos> rows = sincos_of(laser.row_angles());
    beams.reserve(columns.size() * rows.size());
    for (const SinCos& up : rows)
        for (const SinCos& left : columns) beams.push_back({up.cos * left.cos, up.cos * left.sin, up.sin});
    return beams;
}

Result<LaserReading> read(const LaserSpec& spec, const SensorQuery& query) {
    const Transform X_WS = sensor_pose(query);
    const std::vector<Vec3> beams = laser_beams(spec);
    const RayScene& scene = query.sources.ray_scene();
    LaserReading reading;
    reading.samples = spec.columns(), reading.vertical_samples = spec.rows();
    reading.ranges.resize(beams.size());
    if (scene.has_retro()) reading.intensities.resize(beams.size());
    scene.cast({X_WS, spec.range_max, query.robot, query.info().link}, beams, reading.ranges,
               reading.intensities);

    const SensorNoise noise(spec.noise, query, 0);
    for (std::size_t i = 0; i < beams.size(); ++i)
        reading.ranges[i] = measured(reading.ranges[i], spec, noise, i);
    return reading;
}

}  // namespace roboss
