// WindowStepper: steps an assignment's islands through its window on the thread pool and collects the
// WindowResult. Islands have disjoint robots and the step is a pure function, so results do not depend on
// which thread steps which island.
#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/thread_pool.h"
#include "physics/step.h"
#include "roles/simulator/state_store.h"
#include "wire/message.h"

namespace roboss {

/// Progress of an assignment whose islands are stepped in lockstep (all of them tick by tick).
struct StepProgress {
    double done = 0;  // share of the ticks; 0 if islands are stepped one after the other
    const std::function<double()>* clock = nullptr;  // a call costs a tenth of a robot's step
    double spent_ns() const { return (*clock)(); }
};

/// The most robots of an assignment that is stepped in lockstep, so that a Cut can end it early.
inline constexpr std::size_t kLockstepMost = 24;

struct SteppingOptions {
    /// In ns, CPU time of the calling thread; none: costs are counted work (step.h), so that a seeded test
    /// repeats exactly.
    std::function<std::uint64_t()> clock;
    std::function<void(double)> counted;  // called with counted work, in ns, as it is done; may be empty
    std::size_t lanes = kMostLanes;       // robots stepped at once, at most
    std::size_t look_up = 64;             // robots times ticks between two calls of `between` in lockstep
    StageNow now = nullptr;               // measures assignments that are to be measured
    /// Asked by all threads before each tick; true: the assignment is abandoned. Empty: never.
    std::function<bool()> abandons = {};
};

class WindowStepper {
  public:
    enum class Next { kContinue, kContinueAlert, kStop };  // alert: poll more often; stop: only with progress
    using Between = std::function<Next(const StepProgress&)>;

    WindowStepper(std::shared_ptr<const Model> model, ThreadPool& pool, SteppingOptions options);
    ~WindowStepper();

    /// All robots of the assignment must have been started in the store. `between` is called now and then
    /// from the calling thread. The rest of an assignment after a Cut starts with the bounds before it.
    /// Nothing is returned if it was abandoned: the store then has the states of its start, and no later
    /// ones.
    std::optional<WindowResult> step(const Assignment& assignment, StateStore& store, const Between& between);
    std::size_t threads() const { return scratch_.size(); }

  private:
    struct Job;        // one call of step()
    struct LaneGroup;  // islands of one robot that are stepped together, so that lanes fill
                       // (physics/lanes/lane_stepper.h)
    struct Lockstep;   // islands that are stepped in lockstep
    struct CutRest {   // of an assignment that a Cut ended early
        std::uint32_t epoch = 0;
        std::uint64_t window = 0;
        Tick tick = -1;
        std::vector<RobotId> robots;
        std::vector<Aabb> swept;  // before
        std::vector<EarlierBox> earlier;
    };

    void measure(bool wanted);
    void report_profile(WindowResult& result);
    void sort_orders(const Assignment& assignment);
    void cut_batches(const Assignment& assignment);
    std::size_t step_large_batches(Job& job);
    void step_batch(Job& job, std::size_t batch, std::size_t worker);
    /// Whether the assignment is abandoned. Asked before each tick, so that a long window ends soon.
    bool is_abandoned();
    void forget(const Job& job);
    /// An island's orders of this tick; `next`: its first order that was not taken yet.
    std::span<const Order> take_orders(std::size_t island, Tick tick, std::size_t& next) const;
    void step_island_through(Job& job, std::size_t island, std::size_t worker);
    bool step_tick(Job& job, std::size_t island, Tick tick, std::span<const Order> orders,
                   std::size_t worker);
    void step_lane_group_through(Job& job, std::span<const std::uint32_t> islands, std::size_t worker);
    void load_lane_group(const Job& job, std::span<const std::uint32_t> islands, std::size_t worker);
    bool step_lane_group(Job& job, Tick tick, std::size_t worker);
    void step_apart(Job& job, std::span<const std::uint32_t> islands, std::size_t worker);
    void count(std::size_t island, float effort);
    void sweep(const Job& job, std::size_t island, std::span<const Order> orders);
    void give_up(Job& job, std::size_t island, const StepReport& report, Tick tick);
    void report_robots(Job& job, std::size_t island);
    // window_cut.cpp
    bool in_lockstep(const Assignment& assignment) const;
    void step_lockstep(Job& job, std::span<const std::uint32_t> islands, std::size_t singles,
                       std::uint64_t start_ns);
    double spent_ns(std::uint64_t start_ns) const;
    void step_all(Job& job, Lockstep& a, Tick tick);
    void cut_short(Job& job, Tick tick);
    void resume_after_cut(Job& job);

    std::shared_ptr<const Model> model_;
    ThreadPool& pool_;
    SteppingOptions options_;
    std::vector<StepScratch> scratch_;    // one a thread
    std::atomic<bool> abandoned_{false};  // the assignment
    bool measured_ = false;               // this assignment
    std::vector<StepProfile> profiles_;   // likewise, of this window

    // flat over the assignment's robots
    std::vector<RobotState*> states_;
    std::vector<Aabb> bounds_, swept_, swept_before_;  // before: a Cut
    std::vector<std::uint32_t> island_of_;             // by RobotId; kNone: not in the assignment
    // flat over the assignment's orders, those of an island together
    std::vector<Order> orders_;
    std::vector<std::size_t> order_offsets_;
    // islands by descending size, in batches worth one reading of the clock
    std::vector<std::uint32_t> sequence_;
    std::vector<std::size_t> weights_;  // of the islands: robots (weight_of)
    std::vector<std::size_t> batch_offsets_;
    std::vector<double> efforts_;                   // by island (step.h)
    std::vector<std::size_t> next_order_;           // by island, in lockstep
    std::vector<std::vector<EarlierBox>> earlier_;  // by island
    std::vector<LaneGroup> lane_groups_;            // one a thread
    CutRest cut_rest_;
};

}  // namespace roboss
