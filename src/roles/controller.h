// The Controller role (the paper's section 3): plans windows, validates their results, commits, gives orders
// their ticks, serves observations, and restores the states that a lost Simulator held. It steps nothing. The
// committed tick, the robots' hashes there, the last checkpoint and the order log define the run; everything
// else can be requested again.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bus/bus.h"
#include "journal/run_log.h"
#include "roles/checkpoints.h"
#include "roles/client_service.h"
#include "roles/control_service.h"
#include "roles/cost_model.h"
#include "roles/model_server.h"
#include "roles/order_feed.h"
#include "roles/order_log.h"
#include "roles/recorder.h"
#include "roles/recovery.h"
#include "roles/roster.h"
#include "roles/round.h"
#include "roles/run_notices.h"
#include "roles/state_directory.h"
#include "roles/view_service.h"
#include "schedule/forecast.h"
#include "schedule/touch_watch.h"
#include "schedule/window_length.h"

namespace roboss {

struct ControllerOptions {
    Tick window = 0;      // ticks; 0: adaptive
    Tick window_max = 0;  // limit of the adaptive length; 0: by the robots per worker (longest_window)
    ForecastOptions forecast;
    std::size_t simulators = 1;        // the first window waits for this many
    std::vector<std::string> clients;  // and for these Clients; their ids are their indices here
    std::uint64_t seed = 1;            // sent to Clients
    std::int64_t resend_ms = 100;
    std::size_t ahead_least = 500;  // orders of the next window that are worth sending ahead of it
    /// Work stealing only in windows with at least this much work per Simulator.
    double stealing_least_ns = 500'000;
    std::int64_t heartbeat_ms = 250;  // heartbeat interval
    std::int64_t loss_ms = 0;         // a Simulator silent for so long is considered lost; 0: never
    std::int64_t client_loss_ms = 0;  // so is a Client that does not reply to an observation; 0: never
    std::int64_t client_gone_ms = 0;  // and a Client that the Bus reports as vanished for so long; 0: never
    Tick checkpoint_ticks = 0;        // between recovery checkpoints, at most; 0: none by ticks
    double checkpoint_work_s =
        0;  // stepping CPU time of the busiest Simulator between two of them; 0: none by work
    /// State of the Controller that this one succeeds on the same Bus (after a rewind, say).
    struct Before {
        std::size_t seats = 0;  // never used again
        /// Id of the first Simulator; a process of its own takes one that no other had.
        std::uint32_t first_id = 0;
        std::uint32_t epoch = 0;
        std::uint64_t window = 0;
        std::vector<std::uint64_t> models;  // hashes of earlier Models of the run
        bool went_back = false;             // a rewind: Clients may have seen ticks that were discarded
        ControlService control;
    } before;
    /// Makes the scene, in bytes for viewers; called when the first viewer requests it.
    ModelServer::SceneOf scene;
    RunLog* log = nullptr;  // outlives the Controller; null: nothing is logged
    Tick log_ticks = 0;     // checkpoints for the log at multiples of so many ticks; 0: none
};

/// Where a run starts: the world's beginning, a saved run, or a journal.
struct StartingPoint {
    Tick tick = 0;
    std::vector<RobotState> states;   // by RobotId
    std::vector<LoggedOrder> orders;  // still to be applied
    /// Up to here the run follows `orders`: no new order gets an earlier tick.
    Tick logged_until = 0;
    /// By ClientId: replies to observations up to this one are in `orders` already and are not accepted
    /// again.
    std::vector<Tick> answered;
};
StartingPoint beginning_of(const Model& model);

struct Counters {
    std::uint64_t windows = 0;           // committed
    std::uint64_t windows_repeated = 0;  // of these, with islands merged and stepped again
    std::uint64_t robots_repeated = 0;   // robots stepped again, summed over attempts
    std::uint64_t islands = 0;           // summed over windows
    std::uint64_t ticks = 0;             // committed by this run
    std::uint64_t island_ticks = 0;      // islands times ticks: islands_mean = island_ticks / ticks
    std::uint64_t contacts = 0, static_contacts = 0;  // summed over ticks
    double step_cpu_s = 0;                            // all stepping, repeats included
    double critical_cpu_s = 0;   // of the busiest Simulator of each attempt: a lower bound for many machines
    std::uint64_t silences = 0;  // of the losses, those noticed by silence alone
    std::uint64_t losses = 0, recoveries = 0, migrations = 0, checkpoints = 0, orders_refused = 0;
    std::uint64_t orders_ahead = 0;  // sent ahead of the assignment of their window
    std::uint64_t cuts = 0;          // late assignments of which others took a part (work stealing)
    std::size_t simulators = 0, islands_now = 0;
};

/// A Simulator for status reports. Loads and times are running means over windows.
struct MemberReport {
    std::uint32_t number = 0;  // in the order of joining, from 0
    std::string name;
    std::uint32_t threads = 1;
    bool alive = false, leaving = false;  // both false: lost; leaving and not alive: it has left
    std::size_t robots = 0, islands = 0;  // that it has now
    double step_us = 0;                   // stepping CPU time per tick and thread
    double load = 0;                      // the same, relative to the busiest
    Address address;
};

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
    bool started() const { return started_; }
    /// At the target with no window in progress.
    bool resting() const { return tick() >= target_ && !round_ && started_; }
    /// Resting, and every synchronous Client has replied to all observations before tick(): the run can be
    /// saved.
    bool settled() const;
    /// Failed, with no window in progress.
    bool stopped() const { return failure() && !round_; }
    /// If set, the run cannot continue; tick() and states are those before the failure.
    const std::optional<Error>& failure() const { return notices_.failure(); }

    /// Tells everybody that the run is over; nobody answers after that.
    void dismiss(Bus& bus, const std::string& reason);

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
    std::vector<std::string> client_names() const;
    /// Names of those that are here, without observers.
    std::vector<std::string> clients_serving() const;

    /// Tick of the checkpoint for the log that is being fetched. The caller adds the memory of its control
    /// programs.
    std::optional<Tick> log_tick() const { return recorder_.checkpoint_tick(); }
    /// That checkpoint once it is complete, without the Clients' memory. It is handed out once.
    std::optional<RunCheckpoint> take_log_checkpoint() { return recorder_.take_checkpoint(); }
    /// The next commit waits for the log.
    bool waits_for_log() const;
    std::uint64_t log_needed() const { return recorder_.needed(); }
    /// Logs to `log` from now on, beginning with the orders still to be applied. Only between windows. Null:
    /// ends logging.
    void start_log(RunLog* log, Tick log_ticks);

    /// What the succeeding Controller has to know.
    ControllerOptions::Before hand_over();
    /// Requests to the run: pause, rewind ...
    ControlService& control() { return control_; }
    /// Length of the next windows; 0: adaptive.
    void set_window(Tick ticks);
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
    std::span<const RobotMotion> motions() const { return motions_; }
    Tick window_ticks() const { return length_.ticks(); }

  private:
    // controller.cpp: messages in
    void handle(Bus& bus, Envelope& envelope);
    void take_hello(Bus& bus, const Address& from, const Hello& hello);
    void take_leave(Bus& bus, const Address& from, const LeaveRequest& request);
    /// The seat of the Simulator that is alive at this address.
    std::optional<SeatId> heard_from(Bus& bus, const Address& from);
    /// The seat of this id. A sender that is not alive there gets Expelled or Goodbye.
    std::optional<SeatId> heard_from(Bus& bus, const Address& from, SimulatorId id);

    // controller_clients.cpp
    void take_client_hello(Bus& bus, const Address& from, const ClientHello& hello);
    void take_reply(Bus& bus, const Address& from, const ClientReply& reply);
    void take_orders(ClientSeat& seat, const ClientReply& reply);
    void take_bye(Bus& bus, const Address& from, const ClientBye& bye);
    void queue_observations();
    void queue_observation(ClientId id, Tick tick);
    void drop_client(ClientId id);
    void notice_client_losses(Bus& bus);
    bool stays_away(const ClientSeat& seat, std::int64_t now_ms) const;
    void send_observations(Bus& bus, bool again_now);
    void acknowledge(Bus& bus);
    Tick scheduled_until() const {
        return round_ && !round_->span().recovery ? round_->span().until : tick();
    }
    /// The first tick at which a new order can apply.
    Tick stampable() const { return std::max(scheduled_until(), recorder_.logged_until()); }

    // controller_window.cpp
    void at_boundary(Bus& bus);
    bool may_start_window() const;
    void start_window();
    void keep_wanted(Round& round) const;
    Tick window_end(Tick from, Tick length, bool all_answered = false) const;
    Tick window_max() const;
    void look_ahead();
    double largest_share() const;
    void send_assignments(Bus& bus);
    void take_result(SeatId seat_id, const WindowResult& result);
    void take_cut(const Round::Answered& answered, const WindowResult& result);
    void take_costs(const Round::Answered& answered, const WindowResult& result);
    void finish_round();
    bool merge_touching();
    void commit();
    const IslandResult* first_failure() const;
    void end_before(const IslandResult& failure);
    void drop_round();
    std::string part_of(RobotId robot, JointId joint) const;

    // controller_recovery.cpp: checkpoints, leaving, losses
    void notice_losses(Bus& bus);
    void take_vanished(const Address& address, std::int64_t now_ms);
    void send_heartbeats(Bus& bus);
    void give_up(SeatId seat_id, const std::string& why);
    void advance_checkpoint(Bus& bus);
    void finish_checkpoint();
    bool checkpoint_due() const;
    void begin_log_checkpoint();
    bool release_leaving_members(Bus& bus);
    void begin_recovery();
    void finish_leg();
    void fail_recovery(RobotId robot);
    const std::vector<RobotState>* checkpoint_here() const {
        return checkpoints_.tick() == tick() ? checkpoints_.states().get() : nullptr;
    }

    std::shared_ptr<const Model> model_;
    ControllerOptions options_;
    ModelServer model_server_;
    ControlService control_;
    Roster roster_;
    ClientService clients_;
    OrderLog order_log_;
    OrderFeed feed_;
    Recorder recorder_;

    StateDirectory directory_;
    Tick target_ = 0;
    std::optional<Tick> ends_at_;  // in this tick a state becomes non-finite
    bool started_ = false;
    std::vector<std::uint64_t> hashes_, next_hashes_;  // by RobotId: committed; of the round
    std::vector<RobotMotion> motions_;                 // by RobotId, for the forecast
    CostModel costs_;
    Checkpoints checkpoints_;
    Recovery recovery_;
    Forecast forecast_;
    TouchWatch watch_;
    WindowLength length_;
    Islands islands_;  // of the last window committed

    std::optional<Round> round_;
    std::uint32_t epoch_ = 0;
    std::uint64_t window_ = 0;
    std::vector<OwnedBox> boxes_;
    UnionFind sets_;
    Sweep sweep_;

    bool observations_due_ = false;
    std::int64_t heartbeat_sent_ms_ = 0;

    ViewService views_;

    RunNotices notices_;
    Counters counters_;
    std::vector<Envelope> inbox_;
};

}  // namespace roboss
