// Building the roles of one process and giving each its turn.
#include "simulation/simulation.h"

#include <set>

#include "bus/in_process_bus.h"

namespace roboss {

namespace {

ControllerOptions controller_options(const SimulationOptions& options,
                                     const std::vector<NamedProgram>& programs) {
    ControllerOptions result = options.controller;
    result.simulators = options.simulators + options.simulators_awaited;
    result.clients.clear();
    for (const NamedProgram& program : programs) result.clients.push_back(program.name);
    for (const std::string& name : options.clients_awaited) result.clients.push_back(name);
    return result;
}

StartingPoint starting_point(const Model& model, const SavedRun* from) {
    if (from == nullptr) return beginning_of(model);
    return {from->tick, from->states, from->orders};
}

}  // namespace

Result<std::unique_ptr<Simulation>> Simulation::create(std::shared_ptr<const Model> model,
                                                       const SimulationOptions& options,
                                                       std::vector<NamedProgram> programs,
                                                       const SavedRun* from, std::unique_ptr<Bus> bus) {
    if (options.simulators + options.simulators_awaited < 1)
        return Error{"a run needs at least one Simulator", "give --simulators 1 or more"};
    std::set<std::string> names(options.clients_awaited.begin(), options.clients_awaited.end());
    if (names.size() < options.clients_awaited.size())
        return Error{"two awaited Clients have the same name", "give each its own name"};
    for (const NamedProgram& program : programs) {
        if (!names.insert(program.name).second)
            return Error{"two control programs are called '" + program.name + "'", "give each its own name"};
        if (Result<BusClientOptions> times = client_options(program.program->options(), *model, program.name);
            !times)
            return times.error();
    }
    return std::unique_ptr<Simulation>(
        new Simulation(std::move(model), options, std::move(programs), from, std::move(bus)));
}

Simulation::Simulation(std::shared_ptr<const Model> model, const SimulationOptions& options,
                       std::vector<NamedProgram> programs, const SavedRun* from, std::unique_ptr<Bus> bus)
    : model_(std::move(model)),
      world_file_(options.world_file),
      seed_(options.controller.seed),
      bus_(bus ? std::move(bus) : std::make_unique<InProcessBus>()),
      pool_(options.threads),
      controller_(model_, controller_options(options, programs), starting_point(*model_, from)),
      probe_(*model_) {
    std::uint64_t instance = 0;
    for (NamedProgram& program : programs) {
        hosts_.push_back(std::make_unique<ProgramHost>(model_, Address{Role::kClient, ++instance},
                                                       program.name, std::move(program.program)));
        if (from == nullptr) continue;
        const auto memory = from->memory.find(program.name);
        if (memory != from->memory.end()) hosts_.back()->restore(memory->second);
    }
    SimulatorOptions role;
    role.lanes = options.lanes;
    for (std::size_t i = 0; i < options.simulators; ++i)
        simulators_.push_back(
            std::make_unique<Simulator>(model_, Address{Role::kSimulator, ++instance}, role, pool_));
}

void Simulation::turn() {
    controller_.advance(*bus_);
    for (auto& host : hosts_) host->advance(*bus_);
    for (auto& simulator : simulators_) simulator->advance(*bus_);
}

template <class Done>
void Simulation::turn_until(Done&& done) {
    constexpr std::int64_t kLongestWait_ms = 10;  // roles send again and notice losses by the clock
    while (!done()) {
        turn();
        if (!done()) bus_->wait(kLongestWait_ms);
    }
}

Result<> Simulation::run_until(Tick target, const std::function<bool()>& go_on) {
    controller_.run_until(target);
    bool stop = false;
    turn_until([&] {
        if (go_on && !stop && !go_on()) {
            stop = true;
            controller_.run_until(controller_.tick());
        }
        return controller_.resting() || controller_.stopped() || (stop && !controller_.started());
    });
    if (controller_.failure()) return *controller_.failure();
    return Ok{};
}

const std::vector<RobotState>& Simulation::states() {
    if (controller_.states() == nullptr) controller_.request_states();
    turn_until([&] { return controller_.states() != nullptr; });
    return *controller_.states();
}

StepProbe& Simulation::probe() {
    if (probe_.tick() == tick()) return probe_;
    std::vector<const RobotState*> pointers;
    for (const RobotState& state : states()) pointers.push_back(&state);
    probe_.step(tick(), pointers);
    return probe_;
}

SavedRun Simulation::saved_run() {
    turn_until([&] { return controller_.settled() || controller_.stopped(); });
    SavedRun run;
    run.world_file = world_file_;
    run.seed = seed_;
    run.tick = tick();
    run.states = states();
    run.orders = controller_.pending_orders();
    for (const auto& host : hosts_)
        if (std::string memory = host->memory_at(run.tick); !memory.empty())
            run.memory[host->name()] = std::move(memory);
    return run;
}

std::vector<std::string> Simulation::take_notices() {
    return controller_.take_notices();
}

}  // namespace roboss
