// A control program: an ordinary Client written as a class. `roboss run --client lib.so` loads it from a
// shared library; the same source links into a process of its own. It sees the whole state, computes sensors
// here, and gives orders.
#pragma once

#include <memory>
#include <string>

#include "client/client.h"

namespace roboss {

/// When a control program runs, and when its orders take effect. Times are rounded to ticks.
struct ControlOptions {
    double period_s = 0.02;   // control period: control() is called once in each, in simulated time; > 0
    double latency_s = -1;    // from observation to effect of its orders; negative: one period
    bool synchronous = true;  // the world waits for this Client's reply each period
};

/// Base class of control programs. Derive from it, implement control(), and export the class with
/// ROBOSS_CONTROL_PROGRAM.
class ControlProgram {
  public:
    virtual ~ControlProgram() = default;
    /// Asked before start(). A run with invalid options is refused.
    virtual ControlOptions options() const { return {}; }
    /// Once, before the first control(); the state is that of the first observation.
    virtual void start(Client&) {}
    /// Once a control period. An exception ends the run with its text; the world stays intact and can be
    /// saved.
    virtual void control(Client&) = 0;
    /// What the program remembers from one control() to the next, as bytes. A saved run takes it along and
    /// gives it to restore(), after start(), when it continues; so a program that remembers anything must
    /// have both for saved runs to continue exactly.
    virtual std::string memory() const { return {}; }
    /// Takes the bytes that memory() returned. It is not called if they were empty.
    virtual void restore(const std::string&) {}
};

/// Version of this interface; the loader refuses a library built against another one.
inline constexpr int kControlProgramAbi = 16;

}  // namespace roboss

/// In exactly one source file of the library: the entry point.
#define ROBOSS_CONTROL_PROGRAM(Class)                               \
    extern "C" int roboss_control_program_abi() {                   \
        return ::roboss::kControlProgramAbi;                        \
    }                                                               \
    extern "C" ::roboss::ControlProgram* roboss_control_program() { \
        return new Class();                                         \
    }
