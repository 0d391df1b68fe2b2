// Loads, runs, watches and ends one run. Everything that decides a result is in the roles; here are files,
// clock and terminal.
#include "app/run_command.h"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <set>
#include <thread>

#include "app/company.h"
#include "app/contacts_file.h"
#include "app/exit_codes.h"
#include "app/interrupt.h"
#include "app/orders_file.h"
#include "app/path_picture.h"
#include "app/progress.h"
#include "app/run_options.h"
#include "app/summary.h"
#include "app/trace_file.h"
#include "client/plugin.h"
#include "core/hash.h"
#include "sdf/load_world.h"
#include "simulation/simulation.h"

namespace roboss {
namespace {

constexpr double kPictureEvery_s = 0.25;
constexpr double kPaceEvery_s = 0.01;

void print(const Error& error) {
    fmt::print(stderr, "roboss: {}\n", error.text());
}

/// Warnings and errors in full, notes as a count: `roboss check` tells them all.
void print(const Diagnostics& diagnostics, const std::string& world) {
    for (const Diagnostic& d : diagnostics.items())
        if (d.severity != Severity::kNote) fmt::print(stderr, "{}\n", to_text(d));
    if (const std::size_t notes = diagnostics.count(Severity::kNote); notes > 0)
        fmt::print(stderr, "{} notes about this world: `roboss check {}` shows them\n", notes, world);
}

/// Something due each so many ticks; never if `every` is 0.
class Due {
  public:
    Due(double every_s, double dt_s, Tick start)
        : every_(every_s > 0 ? std::max<Tick>(1, tick_at(every_s, dt_s)) : 0), start_(start) {}
    Tick next(Tick now) const {
        return every_ == 0 ? std::numeric_limits<Tick>::max()
                           : start_ + ((now - start_) / every_ + 1) * every_;
    }
    bool at(Tick now) const { return every_ != 0 && (now - start_) % every_ == 0; }

  private:
    Tick every_, start_;
};

class Run {
  public:
    explicit Run(const RunOptions& options) : o_(options), progress_(!options.quiet) {}

    int go() {
        if (!prepare()) return kBadInput;
        const auto began = Clock::now();
        const bool fine = drive(began);
        tell_notices();
        progress_.clear();
        return finish(fine, std::chrono::duration<double>(Clock::now() - began).count());
    }

  private:
    using Clock = std::chrono::steady_clock;

    bool prepare() {
        Diagnostics diagnostics;
        const std::optional<World> world = load_world(o_.world, {o_.paths, o_.profile}, diagnostics);
        if (world && !diagnostics.has_errors()) model_ = compile(*world, compile_options(), diagnostics);
        if (world) world_speed_ = world->real_time_factor;
        std::vector<Order> orders;
        if (model_ && !o_.orders.empty()) orders = load_orders(o_.orders, *model_, diagnostics);
        print(diagnostics, o_.world);
        if (!model_ || diagnostics.has_errors()) return false;
        return create() && submit(orders) && open_files();
    }

    CompileOptions compile_options() const {
        CompileOptions options;
        options.dt_s = o_.dt_s;
        options.accuracy = o_.accuracy;
        if (o_.no_sleep) options.sleep = false;
        return options;
    }

    bool create() {
        std::optional<SavedRun> from;
        if (!o_.from.empty()) {
            Result<SavedRun> loaded = load_run(o_.from, *model_);
            if (!loaded) return print(loaded.error()), false;
            from = std::move(loaded.value());
        }
        std::vector<NamedProgram> programs;
        for (const std::string& path : o_.clients) {
            Result<std::unique_ptr<ControlProgram>> program = load_control_program(path);
            if (!program) return print(program.error()), false;
            programs.push_back({fmt::format("{}#{}", path, programs.size()), std::move(program.value())});
        }
        Result<std::unique_ptr<Company>> company = Company::gather(o_);
        if (!company) return print(company.error()), false;
        company_ = std::move(company.value());
        SimulationOptions options;
        options.simulators = static_cast<std::size_t>(o_.simulators);
        options.threads = static_cast<unsigned>(o_.threads);
        options.lanes = o_.lanes;
        options.world_file = o_.world;
        options.controller.seed = o_.seed;
        options.controller.window = o_.window == "auto" ? 0 : static_cast<Tick>(std::stod(o_.window));
        options.controller.forecast.merge_all = o_.merge_islands;
        company_->brief(options);
        auto simulation = Simulation::create(model_, options, std::move(programs), from ? &*from : nullptr,
                                             company_->take_bus());
        if (!simulation) return print(simulation.error()), false;
        simulation_ = std::move(simulation.value());
        start_ = simulation_->tick();
        return true;
    }

    /// Orders from before the start of a continued run have been applied already.
    bool submit(const std::vector<Order>& orders) {
        for (const Order& order : orders) {
            if (order.apply_at < start_) continue;
            const Result<> taken = simulation_->submit(order);
            if (!taken) return print(taken.error()), false;
        }
        return true;
    }

    bool open_files() {
        if (!o_.contacts.empty()) {
            Result<ContactsFile> contacts = ContactsFile::create(o_.contacts);
            if (!contacts) return print(contacts.error()), false;
            contacts_ = std::move(contacts.value());
        }
        if (o_.trace.empty()) return true;
        Result<TraceFile> trace = TraceFile::create(o_.trace);
        if (!trace) return print(trace.error()), false;
        trace_ = std::move(trace.value());
        return true;
    }

    /// True at the end of the duration or on Ctrl-C, false if the run failed.
    bool drive(Clock::time_point began) {
        const double dt = model_->dt_s;
        const Tick end =
            o_.duration_s ? start_ + tick_at(*o_.duration_s, dt) : std::numeric_limits<Tick>::max();
        const double speed = o_.speed == "max"     ? 0.0
                             : o_.speed == "world" ? world_speed_
                                                   : std::stod(o_.speed);
        const Due trace(trace_ ? (o_.trace_every_s > 0 ? o_.trace_every_s : dt) : 0.0, dt, start_);
        const Due contacts(contacts_ ? (o_.contacts_every_s > 0 ? o_.contacts_every_s : dt) : 0.0, dt,
                           start_);
        const Due hash(o_.hash_every_s, dt, start_);
        const Due picture(o_.paths_picture.empty() ? 0.0 : kPictureEvery_s, dt, start_);
        const Due pace(speed > 0 ? kPaceEvery_s * speed : 0.0, dt, start_);
        paths_.resize(model_->robots.size());
        watch_for_interrupts();
        for (Tick now = start_;; now = simulation_->tick()) {
            if (trace.at(now) && !write_trace()) return false;
            if (contacts.at(now) && !write_contacts()) return false;
            if (hash.at(now))
                fmt::print("{:.6f} s  {}\n", simulation_->time_s(), to_hex(simulation_->hash()));
            if (picture.at(now)) collect_paths();
            if (now >= end || interrupted()) return true;
            const Tick next = std::min({end, trace.next(now), contacts.next(now), hash.next(now),
                                        picture.next(now), pace.next(now)});
            Result<> looked_after = Ok{};
            const Result<> stepped = simulation_->run_until(next, [&] {
                progress_.show(*simulation_);
                tell_notices();
                looked_after = company_->look_after();
                return looked_after.ok() && !interrupted();
            });
            if (!looked_after) return abandoned_ = true, print(looked_after.error()), false;
            if (!stepped) return progress_.clear(), print(stepped.error()), false;
            if (speed > 0) {
                const double due_s = static_cast<double>(simulation_->tick() - start_) * dt / speed;
                std::this_thread::sleep_until(began + std::chrono::duration_cast<Clock::duration>(
                                                          std::chrono::duration<double>(due_s)));
            }
        }
    }

    void tell_notices() {
        for (const auto& notices : {simulation_->take_notices(), company_->take_notices()})
            for (const std::string& notice : notices)
                if (!o_.quiet) progress_.clear(), fmt::print(stderr, "roboss: {}\n", notice);
    }

    bool write_trace() {
        const Result<> written = trace_->write(*model_, simulation_->tick(), simulation_->states());
        if (!written) print(written.error());
        return written.ok();
    }

    bool write_contacts() {
        const Result<> written = contacts_->write(*model_, simulation_->tick(), simulation_->contacts());
        if (!written) print(written.error());
        return written.ok();
    }

    void collect_paths() {
        const std::vector<RobotState>& states = simulation_->states();
        for (std::size_t r = 0; r < paths_.size(); ++r) {
            paths_[r].robot = model_->robots[r].name;
            paths_[r].points_W.push_back(base_pose(states[r]).p);
        }
    }

    Summary summary(double wall_s) const {
        const Counters& c = simulation_->counters();
        const double ticks = std::max(1.0, static_cast<double>(c.ticks));
        Summary s;
        s.world = o_.world;
        s.robots = model_->robots.size();
        s.ticks = simulation_->tick() - start_;
        s.dt_s = model_->dt_s;
        s.sim_time_s = simulation_->time_s();
        s.wall_time_s = wall_s;
        s.real_time_factor = wall_s > 0 ? static_cast<double>(s.ticks) * s.dt_s / wall_s : 0.0;
        s.step_cpu_s = c.step_cpu_s;
        s.windows = c.windows;
        s.windows_repeated = c.windows_repeated;
        s.islands_mean = static_cast<double>(c.island_ticks) / ticks;
        s.contacts_mean = static_cast<double>(c.contacts) / ticks;
        s.building_contacts_mean = static_cast<double>(c.static_contacts) / ticks;
        s.model_hash = model_->hash;
        s.state_hash = simulation_->hash();
        s.losses = c.losses;
        s.recoveries = c.recoveries;
        s.migrations = c.migrations;
        s.simulators = c.simulators;
        return s;
    }

    /// Files and summary, also of a run that failed: nothing that was computed is lost.
    int finish(bool fine, double wall_s) {
        const Summary s = summary(wall_s);
        bool written = true;
        const auto check = [&](const Result<>& result) {
            if (!result) print(result.error()), written = false;
        };
        if (trace_) check(trace_->close());
        if (contacts_) check(contacts_->close());
        if (!o_.save.empty() && !abandoned_) check(simulation_->save(o_.save));
        if (!o_.json.empty()) check(write_json(s, o_.json));
        if (!o_.paths_picture.empty()) {
            const std::string subtitle =
                fmt::format("{} robots, {:.1f} s simulated, state hash {}", s.robots,
                            static_cast<double>(s.ticks) * s.dt_s, to_hex(s.state_hash));
            check(write_path_picture(o_.paths_picture, *model_, paths_, {model_->name, subtitle}));
        }
        simulation_->controller().dismiss(simulation_->bus(),
                                          fine ? "the run has ended" : "the run has failed");
        company_->see_off();
        fmt::print("{}", to_text(s));
        if (!fine || !written) return kRunFailed;
        return interrupted() ? kInterrupted : kDone;
    }

    const RunOptions& o_;
    Progress progress_;
    std::shared_ptr<const Model> model_;
    std::unique_ptr<Company> company_;
    std::unique_ptr<Simulation> simulation_;
    std::optional<TraceFile> trace_;
    std::optional<ContactsFile> contacts_;
    std::vector<RobotPath> paths_;
    double world_speed_ = 0;  // simulated seconds a real second; 0: as fast as possible
    Tick start_ = 0;
    bool abandoned_ = false;  // nobody is left who has the states
};

}  // namespace

void add_run_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("run", "simulate a world on this computer");
    auto options = std::make_shared<RunOptions>();
    add_run_options(*command, *options);
    command->callback([options, &exit_code] { exit_code = Run(*options).go(); });
}

void add_controller_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("controller", "run a world on Simulators that come from anywhere");
    auto options = std::make_shared<RunOptions>();
    add_controller_options(*command, *options);
    command->callback([options, &exit_code] { exit_code = Run(*options).go(); });
}

}  // namespace roboss
