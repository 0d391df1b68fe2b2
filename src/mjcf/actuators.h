// Actuators: <motor>, <position>, <velocity> and <general> on joints become the gains and bounds of RoBOSS'
// motors.
#pragma once

#include <span>

#include "mjcf/robots.h"

namespace roboss::mjcf {

void read_actuators(Robots& robots, std::span<const Reading> parts);

}  // namespace roboss::mjcf
