// Processes of this computer and members from anywhere.
#include "app/company.h"

#include <fmt/format.h>
#include <unistd.h>

#include <random>

#include "app/network_options.h"

namespace roboss {
namespace {

constexpr std::int64_t kSilence_ms = 1'000;     // a Simulator whose stepping hangs
constexpr std::int64_t kClientGone_ms = 5'000;  // a Client whose process is gone and does not come back
constexpr double kCheckpointEvery_s = 0.2;      // of stepping: what a loss may cost
constexpr std::int64_t kLookAround_ms = 500;    // for another Controller of the same name
constexpr int kStartedAgainMax = 3;
constexpr std::uint32_t kOnOneComputer_ms = 1'000;  // no cable to be cut: what is slow is only busy

}  // namespace

Result<std::unique_ptr<Company>> Company::gather(const RunOptions& options) {
    std::unique_ptr<Company> company(new Company(options));
    company->network_ = options.network;
    if (options.processes > 0) {
        std::random_device device;
        company->network_.simulation = fmt::format("run-{}-{:08x}", getpid(), device());
        company->network_.interface = "127.0.0.1";
        company->network_.multicast = false;
        company->network_.liveliness_ms = kOnOneComputer_ms;
        company->network_.peers = {"127.0.0.1"};
        company->network_.peer_range = static_cast<std::uint32_t>(std::min(120, 16 + options.processes));
        for (int i = 0; i < options.processes; ++i)
            if (Result<> started = company->start_process(); !started) return started.error();
    }
    if (options.processes > 0 || options.is_controller)
        if (Result<> open = company->open_network(); !open) return open.error();
    return company;
}

Result<> Company::open_network() {
    Result<std::unique_ptr<DdsBus>> bus = DdsBus::create(network_);
    if (!bus) return bus.error();
    bus_ = std::move(bus).value();
    open_bus_ = bus_.get();
    std::vector<Envelope> inbox;
    bus_->drain(kControllerAddress, inbox);
    if (!o_.is_controller) return Ok{};
    const std::int64_t end = bus_->now_ms() + kLookAround_ms;
    while (bus_->now_ms() < end) {
        bus_->wait(end - bus_->now_ms());
        if (bus_->taken_elsewhere(kControllerAddress))
            return Error{"there is a Controller of " + describe(network_) + " already",
                         "end it, or give this run another name with --simulation"};
    }
    notices_.push_back(
        fmt::format("Controller of {}, waits for {} Simulators", describe(network_), o_.simulators));
    return Ok{};
}

Result<> Company::start_process() {
    Result<LocalProcess> process = LocalProcess::start({"roboss",
                                                        "simulator",
                                                        "--simulation",
                                                        network_.simulation,
                                                        "--domain",
                                                        std::to_string(network_.domain),
                                                        "--interface",
                                                        network_.interface,
                                                        "--no-multicast",
                                                        "--peer",
                                                        network_.peers.front(),
                                                        "--peer-range",
                                                        std::to_string(network_.peer_range),
                                                        "--liveliness-ms",
                                                        std::to_string(network_.liveliness_ms),
                                                        "--threads",
                                                        std::to_string(o_.threads),
                                                        "--lanes",
                                                        std::to_string(o_.lanes),
                                                        "--patience",
                                                        "10",
                                                        "--quiet"});
    if (!process) return process.error();
    processes_.push_back(std::move(process).value());
    return Ok{};
}

void Company::brief(SimulationOptions& options) const {
    if (open_bus_ == nullptr) return;
    options.simulators = static_cast<std::size_t>(o_.local);
    options.simulators_awaited = static_cast<std::size_t>(o_.processes > 0 ? o_.processes : o_.simulators);
    options.clients_awaited = o_.clients_awaited;
    options.controller.loss_ms = std::max<std::int64_t>(kSilence_ms, network_.liveliness_ms);
    options.controller.client_gone_ms = kClientGone_ms;
    options.controller.checkpoint_work_s = kCheckpointEvery_s;
}

std::unique_ptr<Bus> Company::take_bus() {
    return std::move(bus_);
}

Result<bool> Company::add_simulator() {
    if (o_.is_controller && o_.local == 0)
        return Error{"this run takes its Simulators from anywhere",
                     "start `roboss simulator` where you want it"};
    if (processes_.empty()) return false;
    if (Result<> started = start_process(); !started) return started.error();
    return true;
}

Result<> Company::kill(const std::string& name) {
    for (LocalProcess& process : processes_) {
        if (name != place_name(process.id())) continue;
        process.kill();
        return Ok{};
    }
    return Error{"Simulator '" + name + "' is no process of this run's own",
                 "end it where it runs; runs started with --processes have processes of their own"};
}

Result<> Company::look_after() {
    if (processes_.empty()) return Ok{};
    std::erase_if(processes_, [&](LocalProcess& process) {
        const auto ended = process.ended();
        if (ended) notices_.push_back(fmt::format("Simulator process {} {}", process.id(), *ended));
        return ended.has_value();
    });
    if (!processes_.empty()) return Ok{};
    if (++started_again_ > kStartedAgainMax)
        return Error{"all Simulator processes have ended, again and again", "see why in the lines above"};
    notices_.push_back("no Simulator process is left, starting one");
    return start_process();
}

std::vector<std::string> Company::take_notices() {
    if (open_bus_ != nullptr)
        for (std::string& line : open_bus_->take_notices()) notices_.push_back(std::move(line));
    return std::exchange(notices_, {});
}

void Company::see_off() {
    if (open_bus_ == nullptr) return;
    open_bus_->flush(1'000);
    for (LocalProcess& process : processes_) process.wait(3'000);
    processes_.clear();
}

}  // namespace roboss
