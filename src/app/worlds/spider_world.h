// Spider robots with six legs of three joints on flat ground, rubble, a slope or stairs, as an SDF 1.9 world.
// They stand in a grid and look along +x; the terrain begins before the first row.
#pragma once

#include <cstdint>
#include <string>

namespace roboss {

struct SpiderOptions {
    int spiders = 1;
    int abreast = 0;               // number of spiders in a row; 0: as many as rows
    std::string terrain = "flat";  // flat, rubble, slope, steps
    double height_m = 0.03;        // of the largest stones, of a step
    double angle_deg = 10;         // of the slope
    double motor_torque = 4;       // N m, bound of every motor
    double motor_speed = 8;        // rad/s, likewise
    std::uint64_t seed = 1;        // of the stones
};

/// Empty if there is no such terrain.
std::string spider_sdf(const SpiderOptions& options);

}  // namespace roboss
