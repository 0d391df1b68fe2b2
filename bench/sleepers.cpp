// What a tick costs of a thousand boxes in stacks of four: all awake, all asleep, and one awake beside 999
// asleep. dt 2 ms, one thread, all in one call.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "physics/step.h"
#include "support/robots.h"

namespace {

using namespace roboss;

constexpr int kBoxes = 1000;
constexpr double kEdge = 0.2;

class Sleepers {
  public:
    explicit Sleepers(bool sleep) {
        World world;
        world.dt_s = 2e-3;
        world.sleep = sleep;
        world.prototypes.push_back(test::scenery(test::collision(GeometryKind::kPlane, test::surface(0.7))));
        world.prototypes.push_back(test::solid_box(1.0, {kEdge, kEdge, kEdge}, test::surface(0.6)));
        world.instances.push_back({"ground", 0, {}, {}});
        for (int i = 0; i < kBoxes; ++i) {
            const Pose X{{0.3 * (i / 4 % 16), 0.3 * (i / 64), kEdge * (0.5 + i % 4)}, {}};
            world.instances.push_back({"box_" + std::to_string(i), 1, X, {}});
        }
        Diagnostics diagnostics;
        model_ = compile(world, {}, diagnostics);
        for (std::size_t i = 0; i < model_->robots.size(); ++i) {
            ids_.emplace_back(i);
            states_.push_back(initial_state(*model_, ids_.back()));
        }
        for (RobotState& state : states_) pointers_.push_back(&state);
        bounds_.resize(states_.size());
        for (int i = 0; i < 500; ++i) step();  // a second: all that may sleep does
    }
    void step(std::span<const Order> orders = {}) {
        report_ = step_island(*model_, tick_++, ids_, pointers_, orders, bounds_, scratch_);
    }
    void throw_up(std::size_t robot) {
        const Order order[] = {{tick_, ClientId(0u), 1, RobotId(robot), SetPose{{{-5, 0, 1e4}, {}}}}};
        step(order);
    }
    const StepReport& report() const { return report_; }

  private:
    std::shared_ptr<const Model> model_;
    Tick tick_ = 0;
    std::vector<RobotId> ids_;
    std::vector<RobotState> states_;
    std::vector<RobotState*> pointers_;
    std::vector<Aabb> bounds_;
    StepScratch scratch_;
    StepReport report_;
};

void time_steps(benchmark::State& state, Sleepers& world) {
    for ([[maybe_unused]] auto _ : state) world.step();
    state.counters["robots"] = kBoxes;
    state.counters["asleep"] = world.report().asleep;
    state.counters["placed"] = world.report().placed;
    state.SetLabel("world=stacks_of_four dt=2ms threads=1");
}

void stacks_awake(benchmark::State& state) {
    Sleepers world(false);
    time_steps(state, world);
}

void stacks_asleep(benchmark::State& state) {
    Sleepers world(true);
    time_steps(state, world);
}

/// The upper box of the last stack flies.
void stacks_asleep_but_one(benchmark::State& state) {
    Sleepers world(true);
    world.throw_up(kBoxes - 1);
    for (int i = 0; i < 400; ++i) world.step();  // those it lay on, woken, sleep again
    time_steps(state, world);
}

BENCHMARK(stacks_awake)->Unit(benchmark::kMicrosecond);
BENCHMARK(stacks_asleep)->Unit(benchmark::kMicrosecond);
BENCHMARK(stacks_asleep_but_one)->Unit(benchmark::kMicrosecond)->Iterations(10000);

}  // namespace
