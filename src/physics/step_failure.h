// Which robot a step reports when the run cannot go on: a state that is not finite, or that nothing can be
// computed of.
#pragma once

#include <optional>

#include "physics/dynamics/robot_work.h"
#include "physics/step.h"

namespace roboss {

/// False if a coordinate or velocity is infinite or not a number.
bool is_finite(const RobotState& state);

/// A robot so fast that its displacement in one tick is not finite: it would meet everybody, and spoil them.
/// The body of its first such part, -1: the base; none: it is not so fast.
std::optional<int> body_beyond_numbers(const RobotWork& work);

/// Notes the failure where it is the first of the call (StepReport::not_finite).
void note_beyond_numbers(const RobotWork& work, int body, StepReport& report);
void note_not_finite(const RobotWork& work, StepReport& report);
void note_failure_of(const StepReport& other, StepReport& report);

}  // namespace roboss
