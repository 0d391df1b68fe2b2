// See sensor_messages.h.
#include "ros2/sensor_messages.h"

#include <algorithm>
#include <cmath>
#include <map>
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

Contacts contacts(const ContactReading& reading, const SensorPlace& place) {
    constexpr std::uint8_t kModel = 2, kLink = 3;  // types of an Entity
    Contacts message;
    message.header = header(place, "world");
    std::map<double, std::size_t> places;  // of other robots in the message
    const auto point = [](const std::vector<double>& numbers, std::size_t i) {
        return Vector3{numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
    };
    for (std::size_t i = 0; i < reading.count(); ++i) {
        const double other = reading.others[i];
        const std::string name =
            other < 0 ? "world" : place.model.robots[static_cast<std::size_t>(other)].name;
        const auto [at, is_new] = places.try_emplace(other, message.contacts.size());
        if (is_new)
            message.contacts.push_back({{0, place.link_frame, kLink}, {0, name, kModel}, {}, {}, {}, {}});
        GazeboContact& contact = message.contacts[at->second];
        const Vector3 force = point(reading.forces, i);
        contact.positions.push_back(point(reading.positions, i));
        contact.normals.push_back(point(reading.normals, i));
        contact.wrenches.push_back({message.header,
                                    {place.link_frame},
                                    {},
                                    {name},
                                    {},
                                    {force, {}},
                                    {{-force.x, -force.y, -force.z}, {}}});
    }
    return message;
}

bool is_odometry(const SensorSpec& sensor) {
    return sensor.as<OdometrySpec>() || sensor.as<WheelOdometrySpec>();
}

Pose odometry_pose(const Sample& sample) {
    if (const auto* reading = std::get_if<OdometryReading>(&sample))
        return {reading->position_W, reading->orientation_W};
    const auto* reading = std::get_if<WheelOdometryReading>(&sample);
    if (reading == nullptr) return {};
    return {{reading->x, reading->y, 0},
            Quat{std::cos(0.5 * reading->heading), 0, 0, std::sin(0.5 * reading->heading)}};
}

double cone_angle(const SonarSpec& sonar) {
    return sonar.geometry == "cone" ? 2 * std::atan2(sonar.radius, sonar.range_max) : 2 * kPi;
}

const CameraOptics* optics_of(const SensorSpec& sensor) {
    const CameraOptics* optics = nullptr;
    std::visit(
        [&](const auto& spec) {
            if constexpr (requires { spec.optics; }) optics = &spec.optics;
        },
        sensor.parameters);
    return optics;
}

Transform X_optical(const CameraOptics& optics) {
    const Transform ahead{to_matrix(Quat{0.5, -0.5, 0.5, -0.5}), {}};  // w x y z
    return to_transform(optics.X_SC) * ahead;
}

}  // namespace roboss::ros2::sensor_messages
