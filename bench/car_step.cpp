// What one step of one car costs: 50, 500 and 2000 separate four-wheeled cars with cylinder wheels on a
// plane, dt 2 ms, one thread, while they drive straight or turn on the spot (all wheels slide sideways: the
// harder case for the solver).
#include <benchmark/benchmark.h>

#include "allocation_counter.h"
#include "car_field.h"

namespace {

constexpr double kDt = 0.002;
constexpr int kSettlingTicks = 250;  // buffers grown, motion steady

void step_cars(benchmark::State& state, double left, double right) {
    roboss::bench::CarField field(static_cast<int>(state.range(0)), kDt);
    field.drive(left, right);
    for (int tick = 0; tick < kSettlingTicks; ++tick) field.step();
    const std::int64_t contacts = field.contacts();
    for ([[maybe_unused]] auto _ : state) field.step();
    const double car_steps = static_cast<double>(state.iterations()) * static_cast<double>(field.cars());
    // Seconds of thread time for one step of one car.
    state.counters["car_step"] =
        benchmark::Counter(car_steps, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.counters["contacts_per_car"] = static_cast<double>(field.contacts() - contacts) / car_steps;
    // Counted apart from the timing, whose own bookkeeping allocates.
    const std::uint64_t allocated = roboss::bench::allocations();
    for (int tick = 0; tick < kSettlingTicks; ++tick) field.step();
    state.counters["allocations"] = static_cast<double>(roboss::bench::allocations() - allocated);
    state.counters["robots"] = static_cast<double>(field.cars());
    state.counters["residual_max"] = field.residual_max();
    state.SetLabel("world=car_field dt=2ms threads=1");
}

void car_step_straight(benchmark::State& state) {
    step_cars(state, 8, 8);
}
void car_step_turning(benchmark::State& state) {
    step_cars(state, -8, 8);
}

BENCHMARK(car_step_straight)->Arg(50)->Arg(500)->Arg(2000)->Unit(benchmark::kMillisecond)->MinTime(1);
BENCHMARK(car_step_turning)->Arg(50)->Arg(500)->Arg(2000)->Unit(benchmark::kMillisecond)->MinTime(1);

}  // namespace
