// The magnetometer.
#include "sensors/readings.h"
#include "sensors/sensor_noise.h"

namespace roboss {

Result<MagnetometerReading> read(const MagnetometerSpec& magnetometer, const SensorQuery& query) {
    const Transform X_WS = sensor_pose(query);
    const Vec3 field = transpose_times(X_WS.R, query.model.magnetic_field_T);
    return MagnetometerReading{{noisy_value(field.x, magnetometer.noise_x, query, 0, 0),
                                noisy_value(field.y, magnetometer.noise_y, query, 1, 1),
                                noisy_value(field.z, magnetometer.noise_z, query, 2, 2)},
                               0};
}

}  // namespace roboss
