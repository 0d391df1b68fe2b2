// What an image costs: depth, and colours with shadows, seen by a car among fifty others in the city. World
// worlds/city.sdf, wall-clock time; the last argument is the number of threads.
#include <benchmark/benchmark.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/view.h"
#include "sdf/load_world.h"
#include "visuals/visual_source.h"

namespace {

using namespace roboss;

/// The city at its start, and a camera 0.4 m above the first car, which looks ahead.
class City {
  public:
    explicit City(unsigned threads) {
        Diagnostics diagnostics;
        LoadOptions options;
        options.looks = true;
        std::optional<World> world =
            load_world(std::string(ROBOSS_WORLDS) + "/city.sdf", options, diagnostics);
        if (!world) throw std::runtime_error("worlds/city.sdf cannot be read");
        model_ = compile(*world, {}, diagnostics);
        const auto kept = std::make_shared<const World>(*std::move(world));
        scene_ = std::make_unique<CameraScene>(model_, visuals_of({kept})(*model_).value(), threads);
        for (std::size_t i = 0; i < model_->robots.size(); ++i)
            states_.push_back(initial_state(*model_, RobotId(i)));
        for (const RobotState& state : states_) pointers_.push_back(&state);
        scene_->update(pointers_);
    }
    const CameraScene& scene() const { return *scene_; }
    render::CameraView view(int width, int height) const {
        CameraOptics optics;
        optics.width = width, optics.height = height, optics.horizontal_fov = 1.2;
        Transform X_WC = to_transform(base_pose(states_.front()));
        X_WC.p.z += 0.4;
        return {X_WC, optics, {}};
    }

  private:
    std::shared_ptr<const Model> model_;
    std::unique_ptr<CameraScene> scene_;
    std::vector<RobotState> states_;
    std::vector<const RobotState*> pointers_;
};

void label(benchmark::State& state) {
    state.counters["frames/s"] =
        benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
    state.SetLabel("world=city robots=50 image=" + std::to_string(state.range(0)) + "x" +
                   std::to_string(state.range(1)) + " threads=" + std::to_string(state.range(2)));
}

void camera_depth(benchmark::State& state) {
    const City city(static_cast<unsigned>(state.range(2)));
    const render::CameraView view =
        city.view(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
    for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(sight(city.scene(), view, 0.05, 100));
    label(state);
}

void camera_colours(benchmark::State& state) {
    const City city(static_cast<unsigned>(state.range(2)));
    const render::CameraView view =
        city.view(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
    for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(picture(city.scene(), view));
    label(state);
}

void sizes(benchmark::internal::Benchmark* benchmark) {
    for (const int threads : {1, 2})
        for (const auto& size : {std::pair(64, 64), std::pair(160, 120), std::pair(640, 480)})
            benchmark->Args({size.first, size.second, threads});
    benchmark->UseRealTime()->Unit(benchmark::kMillisecond);
}

BENCHMARK(camera_depth)->Apply(sizes);
BENCHMARK(camera_colours)->Apply(sizes);

}  // namespace
