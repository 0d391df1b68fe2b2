// Round: a window in progress: which Simulator steps which islands, which assignments are unanswered, and the
// results so far. Flat arrays by RobotId, so merging islands moves nothing.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "bus/bus.h"
#include "roles/controller/roster.h"
#include "schedule/forecast.h"

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
    /// How often islands of the window were merged and stepped again.
    std::uint32_t repeats() const { return repeats_; }

    /// Assigns part.of(i) to seat_of_island[i]; source[robot]: where its state at `from` is. Later calls
    /// begin further attempts, for those islands only.
    void assign(const Islands& part, std::span<const SeatId> seat_of_island, std::span<const SeatId> source,
                const Roster& roster);
    /// Adds an order of this span to the assignment of its robot in this attempt, if there is one.
    void give(const Order& order);
    /// The seats in `sent_ahead` have also got the orders that were sent ahead in `window`.
    void give_ahead(std::uint64_t window, const std::vector<bool>& sent_ahead);
    /// States that this Simulator must keep when it gets its assignment (an empty one is added if it has
    /// none).
    void keep(SeatId seat_id, std::vector<RobotId> robots);
    void release_before(Tick tick);
    /// The most expensive assignment is sent first. `cost`: by RobotId.
    void send_dearest_first(std::span<const float> cost);
    /// Sends new assignments, and those unanswered for resend_ms again; the latter after `complete`, which
    /// adds all their orders.
    void send(Bus& bus, const Roster& roster, std::int64_t resend_ms,
              const std::function<void(Assignment&)>& complete);

    /// An assignment with its result.
    struct Answered {
        SeatId seat_id = 0;
        Assignment assignment;
        std::vector<SeatId> helpers;  // idle seats that share the rest after a Cut
    };
    /// Removes the assignment that this result answers from the unanswered ones and returns it; nothing if
    /// there is none. `fits`: false if the result contradicts its assignment.
    std::optional<Answered> answered_by(SeatId seat_id, const WindowResult& result, bool& fits);
    bool all_answered() const { return sent_.empty(); }
    /// Those whose answers are missing.
    std::vector<SeatId> unanswered() const;

    /// Adds to a seat's stepping cost. spent_ns: in the whole window; busiest_ns: the maximum over the seats
    /// since the last attempt began.
    void spend(SeatId seat_id, std::uint64_t cost_ns);
    double spent_ns(SeatId seat_id) const { return seat_id < spent_ns_.size() ? spent_ns_[seat_id] : 0; }
    double busiest_ns() const;
    /// The maximum over the seats in the whole window.
    double window_busiest_ns() const;

    // Work stealing: idle Simulators take over a part of a late one's assignment.
    /// The CPU time that each Simulator is expected to need for the window.
    void expect(std::uint64_t due_ns);
    void take_late(SeatId seat_id, const Late& late);
    struct LateSeat {
        SeatId seat_id = 0;
        std::size_t islands = 0;
    };
    /// Late seats with several islands that were not cut yet, the latest first.
    std::vector<LateSeat> late() const;
    /// Workers from which no result is due.
    std::vector<SeatId> idle(const Roster& roster) const;
    void cut(Bus& bus, const Roster& roster, SeatId seat_id, std::vector<SeatId> helpers);
    /// Writes assignments for the rest of an assignment from tick `at` on, island i to seat_of_island[i].
    /// `complete` adds their orders.
    void assign_rest(const Answered& cut_short, Tick at, std::span<const SeatId> seat_of_island,
                     std::uint64_t due_ns, const Roster& roster,
                     const std::function<void(Assignment&)>& complete);

    /// The seat that steps this robot from the window's start, to the end or to a Cut.
    std::uint32_t seat_of(RobotId robot) const { return seat_[robot.index()]; }
    std::span<const SeatId> seats() const { return seat_; }
    /// The seats that hold the robots at the window's end.
    std::span<const SeatId> last_seats() const { return last_seat_; }
    /// Since when its last seat steps it.
    Tick since(RobotId robot) const { return since_[robot.index()]; }

    Islands islands;                    // of the whole window so far
    std::vector<IslandResult> outcome;  // by the island's root
    std::vector<EarlierBox> earlier;
    bool measured = false;  // Simulators profile it

  private:
    struct Sent {
        SeatId seat_id = 0;
        Assignment assignment;
        std::optional<std::int64_t> sent_ms;
        int times = 0;               // sent again
        std::uint64_t needs_ns = 0;  // it is late and needs so much
        bool cut = false;
        std::vector<SeatId> helpers;
    };
    Assignment& assignment_for(SeatId seat_id);
    bool suits(const Assignment& assignment, const WindowResult& result) const;
    void write(const Islands& part, std::span<const SeatId> seat_of_island, std::span<const SeatId> source,
               const Roster& roster);

    RoundSpan span_;
    std::uint32_t attempt_ = 0, repeats_ = 0;
    bool assigned_ = false;
    std::deque<Sent> sent_;                 // so that an assignment stays where it is while others are added
    std::vector<SeatId> seat_, last_seat_;  // by RobotId
    std::vector<Tick> since_;               // by RobotId
    std::vector<bool> in_attempt_;          // by RobotId
    std::vector<double> spent_ns_, spent_before_ns_;  // by seat; before: when islands were planned again
    std::vector<Assignment*> assignment_of_seat_;     // of this attempt; null: has none
};

}  // namespace roboss
