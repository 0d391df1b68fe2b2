// How deep bodies that should not overlap do so: measured from the poses that an engine reports, by one
// narrow phase for all engines.
#pragma once

#include "engines/engine.h"

namespace roboss::bench {

struct Overlap {
    double deepest_m = 0;      // between shapes of different instances; 0: none overlap
    std::size_t touching = 0;  // instances, planes left out, within a millimetre of another one
};

/// Of all shapes of the world, where `engine` has put them.
Overlap measure_overlap(const World& world, const Engine& engine);

}  // namespace roboss::bench
