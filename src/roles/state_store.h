// A Simulator's states: of each robot that at the window's start and that at its end (and a second copy of
// it, to be stepped on in the next); those at the start of a window of which only the rest is stepped here;
// and copies that were kept because somebody still wants an earlier tick.
// A state is found by (robot, tick), never by "the current one", so late and doubled requests get the right
// bits or nothing.
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

    /// Takes a state from elsewhere.
    void put(RobotId robot, Tick tick, RobotState&& state);
    /// Makes the robot's state at `tick` the start of a window. False: it is not here.
    bool start(RobotId robot, Tick tick);
    /// Whether start() would find it.
    bool has(RobotId robot, Tick tick) const { return find(robot, tick) != nullptr; }
    const RobotState& start_of(RobotId robot) const { return slots_[robot.index()].start; }
    /// The state to step on: a copy of the start, which becomes the state at `until`.
    RobotState& begin_window(RobotId robot, Tick until);
    const RobotState& end_of(RobotId robot) const { return slots_[robot.index()].end; }
    /// The window is left off here: the state that is stepped on is that at `tick`.
    void cut_window(RobotId robot, Tick tick);
    /// Before what is left of a window is stepped: the states at its start, of those that have one here, may
    /// be asked for again.
    void set_aside(std::span<const RobotId> robots, Tick tick);
    void forget_aside_before(Tick tick);
    /// begin_window()'s copy for the next window, made while there is time.
    void copy_ahead(RobotId robot);

    /// Copies these robots' states at `tick`, to be found after the slots have moved on.
    void keep(std::span<const RobotId> robots, Tick tick);
    void release_before(Tick tick);
    /// Appends the state to `out`; false: not here.
    bool copy_to(StateBlock& out, RobotId robot, Tick tick) const;
    /// The state, if it is that of a window under way or just done; copies that were kept do not count.
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
