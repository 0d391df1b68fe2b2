// Run: loads, runs, watches and ends one run. Everything that decides a result is in the roles; here are
// files, clock and terminal.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>

#include "app/dataset/dataset.h"
#include "app/local/control_socket.h"
#include "app/local/run_list.h"
#include "app/output/contacts_file.h"
#include "app/output/event_log.h"
#include "app/output/path_picture.h"
#include "app/output/progress.h"
#include "app/output/summary.h"
#include "app/output/trace_file.h"
#include "app/run/journal_preview.h"
#include "app/run/profile_meter.h"
#include "app/run/removed_robots.h"
#include "app/run/run_journal.h"
#include "app/run/run_members.h"
#include "app/run/run_options.h"
#include "app/run/traffic_meter.h"
#include "app/viewer/model_visuals.h"
#include "app/viewer/viewer.h"
#include "model/edit.h"
#include "simulation/simulation.h"

namespace roboss {

/// Runs the world of `options`; of an example (example:NAME) with its programs and orders, where the options
/// name no others. Returns the exit code.
int run(RunOptions options);

class Run {
  public:
    explicit Run(const RunOptions& options) : o_(options), progress_(options.shows_progress()) {}
    /// The exit code.
    int go();

  private:
    using Clock = std::chrono::steady_clock;
    struct Schedule;  // when files and pictures are due

    // run.cpp: the beginning and the end
    bool prepare();
    void read_orders(Diagnostics& findings);  // an orders file or a bag
    bool prepare_replay();
    CompileOptions compile_options() const;
    bool create();
    /// Those that the user named, and what the world brings along.
    bool load_programs(const std::shared_ptr<const Model>& model, std::vector<NamedProgram>& programs);
    bool submit(const std::vector<Order>& orders, Tick start);
    bool open_files();
    bool open_dataset();
    bool begin();
    /// The same run with another Model or from another time: a new Simulation on the same Bus, a new branch.
    struct Turn {
        BranchId parent = 0;
        std::string reason;
        bool back = false;                           // in time
        const std::vector<Order>* orders = nullptr;  // besides those of `from`; null: none
    };
    Result<> restart(std::shared_ptr<const Model> model, const SavedRun& from, bool back);
    Result<> start_again(std::shared_ptr<const Model> model, const SavedRun& from, const Turn& turn);
    SimulationOptions simulation_options(const SavedRun* from);
    bool open_gateway();
    /// Lists the run for `roboss control`; if that fails, a notice says so. False: its name is taken.
    bool list();
    /// Here, or by `roboss view` elsewhere.
    bool is_shown() const {
        return !o_.viewer.headless || o_.is_controller || o_.sense.wanted() || o_.dataset.wanted() ||
               o_.shows_nodes();
    }
    bool keeps_looks(const Model& with_them);
    Result<ModelVisuals::Worlds> seen_worlds(const Model& model);
    Result<std::shared_ptr<const render::VisualWorld>> visual_world(const Model& model);
    std::vector<std::uint8_t> visual_bytes(const Model& model);
    /// The present state, with the world that it comes from.
    SavedRun saved_run() const;
    bool takes_picture() const { return !o_.snapshot.file.empty() || o_.sense.wanted(); }
    bool writes_to_standard_output() const;
    Summary summary(double wall_s) const;
    Result<> save_end();
    int finish(bool fine, double wall_s);

    // run_loop.cpp: the time between
    bool drive();
    RunOver over(bool fine) const;
    bool go_on();
    bool look(const Schedule& due);
    bool rest();
    /// At the end of the duration: whether the run stays, paused, for inspection.
    bool stays();
    bool take_picture();
    Tick end_of_run() const;
    Tick last_tick() const;

    // run_control.cpp: requests to the run (wire/control.h). An Error refuses one; nothing has changed then.
    using Done = Result<std::string>;  // what was done, for people
    /// Those that came; previews go to their own thread at once.
    void take_requests();
    void take(Address asker, ControlAction action, std::function<void(ControlOutcome)> answer);
    void serve_requests();
    void answer_previews();
    ControlOutcome execute(const ControlAction& action);
    Done act(const PauseRun&);
    Done act(const ResumeRun&);
    Done act(const StepRun& step);
    Done act(const SetSpeed& speed);
    Done act(const SetWindow& window);
    Done act(const AddSimulator&);
    Done act(const RemoveSimulator&);
    Done act(const KillSimulator& kill);
    Done act(const SaveRun& save);
    Done act(const QuitRun&);
    Done act(const RewindRun& rewind);
    Done act(const ChangeAccuracy& change);
    Done act(const AddModels& add);
    Done act(const RemoveRobots& remove);
    Done act(const ResetRun& reset);
    Done reset_to_save();
    Done act(const AddBookmark& add);
    Done act(const RemoveBookmark& remove);
    /// In a replay.
    Done seek(const RewindRun& to);
    Done act(const CopyRobots& copy);
    Done act(const RestoreRobots& restore);
    std::vector<std::string> findings_of(const ModelEdit& edit, Diagnostics found) const;
    /// `arrived`: the states of the last robots of the new Model, instead of their initial ones.
    Done change_model(const ModelEdit& edit, const std::string& what,
                      std::span<const RobotState> arrived = {});
    // run_status.cpp: what only asks
    RunStatus status(bool with_robots) const;
    RobotGroups groups() const;
    RobotBounds bounds() const;
    RunProfile profile();
    /// Steps are measured for the summary, or while somebody asks.
    void measure();
    void take_profile();

    bool advance_to(Tick target);
    /// Waits for the states at this tick. False: no Simulator has them, 10 s after the run was interrupted or
    /// failed (with `request`: after the call), or no process is left that could bring them back.
    bool await_states(bool request);
    static Error no_states();
    void report_notices();
    void stop(const Error& why);
    /// Prints why the run cannot continue, and keeps it for pages and members. Returns false.
    bool fail(const Error& why);
    void show_progress();
    bool write_trace();
    bool write_contacts();
    bool write_dataset();
    void collect_paths();

    const RunOptions& o_;
    Progress progress_;
    std::string doing_;  // besides stepping, for the progress line
    std::shared_ptr<const Model> model_;
    std::shared_ptr<const Model>
        world_model_;        // of the world file, to which a reset returns; null: of a replay
    ModelVisuals visuals_;   // for the viewer; none: of a replay
    RemovedRobots removed_;  // that may be brought back
    std::shared_ptr<const render::VisualWorld> visual_world_;  // of the first camera that was read
    std::unique_ptr<Gateway> gateway_;                         // none: headless
    std::unique_ptr<ControlSocket> socket_;
    std::optional<RunListing> listing_;
    /// To which `reset save` returns.
    struct Kept {
        std::shared_ptr<const Model> model;
        SavedRun run;
        BranchId branch = 0;  // of the journal, that has this state; 0: there is none
    };
    std::optional<Kept> last_save_;
    std::vector<Order> orders_;  // of the orders file
    std::unique_ptr<RunJournal> journal_;
    std::unique_ptr<JournalPreview> preview_;  // made by the first request
    std::unique_ptr<RunMembers> members_;
    std::unique_ptr<Simulation> simulation_;
    std::optional<TraceFile> trace_;
    std::optional<ContactsFile> contacts_;
    std::optional<EventLog> log_;
    LabelNames labels_;                 // of what cameras see, for a data set
    std::unique_ptr<Dataset> dataset_;  // null: none is recorded
    std::vector<RobotPath> paths_;
    double world_speed_ = 0;  // simulated seconds per real second; 0: as fast as possible
    Tick start_ = 0;
    /// How fast, and whether at all. No part of the state.
    struct Pace {
        double speed = 0;  // simulated seconds per real second; 0: as fast as possible
        bool paused = false, quit = false;
        std::optional<Tick> step_until;  // and pauses there
        Tick from = 0;                   // since `since`
        Clock::time_point since;
        void begin(Tick tick) { from = tick, since = Clock::now(); }
        void resume(Tick tick) {
            paused = false, step_until.reset();
            begin(tick);
        }
    } pace_;
    bool over_ =
        false;  // the duration is over; the run stays, until a page or `roboss control` continues or ends it
    Clock::time_point last_page_;  // when it was last seen by a page since then
    Clock::duration rested_{};     // wall time in which the run was paused
    TrafficMeter traffic_;
    StepProfile profile_;  // of all steps that were measured
    ProfileMeter meter_;   // of the last second, for who asks
    /// A request and who waits for its outcome.
    struct Request {
        ControlAction action;
        std::function<void(ControlOutcome)> answer;
    };
    std::vector<Request> requests_;    // to be served
    std::uint64_t socket_askers_ = 0;  // for names of those who ask over the socket
    std::vector<std::string> notices_;
    std::optional<Error> failure_;  // why the run cannot continue
    Tick busy_until_ = 0;           // to which requests wait: the run is being brought to its start
    bool abandoned_ =
        false;  // Simulator processes of this run failed: no process is left that has the states
};

/// True if a run prints the finding: all but notes, and notes about where robots start ("start-moved" ...).
bool is_told_by_run(const Diagnostic& diagnostic);
void print(const Error& error);

}  // namespace roboss
