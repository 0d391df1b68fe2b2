// Recovery: recomputes the states that a lost Simulator held. Its robots, and all that these may have touched
// since the checkpoint, are stepped from there with the logged orders, and must reach the committed hashes.
// It goes in legs: each is a Round that ends at the next tick that somebody needs, the last one at the
// committed tick.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "roles/controller/checkpoints.h"
#include "roles/controller/cost_model.h"
#include "roles/controller/order_log.h"
#include "roles/controller/round.h"

namespace roboss {

class Recovery {
  public:
    /// All of them outlive the Recovery.
    Recovery(const Roster& roster, const CostModel& costs, OrderLog& order_log, Checkpoints& checkpoints,
             StateDirectory& directory)
        : roster_(roster),
          costs_(costs),
          order_log_(order_log),
          checkpoints_(checkpoints),
          directory_(directory) {}

    /// Begins with what is lost now; a recovery that is under way ends. Robots whose states the checkpoint
    /// has are back at once.
    void begin();
    /// Ascending.
    std::span<const RobotId> robots() const { return robots_; }
    /// Legs are needed, since the checkpoint is older than the committed tick.
    bool has_legs() const { return checkpoints_.tick() < directory_.tick(); }
    Round first_leg(std::uint32_t epoch, std::uint64_t window);
    /// After `before`, which is complete.
    Round next_leg(const Round& before, std::uint64_t window);
    /// The last leg is complete: a robot whose new hash is not the committed one. Both by RobotId.
    std::optional<RobotId> first_difference(std::span<const std::uint64_t> hashes,
                                            std::span<const std::uint64_t> committed) const;
    /// The leg is complete: its Simulators have the states. True: it was the last one.
    bool finish_leg(const Round& leg);

  private:
    Round leg(const RoundSpan& span, const Islands& islands, std::span<const SeatId> seat_of_island,
              std::span<const SeatId> source);
    Islands islands();

    const Roster& roster_;
    const CostModel& costs_;
    OrderLog& order_log_;
    Checkpoints& checkpoints_;
    StateDirectory& directory_;
    std::vector<RobotId> robots_;
};

}  // namespace roboss
