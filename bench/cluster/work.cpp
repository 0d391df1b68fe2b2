// Recording a run, and running it again in one process.
#include "cluster/work.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "app/worlds/city_world.h"
#include "client/plugin.h"
#include "core/thread_cpu.h"
#include "sdf/load_world.h"
#include "take.h"

namespace roboss::bench {
namespace {

constexpr Tick kWarmUp = 200;

/// A log in memory that keeps the orders.
class OrderRecorder : public RunLog {
  public:
    std::vector<LoggedOrder> orders;
    void joined(ClientId, const std::string&) override {}
    void order(const Order& order, Tick given_at) override { orders.push_back({order, given_at}); }
    void reply(ClientId, Tick) override {}
    void note(Tick, const std::string&) override {}
    void planned(Tick) override {}
    void committed(Tick, std::uint64_t) override {}
    bool takes_checkpoint() const override { return false; }
    void checkpoint(RunCheckpoint) override {}
    std::uint64_t given() const override { return 0; }
    bool safe(std::uint64_t) const override { return true; }
    void hurry() override {}
    void wait_safe(std::uint64_t, std::int64_t) override {}
};

std::shared_ptr<const Model> load(const std::string& file) {
    Diagnostics found;
    const std::optional<World> world = load_world(file, {}, found);
    const auto model = world && !found.has_errors() ? compile(*world, {}, found) : nullptr;
    if (!model) throw std::runtime_error(file + " has errors; see `roboss check`");
    return model;
}

}  // namespace

StartingPoint Work::start() const {
    StartingPoint start = beginning_of(*model);
    start.orders = orders;
    start.logged_until = ticks;
    return start;
}

std::string city_file(std::size_t cars) {
    CityOptions options;
    options.cars = static_cast<int>(cars);
    const auto file =
        std::filesystem::temp_directory_path() / ("roboss-city-" + std::to_string(cars) + ".sdf");
    if (!(std::ofstream(file) << city_sdf(options)))
        throw std::runtime_error("cannot write " + file.string());
    return file.string();
}

Work record(const std::string& name, const std::string& file, const std::string& driver, Tick settle,
            Tick ticks, std::size_t lanes) {
    Work work{name, load(file), {}, settle, ticks, std::max<Tick>(0, settle - kWarmUp), {}, 0};
    OrderRecorder recorder;
    SimulationOptions options;
    options.lanes = lanes;
    options.controller.seed = 7;
    options.controller.log = &recorder;
    std::vector<NamedProgram> programs;
    if (!driver.empty()) programs.push_back({"driver", take(load_control_program(driver))});
    const auto recording = take(Simulation::create(work.model, options, std::move(programs)));
    take(recording->run_until(work.before));
    work.states = recording->states();
    take(recording->run_until(ticks));
    work.hash = recording->hash();
    work.orders = std::move(recorder.orders);
    return work;
}

OneProcess::OneProcess(const Work& work, std::size_t lanes, bool one_island) {
    SimulationOptions options;
    options.lanes = lanes;
    options.controller.seed = 7;
    options.controller.forecast.merge_all = one_island;
    SavedRun from;
    from.tick = work.before;
    from.states = work.states;
    from.orders = work.orders;
    from.logged_until = work.ticks;
    simulation_ = take(Simulation::create(work.model, options, {}, &from));
    take(simulation_->run_until(work.settle));
    warm_s_ = simulation_->counters().step_cpu_s;
}

void OneProcess::run_until(Tick tick) {
    const std::uint64_t begin_ns = thread_cpu_ns();
    take(simulation_->run_until(tick));
    cpu_s_ += 1e-9 * static_cast<double>(thread_cpu_ns() - begin_ns);
}

}  // namespace roboss::bench
