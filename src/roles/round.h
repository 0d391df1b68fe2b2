// Round: one attempt at a window under way: which Simulator has which islands, the plans sent and not
// answered, and what the answers said so far. Kept by RobotId in flat arrays, so merging islands moves
// nothing.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "bus/bus.h"
#include "plan/forecast.h"
#include "roles/roster.h"

namespace roboss {

struct RoundSpan {
    std::uint32_t epoch = 0;
    std::uint64_t window = 0;
    Tick from = 0, until = 0;
    bool recovery = false;  // steps what was committed before, from a checkpoint
};

class Round {
  public:
    Round(const RoundSpan& span, std::size_t robots);

    const RoundSpan& span() const { return span_; }
    std::uint32_t attempt() const { return attempt_; }

    /// Writes plans: part.of(i) to seat place[i]; `source`[robot]: where its state at `from` is. Later
    /// calls are further attempts, for those islands only.
    void plan(const Islands& part, std::span<const std::uint32_t> place,
              std::span<const std::uint32_t> source, const Roster& roster);
    /// An order of this span, for whoever steps its robot in this attempt; nobody does: it is passed over.
    void give(const Order& order);
    /// Besides the orders given, those told in this window before hold for the seats in `told`.
    void give_ahead(std::uint64_t window, const std::vector<bool>& told);
    /// To be kept by the Simulator at `place` on receiving the plan; writes an empty plan if it has none.
    void keep(std::uint32_t place, std::vector<RobotId> robots);
    void release_before(Tick tick);
    /// Who has most to do is told first. `cost`: by RobotId.
    void send_dearest_first(std::span<const float> cost);
    /// Sends plans that were never sent or not answered for resend_ms; these only after `complete`, which
    /// gives them all their orders.
    void send(Bus& bus, const Roster& roster, std::int64_t resend_ms,
              const std::function<void(Plan&)>& complete);

    /// The plan that this frame answers, removed from those unanswered; nothing if it answers none.
    std::optional<Plan> answered_by(const Frame& frame);
    bool all_answered() const { return sent_.empty(); }

    /// The seat that steps this robot.
    std::uint32_t seat_of(RobotId robot) const { return seat_[robot.index()]; }
    std::span<const std::uint32_t> seats() const { return seat_; }

    Islands islands;                   // of the whole window so far
    std::vector<IslandFrame> outcome;  // by the island's root
    std::vector<EarlierBox> earlier;

  private:
    struct Sent {
        std::uint32_t place = 0;
        Plan plan;
        std::optional<std::int64_t> sent_ms;
        int times = 0;  // sent again
    };
    Plan& plan_for(std::uint32_t place);

    RoundSpan span_;
    std::uint32_t attempt_ = 0;
    bool planned_ = false;
    std::deque<Sent> sent_;            // so that a plan stays where it is while others are added
    std::vector<std::uint32_t> seat_;  // by RobotId
    std::vector<bool> in_attempt_;     // by RobotId
    std::vector<Plan*> plan_of_seat_;  // of this attempt; null: has none
};

}  // namespace roboss
