// The infrared proximity sensor: the nearest hit of rays that fill its cone, and the response to it.
//
// Khepera: the numbers are those of the simulator Enki (S. Magnenat, M. Waibel, A. Beyeler: class Khepera), a
// fit of the curve of K-Team's manual for a white surface. The sensors saturate at 10 bits.
#include <algorithm>
#include <cmath>

#include "core/fixed_math.h"
#include "sensors/cone.h"
#include "sensors/readings.h"
#include "sensors/sensor_noise.h"

namespace roboss {
namespace {

constexpr double kFull = 1023;  // 10 bits

double khepera(double distance) {
    constexpr double kAtContact = 1100, kFlat = 0.01, kFalls = 0.025;  // -, m, m
    if (!std::isfinite(distance)) return 0;
    return kAtContact * fixed_exp(-std::max(distance - kFlat, 0.0) / kFalls);
}

}  // namespace

Result<InfraredReading> read(const InfraredSpec& sensor, const SensorQuery& query) {
    std::vector<Vec3> directions = cone_about_minus_z(0.5 * sensor.opening_angle);
    for (Vec3& d : directions) d = {-d.z, d.y, d.x};  // about x
    InfraredReading reading;
    reading.range = nearest_in(directions, sensor.range_max, query);
    const bool counts = sensor.response == "khepera";
    const double response = counts ? khepera(reading.range) : reading.range;
    reading.value = std::isfinite(response) ? noisy_value(response, sensor.noise, query, 0, 0) : response;
    if (counts) reading.value = std::clamp(std::floor(reading.value + 0.5), 0.0, kFull);
    return reading;
}

}  // namespace roboss
