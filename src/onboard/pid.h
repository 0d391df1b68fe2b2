// The PID controller of the joint controllers, with the conventions of gz::math::PID.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "onboard_kinds/pid_gains.h"

namespace roboss {

/// What a PID controller remembers: the last error and the integral, two numbers of a controller's memory,
/// zero at the start. So the first call has a derivative of error / dt.
struct PidMemory {
    double& last_error;
    double& integral;

    /// The two numbers at `at` of a memory.
    PidMemory(std::span<double> memory, std::size_t at) : last_error(memory[at]), integral(memory[at + 1]) {}
};

/// The command against `error` = measured - wanted, `dt` seconds after the last call. The integral contains
/// its gain, and its limits are those of the command's unit.
inline double update_pid(const PidGains& gains, double error, double dt, PidMemory memory) {
    if (!(dt > 0) || !std::isfinite(error)) return 0;
    memory.integral += gains.i * dt * error;
    if (gains.i_max >= gains.i_min) memory.integral = std::clamp(memory.integral, gains.i_min, gains.i_max);
    const double rate = (error - memory.last_error) / dt;
    memory.last_error = error;
    const double command = gains.cmd_offset - gains.p * error - memory.integral - gains.d * rate;
    return gains.cmd_max >= gains.cmd_min ? std::clamp(command, gains.cmd_min, gains.cmd_max) : command;
}

}  // namespace roboss
