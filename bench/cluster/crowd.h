// Crowd: a Controller under a made-up load. Members that step nothing answer every assignment at once with
// results of robots that drive over a field; what it costs the Controller is measured, for more robots than a
// computer could step.
#pragma once

#include <cstddef>

namespace roboss::bench {

struct CrowdCosts {
    double window_us = 0;       // CPU time of the Controller for a window
    double last_result_us = 0;  // of it, from the last result until the next assignments are on their way
    double bytes_to_controller = 0, bytes_from_controller = 0;  // a window
    std::size_t windows = 0;
};

/// The Controller's costs with so many robots on so many Simulators.
CrowdCosts measure_crowd(std::size_t robots, std::size_t simulators, std::size_t windows);

}  // namespace roboss::bench
