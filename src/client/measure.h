// Reads a sensor of any kind, for code that treats all sensors alike.
#pragma once

#include <functional>

#include "client/held_samples.h"

namespace roboss {

/// Sensor number `sensor` of a robot in `state`; see sensors/readings.h.
struct SensorQuery {
    const Model& model;
    RobotId robot;
    std::size_t sensor = 0;
    const RobotState& state;
    Tick tick = 0;
    std::uint64_t seed = 0;
};

/// `rays`: asked for by lasers only. The sensor must be of a kind that measures.
Sample measure(const SensorQuery& at, const std::function<RayScene&()>& rays);

}  // namespace roboss
