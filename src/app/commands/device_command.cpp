// Opens the lines, loads the program, and drives until the time is over, the user ends it, or a device is
// lost.
#include "app/commands/device_command.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "app/commands/exit_codes.h"
#include "app/commands/numbers.h"
#include "app/output/output_file.h"
#include "app/output/say.h"
#include "app/processes/crash_report.h"
#include "app/processes/interrupt.h"
#include "app/processes/member.h"
#include "client/plugin.h"
#include "client/program_host.h"
#include "core/monotonic.h"
#include "core/output_check.h"
#include "core/similar.h"
#include "device/device_run.h"
#include "device/twin.h"
#include "sdf/load_world.h"

namespace roboss {
namespace {

const char* const kDeviceFooter =
    R"(PROGRAM is the same library as for `roboss run --client`. WORLD describes the robots: names, joints, sensors. The program
reads what the devices measure, and drives their motors, in real time; what a device cannot do is refused with a reason.

First try the program in a simulation, then with a stand-in (examples/devices), then with the robot:
  roboss run worlds/khepera.sdf --client roboss_khepera.so
  roboss device worlds/khepera.sdf --client roboss_khepera.so --robot khepera --connect serial:/dev/ttyUSB0,9600 \
      --protocol khepera
Two robots of a team, seen by an overhead camera:
  roboss device worlds/soccer.sdf --client roboss_soccer_blue.so --robot blue_0 --connect udp:10.0.0.5:2008 \
      --robot blue_1 --connect udp:10.0.0.6:2008 --camera udp:10.0.0.2:2009
A robot's twin among simulated ones; the world is that of the run, so none is named:
  roboss controller worlds/khepera.sdf --local 1 --simulators 0 --simulation lab &
  roboss device --twin --simulation lab --client roboss_khepera.so --robot khepera --connect ... --protocol khepera

Two robots that work apart: one that is silent rests alone, the other goes on:
  roboss device ... --robot blue_0 --connect ... --robot blue_1 --connect ... --on-silence stop-this

Protocols, and what happens when a line fails: docs/devices.md.

Exit codes: 0 the time is over, or the run of the twin has ended; 1 the world, the program or a line cannot be used; 2
wrong usage; 3 the program threw an exception, or a device was silent for longer than --give-up; 130 Ctrl-C. The robots
get the command to stop in each case.)";

struct DeviceOptions {
    MemberOptions member;
    std::string world, program;
    std::vector<std::string> robots, lines, protocols, cameras, on_silence;
    DeviceRunOptions run;
    std::string json;
    bool twin = false;
};

const std::map<std::string, OnSilence> kOnSilence{
    {"stop-all", OnSilence::kStopAll}, {"stop-this", OnSilence::kStopThis}, {"go-on", OnSilence::kGoOn}};

double now_s() {
    return static_cast<double>(monotonic_ns()) * 1e-9;
}

class DeviceProcess {
  public:
    explicit DeviceProcess(const DeviceOptions& options) : o_(options), member_("device", options.member) {}

    int go() {
        report_crashes({});
        watch_for_interrupts();
        if (Result<> sound = check_usage(); !sound) return member_.report_error(sound.error()), kWrongUsage;
        if (!get_model()) return interrupted() ? kInterrupted : kBadInput;
        if (Result<> made = make_run(); !made) return member_.report_error(made.error()), kBadInput;
        if (o_.twin) join_run();
        drive();
        report_end();
        if (!o_.json.empty() && !write_summary()) return kRunFailed;
        if (!run_->failure()) return stopped_ ? kInterrupted : kSuccess;
        return kRunFailed;
    }

  private:
    Result<> check_usage() const {
        OutputCheck outputs;
        outputs.reads(o_.world), outputs.reads(o_.program);
        outputs.writes("--json", o_.json, "device summary");
        if (Result<> fine = outputs.check(); !fine) return fine;
        if (o_.world.empty() == !o_.twin)
            return Error{
                o_.twin ? "a world and --twin" : "no world",
                "name the WORLD that describes the robots, or join a run with --twin: it has its own"};
        if (o_.robots.empty() || o_.robots.size() != o_.lines.size())
            return Error{fmt::format("{} --robot and {} --connect", o_.robots.size(), o_.lines.size()),
                         "give each robot its line: --robot NAME --connect ADDRESS"};
        if (o_.protocols.size() > 1 && o_.protocols.size() != o_.robots.size())
            return Error{fmt::format("{} --protocol for {} robots", o_.protocols.size(), o_.robots.size()),
                         "give one for all, or one for each"};
        const std::size_t devices = o_.robots.size() + o_.cameras.size();
        if (o_.on_silence.size() > 1 && o_.on_silence.size() != devices)
            return Error{fmt::format("{} --on-silence for {} devices", o_.on_silence.size(), devices),
                         "give one for all, or one for each --robot and then for each --camera"};
        return Ok{};
    }

    bool get_model() {
        if (o_.twin) {
            if (!member_.open()) return false;
            address_ = member_.new_address(Role::kClient);
            model_ = member_.fetch_model(address_);
            return model_ != nullptr;
        }
        Diagnostics diagnostics;
        std::optional<World> world = load_world(o_.world, {{}, {}, false}, diagnostics);
        if (world && !diagnostics.refuses()) model_ = compile(*world, {}, diagnostics);
        for (const Diagnostic& d : diagnostics.items())
            if (d.severity != Severity::kNote) say(stderr, "{}\n", to_text(d));
        return model_ && !diagnostics.refuses();
    }

    Result<RobotId> robot(const std::string& name) const {
        if (const auto found = model_->find_robot(name)) return *found;
        std::vector<std::string> names;
        for (const Robot& one : model_->robots) names.push_back(one.name);
        return Error{"the world has no robot '" + name + "'",
                     did_you_mean(name, names, "see `roboss check` for their names"), "no-robot"};
    }

    Result<> add_line(const std::string& address, const std::string& protocol, RobotId id) {
        auto adapter = make_adapter(protocol, *model_, id);
        if (!adapter) return adapter.error();
        auto line = open_line(address);
        if (!line) return line.error();
        OnSilence chosen = OnSilence::kStopAll;
        if (!o_.on_silence.empty())
            chosen = kOnSilence.at(o_.on_silence[std::min(lines_.size(), o_.on_silence.size() - 1)]);
        lines_.push_back({std::move(line).value(), std::move(adapter).value(), id, chosen});
        return Ok{};
    }

    Result<> make_run() {
        auto program = load_control_program(o_.program);
        if (!program) return program.error();
        DeviceRunOptions options = o_.run;
        options.name = std::filesystem::path(o_.program).filename().string();
        const auto times = client_options(*program.value(), *model_, options.name);
        if (!times) return times.error();
        options.period = times.value().period;
        for (std::size_t i = 0; i < o_.robots.size(); ++i) {
            const Result<RobotId> id = robot(o_.robots[i]);
            if (!id) return id.error();
            for (std::size_t j = 0; j < i; ++j)
                if (o_.robots[j] == o_.robots[i])
                    return Error{"robot '" + o_.robots[i] + "' has two lines", "give it one"};
            const std::string& protocol =
                o_.protocols.empty() ? "joints" : o_.protocols[std::min(i, o_.protocols.size() - 1)];
            if (Result<> added = add_line(o_.lines[i], protocol, id.value()); !added) return added;
        }
        for (const std::string& camera : o_.cameras)
            if (Result<> added = add_line(camera, "joints", RobotId()); !added) return added;
        run_ = std::make_unique<DeviceRun>(model_, std::move(lines_), std::move(program).value(), options);
        return Ok{};
    }

    void join_run() {
        const std::string name = "twin of " + o_.robots.front();
        member_client_ = std::make_unique<BusClient>(model_, address_, twin_options(*model_, name));
        twin_ = std::make_unique<Twin>(*member_client_, run_->devices());
        run_->client().set_others([this](RobotId id) { return twin_->state(id); });
    }

    void drive() {
        while (run_->phase() != DeviceRun::Phase::kOver) {
            if (interrupted() && !std::exchange(stopped_, true)) run_->stop();
            run_->advance(now_s());
            if (run_->failure() && !std::exchange(failed_, true)) member_.report_error(*run_->failure());
            for (const std::string& notice : run_->take_notices()) member_.report(notice);
            if (twin_)
                move_twin();
            else
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        if (twin_) leave_run();
    }

    /// Places the twins once more, at rest: they would keep their last velocities.
    void leave_run() {
        twin_->stop();
        const double end = now_s() + 0.5;
        for (const std::uint64_t before = twin_->placed();
             !run_ended_ && twin_->placed() == before && now_s() < end;)
            move_twin();
        member_client_->leave(member_.bus()), member_.bus().flush(500);
    }

    void move_twin() {
        twin_->advance(member_.bus());
        for (const std::string& refusal : member_client_->take_refusals()) member_.report(refusal);
        const BusClient& client = *member_client_;
        const bool over = !client.over().empty() || client.outdated() || !client.refusal().empty();
        if (over && !std::exchange(run_ended_, true)) {
            member_.report(client.outdated()          ? "the world of the run has changed: start again"
                           : client.refusal().empty() ? "the run is over: " + client.over()
                                                      : "the run refuses the twin: " + client.refusal());
            run_->stop();
        }
        member_.bus().wait(1);
    }

    void report_end() const {
        const DeviceRun::Count& count = run_->count();
        member_.report(fmt::format("drove {:.1f} s: {} calls of control(), {} late, devices lost {} times",
                                   count.driven_s, count.calls, count.late, count.losses));
        for (const Device& device : run_->devices()) {
            const LineCount& line = device.adapter->count();
            member_.report(fmt::format("{} at {}: {} messages, {} lost, {} stale, {} damaged, {} reboots",
                                       device.adapter->protocol(), device.address, line.taken, line.lost,
                                       line.stale, line.damaged, line.reboots));
        }
        if (twin_) member_.report(fmt::format("the twin was put {} times", twin_->placed()));
    }

    bool write_summary() const {
        const DeviceRun::Count& count = run_->count();
        nlohmann::json summary = {{"driven_s", count.driven_s},
                                  {"calls", count.calls},
                                  {"late", count.late},
                                  {"losses", count.losses},
                                  {"failure", nullptr}};
        if (run_->failure()) summary["failure"] = run_->failure()->code;
        if (twin_) summary["placed"] = twin_->placed();
        for (const Device& device : run_->devices()) {
            const LineCount& line = device.adapter->count();
            nlohmann::json each = {{"address", device.address}, {"protocol", device.adapter->protocol()},
                                   {"taken", line.taken},       {"lost", line.lost},
                                   {"stale", line.stale},       {"damaged", line.damaged},
                                   {"reboots", line.reboots}};
            if (device.robot.valid()) each["robot"] = model_->robots[device.robot.index()].name;
            summary["devices"].push_back(each);
        }
        const OutputFile file = open_output(o_.json);
        if (file && std::fputs((summary.dump() + "\n").c_str(), file.get()) >= 0) return true;
        member_.report_error(
            {"the summary " + o_.json + " cannot be written", "choose another file", "no-file"});
        return false;
    }

    const DeviceOptions& o_;
    Member member_;
    Address address_{};
    std::shared_ptr<const Model> model_;
    std::vector<ConnectedDevice> lines_;
    std::unique_ptr<DeviceRun> run_;
    std::unique_ptr<BusClient> member_client_;
    std::unique_ptr<Twin> twin_;
    bool stopped_ = false, run_ended_ = false, failed_ = false;
};

}  // namespace

void add_device_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("device", "let a control program drive real robots");
    command->footer(kDeviceFooter);
    auto options = std::make_shared<DeviceOptions>();
    const std::string group = "Devices";
    command->add_option("world", options->world, "world, SDFormat or URDF file that describes the robots");
    command->add_option("--client", options->program, "the control program: a shared library")->required();
    command->add_option("--robot", options->robots, "name of a robot that is real (may be repeated)")
        ->required()
        ->allow_extra_args(false)
        ->group(group);
    command
        ->add_option("--connect", options->lines,
                     "its line: serial:PATH[,BAUD] or udp:HOST:PORT, one for each --robot, in their order")
        ->required()
        ->allow_extra_args(false)
        ->group(group);
    command
        ->add_option("--protocol", options->protocols,
                     "what it speaks: khepera or joints (default); one for all robots or one for each")
        ->check(CLI::IsMember({"khepera", "joints"}))
        ->allow_extra_args(false)
        ->group(group);
    command
        ->add_option("--camera", options->cameras,
                     "udp:HOST:PORT of a camera that gives poses of robots (may be repeated)")
        ->allow_extra_args(false)
        ->group(group);
    command
        ->add_option(
            "--on-silence", options->on_silence,
            "while a device is silent: stop-all robots (default), stop-this robot, or go-on; one for all "
            "devices, or one for each --robot and then for each --camera")
        ->check(CLI::IsMember({"stop-all", "stop-this", "go-on"}))
        ->allow_extra_args(false)
        ->group(group);
    command
        ->add_option("--duration", options->run.duration_s,
                     "end after driving for this long, s (default: at Ctrl-C)")
        ->check(positive_number());
    command
        ->add_option("--max-age", options->run.max_age_s,
                     "a device is silent while its readings are older than this, s")
        ->check(positive_number())
        ->capture_default_str();
    command
        ->add_option("--give-up", options->run.give_up_s,
                     "end when a device that stops all is silent for this long, s")
        ->check(positive_number())
        ->capture_default_str();
    command->add_option("--seed", options->run.seed, "what Client::seed() gives")->capture_default_str();
    command->add_option("--json", options->json, "write a summary as JSON to this file");
    command->add_flag("--twin", options->twin,
                      "join the run of --simulation, and move the twins of the real robots there");
    add_member_options(*command, options->member);
    command->callback([options, &exit_code] { exit_code = DeviceProcess(*options).go(); });
}

}  // namespace roboss
