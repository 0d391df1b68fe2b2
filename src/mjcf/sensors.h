// Sensors: those of MuJoCo that RoBOSS has, on the links of their sites.
#pragma once

#include "mjcf/robots.h"

namespace roboss::mjcf {

void read_sensors(Robots& robots, const Reading& reading);

}  // namespace roboss::mjcf
