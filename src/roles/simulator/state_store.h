// StateStore: a Simulator's states. Of each robot: the state at the window's start, that at its end, and a
// copy of the latter to step in the next window. In addition: states at the start of a window of which only
// the rest is stepped here, and copies of earlier ticks that others still need. A state is found by (robot,
// tick), never as "the current one", so late and duplicate requests get the right state or nothing.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "model/robot_state.h"
#include "wire/state_block.h"

namespace roboss {

class StateStore {
  public:
    explicit StateStore(const Model& model) : slots_(model.robots.size()) {}

    /// Adds a received state.
    void put(RobotId robot, Tick tick, RobotState&& state);
    /// Makes the robot's state at `tick` the start of a window. False: there is none.
    bool start(RobotId robot, Tick tick);
    /// Whether start() would find it.
    bool has(RobotId robot, Tick tick) const { return find(robot, tick) != nullptr; }
    const RobotState& start_of(RobotId robot) const { return slots_[robot.index()].start; }
    /// The state to step on: a copy of the start, which becomes the state at `until`.
    RobotState& begin_window(RobotId robot, Tick until);
    const RobotState& end_of(RobotId robot) const { return slots_[robot.index()].end; }
    /// The window ends at `tick` because of a Cut: so does the stepped state.
    void cut_window(RobotId robot, Tick tick);
    /// The window was abandoned: its start remains.
    void abandon_window(RobotId robot);
    /// Called before the rest of a window is stepped: keeps the states at the window's start that are here,
    /// since they may be requested again.
    void set_aside(std::span<const RobotId> robots, Tick tick);
    void forget_aside_before(Tick tick);
    /// Makes begin_window()'s copy for the next window in advance, while others are waited for.
    void copy_ahead(RobotId robot);

    /// Copies these robots' states at `tick`, so that they can be found after the slots have been reused.
    void keep(std::span<const RobotId> robots, Tick tick);
    void release_before(Tick tick);
    /// Appends the state to `out`; false: there is none.
    bool copy_to(StateBlock& out, RobotId robot, Tick tick) const;
    /// The state, if it belongs to the window in progress or the last one; kept copies are not searched.
    const RobotState* find(RobotId robot, Tick tick) const;
    void clear();

  private:
    static constexpr Tick kNone = -1;
    struct Slot {
        Tick start_tick = kNone, end_tick = kNone, ahead_tick = kNone;
        RobotState start, end, ahead;
    };

    struct Aside {
        RobotId robot;
        Tick tick = kNone;
        RobotState state;
    };

    const RobotState* find_in_slot(RobotId robot, Tick tick) const;
    const RobotState* find_aside(RobotId robot, Tick tick) const;
    void forget_aside(RobotId robot, Tick tick);

    std::vector<Slot> slots_;
    std::vector<Aside> aside_;  // few
    std::vector<StateShelf> kept_;
};

}  // namespace roboss
