// How one car of the city drives: from what its sensors say now to the speed of its wheels. A pure function
// without memory (the wheels' last ordered speeds, which the world keeps, are part of what it sees), so a run
// that is saved and continued drives on exactly as if it had never stopped.
#pragma once

#include <cstdint>
#include <span>

namespace city_driver {

/// What the driver knows. Angles in rad, to the left; the laser's zero is straight ahead.
struct DriverView {
    std::span<const double> ranges;  // m, from the right to the left; +-infinity as the laser gives them
    double min_angle = 0, max_angle = 0, range_max = 0;
    double goal_angle = 0;                       // where the car wants to go, against straight ahead
    double goal_distance = 0;                    // m
    double speed = 0;                            // m/s, along the car
    double turn_rate = 0;                        // rad/s
    double ordered_left = 0, ordered_right = 0;  // m/s, the wheels' last orders
};

/// Speeds of the wheels' rims, m/s.
struct WheelSpeeds {
    double left = 0, right = 0;
};

WheelSpeeds drive(const DriverView& view);

/// How far a car could go in the direction `angle` before something comes nearer than `half_width` to its
/// middle, m.
double free_way(const DriverView& view, double angle, double half_width);

/// A wish of a car at a time: a point of the rectangle, another one every so often. Times in s, lengths in m.
struct Rectangle {
    double min_x = 0, min_y = 0, max_x = 0, max_y = 0;
};
struct Place {
    double x = 0, y = 0;
};
Place goal_of(std::uint64_t seed, std::uint32_t car, double time_s, const Rectangle& city);

}  // namespace city_driver
