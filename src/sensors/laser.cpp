// The laser range finder: a fan (or grid) of rays, then noise, then the sensor's range and resolution.
#include <cmath>
#include <limits>
#include <vector>

#include "core/check.h"
#include "core/float_env.h"
#include "physics/kinematics.h"
#include "sensors/readings.h"
#include "sensors/sensor_noise.h"

namespace roboss {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Beam directions of one axis: `count` angles from min to max, both included; a single beam points along
/// min.
std::vector<SinCos> beams(int count, double min_angle, double max_angle) {
    std::vector<SinCos> directions;
    directions.reserve(static_cast<std::size_t>(count));
    const double step = count > 1 ? (max_angle - min_angle) / (count - 1) : 0.0;
    for (int i = 0; i < count; ++i) directions.push_back(fixed_sincos(min_angle + step * i));
    return directions;
}

double measured(double distance, const SensorSpec& spec, const SensorMoment& moment, std::uint64_t beam) {
    if (distance > spec.range_max) return kInfinity;
    if (distance < spec.range_min) return -kInfinity;
    const double noisy =
        rounded_to(noisy_value(distance, spec.noise, moment, 0, beam), spec.range_resolution);
    return std::fmin(std::fmax(noisy, spec.range_min), spec.range_max);
}

}  // namespace

LaserReading read_laser(const Model& model, RobotId robot, std::size_t sensor, const RobotState& state,
                        Tick tick, std::uint64_t seed, RayScene& scene) {
    const ExactFloatScope exact;
    const RobotType& type = model.type_of(robot);
    ROBOSS_CHECK(sensor < type.sensors.size(), type.name + " has no sensor number " + std::to_string(sensor));
    const SensorInfo& info = type.sensors[sensor];
    const SensorSpec& spec = info.spec;
    ROBOSS_CHECK(spec.kind == SensorKind::kLaser, spec.name + " is no laser");
    const Transform X_WS = link_pose(type, state, info.link) * to_transform(spec.X_LS);

    std::vector<RayScene::Ray> rays;
    const std::vector<SinCos> columns = beams(spec.samples, spec.min_angle, spec.max_angle);
    for (const SinCos& up : beams(spec.vertical_samples, spec.vertical_min_angle, spec.vertical_max_angle))
        for (const SinCos& left : columns)
            rays.push_back({X_WS.p, X_WS.R * Vec3{up.cos * left.cos, up.cos * left.sin, up.sin},
                            spec.range_max, robot, info.link});
    LaserReading reading{spec.samples, spec.vertical_samples, std::vector<double>(rays.size()), tick};
    scene.cast(rays, reading.ranges);

    const SensorMoment moment{seed, robot, sensor, tick};
    for (std::size_t i = 0; i < rays.size(); ++i)
        reading.ranges[i] = measured(reading.ranges[i], spec, moment, i);
    return reading;
}

}  // namespace roboss
