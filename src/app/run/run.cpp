// How a run begins and how it ends.
#include "app/run/run.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <ctime>
#include <filesystem>
#include <random>

#include "app/commands/exit_codes.h"
#include "app/output/findings.h"
#include "app/output/say.h"
#include "app/processes/crash_report.h"
#include "app/processes/interrupt.h"
#include "app/processes/threads.h"
#include "app/run/run_outputs.h"
#include "app/worlds/bag_orders.h"
#include "app/worlds/examples.h"
#include "app/worlds/orders_file.h"
#include "app/worlds/world_census.h"
#include "bags/bag.h"
#include "client/plugin.h"
#include "client/triggers/triggers.h"
#include "core/float_env.h"
#include "core/hash.h"
#include "model/on_ground.h"
#include "physics/start_overlaps.h"
#include "scene/scene_codec.h"
#include "scene/scene_file.h"
#include "sdf/load_world.h"
#include "visuals/visual_source.h"

namespace roboss {
namespace {

/// Prints errors and warnings, those that are alike as one. Returns how many findings are not printed.
std::size_t print_groups(const Diagnostics& findings) {
    std::size_t unprinted = findings.count(Severity::kNote);
    for (const Severity severity : {Severity::kError, Severity::kWarning})
        for (const FindingGroup& group : group_findings(findings, severity)) {
            say(stderr, "{}\n", to_text(group));
            unprinted += group.more;
        }
    return unprinted;
}

/// Also prints notes about the start.
void print(const Diagnostics& diagnostics, const std::string& world) {
    std::size_t unprinted = print_groups(diagnostics);
    for (const FindingGroup& group : group_findings(diagnostics, Severity::kNote))
        if (is_told_by_run(*group.first)) {
            say(stderr, "{}\n", to_text(group));
            --unprinted;
        }
    if (unprinted > 0)
        say(stderr, "{} more {} about this world; `roboss check {} --all` prints {}\n", unprinted,
            unprinted == 1 ? "finding" : "findings", world, unprinted == 1 ? "it" : "them");
}

/// Prints what is wrong with the orders of a file. Returns false if anything is.
bool are_orders_right(const Diagnostics& findings, const std::string& file) {
    print_groups(findings);
    if (findings.has_errors())
        say(stderr, "roboss: the orders file {} is refused for the errors above; nothing was run\n", file);
    return !findings.has_errors();
}

bool has_cameras(const Model& model) {
    for (const RobotType& type : model.types)
        for (const SensorInfo& sensor : type.sensors)
            if (sensor.spec.kind().is_image) return true;
    return false;
}

/// Ids of an earlier, killed Controller of this run may still be in use by its Simulators.
std::uint32_t first_simulator_id() {
    constexpr int kSeatBits = 12;
    std::random_device device;
    return (device() >> 1) & ~((1u << kSeatBits) - 1);
}

}  // namespace

namespace {

/// Puts the files of an example in the place of its name.
Result<> take_example(RunOptions& o) {
    const Result<Example> example = find_example(o.world);
    if (!example) return example.error();
    o.world = example.value().world.string();
    if (o.orders.empty()) o.orders = example.value().orders.string();
    if (!o.clients.empty() || !o.clients_awaited.empty()) return Ok{};
    for (const ExampleProgram& program : example.value().programs) {
        if (program.library.empty())
            return Error{fmt::format("the control program {}.so of {} is not there", program.name, o.world),
                         fmt::format("build it (tools/build.sh release {}), or run {} without it",
                                     program.name, o.world),
                         "no-program"};
        o.clients.push_back(program.library.string());
    }
    return Ok{};
}

}  // namespace

int run(RunOptions options) {
    if (names_example(options.world))
        if (const Result<> taken = take_example(options); !taken) return print(taken.error()), kBadInput;
    if (options.ros2.wanted && !options.ros2.face.lockstep.empty())
        options.clients_awaited.push_back(options.ros2.face.name);
    return Run(options).go();
}

bool is_told_by_run(const Diagnostic& d) {
    return d.severity != Severity::kNote || d.code.starts_with("start-");
}

void print(const Error& error) {
    say(stderr, "roboss: {}\n", error.text());
}

int Run::go() {
    if (const Result<> fine = check_outputs(o_); !fine) return print(fine.error()), kBadInput;
    if (!o_.clients.empty()) report_crashes(o_.journal);
    if (!prepare()) return kBadInput;
    watch_for_interrupts();
    if (!begin()) return finish(false, 0);
    const auto began = Clock::now();
    const bool fine = drive();
    if (gateway_) gateway_->say_farewell(over(fine));
    report_notices();
    progress_.clear();
    return finish(fine, std::chrono::duration<double>(Clock::now() - began).count());
}

/// For pages and members: why the run is over.
RunOver Run::over(bool fine) const {
    if (!fine) return {failure_ ? failure_->text() : "its output says why", true};
    if (pace_.quit) return {"a request ended it"};
    if (interrupted()) return {"a signal ended it (Ctrl-C or kill)"};
    return {fmt::format("its duration was over at {:.3f} s", simulation_->time_s())};
}

bool Run::fail(const Error& why) {
    failure_ = why;
    print(why);
    return false;
}

bool Run::prepare() {
    if (!o_.replay.empty()) return prepare_replay();
    Diagnostics diagnostics;
    std::optional<World> world =
        load_world(o_.world, {o_.paths, o_.profile, is_shown(), o_.keyframe}, diagnostics);
    const auto refused = [&] { return o_.strict ? diagnostics.has_errors() : diagnostics.refuses(); };
    if (world)
        if (Result<> completed = complete(*world, o_.bare); !completed)
            return print(completed.error()), false;
    if (world) add_drives(o_, "", *world);
    if (world && !refused()) model_ = compile(*world, compile_options(), diagnostics);
    if (world) world_speed_ = world->real_time_factor;
    if (model_ && o_.on_ground) model_ = stood_on_ground(*model_, {world->file, 0}, diagnostics);
    if (model_ && o_.from.empty()) report_overlaps(*model_, &*world, diagnostics);
    Diagnostics order_findings;
    if (model_ && !o_.orders.empty()) read_orders(order_findings);
    print(diagnostics, o_.world);
    if (!model_ || refused()) {
        say(stderr, "roboss: {} is refused for the errors above{}\n", o_.world,
            o_.strict ? ", as --strict asks" : "; they concern the whole world or all its models");
        return false;
    }
    if (!are_orders_right(order_findings, o_.orders)) return false;
    if (Result<> found = check_snapshot(o_.snapshot, o_.viewer.page_folder, *model_); !found)
        return print(found.error()), false;
    if (Result<> found = check_sense(o_.sense, *model_); !found) return print(found.error()), false;
    world_model_ = model_;
    if (o_.dataset.wanted()) labels_ = label_world(*world, o_.dataset.labels);
    if (is_shown()) visuals_.begin(*model_, std::move(*world));
    Result<std::unique_ptr<RunJournal>> journal = RunJournal::open(o_, *model_);
    if (!journal) return print(journal.error()), false;
    journal_ = std::move(journal).value();
    if (journal_->changed_model()) {
        model_ = journal_->changed_model();
        if (!orders_.empty())
            notices_.push_back("the orders file is not read: its orders are in the journal already");
    }
    const bool reads_orders = model_ == world_model_;
    return create() && (!reads_orders || submit(orders_, start_)) && open_files();
}

void Run::read_orders(Diagnostics& findings) {
    if (!bags::is_bag(o_.orders)) {
        orders_ = load_orders(o_.orders, *model_, findings);
        return;
    }
    BagOrders bag = load_bag_orders(o_.orders, model_, findings);
    orders_ = std::move(bag.orders);
    notices_.push_back(bag.summary + " [bag]");
}

bool Run::prepare_replay() {
    Result<std::unique_ptr<RunJournal>> journal = RunJournal::open_replay(o_);
    if (!journal) return print(journal.error()), false;
    journal_ = std::move(journal).value();
    model_ = journal_->replay()->model;
    world_speed_ = 1;
    return create() && open_files();
}

CompileOptions Run::compile_options() const {
    CompileOptions options;
    options.dt_s = o_.dt_s;
    options.accuracy = o_.accuracy;
    if (o_.no_sleep) options.sleep = false;
    options.precision = o_.precision;
    return options;
}

bool Run::load_programs(const std::shared_ptr<const Model>& model, std::vector<NamedProgram>& programs) {
    for (const std::string& path : o_.clients) {
        Result<std::unique_ptr<ControlProgram>> program = load_control_program(path);
        if (!program) return print(program.error()), false;
        programs.push_back({fmt::format("{}#{}", path, programs.size()), std::move(program.value())});
    }
    if (!o_.replay.empty() || !has_message_board(*model)) return true;
    const auto told = [this](Tick tick, const std::string& text) {
        if (log_) log_->message(tick, text);
    };
    programs.push_back({Triggers::kName, std::make_unique<Triggers>(model, told)});
    return true;
}

bool Run::create() {
    std::vector<NamedProgram> programs;
    if (!load_programs(model_, programs)) return false;
    std::vector<std::string> names;
    names.reserve(programs.size());
    for (const NamedProgram& program : programs) names.push_back(program.name);
    names.insert(names.end(), o_.clients_awaited.begin(), o_.clients_awaited.end());
    const Result<std::vector<std::string>> others = journal_->awaited(names, o_.is_controller);
    if (!others) return print(others.error()), false;
    const auto prepared_ms =
        static_cast<std::int64_t>(1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC);
    Result<std::unique_ptr<RunMembers>> members = RunMembers::gather(o_, prepared_ms);
    if (!members) return print(members.error()), false;
    members_ = std::move(members.value());
    if (!open_gateway()) return false;
    if (!list()) return false;
    const SavedRun* from = journal_->from();
    SimulationOptions options = simulation_options(from);
    options.controller.log = journal_->resumed();
    options.controller.before.first_id = first_simulator_id();
    members_->configure(options);
    options.clients_awaited.insert(options.clients_awaited.end(), others.value().begin(),
                                   others.value().end());
    auto simulation = Simulation::create(model_, options, std::move(programs), from, members_->take_bus());
    if (!simulation) return print(simulation.error()), false;
    simulation_ = std::move(simulation.value());
    measure();
    start_ = journal_->start();
    return true;
}

bool Run::open_gateway() {
    if (o_.viewer.headless) return true;
    Result<std::unique_ptr<Gateway>> gateway =
        open_viewer(o_.viewer, !o_.journal.empty(), o_.network.insecure);
    if (!gateway) return print(gateway.error()), false;
    gateway_ = std::move(gateway).value();
    if (!o_.quiet) print_urls(*gateway_);
    return true;
}

bool Run::list() {
    if (takes_picture() || o_.dataset.wanted() || listing_) return true;
    const auto unlisted = [this](const Error& error) {
        if (error.code == "run-exists") return print(error), false;
        notices_.push_back(error.text());
        return true;
    };
    const Result<std::filesystem::path> folder = run_folder();
    if (!folder) return unlisted(folder.error());
    ListedRun run;
    run.pid = getpid();
    run.command = !o_.replay.empty() ? "replay" : o_.is_controller ? "controller" : "run";
    run.world = o_.replay.empty() ? o_.world : o_.replay;
    const bool named = o_.network.simulation != kDefaultSimulation;
    run.name =
        o_.is_controller || named ? o_.network.simulation : std::filesystem::path(run.world).stem().string();
    if (gateway_) run.viewer = gateway_->url();
    run.started = fmt::format("{:%FT%TZ}", fmt::gmtime(std::time(nullptr)));
    run.socket = folder.value() / fmt::format("{}.sock", run.pid);
    Result<std::unique_ptr<ControlSocket>> socket = ControlSocket::open(run.socket);
    if (!socket) return unlisted(socket.error());
    socket_ = std::move(socket).value();
    Result<RunListing> listing = RunListing::add(std::move(run), named && !o_.is_controller);
    if (!listing) return unlisted(listing.error());
    listing_.emplace(std::move(listing).value());
    return true;
}

SimulationOptions Run::simulation_options(const SavedRun* from) {
    SimulationOptions options;
    options.simulators = static_cast<std::size_t>(o_.simulators);
    options.threads = static_cast<unsigned>(threads_of_each(o_.threads, 1));
    options.lanes = o_.lanes;
    options.world_file = o_.world;
    options.controller.seed = o_.seed.value_or(from != nullptr ? from->seed : 0);
    options.controller.window = o_.window == "auto" ? 0 : static_cast<Tick>(std::stod(o_.window));
    options.controller.forecast.merge_all = o_.merge_islands;
    options.controller.log_ticks = journal_->log_ticks();
    options.visuals = [this](const Model& model) { return visual_world(model); };
    options.interrupted = interrupted;
    if (gateway_) options.observer = [gateway = gateway_.get()](Bus& bus) { gateway->advance(bus); };
    options.controller.visuals = [this](const Model& model) { return visual_bytes(model); };
    if (!is_shown()) return options;
    options.controller.scene = [this, seed = options.controller.seed](const Model& model) {
        return encode(scene_file(make_scene(model, visuals_.of(model)), model, seed));
    };
    return options;
}

/// What describes the looks of a Model. A run that is not shown has read no visuals: it reads the world file
/// again when the first camera asks.
Result<ModelVisuals::Worlds> Run::seen_worlds(const Model& model) {
    if (!is_shown() && world_model_ && !visuals_.begun()) {
        Diagnostics diagnostics;
        std::optional<World> world =
            load_world(o_.world, {o_.paths, o_.profile, true, o_.keyframe}, diagnostics);
        if (!world)
            return Error{"the world file " + o_.world + ", which has the visuals, cannot be read any more",
                         "put it back (`roboss check` says what is wrong with it)", "no-look"};
        visuals_.begin(*world_model_, *std::move(world));
    }
    return visuals_.worlds_of(model);
}

/// Whether the looks of robots that come are kept.
bool Run::keeps_looks(const Model& with_them) {
    if (is_shown() || visuals_.begun()) return true;
    return has_cameras(with_them) && seen_worlds(*model_).ok();
}

/// What cameras see, of programs in this process.
Result<std::shared_ptr<const render::VisualWorld>> Run::visual_world(const Model& model) {
    if (visual_world_ && visual_world_->model_hash == model.hash) return visual_world_;
    Result<ModelVisuals::Worlds> worlds = seen_worlds(model);
    if (!worlds) return worlds.error();
    Result<std::shared_ptr<const render::VisualWorld>> made = visuals_of(std::move(worlds).value())(model);
    if (made) visual_world_ = made.value();
    return made;
}

/// What cameras see, for Clients in other processes; no bytes: it is not known.
std::vector<std::uint8_t> Run::visual_bytes(const Model& model) {
    const Result<ModelVisuals::Worlds> worlds = seen_worlds(model);
    if (!worlds) return notices_.push_back(worlds.error().text()), std::vector<std::uint8_t>{};
    std::vector<const World*> seen;
    for (const auto& world : worlds.value()) seen.push_back(world.get());
    const ExactFloatScope exact;
    return encode_scene(make_scene(model, seen), model);
}

Result<> Run::restart(std::shared_ptr<const Model> model, const SavedRun& from, bool back) {
    std::vector<NamedProgram> programs;
    if (!load_programs(model, programs))
        return Error{"a control program cannot be loaded again", "see the messages above"};
    SimulationOptions options = simulation_options(&from);
    members_->configure(options);
    options.simulators_awaited = options.simulators > 0 ? 0 : 1;
    options.controller.before = simulation_->hand_over();
    options.controller.before.went_back = options.controller.before.went_back || back;
    options.clients_awaited = simulation_->clients_elsewhere();
    const bool reaches_others = members_->reaches_others();
    take_profile();
    simulation_->start_log(nullptr, 0);
    auto made = Simulation::create(model, options, std::move(programs), &from,
                                   reaches_others ? simulation_->release_bus() : nullptr);
    if (!made) return made.error();
    simulation_ = std::move(made).value();
    measure();
    model_ = std::move(model);
    return Ok{};
}

Result<> Run::start_again(std::shared_ptr<const Model> model, const SavedRun& from, const Turn& turn) {
    if (Result<> again = restart(std::move(model), from, turn.back); !again) return again;
    busy_until_ = from.logged_until;
    if (!advance_to(from.logged_until))
        return Error{"the run could not be restored at that time", "see the messages above"};
    if (turn.orders != nullptr && !submit(*turn.orders, from.tick))
        return Error{"the orders of the orders file cannot be given again", "see the messages above"};
    pace_.begin(simulation_->tick());  // so that the speed limit does not catch up with the time before
    if (!await_states(true)) return no_states();
    return journal_->begin_branch(*simulation_, turn.parent, turn.reason);
}

/// Orders from before the start of a continued run have been applied already.
bool Run::submit(const std::vector<Order>& orders, Tick start) {
    for (const Order& order : orders) {
        if (order.apply_at < start) continue;
        const Result<> taken = simulation_->submit(order);
        if (!taken) return print(taken.error()), false;
    }
    return true;
}

bool Run::open_files() {
    if (!o_.log.empty()) {
        Result<EventLog> log = EventLog::open(o_.log, o_.log_every_s);
        if (!log) return print(log.error()), false;
        log_ = std::move(log.value());
    }
    if (!o_.contacts.empty()) {
        Result<ContactsFile> contacts = ContactsFile::create(o_.contacts);
        if (!contacts) return print(contacts.error()), false;
        contacts_ = std::move(contacts.value());
    }
    if (o_.dataset.wanted() && !open_dataset()) return false;
    if (o_.trace.empty()) return true;
    Result<TraceFile> trace = TraceFile::create(o_.trace);
    if (!trace) return print(trace.error()), false;
    trace_ = std::move(trace.value());
    return true;
}

bool Run::open_dataset() {
    DatasetRun run{model_,
                   o_.world,
                   simulation_->seed(),
                   static_cast<unsigned>(threads_of_each(o_.threads, 1)),
                   [this](const Model& model) { return visual_world(model); },
                   labels_};
    Result<std::unique_ptr<Dataset>> dataset = Dataset::create(o_.dataset, std::move(run));
    if (!dataset) return print(dataset.error()), false;
    dataset_ = std::move(dataset).value();
    return true;
}

/// From the checkpoint to where the run starts, and the journal's new branch there.
bool Run::begin() {
    busy_until_ = start_;
    if (start_ > simulation_->tick() && !advance_to(start_)) return false;
    if (interrupted()) return true;
    if (!await_states(false)) return !abandoned_ && (interrupted() || advance_to(simulation_->tick()));
    const Result<> begun = journal_->begin(*simulation_);
    if (!begun) return print(begun.error()), false;
    if (!o_.from.empty()) last_save_ = Kept{model_, saved_run(), journal_->branch()};
    return true;
}

SavedRun Run::saved_run() const {
    SavedRun run = simulation_->saved_run();
    const std::uint64_t world = world_model_ ? world_model_->hash : journal_->world_hash();
    run.world_hash = world == model_->hash ? 0 : world;
    return run;
}

/// A table or the summary as JSON: what is for people goes to standard error then.
bool Run::writes_to_standard_output() const {
    return o_.json == kStandardOutput || o_.trace == kStandardOutput || o_.contacts == kStandardOutput;
}

Summary Run::summary(double wall_s) const {
    const Counters& c = simulation_->counters();
    const double ticks = std::max(1.0, static_cast<double>(c.ticks));
    Summary s;
    s.world = journal_->replay() ? journal_->replay()->branch.world_file : o_.world;
    s.robots = count_robots(*model_);
    s.ticks = std::max<Tick>(simulation_->tick() - start_, 0);
    s.dt_s = model_->dt_s;
    s.sim_time_s = simulation_->time_s();
    s.wall_time_s = wall_s;
    s.paused_time_s = std::min(wall_s, std::chrono::duration<double>(rested_).count());
    const double running_s = wall_s - s.paused_time_s;
    s.real_time_factor = running_s > 0 ? static_cast<double>(s.ticks) * s.dt_s / running_s : 0.0;
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
    s.cuts = c.cuts;
    s.simulators = c.simulators;
    if (o_.profile_steps) s.profile = profile_;
    s.friction_tolerance = model_->accuracy.friction_tolerance;
    if (journal_->replay()) s.replayed = {journal_->compared(), journal_->differs()};
    if (journal_->writes()) s.journal = journal_->file(), s.journal_bytes = journal_->bytes();
    return s;
}

Result<> Run::save_end() {
    if (!await_states(false))
        return Error{"the state at the end is not saved: the Simulators that have it are gone",
                     "continue from the last checkpoint of a --journal", "no-states"};
    return save_run(o_.save, *model_, saved_run());
}

/// Writes files and summary, also of a failed run: nothing that was computed is lost.
int Run::finish(bool fine, double wall_s) {
    bool written = true;
    const auto check = [&](const Result<>& result) {
        if (!result) print(result.error()), written = false;
    };
    if (trace_) check(trace_->close());
    if (contacts_) check(contacts_->close());
    if (dataset_) {
        check(dataset_->close());
        say(stderr, "wrote {}\n", dataset_->summary());
    }
    if (!o_.save.empty() && !abandoned_) check(save_end());
    check(journal_->close());
    take_profile();
    const Summary s = summary(wall_s);  // the journal has its last size
    if (!o_.json.empty()) check(write_json(s, o_.json));
    if (!o_.paths_picture.empty()) {
        const std::string subtitle = fmt::format("{} robots, {:.1f} s simulated, state hash {}", s.robots,
                                                 static_cast<double>(s.ticks) * s.dt_s, to_hex(s.state_hash));
        check(write_path_picture(o_.paths_picture, *model_, paths_, {model_->name, subtitle}));
    }
    if (log_) {
        log_->write_state(*simulation_);
        log_->end(simulation_->tick(), fine ? "done" : "failed");
    }
    simulation_->dismiss(over(fine));
    members_->end(over(fine), abandoned_);
    say(writes_to_standard_output() ? stderr : stdout, "{}", to_text(s));
    if (abandoned_) return kProcessesFailed;
    if (!fine && failure_ && failure_->code == "journal-damaged") return kBadInput;  // wherever it is met
    if (!fine || !written) return kRunFailed;
    return interrupted() ? kInterrupted : kSuccess;
}

}  // namespace roboss
