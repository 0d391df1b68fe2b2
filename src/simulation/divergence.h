// Where two runs diverge: the first tick at which their states differ, and the differences. Checkpoints that
// both journals have are compared; the first stretch whose end differs is stepped again, both runs side by
// side, tick by tick. So a journal need not hold every tick. Diverged runs are assumed to stay different.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulation/replay.h"

namespace roboss {

/// One number of a robot's state, by a readable name.
struct FieldDifference {
    std::string field;  // "joint 'wheel_0' velocity"
    std::string a,      // its value in run A, exact
        b;              // its value in run B, exact
};

/// The first field of the state, in a fixed order, that differs; nothing if all bits are equal.
std::optional<FieldDifference> first_difference(const RobotType& type, const RobotState& a,
                                                const RobotState& b);

/// The first tick at which two runs differ, and what differs there.
struct Divergence {
    Tick tick = 0;           // the first at which the states differ
    double time_s = 0;       // the same in simulated time, s
    std::string robot;       // name of the first robot that differs, by RobotId
    FieldDifference field;   // the first field of this robot that differs
    std::size_t robots = 0;  // that differ at this tick
    /// Orders that took effect in the step before `tick` in run A only, as text.
    std::vector<std::string> orders_a_only,
        orders_b_only;   // in run B only
    std::string remark;  // additional remarks
};

/// What compare() found.
struct Comparison {
    Tick from = 0,                         // first tick compared
        until = 0;                         // last tick compared
    std::uint64_t model_a = 0,             // Model::hash of run A
        model_b = 0;                       // Model::hash of run B
    std::optional<Divergence> divergence;  // none: the runs are equal over these ticks
};

/// `a` and `b`: the journals with the branches whose lineages are compared. An Error: they have nothing in
/// common (other robots, no common time), or cannot be read.
Result<Comparison> compare(const Journal& journal_a, const Branch& a, const Journal& journal_b,
                           const Branch& b, const ReplayOptions& options);

}  // namespace roboss
