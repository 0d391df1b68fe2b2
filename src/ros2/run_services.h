// The services of simulation_interfaces that act on the run, and those about worlds.
#pragma once

#include "ros2/simulation_context.h"
#include "ros2/spawner.h"
#include "ros2_types/messages/simulation_run_services.h"

namespace roboss::ros2 {

/// Memory of what a run itself does not know.
///
/// kStopped of simulation_interfaces is a run that is paused at its beginning, unless a node asked for it to
/// be paused there.
struct RunMemory {
    bool paused_at_start = false;  ///< a node has paused the stopped run
};

/// The state of the run, in terms of simulation_interfaces.
std::uint8_t simulation_state(const RunStatus& status, const RunMemory& memory);

/// Lets a paused run advance by so many ticks, and calls `then` when it is paused again. `progress` gets the
/// ticks that are done, now and then. `is_cancelled` is asked once, when the run is found paused; if it is
/// true there, the run does not advance.
void step_run(
    const SimulationContext& c, std::uint64_t ticks, const std::function<void(std::uint64_t)>& progress,
    const std::function<void(const simulation_interfaces::Result&)>& then,
    const std::function<bool()>& is_cancelled = [] { return false; });

/// GetSimulatorFeatures, GetSimulationState, SetSimulationState, StepSimulation. `memory` outlives them.
void add_run_services(const SimulationContext& c, RunMemory& memory);

/// ResetSimulation. Spawner and memory outlive it.
void add_reset_service(const SimulationContext& c, RunMemory& memory, Spawner& spawner);

/// GetNamedPoses, GetNamedPoseBounds, GetAvailableWorlds, GetCurrentWorld, LoadWorld, UnloadWorld.
void add_world_services(const SimulationContext& c, RunMemory& memory);

/// Returns the run to its beginning, and calls `then` when it is seen there.
void reset_run(const SimulationContext& c,
               const std::function<void(const simulation_interfaces::Result&)>& then);

/// Pauses the run and returns it to its beginning.
void stop_run(const SimulationContext& c, RunMemory& memory,
              const std::function<void(const simulation_interfaces::Result&)>& then);

/// Why the run refused; code OPERATION_FAILED.
simulation_interfaces::Result failure_of(const ControlOutcome& outcome);

}  // namespace roboss::ros2
