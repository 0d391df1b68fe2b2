// The Simulator role (the paper's section 3): takes a window's plan, fetches the states it lacks, steps its
// islands through the window without waiting for anyone, and answers with a frame. It knows nothing of other
// Simulators' plans and decides nothing; a plan that comes twice is answered from memory.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bus/bus.h"
#include "bus/state_pull.h"
#include "roles/state_store.h"
#include "roles/window_stepper.h"
#include "wire/view_state.h"

namespace roboss {

struct SimulatorOptions {
    std::int64_t resend_ms = 100;  // unanswered requests are sent again after this
    std::int64_t alive_ms = 50;    // sign of life, also from within a long step
    bool measure_cpu = true;       // false: cost is counted work, so that a seeded test repeats exactly
    // For clusters in virtual time:
    std::function<std::uint64_t()> cpu_clock;  // in ns; none: the thread's
    std::function<void(double)> counted;       // told of counted work, in ns, as it is done
    std::size_t look_up = 64;      // robots times ticks between two looks for messages, where few are stepped
    double cut_least_ns = 50'000;  // of a plan's work: less does not pay to be told of, or given away
    std::size_t lanes = kMostLanes;  // robots stepped at once (StepScratch::use_lanes)
    std::string name;                // for people: where it runs
};

class Simulator {
  public:
    /// `pool` steps the islands; it may be shared by Simulators that advance in one thread.
    Simulator(std::shared_ptr<const Model> model, const Address& self, const SimulatorOptions& options,
              ThreadPool& pool);

    /// Handles what has come and does the work that is due. Never waits.
    void advance(Bus& bus);

    /// Asks to leave; serves on until gone().
    void leave() { leaving_ = true; }
    bool gone() const { return gone_; }
    bool joined() const { return id_.valid(); }
    bool idle() const { return !plan_.has_value(); }
    /// Why the Controller does not want it (another Model, say); empty: nothing of the kind.
    const std::string& refusal() const { return refusal_; }
    /// The run has another Model than this one.
    bool outdated() const { return outdated_; }
    /// Sent home by the Controller.
    bool sent_home() const { return sent_home_; }
    /// Why the run is over; empty: it is not.
    const std::string& over() const { return over_; }
    /// Messages that made no sense and were dropped since the last call: one line each, key=value.
    std::vector<std::string> take_notices() { return std::exchange(notices_, {}); }

  private:
    void handle(Bus& bus, Envelope& envelope);
    void take_plan(Bus& bus, Plan& plan);
    std::string flaw_of(const Plan& plan) const;
    void note_dropped(const char* message, std::uint64_t window, const std::string& why);
    void adopt(Bus& bus, Plan& plan);
    void give(Bus& bus, const Plan& plan) const;
    void take_ahead(Bus& bus, OrdersAhead& ahead);
    void add_ahead(Plan& plan) const;
    void take_states(StateReply& reply);
    WindowStepper::Next attend(Bus& bus, const StepProgress& progress);
    WindowStepper::Next whether_late(Bus& bus, const StepProgress& progress);
    void serve(Bus& bus, const Address& from, const StateRequest& request) const;
    void show(Bus& bus, const ViewDue& due);
    void catch_up(Bus& bus);
    void keep_wanted();
    void keep_in_touch(Bus& bus);
    void say_alive(Bus& bus);
    void start_over();

    std::shared_ptr<const Model> model_;
    Address self_;
    SimulatorOptions options_;

    SimulatorId id_;
    std::string refusal_, over_;
    bool leaving_ = false, gone_ = false, outdated_ = false, sent_home_ = false;
    std::int64_t asked_ms_ = kLongAgo, alive_ms_ = kLongAgo;

    StateStore store_;
    std::optional<Plan> plan_;   // being worked on
    std::optional<Plan> unfed_;  // waits for the orders that were told ahead of it
    std::optional<OrdersAhead> ahead_;
    bool said_late_ = false, cut_ = false;  // of the plan
    StateRequest to_keep_;           // of the plan: copied when there is time, before another is adopted
    StatePull pull_;                 // of its hand-offs
    std::vector<StateReply> early_;  // that came before the plan that speaks of them
    std::vector<Envelope> later_;    // came while it was stepping
    std::optional<Frame> answer_;    // to the last plan worked on
    WindowStepper stepper_;
    std::optional<ViewLayout> view_layout_;  // made by the first view
    std::vector<std::string> notices_;
    std::vector<Envelope> inbox_;

    static constexpr std::int64_t kLongAgo = -1'000'000'000;
};

}  // namespace roboss
