// The environmental sensor: linear in time and in each coordinate between the points of its table, as
// InMemoryTimeVaryingVolumetricGrid of gz-math.
#include <algorithm>
#include <array>
#include <optional>

#include "core/fixed_math.h"
#include "physics/dynamics/kinematics.h"
#include "sensors/geodesy.h"
#include "sensors/readings.h"

namespace roboss {
namespace {

/// Two neighbours on an axis, and how far behind the first (0 to 1).
struct Between {
    std::size_t first = 0, second = 0;
    double share = 0;
};

/// nullopt: outside. A point nearer than 1e-6 to one of the axis is that one, as in gz-math.
std::optional<Between> find(const std::vector<double>& axis, double x) {
    constexpr double kSame = 1e-6;
    const auto above = std::ranges::lower_bound(axis, x);
    if (above == axis.end()) return std::nullopt;
    const auto at = static_cast<std::size_t>(above - axis.begin());
    if (*above - x < kSame) return Between{at, at, 0};
    if (at == 0) return std::nullopt;
    return Between{at - 1, at, (x - axis[at - 1]) / (axis[at] - axis[at - 1])};
}

/// The coordinates in which the table is written; nullopt: the world does not have them.
std::optional<Vec3> place_in(const EnvironmentalSpec& spec, const Vec3& p_W, const Model& model) {
    if (spec.reference == "global") return p_W;
    if (!model.spherical) return std::nullopt;
    const Geodetic place = world_to_geodetic(*model.spherical, p_W);
    if (spec.reference == "ecef") return to_earth(place);
    const double unit = spec.in_degrees ? 180.0 / kPi : 1.0;
    return Vec3{place.latitude_rad * unit, place.longitude_rad * unit, place.altitude_m};
}

/// A cell of the grid.
struct Cell {
    std::array<Between, 4> at;  // time, x, y, z
    std::array<std::size_t, 4> size;

    double mean(const double* column, std::size_t axis = 0, std::size_t index = 0) const {
        if (axis == at.size()) return column[index];
        const Between& b = at[axis];
        const double first = mean(column, axis + 1, index * size[axis] + b.first);
        if (b.first == b.second) return first;
        const double second = mean(column, axis + 1, index * size[axis] + b.second);
        return (1 - b.share) * first + b.share * second;
    }
};

std::optional<Cell> cell_at(const EnvironmentalSpec& spec, double time, const Vec3& p) {
    std::optional<Between> t = Between{};
    if (!spec.is_static) t = find(spec.times, time);
    const auto x = find(spec.xs, p.x), y = find(spec.ys, p.y), z = find(spec.zs, p.z);
    if (!t || !x || !y || !z) return std::nullopt;
    return Cell{{*t, *x, *y, *z}, {spec.times.size(), spec.xs.size(), spec.ys.size(), spec.zs.size()}};
}

/// A vector as the sensor's `<transform_type>` asks for it.
Vec3 transformed(const EnvironmentalSpec& spec, const SensorQuery& query, const Transform& X_WS, Vec3 v) {
    if (spec.transform_type.starts_with("ADD_VELOCITY")) {
        const Transform X_WL = link_pose(query.type(), query.state, query.info().link);
        const Twist twist = link_twist(query.type(), query.state, query.info().link);
        v = v - (twist.linear + cross(twist.angular, X_WS.p - X_WL.p));
    }
    return spec.transform_type.ends_with("LOCAL") ? transpose_times(X_WS.R, v) : v;
}

}  // namespace

Result<EnvironmentalReading> read(const EnvironmentalSpec& spec, const SensorQuery& query) {
    const Transform X_WS = sensor_pose(query);
    const std::vector<std::string> columns = spec.columns();
    EnvironmentalReading reading;
    if (spec.points() == 0 || spec.values.size() != columns.size() * spec.points()) return reading;
    const auto place = place_in(spec, X_WS.p, query.model);
    if (!place) return reading;
    const auto cell = cell_at(spec, static_cast<double>(query.tick) * query.model.dt_s, *place);
    if (!cell) return reading;
    for (std::size_t c = 0; c < columns.size(); ++c)
        reading.values.push_back(cell->mean(spec.values.data() + c * spec.points()));
    if (spec.is_vector()) {
        std::vector<double>& v = reading.values;
        const Vec3 result = transformed(spec, query, X_WS, {v[0], v[1], v[2]});
        v = {result.x, result.y, result.z};
    }
    return reading;
}

}  // namespace roboss
