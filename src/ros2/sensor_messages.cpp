// See sensor_messages.h.
#include "ros2/sensor_messages.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace roboss::ros2::sensor_messages {

bool is_level_scan(const LaserSpec& laser) {
    const bool is_level = laser.row_angles() == std::vector<double>{0};
    return is_level && laser.angles.empty();
}

LaserScan scan(const LaserSpec& laser, const LaserReading& reading, const SensorPlace& place) {
    LaserScan scan;
    const double step = laser.samples > 1 ? (laser.max_angle - laser.min_angle) / (laser.samples - 1) : 0;
    const double rate = place.info.spec.update_rate_hz;
    scan.header = header(place, place.frame);
    scan.angle_min = static_cast<float>(laser.min_angle),
    scan.angle_max = static_cast<float>(laser.max_angle);
    scan.angle_increment = static_cast<float>(step),
    scan.scan_time = static_cast<float>(rate > 0 ? 1 / rate : 0);
    scan.range_min = static_cast<float>(laser.range_min),
    scan.range_max = static_cast<float>(laser.range_max);
    const auto columns = static_cast<std::size_t>(laser.columns());
    const auto add_row = [&](const std::vector<double>& from, std::vector<float>& to) {
        const std::size_t begin = std::min(static_cast<std::size_t>(laser.rows() / 2) * columns, from.size());
        const std::span row = std::span(from).subspan(begin, std::min(columns, from.size() - begin));
        to.assign(row.begin(), row.end());
    };
    add_row(reading.ranges, scan.ranges), add_row(reading.intensities, scan.intensities);
    return scan;
}

PointCloud2 cloud(const LaserSpec& laser, const LaserReading& reading, const SensorPlace& place) {
    PointCloud2 cloud;
    cloud.header = header(place, place.frame);
    std::vector<const char*> names{"x", "y", "z"};
    const bool has_intensity = !reading.intensities.empty();
    if (has_intensity) names.push_back("intensity");
    for (std::size_t i = 0; i < names.size(); ++i)
        cloud.point_fields.push_back({names[i], static_cast<std::uint32_t>(4 * i), PointField::kFloat32, 1});
    cloud.point_step = static_cast<std::uint32_t>(4 * names.size());
    const std::vector<double> columns = laser.column_angles(), rows = laser.row_angles();
    std::vector<float> numbers;
    for (std::size_t i = 0; i < reading.ranges.size(); ++i) {
        const double range = reading.ranges[i];
        if (!std::isfinite(range)) continue;
        const double up = rows[i / columns.size()], across = columns[i % columns.size()];
        numbers.push_back(static_cast<float>(range * std::cos(up) * std::cos(across)));
        numbers.push_back(static_cast<float>(range * std::cos(up) * std::sin(across)));
        numbers.push_back(static_cast<float>(range * std::sin(up)));
        if (has_intensity) numbers.push_back(static_cast<float>(reading.intensities[i]));
    }
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(numbers.data());
    cloud.data.assign(bytes, bytes + 4 * numbers.size());
    cloud.width = static_cast<std::uint32_t>(numbers.size() / names.size());
    cloud.row_step = cloud.width * cloud.point_step;
    return cloud;
}

CameraInfo camera_info(const CameraOptics& optics, const std::vector<double>& intrinsics,
                       const std::vector<double>& distortion, const SensorPlace& place) {
    CameraInfo info;
    info.header = header(place, place.optical_frame);
    info.height = static_cast<std::uint32_t>(optics.height),
    info.width = static_cast<std::uint32_t>(optics.width);
    info.distortion_model = "plumb_bob", info.d = distortion;
    info.d.resize(5);
    if (intrinsics.size() == 4) {
        const double fx = intrinsics[0], fy = intrinsics[1], cx = intrinsics[2], cy = intrinsics[3];
        info.k = {fx, optics.skew, cx, 0, fy, cy, 0, 0, 1};
        info.p = {fx, optics.skew, cx, 0, 0, fy, cy, 0, 0, 0, 1, 0};
    }
    return info;
}

double cone_angle(const SonarSpec& sonar) {
    return sonar.geometry == "cone" ? 2 * std::atan2(sonar.radius, sonar.range_max) : 2 * kPi;
}

PoseMessage planar_pose(const WheelOdometryReading& reading) {
    return {{reading.x, reading.y, 0},
            {0, 0, std::sin(0.5 * reading.heading), std::cos(0.5 * reading.heading)}};
}

}  // namespace roboss::ros2::sensor_messages
