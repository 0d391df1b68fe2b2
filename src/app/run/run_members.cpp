// Starts processes on this computer and opens the network on which members join.
#include "app/run/run_members.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <random>
#include <set>

#include "app/processes/threads.h"

namespace roboss {
namespace {

constexpr std::int64_t kSilence_ms = 1'000;      // silence after which a Simulator counts as lost
constexpr std::int64_t kClientGone_ms = 10'000;  // a Client whose process is gone, until its successor joins
constexpr double kCheckpointEvery_s = 0.2;       // of stepping time: bounds the work lost with a Simulator
constexpr int kStartedAgainMax = 3;
constexpr std::int64_t kLookEvery_ms = 20;
constexpr std::uint32_t kOnOneComputer_ms = 5'000;  // no network can fail: a slow process is only busy
constexpr std::int64_t kJoin_ms = 7'000;            // without another process joining
constexpr std::int64_t kLinked_ms = 100;            // CPU time of a start, without the world
constexpr std::int64_t kFarewell_ms = 3'000;        // for all processes to end by themselves

}  // namespace

Result<std::unique_ptr<RunMembers>> RunMembers::gather(const RunOptions& options, std::int64_t prepared_ms) {
    std::unique_ptr<RunMembers> members(new RunMembers(options));
    members->network_ = options.network;
    const bool is_private = !options.is_controller && (options.processes > 0 || options.shows_nodes());
    if (is_private) {
        std::random_device device;
        members->network_.simulation = fmt::format("run-{}-{:08x}", getpid(), device());
        members->network_.liveliness_ms = kOnOneComputer_ms;
    }
    if (options.processes > 0)
        members->patience_ms_ = kJoin_ms + std::max<std::int64_t>(prepared_ms - kLinked_ms, 0) *
                                               std::max(1, options.processes / cores());
    if (is_private || options.is_controller)
        if (Result<> open = members->open_network(); !open) return open.error();
    for (int i = 0; i < options.processes; ++i)
        if (Result<> started = members->start_process(); !started) return started.error();
    if (!members->network_.keys.empty() && options.shows_nodes())
        return Error{
            "the process that speaks to nodes needs a key of its own, beside the Controller's --keys",
            "leave --ros2 and --foxglove out, and start `roboss ros2 --keys FOLDER` or `roboss "
            "foxglove --keys FOLDER`",
            "no-key"};
    if (options.ros2.wanted)
        if (Result<> started = members->start_companion("the ROS 2 process", ros2_arguments(options.ros2));
            !started)
            return started.error();
    if (options.foxglove.wanted())
        if (Result<> started =
                members->start_companion("the Foxglove server", foxglove_arguments(options.foxglove));
            !started)
            return started.error();
    return members;
}

Result<> RunMembers::open_network() {
    Result<std::unique_ptr<StreamBus>> bus = StreamBus::listen(network_);
    if (!bus) return bus.error();
    bus_ = std::move(bus).value();
    open_bus_ = bus_.get();
    std::vector<Envelope> inbox;
    bus_->drain(kControllerAddress, inbox);
    if (!o_.is_controller) return Ok{};
    notices_.push_back(fmt::format("Controller of {} at {}, waiting for {} Simulators [waiting]",
                                   describe(network_), bus_->where(), o_.simulators));
    if (network_.insecure)
        notices_.push_back("everybody who reaches " + bus_->where() +
                           " can read and change this run [insecure]");
    return Ok{};
}

/// The process finds this one, and a key, by the name of the run.
Result<> RunMembers::start_process() {
    return processes_.start({"roboss", "simulator", "--simulation", network_.simulation, "--liveliness-ms",
                             std::to_string(network_.liveliness_ms), "--threads",
                             std::to_string(threads_of_each(o_.threads, o_.processes)), "--lanes",
                             std::to_string(o_.lanes), "--patience", "10", "--quiet"});
}

/// It finds this process as Simulators do.
Result<> RunMembers::start_companion(const char* what, std::vector<std::string> words) {
    words.insert(words.end(), {"--simulation", network_.simulation, "--liveliness-ms",
                               std::to_string(network_.liveliness_ms)});
    for (const std::string& folder : o_.paths) words.insert(words.end(), {"--path", folder});
    if (network_.insecure) words.emplace_back("--insecure");
    companions_.emplace_back(what, std::move(words));
    return companions_.back().start(monotonic_ms());
}

void RunMembers::configure(SimulationOptions& options) const {
    if (open_bus_ == nullptr) return;
    options.controller.client_gone_ms = kClientGone_ms;
    if (o_.processes == 0 && !o_.is_controller) {
        options.clients_awaited = o_.clients_awaited;
        return;
    }
    options.simulators = static_cast<std::size_t>(o_.local);
    options.simulators_awaited = static_cast<std::size_t>(o_.processes > 0 ? o_.processes : o_.simulators);
    options.clients_awaited = o_.clients_awaited;
    options.controller.loss_ms =
        o_.processes > 0 ? kSilence_ms : std::max<std::int64_t>(kSilence_ms, network_.liveliness_ms);
    options.controller.checkpoint_work_s = kCheckpointEvery_s;
}

std::unique_ptr<Bus> RunMembers::take_bus() {
    return std::move(bus_);
}

Result<bool> RunMembers::add_simulator() {
    if (o_.is_controller && o_.local == 0)
        return Error{"Simulators of this run join over the network",
                     "start `roboss simulator` where you want it", "external-simulators"};
    if (o_.processes == 0) return false;
    if (Result<> started = start_process(); !started) return started.error();
    return true;
}

Result<> RunMembers::kill(const std::string& name) {
    if (processes_.kill(name)) return Ok{};
    return Error{"Simulator '" + name + "' was not started by this run",
                 "end it where it runs; only runs with --processes start their own Simulator processes",
                 "not-own-process"};
}

Result<> RunMembers::watch_start(const Simulation& simulation) {
    std::vector<std::string> joined;
    std::set<Address> known;
    for (const MemberReport& member : simulation.members()) {
        joined.push_back(member.name);
        known.insert(member.address);
    }
    std::uint64_t fetched = 0;
    for (const Flow& flow : open_bus_->flows())
        if (flow.from == kControllerAddress && !known.contains(flow.to)) fetched += flow.bytes;
    return processes_.watch_start(joined, fetched, monotonic_ms(), patience_ms_);
}

Result<> RunMembers::look_after(const Simulation& simulation) {
    if (o_.processes == 0 && companions_.empty()) return Ok{};
    const std::int64_t now = monotonic_ms();  // it asks the kernel about every process: not in every turn
    if (now - looked_ms_ < kLookEvery_ms) return Ok{};
    looked_ms_ = now;
    for (Companion& companion : companions_)
        if (Result<> looked = companion.look(now); !looked) return looked;
    if (o_.processes == 0) return Ok{};
    if (processes_.starting()) return watch_start(simulation);
    for (std::string& line : processes_.take_ended()) notices_.push_back(std::move(line));
    if (processes_.count() > 0) return Ok{};
    if (++started_again_ > kStartedAgainMax)
        return Error{"all Simulator processes have ended, repeatedly",
                     "see the messages above for the reason", "processes-ended"};
    notices_.push_back("no Simulator process is left; starting one [process-restarted]");
    return start_process();
}

std::vector<std::string> RunMembers::take_notices() {
    if (open_bus_ != nullptr)
        for (std::string& line : open_bus_->take_notices()) notices_.push_back(std::move(line));
    for (Companion& companion : companions_)
        for (std::string& line : companion.take_notices()) notices_.push_back(std::move(line));
    return std::exchange(notices_, {});
}

void RunMembers::end(const RunOver& over, bool abandoned) {
    if (open_bus_ == nullptr) return;
    open_bus_->say_farewell(over);
    if (!abandoned) open_bus_->flush(1'000);
    processes_.await_exit(abandoned ? 0 : kFarewell_ms);
    for (Companion& companion : companions_) companion.await_exit(abandoned ? 0 : kFarewell_ms);
}

}  // namespace roboss
