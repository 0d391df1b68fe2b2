// What LocalRun adds to the kernel: the same cars (car_step.cpp), one thread, stepped by bare calls of
// step_island() with all robots, and by a LocalRun in calls of 10 ticks with new setpoints before each, as a
// learner's loop does.
#include <benchmark/benchmark.h>

#include <numeric>

#include "car_field.h"
#include "local/local_run.h"
#include "local/robot_set.h"
#include "take.h"

namespace {

using namespace roboss;

constexpr double kDt = 0.002;
constexpr Tick kTicks = 10, kSettlingTicks = 250;

/// rad/s of a wheel: the cars turn on the spot, so they never meet however long the benchmark lasts.
double speed_of(std::size_t wheel) {
    return wheel % 2 == 0 ? -8 : 8;
}

std::shared_ptr<const Model> compiled_field(benchmark::State& state) {
    Diagnostics diagnostics;
    return compile(bench::car_field_world(static_cast<int>(state.range(0)), kDt), {}, diagnostics);
}

void report(benchmark::State& state, const Model& model) {
    const double steps = static_cast<double>(state.iterations()) * static_cast<double>(model.robots.size());
    // Seconds of thread time for one step of one car.
    state.counters["car_step"] = benchmark::Counter(
        steps * static_cast<double>(kTicks), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.SetLabel("world=car_field dt=2ms threads=1 ticks=10");
}

void local_run_bare_kernel(benchmark::State& state) {
    const std::shared_ptr<const Model> model = compiled_field(state);
    std::vector<RobotState> states;
    std::vector<RobotState*> pointers;
    std::vector<RobotId> robots;
    for (std::size_t r = 0; r < model->robots.size(); ++r) {
        robots.emplace_back(r);
        states.push_back(initial_state(*model, RobotId(r)));
    }
    for (RobotState& robot : states) {
        pointers.push_back(&robot);
        for (std::size_t m = 0; m < robot.motors.size(); ++m)
            robot.motors[m] = {MotorMode::kVelocity, speed_of(m), 2.0};
    }
    std::vector<Aabb> bounds(robots.size());
    StepScratch scratch;
    Tick tick = 0;
    const auto step = [&](Tick ticks) {
        for (const Tick end = tick + ticks; tick < end; ++tick)
            step_island(*model, tick, robots, pointers, {}, bounds, scratch);
    };
    step(kSettlingTicks);
    for ([[maybe_unused]] auto _ : state) step(kTicks);
    report(state, *model);
}

void run_cars(benchmark::State& state, bool orders) {
    const std::shared_ptr<const Model> model = compiled_field(state);
    const std::unique_ptr<LocalRun> run = bench::take(LocalRun::create(model));
    std::vector<RobotId> robots;
    for (std::size_t r = 0; r < model->robots.size(); ++r) robots.emplace_back(r);
    const RobotSet cars(model, robots);
    std::vector<std::size_t> columns(cars.axes().size());
    std::iota(columns.begin(), columns.end(), std::size_t{0});
    std::vector<double> targets;
    for (std::size_t i = 0; i < cars.size() * columns.size(); ++i)
        targets.push_back(speed_of(i % columns.size()));
    bench::take(cars.set_joints(*run, columns, MotorMode::kVelocity, targets));
    bench::take(run->step(kSettlingTicks));
    for ([[maybe_unused]] auto _ : state) {
        if (orders) bench::take(cars.set_joints(*run, columns, MotorMode::kVelocity, targets));
        bench::take(run->step(kTicks));
    }
    report(state, *model);
}

void local_run_step(benchmark::State& state) {
    run_cars(state, false);
}
void local_run_step_with_orders(benchmark::State& state) {
    run_cars(state, true);
}

BENCHMARK(local_run_bare_kernel)->Arg(50)->Arg(500)->Unit(benchmark::kMillisecond)->MinTime(0.5);
BENCHMARK(local_run_step)->Arg(50)->Arg(500)->Unit(benchmark::kMillisecond)->MinTime(0.5);
BENCHMARK(local_run_step_with_orders)->Arg(50)->Arg(500)->Unit(benchmark::kMillisecond)->MinTime(0.5);

}  // namespace
