// The controller of one cell: from readings to orders. It knows nothing of the simulator: what it reads and
// orders are numbers, so tests can play the plant.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "motion.h"
#include "scan.h"

namespace arm_cell {

inline constexpr double kPeriod = 0.01;  // s, between two calls; orders take effect one period later

enum class Gripper { kFingers, kSuction };

/// What the arm is doing. Idle -> Reach -> Lower -> Close -> Lift -> Carry -> SetDown -> Open -> Rise ->
/// Idle. Without a box in the hand: Close -> Open (missed); Lift, Carry or SetDown -> Open (dropped).
enum class Phase : int { kIdle, kReach, kLower, kClose, kLift, kCarry, kSetDown, kOpen, kRise };

/// What the feed belt is doing. Runs -> Stopping, when a box breaks the light barrier -> Stopped -> Runs,
/// when the arm has lifted the box. Stopped -> Discards, if the scanner finds no box that the arm can fetch
/// -> Runs, when the light barrier is clear.
enum class Belt : int { kRuns, kStopping, kStopped, kDiscards };

struct Readings {
    double time_s = 0;
    bool barrier_broken = false;
    double eye = 0;      // m, from the palm down to what is below it; infinite: nothing
    double opening = 0;  // m, of one finger
    Joints q{};
};

struct Orders {
    Joints velocity{};  // rad/s and m/s
    bool belt_runs = false;
    bool hand_closes = false;  // the fingers close, or the cup sucks
};

/// All that the controller remembers.
struct CellState {
    Phase phase = Phase::kIdle;
    Belt belt = Belt::kRuns;
    double phase_since = 0, belt_since = 0;  // s
    Motion motion;                           // the last one
    SeenBox box;                             // that is to be fetched, or is in the hand
    double felt = 0;                         // s, when the eye saw the box in the hand for the last time
    int moved = 0, dropped = 0, missed = 0, discarded = 0;
    double last_moved = -1;                                   // s, when a box was put down
    double cycle_sum = 0, cycle_least = 1e9, cycle_most = 0;  // s, between two of them
    int belt_ordered = -1, hand_ordered = -1;                 // what was ordered last; -1: nothing yet

    /// Calls visit(number) for each member, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& s) {
        visit(s.phase), visit(s.belt), visit(s.phase_since), visit(s.belt_since);
        for (std::size_t i = 0; i < s.motion.from.size(); ++i) visit(s.motion.from[i]), visit(s.motion.to[i]);
        visit(s.motion.begin_s), visit(s.motion.length_s);
        visit(s.box.x), visit(s.box.y), visit(s.box.top), visit(s.box.yaw), visit(s.felt);
        visit(s.moved), visit(s.dropped), visit(s.missed), visit(s.discarded), visit(s.last_moved);
        visit(s.cycle_sum), visit(s.cycle_least), visit(s.cycle_most);
        visit(s.belt_ordered), visit(s.hand_ordered);
    }
};

class Cell {
  public:
    /// `start`: of the arm's joints.
    Cell(Gripper gripper, const Joints& start) : gripper_(gripper) { state.motion = {start, start, 0, 0}; }

    /// Where the arm waits for a box.
    static Joints rest();
    /// Whether step() uses the scanner's ranges in this call.
    bool wants_scan(double time_s) const;
    /// Whether step() asks in this call if the pads feel the box.
    bool wants_touch(double time_s) const;
    /// Whether the hand is to hold a box: then step() uses the eye.
    bool closes() const;
    /// Whether step() uses the light barrier.
    bool wants_barrier() const { return state.belt == Belt::kRuns || state.belt == Belt::kDiscards; }
    /// `seen`: by the scanner, if it was asked. `touched`: both pads feel something; true if not asked.
    Orders step(const Readings& readings, const std::optional<SeenBox>& seen, bool touched);

    CellState state;

  private:
    void enter(Phase phase, double time_s);
    /// Starts a motion to the pose; false: out of reach.
    bool start(Phase phase, const HandPose& pose, const Readings& readings);
    void move_belt(const Readings& readings);
    void move_arm(const Readings& readings, const std::optional<SeenBox>& seen, bool touched);
    void decide(const Readings& readings, const std::optional<SeenBox>& seen);
    void leave(const Readings& readings, bool touched);
    void put_down(double time_s);
    bool arrived(const Readings& readings) const;
    bool holds(const Readings& readings) const;
    double grip_height() const;

    Gripper gripper_;
};

/// Counts of a cell as JSON, without the braces.
std::string summary(const CellState& state);

}  // namespace arm_cell
