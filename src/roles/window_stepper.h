// Steps a plan's islands through its window on the thread pool and measures what the frame reports. Islands
// touch disjoint robots and the step is a pure function, so it does not matter which thread takes which
// island.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "core/thread_pool.h"
#include "physics/step.h"
#include "roles/state_store.h"
#include "wire/message.h"

namespace roboss {

/// How far a plan is stepped whose islands all go tick by tick.
struct StepProgress {
    double done = 0;  // share of the ticks; 0 where islands are stepped one after the other
    const std::function<double()>* clock = nullptr;  // asking it costs a tenth of a robot's step
    double spent_ns() const { return (*clock)(); }
};

/// Robots of a plan that is stepped tick by tick in all its islands, so that it can be cut short, at most.
inline constexpr std::size_t kAbreastMost = 24;

struct SteppingOptions {
    /// In ns, CPU time of the calling thread; none: costs are counted work (step.h), so that a seeded test
    /// repeats exactly.
    std::function<std::uint64_t()> clock;
    std::function<void(double)> counted;  // told of counted work, in ns, as it is done; may be none
    std::size_t lanes = kMostLanes;       // robots stepped at once, at most
    std::size_t look_up = 64;  // robots times ticks between two calls of `between`, where all go tick by tick
};

class WindowStepper {
  public:
    enum class Next { kGoOn, kGoOnAlert, kStop };  // alert: asked more often; stop: only what has progress
    using Between = std::function<Next(const StepProgress&)>;

    WindowStepper(std::shared_ptr<const Model> model, ThreadPool& pool, SteppingOptions options);
    ~WindowStepper();

    /// All robots of the plan must have been started in the store. `between` is called now and then from the
    /// calling thread. What a Cut left of a plan steps on from the bounds before.
    Frame step(const Plan& plan, StateStore& store, const Between& between);
    std::size_t threads() const { return scratch_.size(); }

  private:
    struct Job;      // one call of step()
    struct Convoy;   // islands of one robot that are stepped together, so that lanes fill
                     // (physics/lane_stepper.h)
    struct Abreast;  // islands that all go tick by tick
    struct Stub {    // of a plan that was cut short
        std::uint32_t epoch = 0;
        std::uint64_t window = 0;
        Tick tick = -1;
        std::vector<RobotId> robots;
        std::vector<Aabb> swept;  // before
        std::vector<EarlierBox> earlier;
    };

    void sort_orders(const Plan& plan);
    void cut_batches(const Plan& plan);
    void step_batch(Job& job, std::size_t batch, std::size_t worker);
    /// An island's orders of this tick; `next`: its first that was not taken yet.
    std::span<const Order> take_orders(std::size_t island, Tick tick, std::size_t& next) const;
    void step_island_through(Job& job, std::size_t island, std::size_t worker);
    bool step_tick(Job& job, std::size_t island, Tick tick, std::span<const Order> orders,
                   std::size_t worker);
    void step_convoy_through(Job& job, std::span<const std::uint32_t> islands, std::size_t worker);
    void load_convoy(const Job& job, std::span<const std::uint32_t> islands, std::size_t worker);
    bool step_convoy(Job& job, Tick tick, std::size_t worker);
    void step_apart(Job& job, std::span<const std::uint32_t> islands, std::size_t worker);
    void count(std::size_t island, float effort);
    void sweep(const Job& job, std::size_t island, std::span<const Order> orders);
    void give_up(Job& job, std::size_t island, const StepReport& report, Tick tick);
    void report_robots(Job& job, std::size_t island);
    // window_cut.cpp
    bool abreast(const Plan& plan) const;
    void step_abreast(Job& job, std::span<const std::uint32_t> islands, std::size_t singles,
                      std::uint64_t start_ns);
    double spent_ns(std::uint64_t start_ns) const;
    void step_all(Job& job, Abreast& a, Tick tick);
    void cut_short(Job& job, Tick tick);
    void take_up(Job& job);

    std::shared_ptr<const Model> model_;
    ThreadPool& pool_;
    SteppingOptions options_;
    std::vector<StepScratch> scratch_;  // one a thread

    // flat over the plan's robots
    std::vector<RobotState*> states_;
    std::vector<Aabb> bounds_, swept_, swept_before_;  // before: a Cut
    std::vector<std::uint32_t> island_of_;             // by RobotId; kNone: not in the plan
    // flat over the plan's orders, those of an island together
    std::vector<Order> orders_;
    std::vector<std::size_t> order_offsets_;
    // islands by falling size, in batches worth one look at the clock
    std::vector<std::uint32_t> sequence_;
    std::vector<std::size_t> batch_offsets_;
    std::vector<double> efforts_;                   // by island (step.h)
    std::vector<std::size_t> next_order_;           // by island, where all go tick by tick
    std::vector<std::vector<EarlierBox>> earlier_;  // by island
    std::vector<Convoy> convoys_;                   // one a thread
    Stub stub_;
};

}  // namespace roboss
