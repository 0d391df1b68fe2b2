// What lidars cost: rays a second of scans of 1 x 360, 16 x 1800 and 128 x 1024 beams, on cars of the city
// (worlds/city.sdf). Every iteration moves the cars, so it includes the update of the ray scene; without
// noise. Wall-clock time, and the processor time of all threads; the arguments are rows, columns, robots that
// carry a lidar, and threads.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/fixed_math.h"
#include "sdf/load_world.h"
#include "sensors/readings.h"

namespace {

using namespace roboss;

constexpr double kReach = 100;  // m

LaserSpec lidar(int rows, int columns) {
    constexpr double kUp = 0.26;  // rad
    LaserSpec laser;
    laser.samples = columns, laser.vertical_samples = rows;
    laser.min_angle = -kPi, laser.max_angle = kPi;
    if (rows > 1) laser.vertical_min_angle = -kUp, laser.vertical_max_angle = kUp;
    laser.range_min = 0.1, laser.range_max = kReach;
    return laser;
}

/// The city; `robots` of its cars carry a lidar 0.4 m above them. Beyond the fifty of the file there are
/// copies, 3 m ahead of them.
World city_with(const LaserSpec& laser, std::size_t robots) {
    Diagnostics diagnostics;
    std::optional<World> world = load_world(std::string(ROBOSS_WORLDS) + "/city.sdf", {}, diagnostics);
    if (!world) throw std::runtime_error("worlds/city.sdf cannot be read");
    SensorSpec sensor;
    sensor.name = "bench", sensor.parameters = laser, sensor.X_LS.p = {0, 0, 0.4};
    for (ModelSpec& spec : world->prototypes)
        if (!spec.is_static) spec.links.front().sensors.push_back(sensor);
    const auto is_car = [&](const ModelInstance& i) { return !world->prototypes[i.prototype].is_static; };
    std::vector<ModelInstance> copies;
    std::ranges::copy_if(world->instances, std::back_inserter(copies), is_car);
    const auto cars = copies.size();
    copies.resize(robots > cars ? std::min(cars, robots - cars) : 0);
    for (ModelInstance& copy : copies) {
        copy.name += "_copy";
        copy.X_WM = copy.X_WM * Pose{{3, 0, 0}, {}};
        world->instances.push_back(copy);
    }
    return *std::move(world);
}

class City final : public SensorSources {
  public:
    City(const LaserSpec& laser, std::size_t robots, unsigned threads) {
        Diagnostics diagnostics;
        model_ = compile(city_with(laser, robots), {}, diagnostics);
        if (!model_) throw std::runtime_error("the city with lidars cannot be compiled");
        rays_ = std::make_unique<RayScene>(model_);
        rays_->set_threads(threads);
        for (std::size_t i = 0; i < model_->robots.size(); ++i)
            states_.push_back(initial_state(*model_, RobotId(i)));
        for (std::size_t i = 0; i < states_.size(); ++i) {
            pointers_.push_back(&states_[i]);
            const auto sensor = model_->type_of(RobotId(i)).find_sensor("bench");
            if (sensor && queries_.size() < robots)
                queries_.push_back({*model_, RobotId(i), *sensor, states_[i], 0, 1, *this});
        }
        if (queries_.size() < robots) throw std::runtime_error("the city has too few cars");
    }
    City(const City&) = delete;
    City& operator=(const City&) = delete;

    void scan() {
        for (RobotState& state : states_) state.q[0] += 1e-4;
        rays_->update(pointers_);
        benchmark::DoNotOptimize(measure_all(queries_));
    }
    std::size_t boxes() const { return model_->statics.size(); }

    RayScene& ray_scene() override { return *rays_; }
    StepProbe& step_probe() override { throw std::logic_error("lidars need no step"); }
    const RobotState& state_of(RobotId robot) override { return states_[robot.index()]; }

  private:
    std::shared_ptr<const Model> model_;
    std::vector<RobotState> states_;
    std::vector<const RobotState*> pointers_;
    std::unique_ptr<RayScene> rays_;
    std::vector<SensorQuery> queries_;
};

void lidar_scan(benchmark::State& state) {
    const auto rows = static_cast<int>(state.range(0)), columns = static_cast<int>(state.range(1));
    City city(lidar(rows, columns), static_cast<std::size_t>(state.range(2)),
              static_cast<unsigned>(state.range(3)));
    for ([[maybe_unused]] auto _ : state) city.scan();
    state.counters["rays/s"] = benchmark::Counter(
        static_cast<double>(state.iterations()) * rows * columns * static_cast<double>(state.range(2)),
        benchmark::Counter::kIsRate);
    state.SetLabel("world=city shapes=" + std::to_string(city.boxes()) + " beams=" + std::to_string(rows) +
                   "x" + std::to_string(columns) + " robots=" + std::to_string(state.range(2)) +
                   " threads=" + std::to_string(state.range(3)));
}

void sizes(benchmark::internal::Benchmark* benchmark) {
    for (const int threads : {1, 2})
        for (const auto& size : {std::pair(1, 360), std::pair(16, 1800), std::pair(128, 1024)})
            for (const int robots : {1, 10, 100}) benchmark->Args({size.first, size.second, robots, threads});
    benchmark->UseRealTime()->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);
}

BENCHMARK(lidar_scan)->Apply(sizes);

}  // namespace
