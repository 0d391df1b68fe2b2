// CostModel: what stepping costs, measured while the run goes on: CPU time per tick of each robot on the mean
// Simulator, and how fast each Simulator is (SimulatorSeat::rate). Islands are assigned by these costs. No
// result of a run depends on them.
#pragma once

#include <span>
#include <vector>

#include "model/model.h"
#include "roles/controller/round.h"

namespace roboss {

class CostModel {
  public:
    /// Guesses costs by degrees of freedom, until they are measured.
    explicit CostModel(const Model& model);

    /// Learns from a complete window: the costs of its robots, and the speeds in `roster`.
    void learn(const Round& round, Roster& roster);
    /// By RobotId: ns per tick on the mean Simulator.
    std::span<const float> costs() const { return costs_; }
    /// Costs are measured, no longer guessed.
    bool measured() const { return measured_; }

    /// For each island of a window of `ticks` the seat of a worker, by cost, speed and where its states are.
    std::vector<SeatId> assign_islands(const Islands& islands, const Roster& roster,
                                       std::span<const SeatId> holders, Tick ticks) const;
    /// The same for islands whose states all Simulators have to fetch from the Controller.
    std::vector<SeatId> assign_recovered(const Islands& islands, const Roster& roster) const;
    /// CPU time that each Simulator needs for `ticks` ticks of all robots, evenly shared. 0: not known, or
    /// there is nobody to share with.
    double even_share_ns(const Roster& roster, Tick ticks) const;

  private:
    struct Work {
        std::vector<double> expected_ns, spent_ns;  // by seat
    };
    Work learn_costs(const Round& round, const Roster& roster, double ticks);
    static void learn_rates(const Work& work, Roster& roster);

    std::vector<float> costs_;
    bool measured_ = false;
};

}  // namespace roboss
