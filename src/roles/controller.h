// The Controller role (the paper's section 3): plans windows, validates what came of them, commits, stamps
// orders, serves observations, and brings back what a lost Simulator had. It steps nothing. The truth is in
// its committed tick, the robots' hashes there, the last checkpoint and the order log; everything else can be
// asked for again.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bus/bus.h"
#include "bus/state_pull.h"
#include "journal/run_log.h"
#include "plan/forecast.h"
#include "plan/touch_watch.h"
#include "plan/window_length.h"
#include "roles/client_desk.h"
#include "roles/control_desk.h"
#include "roles/order_book.h"
#include "roles/order_feed.h"
#include "roles/roster.h"
#include "roles/round.h"
#include "roles/view_desk.h"
#include "wire/view_state.h"

namespace roboss {

struct ControllerOptions {
    Tick window = 0;      // ticks; 0: adaptive
    Tick window_max = 0;  // of the adaptive one; 0: by how many robots a worker has (longest_window)
    ForecastOptions forecast;
    std::size_t simulators = 1;        // the first window waits for so many
    std::vector<std::string> clients;  // and for these; their ids are their places here
    std::uint64_t seed = 1;            // told to Clients
    std::int64_t resend_ms = 100;
    std::size_t ahead_least = 500;  // orders of the next window that are worth telling before it
    /// Of a window's work for each: less of it is not shared out anew, whoever is late.
    double help_least_ns = 500'000;
    std::int64_t alive_ms = 250;      // a sign of life to everybody
    std::int64_t loss_ms = 0;         // a Simulator silent for so long is given up; 0: never
    std::int64_t client_loss_ms = 0;  // so is a Client that does not answer an observation; 0: never
    std::int64_t client_gone_ms = 0;  // and one that the Bus says has vanished and that stays away; 0: never
    Tick checkpoint_ticks = 0;        // recovery checkpoints at most so far apart; 0: none by ticks
    double checkpoint_work_s =
        0;  // and so much stepping CPU time of the busiest Simulator apart; 0: none by work
    /// Of the Controller that this one takes over from on the same Bus (after a rewind, say).
    struct Before {
        std::size_t seats = 0;  // never given again
        /// Of the first Simulator; a process of its own takes one that no other had.
        std::uint32_t first_id = 0;
        std::uint32_t epoch = 0;
        std::uint64_t window = 0;
        std::vector<std::uint64_t> models;  // hashes of earlier Models of the run
        bool went_back = false;             // Clients may have seen ticks that are no more
        ControlDesk control;
    } before;
    /// What the world looks like, in bytes for viewers; asked for when the first viewer asks.
    std::function<std::vector<std::uint8_t>(const Model&)> scene;
    RunLog* log = nullptr;  // outlives the Controller; none: nothing is kept
    Tick log_ticks = 0;     // checkpoints for the log at multiples of so many ticks; 0: none
};

/// Where a run starts: the world's beginning, a saved run, or a journal.
struct StartingPoint {
    Tick tick = 0;
    std::vector<RobotState> states;  // by RobotId
    std::vector<SaidOrder> orders;   // still to come
    /// Up to here the run goes by `orders`: nothing new is given an earlier tick.
    Tick logged_until = 0;
    /// By ClientId: words for observations up to this one are in `orders` already and are not taken again.
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
    double critical_cpu_s = 0;  // of the busiest Simulator of each attempt: what many machines would wait for
    std::uint64_t silences = 0;  // of the losses, those noticed by silence alone
    std::uint64_t losses = 0, recoveries = 0, migrations = 0, checkpoints = 0, orders_refused = 0;
    std::uint64_t orders_ahead = 0;  // told before the plan of their window
    std::uint64_t cuts = 0;          // plans that were late and of which others took a part over
    std::size_t simulators = 0, islands_now = 0;
};

/// A Simulator as people want to see it. Loads and times are running means over windows.
struct MemberReport {
    std::uint32_t number = 0;  // in the order of joining, from 0
    std::string name;
    std::uint32_t threads = 1;
    bool alive = false, leaving = false;  // neither: it was lost; leaving and not alive: it has left
    std::size_t robots = 0, islands = 0;  // that it has now
    double step_us = 0;                   // CPU time of its stepping a tick and thread
    double load = 0;                      // the same, relative to the busiest
    Address address;
};

/// A committed tick that somebody still wants to fetch.
struct WantedTick {
    Tick tick = 0;
    std::vector<std::uint32_t> holder;  // by RobotId: place, or kLost
    std::vector<ClientId> clients;
    bool checkpoint = false;
    bool open() const { return checkpoint || !clients.empty(); }
};

struct RecoveryCheckpoint {
    Tick tick = 0;
    std::shared_ptr<std::vector<RobotState>> states;  // by RobotId; never changed once it is complete
    UnionFind touched;                                // robots that may have interacted since
};

/// Model or scene, as they travel.
struct WholeBytes {
    std::vector<std::uint8_t> bytes;
    std::uint64_t hash = 0;
};

class Controller {
  public:
    Controller(std::shared_ptr<const Model> model, const ControllerOptions& options, StartingPoint start);

    /// Handles what has come and starts what is due. Never waits.
    void advance(Bus& bus);

    /// The world goes on until this tick and stops there. An earlier one than tick() pauses at the next
    /// boundary.
    void run_until(Tick target) { target_ = target; }
    Tick target() const { return target_; }
    Tick tick() const { return tick_; }  // committed
    /// Everybody whom the first window waits for has come.
    bool started() const { return started_; }
    /// At the target with nothing under way.
    bool resting() const { return tick_ >= target_ && !round_ && started_; }
    /// Resting, and every synchronous Client has answered all it observed before tick(): time for a save.
    bool settled() const;
    /// Nothing under way any more after a failure.
    bool stopped() const { return failure_ && !round_; }
    /// Set: the run cannot go on; tick() and states are those before.
    const std::optional<Error>& failure() const { return failure_; }

    /// Tells everybody that the run is over; nothing is to be expected of them after that.
    void dismiss(Bus& bus, const std::string& reason);

    /// The 64-bit hash of the world at tick().
    std::uint64_t hash() const { return world_hash(model_->hash, hashes_); }
    std::uint64_t robot_hash(RobotId robot) const { return hashes_[robot.index()]; }
    /// Fetches all states at tick(); only while resting (or failed). Then states() has them after some
    /// advances.
    void request_states() { states_wanted_ = true; }
    const std::vector<RobotState>* states() const;

    /// An order with a given tick, `apply_at` >= tick().
    Result<> submit(const Order& order);
    /// Orders that a run saved at tick() takes along.
    std::vector<SaidOrder> pending_orders() { return book_.pending(tick_); }
    /// Names of all Clients so far, by ClientId.
    std::vector<std::string> client_names() const;
    /// Of these, those that are here and no guests.
    std::vector<std::string> clients_serving() const;

    /// A checkpoint for the log is being fetched: its tick. What Clients of this process remember there has
    /// to be noted meanwhile.
    std::optional<Tick> log_tick() const { return log_tick_; }
    /// It is complete: taken once. What is missing in it is the Clients' memory.
    std::optional<RunCheckpoint> take_log_checkpoint();
    /// The next commit waits for the log.
    bool waits_for_log() const;
    std::uint64_t log_needed() const { return log_needed_; }
    /// From now on all goes to this log, first what is still to come. Only while nothing is under way. None:
    /// nothing is logged any more.
    void start_log(RunLog* log, Tick log_ticks);

    /// What a Controller that takes over has to know.
    ControllerOptions::Before hand_over();
    /// Requests to the run: pause, rewind ...
    ControlDesk& control() { return control_; }
    /// Of the windows to come; 0: adaptive.
    void set_window(Tick ticks);
    /// Lets the Simulator with the highest number go, in good order. False: there is none but one.
    bool send_one_home();

    const Counters& counters() const { return counters_; }
    /// What happened since the last call: losses, refusals, joins. One line each.
    std::vector<std::string> take_notices() { return std::exchange(notices_, {}); }
    /// Index of the Simulator that has the robot; for drawing.
    std::uint32_t place_of(RobotId robot) const { return holder_[robot.index()]; }
    const Islands& islands() const { return islands_; }
    /// Everybody who holds a seat, or held one.
    std::vector<MemberReport> members() const;
    /// How evenly the stepping of late windows was spread: 1 is perfect; what messages cost is not in it.
    double balance() const;
    /// What is known of each robot's whereabouts in the last window, by RobotId.
    std::span<const RobotMotion> motions() const { return motions_; }
    Tick window_ticks() const { return length_.ticks(); }

  private:
    // controller.cpp: messages in
    void handle(Bus& bus, Envelope& envelope);
    void take_hello(Bus& bus, const Address& from, const Hello& hello);
    void take_leave(Bus& bus, const Address& from, const LeaveRequest& request);
    /// The place of the Simulator that lives there.
    std::optional<std::uint32_t> heard_from(Bus& bus, const Address& from);
    /// The place of who lives by this id; who does not is told.
    std::optional<std::uint32_t> heard_from(Bus& bus, const Address& from, SimulatorId id);
    void serve(Bus& bus, const Address& from, const StateRequest& request) const;
    bool is_earlier_model(std::uint64_t hash) const;
    void serve_model(Bus& bus, const Address& from, const ModelRequest& request);
    const WholeBytes& whole(Whole what);
    void fail(Error error);
    /// A message that makes no sense.
    void note_dropped(const char* message, const std::string& why);
    void notice(std::string text) { notices_.push_back(std::move(text)); }

    // controller_clients.cpp
    void take_client_hello(Bus& bus, const Address& from, const ClientHello& hello);
    void take_word(Bus& bus, const Address& from, const ClientWord& word);
    void take_orders(ClientSeat& seat, const ClientWord& word);
    void take_bye(Bus& bus, const Address& from, const ClientBye& bye);
    void tell_observers();
    void tell_observer(ClientId id, Tick tick);
    void forget(ClientId id, Tick tick);
    void drop_client(ClientId id);
    void notice_client_losses(Bus& bus);
    bool stays_away(const ClientSeat& seat, std::int64_t now_ms) const;
    void send_observations(Bus& bus, bool again_now);
    WantedTick& want_at_this_tick();
    void acknowledge(Bus& bus);
    Tick plannable() const { return round_ && !round_->span().recovery ? round_->span().until : tick_; }
    /// The first tick that a new order may be given.
    Tick stampable() const { return std::max(plannable(), logged_until_); }
    bool is_in_log(const ClientSeat& seat, const ClientWord& word) const;

    // controller_window.cpp
    void at_boundary(Bus& bus);
    bool may_plan() const;
    void plan_window();
    void keep_wanted(Round& round) const;
    Tick window_end(Tick from, Tick length, bool all_answered = false) const;
    Tick window_max() const;
    void look_ahead();
    double largest_share() const;
    void send_plans(Bus& bus);
    void take_frame(std::uint32_t place, const Frame& frame);
    void take_costs(const Round::Answered& answered, const Frame& frame);
    void finish_round();
    bool merge_touching();
    void commit();
    void learn_costs();
    void learn_rates(std::span<const double> expected_ns, std::span<const double> spent_ns);
    const IslandFrame* first_failure() const;
    void end_before(const IslandFrame& failure);
    void drop_round();
    std::string part_of(RobotId robot, JointId joint) const;

    // controller_help.cpp: who is done takes over from who is late
    void expect_work();
    void relieve(Bus& bus);
    void share_out_rest(const Round::Answered& cut_short, std::span<const IslandFrame> stepped, Tick at);

    // controller_views.cpp
    void take_view_request(Bus& bus, const Address& from, const ViewRequest& request);
    void serve_views(Bus& bus);
    void show(Bus& bus, const ViewDesk::Due& due);
    void show_here(Bus& bus, const ViewDue& part);

    // controller_recovery.cpp: checkpoints, leaving, losses
    void notice_losses(Bus& bus);
    void take_vanished(const Address& address, std::int64_t now_ms);
    void say_alive(Bus& bus);
    void give_up(std::uint32_t place, const std::string& why);
    void begin_checkpoint();
    void tend_checkpoint(Bus& bus);
    void finish_checkpoint();
    bool checkpoint_due() const;

    // controller_log.cpp
    void begin_log_checkpoint();
    Tick next_log_tick(Tick from) const;
    void log_window(Tick until);
    void log_commit();
    bool let_leavers_go(Bus& bus);
    bool anything_lost() const;
    void begin_recovery();
    std::vector<RobotId> closure_of_lost();
    void begin_leg(Tick from);
    void finish_leg();
    bool is_lost(std::uint32_t place) const { return place != kAtController && !roster_.alive(place); }

    std::shared_ptr<const Model> model_;
    std::optional<WholeBytes> model_bytes_, scene_bytes_;  // made for the first who asks
    ControllerOptions options_;
    ControlDesk control_;
    Roster roster_;
    ClientDesk desk_;
    OrderBook book_;
    OrderFeed feed_;

    Tick tick_ = 0, target_ = 0;
    Tick logged_until_ = 0;
    std::vector<Tick> answered_;    // by ClientId, in the log that this run started from
    std::uint64_t log_needed_ = 0;  // entries that must be safe before the round is committed
    std::optional<Tick> log_tick_;  // of the checkpoint for the log that is under way
    Tick log_tried_ = -1;           // tick of the last one, whatever came of it
    std::optional<RunCheckpoint> log_checkpoint_;
    std::optional<Tick> ends_at_;  // in this tick a state ceases to be finite
    bool started_ = false;
    std::vector<std::uint64_t> hashes_, next_hashes_;  // by RobotId: committed; of the round
    std::vector<std::uint32_t> holder_;                // by RobotId: place of its state at tick_
    std::vector<RobotMotion> motions_;                 // by RobotId, for the forecast
    std::vector<float> cost_;                          // by RobotId: ns a tick on the mean Simulator
    bool costs_known_ = false;                         // measured, not guessed
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

    RecoveryCheckpoint base_;
    std::optional<RecoveryCheckpoint>
        next_base_;  // being fetched, or waiting until nobody wants an earlier tick
    StatePull pull_;
    double work_since_s_ = 0;  // of the busiest Simulator since the last checkpoint
    bool states_wanted_ = false;
    std::vector<WantedTick> wants_;
    std::vector<RobotId> recovering_;  // robots of the recovery under way, ascending
    bool tell_again_ = false;
    std::int64_t alive_said_ms_ = 0;

    ViewDesk views_;
    std::uint64_t view_serial_ = 0;
    std::optional<ViewLayout> view_layout_;  // made by the first view

    std::optional<Error> failure_;
    Counters counters_;
    std::vector<std::string> notices_;
    std::vector<Envelope> inbox_;
};

}  // namespace roboss
