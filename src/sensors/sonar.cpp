// The sonar: the nearest hit of rays that fill its cone.
#include "core/fixed_math.h"
#include "sensors/cone.h"
#include "sensors/infinity.h"
#include "sensors/readings.h"

namespace roboss {

Result<SonarReading> read(const SonarSpec& sonar, const SensorQuery& query) {
    const double opening = sonar.geometry == "sphere" ? kPi : fixed_atan2(sonar.radius, sonar.range_max);
    SonarReading reading;
    reading.range = nearest_in(cone_about_minus_z(opening), sonar.range_max, query);
    if (reading.range < sonar.range_min) reading.range = -kInfinity;
    return reading;
}

}  // namespace roboss
