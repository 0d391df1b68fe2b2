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

class WindowStepper {
  public:
    /// `measure_cpu` false: costs are counted work instead of thread CPU time, so that a seeded test repeats
    /// exactly. `lanes`: robots stepped at once, at most.
    WindowStepper(std::shared_ptr<const Model> model, ThreadPool& pool, bool measure_cpu, std::size_t lanes);
    ~WindowStepper();

    /// All robots of the plan must have been started in the store. `between` is called now and then from the
    /// calling thread.
    Frame step(const Plan& plan, StateStore& store, const std::function<void()>& between);
    std::size_t threads() const { return scratch_.size(); }

  private:
    struct Job;     // one call of step()
    struct Convoy;  // islands of one robot that are stepped together, so that lanes fill
                    // (physics/lane_stepper.h)

    void sort_orders(const Plan& plan);
    void cut_batches(const Plan& plan);
    void step_batch(Job& job, std::size_t batch, std::size_t worker);
    void step_island_through(Job& job, std::size_t island, std::size_t worker);
    bool step_tick(Job& job, std::size_t island, Tick tick, std::span<const Order> orders,
                   std::size_t worker);
    void step_convoy_through(Job& job, std::span<const std::uint32_t> islands, std::size_t worker);
    void step_apart(Job& job, std::span<const std::uint32_t> islands, std::size_t worker);
    void sweep(const Job& job, std::size_t island, std::span<const Order> orders);
    void give_up(Job& job, std::size_t island, RobotId failed, Tick tick);
    void report_robots(Job& job, std::size_t island);

    std::shared_ptr<const Model> model_;
    ThreadPool& pool_;
    bool measure_cpu_;
    std::vector<StepScratch> scratch_;  // one a thread

    // flat over the plan's robots
    std::vector<RobotState*> states_;
    std::vector<Aabb> bounds_, swept_;
    std::vector<std::uint32_t> island_of_;  // by RobotId; kNone: not in the plan
    // flat over the plan's orders, those of an island together
    std::vector<Order> orders_;
    std::vector<std::size_t> order_offsets_;
    // islands by falling size, in batches worth one look at the clock
    std::vector<std::uint32_t> sequence_;
    std::vector<std::size_t> batch_offsets_;
    std::vector<double> efforts_;                   // by island (step.h)
    std::vector<std::vector<EarlierBox>> earlier_;  // by island
    std::vector<Convoy> convoys_;                   // one a thread
};

}  // namespace roboss
