// What a clock of CPU time makes of work that is shared out to perfection.
#pragma once

#include "cluster/work.h"

namespace roboss::bench {

/// Efficiency (mean of the Simulators' times over the largest, by CPU time) if each of `simulators` steps the
/// very same robots, an equal share of the world, through the same windows: 1 on a computer that always takes
/// the same time for the same work. What is missing to it here no assignment can win.
double even_efficiency(const Work& work, std::size_t simulators, std::size_t lanes);

}  // namespace roboss::bench
