// Barometer and air speed sensor: the standard atmosphere near the ground, with the constants of gz-sensors.
#include <cmath>

#include "core/fixed_math.h"
#include "physics/dynamics/kinematics.h"
#include "sensors/readings.h"
#include "sensors/sensor_noise.h"

namespace roboss {
namespace {

constexpr double kSeaPressure = 101325.0;   // Pa
constexpr double kSeaTemperature = 288.15;  // K
constexpr double kSeaDensity = 1.225;       // kg/m^3
constexpr double kLapse = 0.0065;           // K/m
constexpr double kEarthRadius = 6356766.0;  // m
constexpr double kGravity = 9.80665;        // m/s^2
constexpr double kGas = 8314.32 / 28.9644;  // J/(kg K), of dry air
constexpr double kDensityExponent = 4.256;  // of the temperature ratio

double power(double base, double exponent) {
    return fixed_exp(exponent * fixed_log(base));
}

/// The wind that blows at the robot, m/s, world axes.
Vec3 wind_at(const SensorQuery& query) {
    if (query.type().wind_index < 0) return wind_of(query.model, type_of(query.type(), query.state));
    const auto at = static_cast<std::size_t>(query.type().wind_index);
    return {query.state.onboard[at], query.state.onboard[at + 1], query.state.onboard[at + 2]};
}

}  // namespace

Result<AirPressureReading> read(const AirPressureSpec& spec, const SensorQuery& query) {
    const SensorInfo& info = query.info();
    const Vec3 p = link_pose(query.type(), query.state, info.link) * info.spec.X_LS.p;
    const double height = spec.reference_altitude + p.z;
    const double geopotential = kEarthRadius * height / (kEarthRadius + height);
    const double temperature = kSeaTemperature - kLapse * geopotential;
    if (!(temperature > 0))
        return Error{"sensor '" + info.spec.name + "' is where the standard atmosphere has no air",
                     "it is made for heights below 11 km"};
    const double pressure = kSeaPressure * power(temperature / kSeaTemperature, kGravity / (kGas * kLapse));
    return AirPressureReading{noisy_value(pressure, spec.noise, query, 0, 0), 0};
}

Result<AirSpeedReading> read(const AirSpeedSpec& spec, const SensorQuery& query) {
    const SensorInfo& info = query.info();
    const Transform X_WL = link_pose(query.type(), query.state, info.link);
    const Twist twist = link_twist(query.type(), query.state, info.link);
    const Transform X_WS = X_WL * to_transform(info.spec.X_LS);
    const Vec3 v = twist.linear + cross(twist.angular, X_WS.p - X_WL.p);
    const double speed = transpose_times(X_WS.R, v - wind_at(query)).x;
    const double temperature = kSeaTemperature - kLapse * X_WS.p.z;
    if (!(temperature > 0))
        return Error{"sensor '" + info.spec.name + "' is where the standard atmosphere has no air",
                     "it is made for heights below 11 km"};
    const double density = kSeaDensity * power(temperature / kSeaTemperature, kDensityExponent);
    const double pressure_hPa = 0.005 * density * speed * std::fabs(speed);
    return AirSpeedReading{100 * noisy_value(pressure_hPa, spec.noise, query, 0, 0), temperature, 0};
}

}  // namespace roboss
