// LocalRun: one world in this process, stepped on all cores, without roles, Bus or messages. For programs
// that own the loop: learning, optimisation, bindings to other languages. Its states are those of `roboss
// run`, bit for bit.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "local/world_stepper.h"
#include "model/edit.h"
#include "physics/probe.h"
#include "sensors/readings.h"

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
class LocalRun : private SensorSources {
  public:
    /// At the beginning of the world. An Error, "message-board": the world has plugins that react to messages
    /// (docs/plugins.md); a program of `roboss run` does that, and here it is missing.
    static Result<std::unique_ptr<LocalRun>> create(std::shared_ptr<const Model> model,
                                                    const LocalRunOptions& options = {});

    /// Advances the world by `ticks` time steps. Returns the Error "not-finite" if a state would become
    /// infinite or no number. The world then stays at the beginning of that tick, tick(), and the order that
    /// causes it may still be pending.
    Result<> step(Tick ticks = 1);

    Tick tick() const { return tick_; }  ///< the world is at its beginning
    /// Simulated time since the start of the world, s.
    double time_s() const { return static_cast<double>(tick_) * model_->dt_s; }
    const Model& model() const { return *model_; }                               ///< the compiled world
    const std::shared_ptr<const Model>& shared_model() const { return model_; }  ///< the same
    std::uint64_t seed() const { return seed_; }                                 ///< of sensor noise
    std::size_t threads() const { return stepper_.threads(); }                   ///< that step
    /// Hash of the model and all states, as `roboss run` reports it.
    std::uint64_t hash() const;
    /// The robot's state at tick(); the robot must exist.
    const RobotState& state(RobotId robot) const { return states_[robot.index()]; }
    const std::vector<RobotState>& states() const { return states_; }  ///< all, by RobotId

    /// Takes effect at the beginning of the next tick that is stepped, in the order in which they were given.
    /// An Error says why check_order() refuses it.
    Result<> order(RobotId robot, const Action& action);
    /// Orders for several robots, as order(), or, if one is refused, none; their ticks, Clients and sequences
    /// do not count.
    Result<> order(std::vector<Order> orders);
    /// As order(), but at once: state() shows what it did. Orders that wait for the next tick follow it, also
    /// those given before.
    Result<> change(RobotId robot, const Action& action);
    /// Puts one axis of a joint at a position (rad or m), or gives it a velocity (rad/s or m/s), at once. An
    /// Error: there is no such robot, joint or axis; it closes a loop ("loop-joint"), or is a ball joint with
    /// a position ("no-position"); the number is not finite or too large.
    Result<> change_joint(RobotId robot, JointId joint, int axis, std::optional<double> position,
                          std::optional<double> velocity);
    /// Why change_joint() would refuse.
    Result<> check_joint_change(RobotId robot, JointId joint, int axis, std::optional<double> position,
                                std::optional<double> velocity) const;
    /// An order with a tick, tick() or later, as from a file. Those of a tick are sorted by (Client,
    /// sequence); those of order() are Client 0.
    Result<> submit(const Order& order);

    /// Reading of sensor number `sensor` (RobotType::sensors) at tick(), with noise. `<update_rate>` has no
    /// effect: each call measures. Returns an Error if there is no such robot or sensor, or if the sensor
    /// cannot measure.
    Result<Sample> read(RobotId robot, std::size_t sensor);
    /// All contact points of the tick that begins at tick(), as long as no order takes effect at it
    /// (physics/probe.h). Valid until the world is changed.
    std::span<const ContactReport> contacts() { return step_probe().contacts(); }
    /// What the joints of the robot bear in the same tick.
    std::vector<JointReaction> joint_reactions(RobotId robot) { return step_probe().joint_reactions(robot); }

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
    RayScene& ray_scene() override;
    StepProbe& step_probe() override;
    const RobotState& state_of(RobotId robot) override { return state(robot); }
    void changed();

    std::shared_ptr<const Model> model_;
    LocalRunOptions options_;
    WorldStepper stepper_;
    std::uint64_t seed_ = 0, given_ = 0;
    Tick tick_ = 0;
    std::vector<RobotState> states_;
    std::vector<Order> orders_;  // in canonical order
    std::vector<const RobotState*> pointers_;
    // made by the first question of a tick
    std::unique_ptr<RayScene> rays_;
    std::unique_ptr<StepProbe> probe_;
    bool rays_are_new_ = false, probe_is_new_ = false;
};

}  // namespace roboss
