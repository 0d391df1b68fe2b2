// The loop of a run.
#include "live_run.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <random>

#include "core/check.h"
#include "core/hash.h"
#include "core/thread_cpu.h"
#include "model/edit.h"

namespace roboss::test {
namespace {

using Clock = std::chrono::steady_clock;

Address new_address() {
    static std::atomic<std::uint64_t> last = 1'000'000'000;
    return {Role::kClient, ++last};
}

}  // namespace

LiveRun::LiveRun(std::shared_ptr<const Model> model, const LiveRunOptions& options,
                 std::vector<NamedProgram> programs)
    : options_(options), model_(std::move(model)), paused_(options.paused) {
    if (options.viewer) {
        GatewayOptions gateway;
        gateway.listen = options.listen;
        gateway.page_folder = options.page_folder;
        gateway.role = options.role;
        gateway.insecure = options.insecure;
        gateway.certificate = options.certificate;
        gateway.users = options.users;
        gateway.new_address = new_address;
        auto opened = Gateway::open(gateway);
        ROBOSS_CHECK(opened.ok(), "the gateway listens");
        gateway_ = std::move(opened).value();
        url_ = gateway_->url();
    }
    auto made = Simulation::create(model_, simulation_options(), std::move(programs));
    ROBOSS_CHECK(made.ok(), "the simulation is made");
    simulation_ = std::move(made).value();
    for (const Order& order : options.orders)
        ROBOSS_CHECK(simulation_->submit(order).ok(), "the order is taken");
    thread_ = std::thread([this] { live(); });
}

SimulationOptions LiveRun::simulation_options() const {
    SimulationOptions options;
    options.simulators = options_.simulators;
    if (!gateway_) return options;
    options.observer = [this](Bus& bus) { gateway_->advance(bus); };
    options.controller.visuals = options_.visuals;
    options.controller.scene = [textures = options_.textures](const Model& model) {
        SceneFile file = scene_file(make_scene(model, nullptr), model, 0);
        file.textures = textures;
        return encode(file);
    };
    return options;
}

LiveRun::~LiveRun() {
    stop_ = true;
    thread_.join();
}

void LiveRun::live() {
    const Tick stride = options_.speed > 0 ? 16 : 4096;
    auto since = Clock::now();
    Tick from = 0;
    cpu_before_ns_ = thread_cpu_ns();
    while (!stop_) {
        serve_calls();
        {
            std::unique_lock lock(mutex_);
            if (auto model = std::exchange(next_model_, nullptr)) {
                lock.unlock();
                start_again(std::move(model));
            }
        }
        const Tick now = simulation_->tick();
        const bool ended = options_.end > 0 && now >= options_.end;
        if (ended || paused_) {
            simulation_->serve();
            hash_ = simulation_->hash();
            at_end_ = ended;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            since = Clock::now(), from = now;
            continue;
        }
        const Tick next = options_.end > 0 ? std::min(now + stride, options_.end) : now + stride;
        const Result<> done = simulation_->run_until(next, [&] {
            for (ControlCall& call : simulation_->take_control_calls()) calls_.push_back(std::move(call));
            note_progress();
            return !stop_ && calls_.empty();
        });
        ROBOSS_CHECK(done.ok(), "the run goes on");
        note_progress();
        if (options_.speed <= 0) continue;
        const double due_s = static_cast<double>(simulation_->tick() - from) * model_->dt_s / options_.speed;
        std::this_thread::sleep_until(
            since + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(due_s)));
    }
}

void LiveRun::note_progress() {
    if (tick_ == simulation_->tick()) return;
    tick_ = simulation_->tick();
    cpu_s_ = 1e-9 * static_cast<double>(thread_cpu_ns() - cpu_before_ns_);
}

void LiveRun::serve_calls() {
    for (ControlCall& call : simulation_->take_control_calls()) calls_.push_back(std::move(call));
    for (const ControlCall& call : std::exchange(calls_, {})) {
        const ControlAction& action = call.request.action;
        ControlOutcome outcome = ControlDone{simulation_->tick(), control_verb(action)};
        if (std::holds_alternative<GetStatus>(action)) {
            RunStatus status;
            status.tick = simulation_->tick(), status.time_s = simulation_->time_s();
            status.paused = paused_;
            outcome = status;
        } else if (std::holds_alternative<GetGroups>(action)) {
            outcome = RobotGroups{model_->hash, {0}, {0}};
        } else if (std::holds_alternative<PauseRun>(action) || std::holds_alternative<ResumeRun>(action)) {
            paused_ = std::holds_alternative<PauseRun>(action);
        } else {
            outcome = ControlRefused(Error{"not of this test's runs", "", "refused"});
        }
        simulation_->answer(call, std::move(outcome));
    }
    if (!gateway_) return;
    const std::scoped_lock lock(mutex_);
    for (const auto& lines : {gateway_->take_notices(), simulation_->take_notices()})
        for (const std::string& line : lines) log_ += line + "\n";
}

/// As `roboss run` does when robots come or go: a new Simulation, on a Bus of its own.
void LiveRun::start_again(std::shared_ptr<const Model> model) {
    SavedRun from = simulation_->saved_run();
    from.states.clear();
    for (std::size_t r = 0; r < model->robots.size(); ++r)
        from.states.push_back(initial_state(*model, RobotId(r)));
    from.orders.clear();
    SimulationOptions options = simulation_options();
    options.controller.before = simulation_->hand_over();
    options.clients_awaited = simulation_->clients_elsewhere();
    auto made = Simulation::create(model, options, {}, &from);
    ROBOSS_CHECK(made.ok(), "the simulation goes on");
    simulation_ = std::move(made).value();
    model_ = std::move(model);
}

std::uint64_t LiveRun::hash_at_end() {
    while (!at_end_) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return hash_;
}

std::string LiveRun::log() {
    const std::scoped_lock lock(mutex_);
    return log_;
}

bool LiveRun::says(const std::string& words, int ms_max) {
    for (int ms = 0; ms < ms_max; ms += 5) {
        if (log().find(words) != std::string::npos) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
}

}  // namespace roboss::test
