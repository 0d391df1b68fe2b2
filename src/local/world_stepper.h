// WorldStepper: advances the states of all robots of a world, on all threads of a pool, to the bits that one
// call of step_island() with all robots gives.
//
// With one thread it is that call, tick by tick. With more, ticks are stepped in windows: a forecast parts
// the robots into islands, batches of islands are stepped through the window, and the volumes that the robots
// really swept are compared. Islands of different batches that touched are stepped again together, from the
// window's start (ARCHITECTURE.md, "Many Simulators").
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/thread_pool.h"
#include "physics/step.h"
#include "schedule/forecast.h"

namespace roboss {

/// Where stepping ended, and why, if it was before the tick that was asked for.
struct StepOutcome {
    Tick tick = 0;                // the states are those at the beginning of this tick
    RobotId not_finite;           // whose state would not be finite after it; not valid: all went well
    JointId not_finite_joint;     // whose coordinate it is; not valid: the base's
    bool beyond_numbers = false;  // the robot is so far that it cannot be stepped
};

/// See the top of the file.
class WorldStepper {
  public:
    /// `lanes`: most robots of a type that a thread steps at once. No bit depends on threads and lanes.
    WorldStepper(std::shared_ptr<const Model> model, unsigned threads, std::size_t lanes);

    /// Steps states[i], of RobotId i, from tick `from` to `until`. `orders`: in canonical order, with ticks
    /// in [from, until). The states must be those that the last call left, unless forget() was called.
    StepOutcome step(Tick from, Tick until, std::span<const Order> orders, std::vector<RobotState>& states);
    /// The states of the next step() are others than those that the last one left.
    void forget();

    std::size_t threads() const { return pool_.threads(); }  ///< that step
    std::size_t repeats() const { return repeats_; }         ///< batches that were stepped again so far

  private:
    /// Robots that are stepped in the same calls.
    struct Batch {
        std::vector<RobotId> robots;  // ascending
        std::vector<RobotState*> states;
        std::vector<Aabb> bounds;
        double effort = 0, heaviest = 0;  // of all robots; of its heaviest island
        StepOutcome outcome;
    };
    /// What a step can be undone with: the states at a tick, and the orders since then.
    struct Backup {
        Tick tick = -1;  // -1: there is none
        std::vector<RobotState> states;
        std::vector<Order> orders;
    };

    void back_up(Tick tick, const std::vector<RobotState>& states);
    StepOutcome step_all(Tick from, Tick until, std::span<const Order> orders,
                         std::vector<RobotState>& states);
    StepOutcome step_window(Tick from, Tick until, std::span<const Order> orders,
                            std::vector<RobotState>& states);
    void step_batch(Batch& batch, Tick from, Tick until, std::span<const Order> orders, StepScratch& scratch);
    void note_tick(const Batch& batch, StepScratch& scratch);
    void fill_all(std::vector<RobotState>& states);
    void plan(Tick ticks, std::span<const Order> orders, std::vector<RobotState>& states);
    bool plan_repeats(std::vector<RobotState>& states);
    bool run_batches(Tick from, Tick until, std::span<const Order> orders);
    std::size_t step_large_batches(Tick from, Tick until, std::span<const Order> orders);
    Batch& add_batch();
    double effort_of(RobotId robot) const;
    void enlist(Batch& batch, std::span<const RobotId> robots);
    void finish(Batch& batch, std::vector<RobotState>& states);
    void note_motions(Tick ticks, const std::vector<RobotState>& states);

    std::shared_ptr<const Model> model_;
    ThreadPool pool_;
    bool in_windows_ = false;           // more than one thread, and more than one robot
    std::vector<StepScratch> scratch_;  // one a thread
    Backup backup_;
    Batch all_;
    // of a window
    Forecast forecast_;
    Islands islands_, merged_;
    std::vector<RobotMotion> motions_;  // by RobotId; empty: not known
    std::vector<Aabb> swept_, bounds_;  // by RobotId
    std::vector<float> efforts_;        // by RobotId, of the window before
    std::vector<std::uint32_t> batch_of_;
    std::vector<Batch> batches_;
    std::size_t batch_count_ = 0;
    std::vector<double> island_efforts_;   // by island
    std::vector<std::uint32_t> sequence_;  // islands by descending effort
    std::vector<OwnedBox> boxes_;
    UnionFind sets_;
    Sweep sweep_;
    Tick window_ = 16;
    std::size_t repeats_ = 0;
};

}  // namespace roboss
