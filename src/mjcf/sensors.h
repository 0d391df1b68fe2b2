// Sensors: those of MuJoCo that RoBOSS has, on the links of their sites.
#pragma once

#include <span>

#include "mjcf/robots.h"

namespace roboss::mjcf {

void read_sensors(Robots& robots, std::span<const Reading> parts);

}  // namespace roboss::mjcf
