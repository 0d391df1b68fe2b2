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

StartingPoint starting_point(const Model& model, const SavedRun* from,
                             const std::vector<std::string>& clients) {
    if (from == nullptr) return beginning_of(model);
    StartingPoint start{from->tick, from->states, from->orders, from->logged_until, {}};
    if (from->logged_until <= from->tick) return start;
    for (const std::string& name : clients) {
        const auto known = from->answered.find(name);
        start.answered.push_back(known != from->answered.end() ? known->second : from->logged_until - 1);
    }
    return start;
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
            return Error{"two control programs are called '" + program.name + "'", "give each its own name",
                         "duplicate-name"};
        if (Result<BusClientOptions> times = client_options(*program.program, *model, program.name); !times)
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
      lanes_(options.lanes),
      observer_(options.observer),
      interrupted_(options.interrupted),
      controller_(model_, controller_options(options, programs),
                  starting_point(*model_, from, controller_options(options, programs).clients)),
      probe_(*model_),
      log_(options.controller.log) {
    instance_ = 1000 * static_cast<std::uint64_t>(options.controller.before.epoch);  // never twice on a Bus
    for (NamedProgram& program : programs) {
        hosts_.push_back(std::make_unique<ProgramHost>(model_, Address{Role::kClient, ++instance_},
                                                       program.name, std::move(program.program)));
        hosts_.back()->client().set_visuals(options.visuals);
        if (from == nullptr) continue;
        const auto memory = from->memory.find(program.name);
        if (memory != from->memory.end()) hosts_.back()->restore(memory->second);
    }
    for (std::size_t i = 0; i < options.simulators; ++i) add_simulator();
}

void Simulation::add_simulator() {
    SimulatorOptions role;
    role.lanes = lanes_;
    role.name = "this process";
    // Not during a recovery: without the states that it restores the run cannot be saved.
    role.abandons = [this] { return is_interrupted() && controller_.phase() == Phase::kStepping; };
    simulators_.push_back(
        std::make_unique<Simulator>(model_, Address{Role::kSimulator, ++instance_}, role, pool_));
}

bool Simulation::remove_simulator() {
    return controller_.dismiss_simulator();
}

std::vector<std::string> Simulation::clients_elsewhere() const {
    std::vector<std::string> names = controller_.clients_serving();
    for (const auto& host : hosts_) std::erase(names, host->name());
    return names;
}

void Simulation::serve() {
    turn();
    wait();
}

void Simulation::turn() {
    controller_.advance(*bus_);
    serve_log();
    for (auto& host : hosts_) host->advance(*bus_);
    serve_log();
    for (auto& simulator : simulators_) simulator->advance(*bus_);
    std::erase_if(simulators_, [](const auto& simulator) { return simulator->gone(); });
    if (observer_) observer_(*bus_);
}

/// Adds the memory of control programs at its tick to a checkpoint for the log.
void Simulation::serve_log() {
    if (log_ == nullptr) return;
    if (controller_.log_tick() && controller_.log_tick() != noting_) {
        noting_ = controller_.log_tick();
        noted_.clear();
    }
    if (!noting_) return;
    bool complete = true;
    for (const auto& host : hosts_) {
        if (noted_.contains(host->name())) continue;
        std::optional<std::string> memory = host->settled_memory(*noting_);
        complete = complete && memory.has_value();
        if (memory) noted_[host->name()] = std::move(*memory);
    }
    if (auto checkpoint = controller_.take_log_checkpoint()) log_checkpoint_ = std::move(checkpoint);
    if (!complete || !log_checkpoint_ || log_checkpoint_->tick != *noting_) return;
    std::erase_if(noted_, [](const auto& memory) { return memory.second.empty(); });
    log_checkpoint_->memory = std::move(noted_);
    log_->checkpoint(std::move(*log_checkpoint_));
    log_checkpoint_.reset();
    noting_.reset();
    noted_.clear();
}

void Simulation::wait() {
    constexpr std::int64_t kLongestWait_ms = 10;  // roles resend and detect losses by the clock
    if (controller_.waits_for_log()) return log_->wait_safe(controller_.log_needed(), kLongestWait_ms);
    bus_->wait(kLongestWait_ms);
}

template <class Done>
void Simulation::turn_until(Done&& done) {
    while (!done()) {
        turn();
        if (!done()) wait();
    }
}

Result<> Simulation::run_until(Tick target, const std::function<bool()>& go_on) {
    controller_.run_until(target);
    bool stop = false;
    turn_until([&] {
        if (is_interrupted()) controller_.abandon_window();
        if (go_on && !stop && !go_on()) {
            stop = true;
            controller_.run_until(controller_.tick());
        }
        return controller_.resting() || controller_.stopped() || (stop && !controller_.started());
    });
    if (controller_.failure()) return *controller_.failure();
    return Ok{};
}

bool Simulation::await_states(const std::function<bool()>& go_on) {
    if (controller_.states() == nullptr) controller_.request_states();
    bool stop = false;
    turn_until([&] {
        stop = controller_.states() == nullptr && !go_on();
        return controller_.states() != nullptr || stop;
    });
    return !stop;
}

const std::vector<RobotState>& Simulation::states() {
    (void)await_states([] { return true; });
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
    run.tick = run.logged_until = tick();
    run.states = states();
    run.orders = controller_.pending_orders();
    run.clients = controller_.client_names();
    for (const auto& host : hosts_)
        if (std::string memory = host->memory_at(run.tick); !memory.empty())
            run.memory[host->name()] = std::move(memory);
    return run;
}

void Simulation::start_log(RunLog* log, Tick log_ticks) {
    log_ = log;
    log_checkpoint_.reset();
    noting_.reset();
    if (log == nullptr) return controller_.start_log(nullptr, 0);
    SavedRun here = saved_run();
    controller_.start_log(log, log_ticks);
    log->committed(here.tick, controller_.hash());
    log->checkpoint({here.tick, std::make_shared<const std::vector<RobotState>>(std::move(here.states)),
                     std::move(here.memory)});
}

std::vector<std::string> Simulation::take_notices() {
    std::vector<std::string> notices = controller_.take_notices();
    for (auto& simulator : simulators_)
        for (std::string& line : simulator->take_notices()) notices.push_back(std::move(line));
    for (auto& host : hosts_)
        for (const std::string& line : host->client().take_refusals())
            notices.push_back("client '" + host->name() + "': " + line);
    return notices;
}

}  // namespace roboss
