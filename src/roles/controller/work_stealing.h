// Work stealing within a window: the cost of islands is known to a tenth at best, so of many Simulators one
// is always late. It reports this (Late). When others are idle it gets a Cut, and the rest of its assignment
// is split between it and them, from the tick that it has reached.
#pragma once

#include <span>

#include "roles/controller/cost_model.h"
#include "roles/controller/order_log.h"
#include "roles/controller/round.h"

namespace roboss {

/// Sets the expected CPU time, so that Simulators that need longer report it. Only in windows in which each
/// has at least `least_ns` of work.
void announce_expected_work(Round& round, const CostModel& costs, const Roster& roster, double least_ns);

/// Sends Cuts to late Simulators, as far as others are idle. Only in the first attempt at a window.
void steal_work(Bus& bus, Round& round, const Roster& roster);

/// Divides what a Cut left of an assignment. `stepped`: its islands, up to tick `at`.
void share_out_rest(Round& round, const Round::Answered& cut_short, std::span<const IslandResult> stepped,
                    Tick at, const Roster& roster, OrderLog& order_log);

}  // namespace roboss
