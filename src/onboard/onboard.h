// The on-board controllers of a robot in one tick, before the dynamics: a pure function of (Model, that
// robot's state, its latched commands).
#pragma once

#include <vector>

#include "math/spatial.h"
#include "model/model.h"
#include "model/robot_state.h"

namespace roboss {

/// Buffers of the controllers; keep one a thread, so that nothing is allocated once they have grown.
struct OnboardScratch {
    std::vector<Transform> X_WB;    // by body
    std::vector<Spatial> velocity;  // by body, about the base's origin, world axes
    std::vector<char> pushed;       // by motor: it was given an effort in this tick
    bool out_of_power = false;      // the robot's battery is empty: its motors are off
};

/// Runs the robot's controllers, one after the other in the order of the file: they set its motors, its base
/// velocity, wrenches and surface motions of this tick, and change their memory. Call it after the tick's
/// orders, for robots that are awake.
void run_onboard(const Model& model, Tick tick, RobotId robot, RobotState& state, OnboardScratch& scratch);

/// Whether the controllers would change nothing while the robot is at rest, so that it may sleep.
bool onboard_rests(const RobotType& type, const RobotState& state);

}  // namespace roboss
