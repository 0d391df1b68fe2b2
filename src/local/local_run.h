// LocalRun: one world in this process, stepped on all cores, without roles, Bus or messages. For programs
// that own the loop: learning, optimisation, bindings to other languages. Its states are those of `roboss
// run`, bit for bit.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "local/run_access.h"
#include "local/world_stepper.h"
#include "model/edit.h"

namespace roboss {

/// Options of a LocalRun. None of `threads` and `lanes` changes a bit.
struct LocalRunOptions {
    unsigned threads = 1;            ///< that step
    std::size_t lanes = kMostLanes;  ///< most robots of a type that a thread steps at once
    std::uint64_t seed = 0;          ///< of sensor noise
};

/// All that a LocalRun needs to continue exactly.
struct LocalSave {
    std::uint64_t model_hash = 0;    ///< of the Model that the states are of
    std::uint64_t seed = 0;          ///< of sensor noise
    Tick tick = 0;                   ///< at whose beginning it is
    std::vector<RobotState> states;  ///< by RobotId
    std::vector<Order> orders;       ///< that have not taken effect yet
    std::uint64_t given = 0;         ///< how many orders order() has numbered
};

/// See the top of the file. Not for use by several threads at once.
///
///     LocalRun run(model, {.threads = 4});
///     run.order(car, SetJoint{wheel, 0, MotorMode::kVelocity, 8.0});
///     run.step(100);
///     const Pose X_WB = base_pose(run.state(car));
class LocalRun final : public RunAccess {
  public:
    /// At the beginning of the world. An Error, "message-board": the world has plugins that react to messages
    /// (docs/plugins.md); a program of `roboss run` does that, and here it is missing.
    static Result<std::unique_ptr<LocalRun>> create(std::shared_ptr<const Model> model,
                                                    const LocalRunOptions& options = {});

    /// Advances the world by `ticks` time steps. Returns the Error "not-finite" if a state would become
    /// infinite or no number. The world then stays at the beginning of that tick, tick(), and the order that
    /// causes it may still be pending.
    Result<> step(Tick ticks = 1);

    Tick tick() const override { return tick_; }
    std::uint64_t seed() const override { return seed_; }
    const std::vector<RobotState>& states() const override { return states_; }
    std::size_t threads() const { return stepper_.threads(); }  ///< that step
    unsigned ray_threads() const override { return static_cast<unsigned>(threads()); }

    /// Takes effect at the beginning of the next tick that is stepped, in the order in which they were given.
    /// An Error says why check_order() refuses it.
    Result<> order(RobotId robot, const Action& action);
    Result<> order(std::vector<Order> orders) override;
    /// As order(), but at once: state() shows what it did. Orders that wait for the next tick follow it, also
    /// those given before.
    Result<> change(RobotId robot, const Action& action) override;
    /// An order with a tick, tick() or later, as from a file. Those of a tick are sorted by (Client,
    /// sequence); those of order() are Client 0.
    Result<> submit(const Order& order);

    /// Everything needed to continue exactly.
    LocalSave save() const;
    /// Continues there. An Error, "other-world": it was saved with another Model; nothing is changed.
    Result<> restore(const LocalSave& save);
    /// Back to the beginning of the world, without orders; with the seed given, or the same one.
    void reset(std::optional<std::uint64_t> seed = {});
    /// A run of the edited world that continues from here, with the same options: robots that stay keep
    /// their states and orders, those that came are in their initial states, at rest. This run stays as it
    /// is. Errors: those of create().
    Result<std::unique_ptr<LocalRun>> edited(const ModelEdit& edit) const;

  private:
    LocalRun(std::shared_ptr<const Model> model, const LocalRunOptions& options);

    LocalRunOptions options_;
    WorldStepper stepper_;
    std::uint64_t seed_ = 0, given_ = 0;
    Tick tick_ = 0;
    std::vector<RobotState> states_;
    std::vector<Order> orders_;  // in canonical order
};

}  // namespace roboss
