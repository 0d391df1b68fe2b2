// Actuators: <motor>, <position>, <velocity> and <general> on joints become the gains and bounds of RoBOSS'
// motors.
#pragma once

#include "mjcf/robots.h"

namespace roboss::mjcf {

void read_actuators(Robots& robots, const Reading& reading);

}  // namespace roboss::mjcf
