// What the scenes with cars share: the car, its motors, its place in the world.
#pragma once

#include <support/robots.h>

#include "scenes/scene.h"

namespace roboss::bench {

inline constexpr double kWheelSpeed = 10, kWheelEffort = 0.5;  // rad/s, N m
inline constexpr double kCarMu = 0.9;

inline ModelSpec scene_car() {
    return test::car({.mu = kCarMu, .max_effort = kWheelEffort});
}

inline void drive_car(Engine& engine, std::size_t instance, double wheel_speed) {
    for (std::size_t wheel = 0; wheel < 4; ++wheel)
        engine.drive_velocity({instance, wheel, 0}, wheel_speed, kWheelEffort);
}

}  // namespace roboss::bench
