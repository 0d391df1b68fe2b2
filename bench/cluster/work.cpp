// Recording a run, and running it again in one process for its cost.
#include "cluster/work.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "app/city_world.h"
#include "client/plugin.h"
#include "core/thread_cpu.h"
#include "sdf/load_world.h"
#include "simulation/simulation.h"
#include "take.h"

namespace roboss::bench {
namespace {

/// A log in memory that keeps the orders.
class OrderRecorder : public RunLog {
  public:
    std::vector<SaidOrder> orders;
    void joined(ClientId, const std::string&) override {}
    void order(const Order& order, Tick said) override { orders.push_back({order, said}); }
    void word(ClientId, Tick) override {}
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

/// Steps the work again without Clients, for its cost.
void measure_in_one_process(Work& work, bool one_island, std::size_t lanes) {
    SimulationOptions options;
    options.lanes = lanes;
    options.controller.seed = 7;
    options.controller.forecast.merge_all = one_island;
    SavedRun from;
    from.states = beginning_of(*work.model).states;
    from.orders = work.orders;
    from.logged_until = work.ticks;
    const auto again = take(Simulation::create(work.model, options, {}, &from));
    take(again->run_until(work.settle));
    const std::uint64_t begin_ns = thread_cpu_ns();
    const double begin_s = again->counters().step_cpu_s;
    take(again->run_until(work.ticks));
    work.process_cpu_s = 1e-9 * static_cast<double>(thread_cpu_ns() - begin_ns);
    work.step_cpu_s = again->counters().step_cpu_s - begin_s;
    if (again->hash() != work.hash)
        throw std::runtime_error(work.name + ": the recorded orders do not give the recorded run");
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
    Work work{name, load(file), {}, settle, ticks, 0, 0, 0};
    OrderRecorder recorder;
    SimulationOptions options;
    options.lanes = lanes;
    options.controller.seed = 7;
    options.controller.log = &recorder;
    std::vector<NamedProgram> programs;
    if (!driver.empty()) programs.push_back({"driver", take(load_control_program(driver))});
    const auto recording = take(Simulation::create(work.model, options, std::move(programs)));
    take(recording->run_until(ticks));
    work.hash = recording->hash();
    work.orders = std::move(recorder.orders);

    measure_in_one_process(work, false, lanes);
    return work;
}

Work as_one_island(Work work, std::size_t lanes) {
    work.name += ", one island";
    measure_in_one_process(work, true, lanes);
    return work;
}

}  // namespace roboss::bench
