// The Simulator role (the paper's section 3): takes an assignment, fetches the states it lacks, steps its
// islands through the window without waiting for anyone, and answers with a WindowResult. It knows nothing of
// other Simulators' assignments and decides nothing; it answers a repeated assignment from memory.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bus/bus.h"
#include "bus/state_pull.h"
#include "core/monotonic.h"
#include "roles/simulator/state_store.h"
#include "roles/simulator/window_stepper.h"
#include "wire/view_state.h"

namespace roboss {

struct SimulatorOptions {
    std::int64_t resend_ms = 100;    // unanswered requests are sent again after this
    std::int64_t heartbeat_ms = 50;  // heartbeat interval, also during a long step
    bool measure_cpu = true;         // false: cost is counted work, so that a seeded test repeats exactly
    // For clusters in virtual time:
    std::function<std::uint64_t()> cpu_clock;  // in ns; none: the thread's
    std::function<void(double)> counted;       // called with counted work, in ns, as it is done
    std::size_t look_up = 64;      // robots times ticks between two polls for messages, where few are stepped
    double cut_least_ns = 50'000;  // of an assignment's work: less is not worth reporting or giving away
    std::size_t lanes = kMostLanes;  // robots stepped at once (StepScratch::use_lanes)
    StageNow now = monotonic_ns;     // measures steps where the Controller asks for it; null: never
    std::string name;                // where it runs, for reports
    /// Asked by all threads between ticks; true: the assignment in progress is abandoned, because the run
    /// ends. Empty: never.
    std::function<bool()> abandons;
};

class Simulator {
  public:
    /// `pool` steps the islands; it may be shared by Simulators that advance in one thread.
    Simulator(std::shared_ptr<const Model> model, const Address& self, const SimulatorOptions& options,
              ThreadPool& pool);

    /// Handles what has come and does the work that is due. Never waits.
    void advance(Bus& bus);

    /// Asks to leave; serves until gone().
    void leave() { leaving_ = true; }
    bool gone() const { return gone_; }
    bool joined() const { return id_.valid(); }
    bool idle() const { return !assignment_.has_value(); }
    /// Why the Controller refused it (another Model, say); empty: it did not.
    const std::string& refusal() const { return refusal_; }
    /// The run has another Model than this one.
    bool outdated() const { return outdated_; }
    /// The Controller dismissed it.
    bool dismissed() const { return dismissed_; }
    /// Why the run is over; empty: it is not.
    const std::string& over() const { return over_; }
    /// It is over because it could not go on.
    bool failed() const { return failed_; }
    /// Invalid messages that were dropped since the last call: one line each, key=value.
    std::vector<std::string> take_notices() { return std::exchange(notices_, {}); }

  private:
    void handle(Bus& bus, Envelope& envelope);
    void take_seat(Bus& bus, SimulatorId id);
    void take_assignment(Bus& bus, Assignment& assignment);
    std::string flaw_of(const Assignment& assignment) const;
    void note_dropped(const char* message, std::uint64_t window, const std::string& why);
    void begin_assignment(Bus& bus, Assignment& assignment);
    void send_transfers(Bus& bus, const Assignment& assignment) const;
    void take_ahead(Bus& bus, OrdersAhead& ahead);
    void add_ahead(Assignment& assignment) const;
    void take_states(StateReply& reply);
    WindowStepper::Next serve_while_stepping(Bus& bus, const StepProgress& progress);
    WindowStepper::Next check_lateness(Bus& bus, const StepProgress& progress);
    void serve(Bus& bus, const Address& from, const StateRequest& request) const;
    void show(Bus& bus, const ViewDue& due);
    void catch_up(Bus& bus);
    void handle_later(Bus& bus);
    SteppingOptions stepping_options() const;
    bool ends_assignment(const Message& message) const;
    void keep_wanted();
    void keep_in_touch(Bus& bus);
    void send_heartbeats(Bus& bus);
    void reset(Bus& bus);

    std::shared_ptr<const Model> model_;
    Address self_;
    SimulatorOptions options_;

    SimulatorId id_;
    std::string refusal_, over_;
    bool leaving_ = false, gone_ = false, outdated_ = false, dismissed_ = false, failed_ = false;
    std::int64_t asked_ms_ = kLongAgo, heartbeat_sent_ms_ = kLongAgo;

    StateStore store_;
    std::optional<Assignment> assignment_;       // in progress
    std::optional<Assignment> awaiting_orders_;  // waits for the orders that were sent ahead of it
    std::optional<OrdersAhead> ahead_;
    bool reported_late_ = false, cut_ = false;  // of the assignment
    std::atomic<bool> unwanted_{false};         // the result of the assignment is not used
    StateRequest to_keep_;           // of the assignment: copied later, but before the next assignment begins
    StatePull pull_;                 // of its hand-offs
    std::vector<StateReply> early_;  // that came before their assignment
    std::vector<Envelope> later_;    // that came while it was stepping
    std::optional<WindowResult> answer_;  // to the last assignment
    WindowStepper stepper_;
    std::optional<ViewLayout> view_layout_;  // made by the first view
    std::vector<std::string> notices_;
    std::vector<Envelope> inbox_;

    static constexpr std::int64_t kLongAgo = -1'000'000'000;
};

}  // namespace roboss
