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
    /// How often islands of the window were merged and planned again.
    std::uint32_t repeats() const { return repeats_; }

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

    /// What a frame answers.
    struct Answered {
        std::uint32_t place = 0;
        Plan plan;
        std::vector<std::uint32_t> helpers;  // that wait for what a Cut leaves
    };
    /// The plan that this frame of a seat answers, removed from those unanswered; nothing if it answers none.
    /// `fits`: false if it is meant for one and says what cannot be true of it.
    std::optional<Answered> answered_by(std::uint32_t place, const Frame& frame, bool& fits);
    bool all_answered() const { return sent_.empty(); }

    /// What a seat's stepping cost; in the whole window; the most of one seat since islands were planned for
    /// all, or again.
    void spend(std::uint32_t place, std::uint64_t cost_ns);
    double spent_ns(std::uint32_t place) const { return place < spent_ns_.size() ? spent_ns_[place] : 0; }
    double busiest_ns() const;

    // Helping out: who has answered may take over from who is late.
    /// Everybody is expected to need so much time for the window.
    void expect(std::uint64_t due_ns);
    void take_late(std::uint32_t place, const Late& late);
    struct LateSeat {
        std::uint32_t place = 0;
        std::size_t islands = 0;
    };
    /// Who said that it is late, has something to give away and was not cut short yet, the latest first.
    std::vector<LateSeat> late() const;
    /// Whom nothing is to come from.
    std::vector<std::uint32_t> idle(const Roster& roster) const;
    void cut(Bus& bus, const Roster& roster, std::uint32_t place, std::vector<std::uint32_t> helpers);
    /// Writes plans for what is left of a plan from tick `at` on: its island i to seat place[i].
    /// `complete` gives them their orders.
    void plan_rest(const Answered& cut_short, Tick at, std::span<const std::uint32_t> place,
                   std::uint64_t due_ns, const Roster& roster, const std::function<void(Plan&)>& complete);

    /// The seat that has this robot at the window's start and steps it, to the end or to a Cut.
    std::uint32_t seat_of(RobotId robot) const { return seat_[robot.index()]; }
    std::span<const std::uint32_t> seats() const { return seat_; }
    /// The seats that have the robots at the window's end.
    std::span<const std::uint32_t> last_seats() const { return last_seat_; }
    /// Since when that seat steps it.
    Tick since(RobotId robot) const { return since_[robot.index()]; }

    Islands islands;                   // of the whole window so far
    std::vector<IslandFrame> outcome;  // by the island's root
    std::vector<EarlierBox> earlier;

  private:
    struct Sent {
        std::uint32_t place = 0;
        Plan plan;
        std::optional<std::int64_t> sent_ms;
        int times = 0;               // sent again
        std::uint64_t needs_ns = 0;  // it is late and needs so much
        bool cut = false;
        std::vector<std::uint32_t> helpers;
    };
    Plan& plan_for(std::uint32_t place);
    bool suits(const Plan& plan, const Frame& frame) const;
    void write(const Islands& part, std::span<const std::uint32_t> place,
               std::span<const std::uint32_t> source, const Roster& roster);

    RoundSpan span_;
    std::uint32_t attempt_ = 0, repeats_ = 0;
    bool planned_ = false;
    std::deque<Sent> sent_;                        // so that a plan stays where it is while others are added
    std::vector<std::uint32_t> seat_, last_seat_;  // by RobotId
    std::vector<Tick> since_;                      // by RobotId
    std::vector<bool> in_attempt_;                 // by RobotId
    std::vector<double> spent_ns_, spent_before_ns_;  // by seat; before: when islands were planned again
    std::vector<Plan*> plan_of_seat_;                 // of this attempt; null: has none
};

}  // namespace roboss
