// What on-board control costs: 2000 separate four-wheeled cars on a plane, driven by an on-board DiffDrive
// (with odometry and limits), beside the same cars with fixed setpoints. Both take a tick by turns, in one
// call, one thread, dt 2 ms; `ratio` is the median of the ratios of blocks of ticks.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "allocation_counter.h"
#include "core/thread_cpu.h"
#include "median.h"
#include "physics/step.h"
#include "support/robots.h"

namespace {

using namespace roboss;

constexpr int kSettlingTicks = 250, kBlock = 4;       // ticks
constexpr double kRadius = 0.05, kSeparation = 0.26;  // m, of the car's wheels

ModelSpec car_with_drive() {
    ModelSpec car = test::car();
    DiffDriveSpec drive;
    drive.left = {"wheel_0", "wheel_2"}, drive.right = {"wheel_1", "wheel_3"};
    drive.wheel_separation = kSeparation, drive.wheel_radius = kRadius;
    drive.linear.min_acceleration = drive.angular.min_acceleration = -5;
    drive.linear.max_acceleration = drive.angular.max_acceleration = 5;
    drive.linear.min_velocity = drive.angular.min_velocity = -10;
    drive.linear.max_velocity = drive.angular.max_velocity = 10;
    car.onboard.push_back({"drive", drive, {}});
    return car;
}

/// Cars on a plane that never meet, all in one call.
class Fleet {
  public:
    Fleet(const ModelSpec& car, int cars) {
        World world;
        world.dt_s = 2e-3;
        world.prototypes.push_back(test::scenery(test::collision(GeometryKind::kPlane, test::surface(0.9))));
        world.prototypes.push_back(car);
        world.instances.push_back({"ground", 0, {}, {}});
        for (int i = 0; i < cars; ++i) {
            const Pose X{{4.0 * (i % 50), 4.0 * (i / 50), 0}, from_rpy(0, 0, 0.1 * i)};
            world.instances.push_back({"car_" + std::to_string(i), 1, X, {}});
        }
        Diagnostics diagnostics;
        model_ = compile(world, {}, diagnostics);
        for (std::size_t i = 0; i < model_->robots.size(); ++i) {
            ids_.emplace_back(i);
            states_.push_back(initial_state(*model_, ids_.back()));
        }
        for (RobotState& state : states_) pointers_.push_back(&state);
        bounds_.resize(states_.size());
    }
    /// Velocity command of each car, m/s and rad/s.
    void command(double speed, double turn) {
        std::vector<Order> orders;
        for (const RobotId id : ids_)
            orders.push_back({tick_, ClientId(0u), id.value, id, Command{0, {speed, 0, 0, 0, 0, turn}}});
        step(orders);
    }
    /// Takes over motion, setpoints and contacts of the same cars with other control.
    void follow(const Fleet& other) {
        tick_ = other.tick_;
        for (std::size_t i = 0; i < states_.size(); ++i) {
            const std::vector<double> onboard = states_[i].onboard;
            states_[i] = other.states_[i];
            states_[i].onboard = onboard;
        }
    }
    /// Whether they move the same way, bit for bit.
    bool moves_like(const Fleet& other) const {
        for (std::size_t i = 0; i < states_.size(); ++i)
            if (states_[i].q != other.states_[i].q || states_[i].v != other.states_[i].v) return false;
        return true;
    }
    void step(std::span<const Order> orders = {}) {
        report_ = step_island(*model_, tick_++, ids_, pointers_, orders, bounds_, scratch_);
    }
    /// CPU time of some ticks, ns.
    double time_block() {
        const std::uint64_t start = thread_cpu_ns();
        for (int i = 0; i < kBlock; ++i) step();
        return static_cast<double>(thread_cpu_ns() - start);
    }
    const StepReport& report() const { return report_; }
    std::size_t lanes() const { return scratch_.lanes(Precision::kDouble); }

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

void compare(benchmark::State& state, double speed, double turn) {
    const int cars = static_cast<int>(state.range(0));
    Fleet driven(car_with_drive(), cars), fixed(test::car(), cars);
    driven.command(speed, turn);
    for (int i = 0; i < kSettlingTicks; ++i) driven.step();
    fixed.follow(driven);
    for (int i = 0; i < kBlock; ++i) driven.step(), fixed.step();
    std::vector<double> ratios, driven_ns, fixed_ns;
    for ([[maybe_unused]] auto _ : state) {
        const double a = driven.time_block(), b = fixed.time_block();
        const double c = fixed.time_block(), d = driven.time_block();  // who is first changes
        ratios.push_back((a + d) / (b + c));
        driven_ns.push_back(0.5 * (a + d)), fixed_ns.push_back(0.5 * (b + c));
    }
    const double steps = static_cast<double>(cars) * kBlock;
    state.counters["ratio"] = bench::median(ratios);
    state.counters["driven_ns"] = bench::median(driven_ns) / steps;  // a car and tick
    state.counters["fixed_ns"] = bench::median(fixed_ns) / steps;
    if (!driven.moves_like(fixed)) state.SkipWithError("the cars move differently");
    const std::uint64_t allocated = bench::allocations();
    for (int i = 0; i < kSettlingTicks; ++i) driven.step();
    state.counters["allocations"] = static_cast<double>(bench::allocations() - allocated);
    state.counters["robots"] = cars;
    state.counters["in_lanes"] = driven.report().placed;
    state.SetLabel("world=cars dt=2ms threads=1 lanes=" + std::to_string(driven.lanes()));
}

void onboard_straight(benchmark::State& state) {
    compare(state, 0.4, 0);
}
void onboard_turning(benchmark::State& state) {
    compare(state, 0, 2);
}

BENCHMARK(onboard_straight)->Arg(2000)->Unit(benchmark::kMillisecond)->Iterations(100);
BENCHMARK(onboard_turning)->Arg(2000)->Unit(benchmark::kMillisecond)->Iterations(100);

}  // namespace
