// Two ways to play, as pure functions of what the team sees. They remember nothing, so a saved match
// continues without their help.
#pragma once

#include <vector>

#include "driving.h"

namespace soccer {

/// Every robot has a task: one goalkeeper, one attacker (the one that is first at the ball), the others hold
/// places between ball and own goal, or wait for a pass.
std::vector<WheelSpeeds> play_zones(const View& view);

/// The two that are nearest go for the ball, from both sides; the others fall back in a line before their
/// goal. The attacker aims at the corner of the goal that is farther from the goalkeeper.
std::vector<WheelSpeeds> play_pack(const View& view);

}  // namespace soccer
