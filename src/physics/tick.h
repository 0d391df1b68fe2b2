// The outline of a tick. step_island (step.cpp) applies the orders, lets on-board controllers act, and
// divides the robots by what may meet (broad phase) into batches that cannot affect each other. Then
// step_robots goes through the stages of a batch. There are two kinds:
// - RobotGroup (robot_group.h): robots that may meet each other; one contact island after the other.
// - LaneStep<T> (lane_step.h): robots of one type that touch no other robot, in the lanes of a register. T
//   holds several doubles, several floats or one float. All lanes together are one island: their decisions
//   must be equal, and a robot that decides otherwise leaves for a batch of its own.
#pragma once

#include "physics/stage.h"

namespace roboss {

/// From the states at the beginning of the tick to those at its end. False if the batch cannot be stepped;
/// then the states are as they were.
template <class Robots>
bool step_robots(Robots& robots, StageClock& clock) {
    clock.enter(Stage::kKinematics);
    if (!robots.forward_kinematics()) return false;
    clock.enter(Stage::kWaking);
    robots.wake_left_sleepers();
    robots.form_bonds();
    clock.enter(Stage::kBroadPhase);
    robots.find_pairs();
    clock.enter(Stage::kWaking);
    robots.wake_touched_sleepers();
    robots.hold_bonds();
    clock.enter(Stage::kNarrowPhase);
    if (!robots.find_contacts()) return false;
    clock.enter(Stage::kIslands);
    robots.build_contact_islands();
    robots.for_each_contact_island(
        [](auto& island, StageClock& island_clock) {
            if (island.has_rows()) {
                island_clock.enter(Stage::kRows);
                island.build_rows();
                island_clock.enter(Stage::kVelocities);
                island.solve_velocities();
                island_clock.enter(Stage::kDisplacements);
                island.solve_displacements();
            }
            island_clock.enter(Stage::kIntegration);
            island.integrate();
            island_clock.enter(Stage::kGuards);
            island.guard();
            island_clock.enter(Stage::kSleep);
            island.put_to_sleep();
        },
        clock);
    clock.enter(Stage::kReport);
    robots.report();
    return true;
}

}  // namespace roboss
