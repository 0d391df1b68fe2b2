// The Controller role (the paper's section 3): plans windows, validates their results, commits, gives orders
// their ticks, serves observations, and restores the states that a lost Simulator held. It steps nothing. The
// committed tick, the robots' hashes there, the last checkpoint and the order log define the run; everything
// else can be requested again.
//
// The parts, each a class of its own: Roster (Simulators), ClientService, ViewService, ModelServer,
// ControlService, OrderLog and Recorder (what came in), StateDirectory (who has which state), CostModel and
// WindowPlanner (who steps what), Round (a window in progress), Checkpoints and Recovery (losses). The
// Controller decides when each acts.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bus/bus.h"
#include "roles/controller/checkpoints.h"
#include "roles/controller/client_service.h"
#include "roles/controller/control_service.h"
#include "roles/controller/controller_options.h"
#include "roles/controller/cost_model.h"
#include "roles/controller/model_server.h"
#include "roles/controller/order_log.h"
#include "roles/controller/recorder.h"
#include "roles/controller/recovery.h"
#include "roles/controller/roster.h"
#include "roles/controller/round.h"
#include "roles/controller/run_notices.h"
#include "roles/controller/state_directory.h"
#include "roles/controller/view_service.h"
#include "roles/controller/window_planner.h"

namespace roboss {

/// What a Controller is doing. Only kStepping and kRecovering have a Round in progress.
///
///     kWaiting ----> kIdle <----> kStepping      a window is stepped, until it is committed or discarded
///                      |  <-----> kRecovering    lost states are stepped again, leg by leg
///                      |  <-----> kReleasing     Simulators leave once the Controller has their states
///                      \--------> kFailed        for good
///
/// A loss ends kStepping and kRecovering at once. A failure (failure()) that is found in another phase is
/// followed by kFailed at the next window boundary; tick() and the states are those before it.
enum class Phase {
    kWaiting,     // for the Simulators and Clients of the first window
    kIdle,        // between windows: at the target, or until Clients reply or Simulators join
    kStepping,    // a window
    kRecovering,  // a leg of a recovery
    kReleasing,   // waits for the states of leaving Simulators, or until nobody needs earlier ones
    kFailed,
};
const char* name_of(Phase phase);

class Controller {
  public:
    Controller(std::shared_ptr<const Model> model, const ControllerOptions& options, StartingPoint start);
    Controller(const Controller&) = delete;
    Controller& operator=(const Controller&) = delete;

    /// Handles the messages received and starts what is due. Never waits.
    void advance(Bus& bus);

    /// The world advances to this tick and stops there. A target before tick() pauses at the next window
    /// boundary.
    void run_until(Tick target) { target_ = target; }
    Tick target() const { return target_; }
    Tick tick() const { return directory_.tick(); }  // committed
    /// All members for whom the first window waits have joined.
    bool started() const { return phase_ != Phase::kWaiting; }
    Phase phase() const { return phase_; }
    /// At the target with no window in progress.
    bool resting() const { return tick() >= target_ && !round_ && started(); }
    /// Resting, and every synchronous Client has replied to all observations before tick(): the run can be
    /// saved.
    bool settled() const;
    /// Failed, with no window in progress.
    bool stopped() const { return failure() && !round_; }
    /// If set, the run cannot continue; tick() and states are those before the failure.
    const std::optional<Error>& failure() const { return notices_.failure(); }

    /// The window in progress is not committed, and no other begins: the world stays at tick(). States that a
    /// loss took are brought back first.
    void abandon_window();

    /// Sends `over` to everybody; nobody answers after that.
    void dismiss(Bus& bus, const RunOver& over);

    /// The 64-bit hash of the world at tick().
    std::uint64_t hash() const { return world_hash(model_->hash, hashes_); }
    std::uint64_t robot_hash(RobotId robot) const { return hashes_[robot.index()]; }
    /// Fetches all states at tick(); only while resting (or failed). Then states() has them after some
    /// advances.
    void request_states() { checkpoints_.request(); }
    const std::vector<RobotState>* states() const { return checkpoints_.states_at(tick()); }

    /// An order with a given tick, `apply_at` >= tick().
    Result<> submit(const Order& order);
    /// Orders that a run saved at tick() takes along.
    std::vector<LoggedOrder> pending_orders() { return order_log_.pending(tick()); }
    /// Names of all Clients that ever joined, by ClientId.
    std::vector<std::string> client_names() const { return clients_.names(); }
    /// Names of those that are here or expected, without observers.
    std::vector<std::string> clients_serving() const { return clients_.names_serving(); }

    /// Tick of the checkpoint for the log that is being fetched. The caller adds the memory of its control
    /// programs.
    std::optional<Tick> log_tick() const { return recorder_.checkpoint_tick(); }
    /// That checkpoint once it is complete, without the Clients' memory. It is handed out once.
    std::optional<RunCheckpoint> take_log_checkpoint() { return recorder_.take_checkpoint(); }
    /// The next commit waits for the log.
    bool waits_for_log() const;
    /// The members for whom the world waits now, in words; empty: none.
    std::string waits_for() const;
    std::uint64_t log_needed() const { return recorder_.needed(); }
    /// Logs to `log` from now on, beginning with the orders still to be applied. Only between windows. Null:
    /// ends logging.
    void start_log(RunLog* log, Tick log_ticks);

    /// What the succeeding Controller has to know.
    ControllerOptions::Before hand_over();
    /// Requests to the run: pause, rewind ...
    ControlService& control() { return control_; }
    /// Whether Simulators measure their steps from the next window on. Costs them some per cent.
    void measure(bool wanted) { measures_ = wanted; }
    /// Of all windows measured since the last call, summed over Simulators.
    StepProfile take_profile() { return std::exchange(profile_, {}); }
    /// Length of the next windows; 0: adaptive.
    void set_window(Tick ticks) { planner_.set_length(ticks); }
    /// Makes the Simulator with the highest number leave. False: there is only one.
    bool dismiss_simulator();

    const Counters& counters() const { return counters_; }
    /// What happened since the last call: losses, refusals, joins. One line each.
    std::vector<std::string> take_notices() { return notices_.take(); }
    /// Seat of the Simulator that holds the robot; for display.
    std::uint32_t seat_of(RobotId robot) const { return directory_.holder_of(robot); }
    const Islands& islands() const { return islands_; }
    /// All Simulators that hold or held a seat.
    std::vector<MemberReport> members() const;
    /// Load balance of the stepping in recent windows: 1 is perfect. The cost of messages is not included.
    double balance() const { return roster_.balance(); }
    /// Each robot's motion in the last window, by RobotId.
    std::span<const RobotMotion> motions() const { return planner_.motions(); }
    Tick window_ticks() const { return planner_.length(); }

  private:
    void enter(Phase phase);
    void check_phase() const;
    bool rests_for_long(std::int64_t now_ms);

    // Messages in.
    void handle(Bus& bus, Envelope& envelope);
    void take_hello(Bus& bus, const Address& from, const Hello& hello);
    void take_leave(Bus& bus, const Address& from, const LeaveRequest& request);
    void take_request(Bus& bus, const Address& from, const ControlRequest& request, const Rights* rights);
    void take_result(SeatId seat_id, const WindowResult& result);

    // controller_window.cpp: a window, from plan to commit
    void at_boundary(Bus& bus);
    bool may_start_window() const;
    void start_window();
    WindowLimits limits_of_window(Tick from, bool all_answered) const;
    void send_assignments(Bus& bus);
    void add_costs(const Round::Answered& answered, const WindowResult& result);
    void finish_round();
    bool repeat_touched();
    void commit();
    void count_window();
    const IslandResult* first_failure() const;
    void end_before(const IslandResult& failure);
    void discard_window();
    std::string part_of(RobotId robot, JointId joint) const;
    /// The end of the window in progress, or else the committed tick.
    Tick scheduled_until() const { return phase_ == Phase::kStepping ? round_->span().until : tick(); }

    // controller_members.cpp: losses, leaving, checkpoints
    void notice_losses(Bus& bus);
    void give_up(SeatId seat_id, const std::string& why);
    bool release_leaving_members(Bus& bus);
    void begin_recovery();
    void finish_leg();
    bool checkpoint_due() const;
    void begin_log_checkpoint();
    void advance_checkpoint(Bus& bus);
    void finish_checkpoint();
    void send_heartbeats(Bus& bus);

    std::shared_ptr<const Model> model_;
    ControllerOptions options_;
    Phase phase_ = Phase::kWaiting;
    RunNotices notices_;
    Counters counters_;

    ModelServer model_server_;
    ControlService control_;
    Roster roster_;
    OrderLog order_log_;
    Recorder recorder_;
    StateDirectory directory_;  // and the committed tick
    ClientService clients_;
    ViewService views_;

    CostModel costs_;
    Checkpoints checkpoints_;
    Recovery recovery_;
    WindowPlanner planner_;

    Tick target_ = 0;
    std::vector<std::uint64_t> hashes_, next_hashes_;  // by RobotId: committed; of the round
    Islands islands_;                                  // of the last window committed
    std::optional<Round> round_;                       // in progress
    Tick rest_tick_ = -1;                              // at which it rests
    std::int64_t rest_since_ms_ = 0;
    std::uint32_t epoch_ = 0;
    std::uint64_t window_ = 0;
    bool measures_ = false;
    StepProfile profile_;
    std::int64_t heartbeat_sent_ms_ = 0;
    std::vector<Envelope> inbox_;
};

}  // namespace roboss
