// RunAccess: a run as a program sees it at a tick, wherever it is stepped: states, sensors, contacts, orders.
// LocalRun is one in this process, RemoteRun one on a cluster; RobotSet shows either as arrays.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "core/result.h"
#include "model/order.h"
#include "physics/probe.h"
#include "render/visuals_of.h"
#include "sensors/readings.h"

namespace roboss {

/// See the top of the file. Not for use by several threads at once.
class RunAccess : private SensorSources {
  public:
    /// Of this world.
    explicit RunAccess(std::shared_ptr<const Model> model);
    ~RunAccess() override;

    const Model& model() const { return *model_; }                               ///< the compiled world
    const std::shared_ptr<const Model>& shared_model() const { return model_; }  ///< the same
    virtual Tick tick() const = 0;           ///< the world is at its beginning
    virtual std::uint64_t seed() const = 0;  ///< of sensor noise
    /// Threads that cast the rays of sensors. No bit depends on it.
    virtual unsigned ray_threads() const { return 1; }
    /// Simulated time since the start of the world, s.
    double time_s() const { return static_cast<double>(tick()) * model_->dt_s; }
    /// All states at tick(), by RobotId.
    virtual const std::vector<RobotState>& states() const = 0;
    /// The robot's state at tick(); the robot must exist.
    const RobotState& state(RobotId robot) const { return states()[robot.index()]; }
    /// Hash of the model and all states, as `roboss run` reports it.
    std::uint64_t hash() const;

    /// Orders for several robots, in this order, or, if one is refused, none; their ticks, Clients and
    /// sequences do not count. An Error says why check_order() refuses it.
    virtual Result<> order(std::vector<Order> orders) = 0;
    /// Changes a state: at once where the run is in this process, else as an order.
    virtual Result<> change(RobotId robot, const Action& action) = 0;

    /// Reading of sensor number `sensor` (RobotType::sensors) at tick(), with noise. `<update_rate>` has no
    /// effect: each call measures. Returns an Error if there is no such robot or sensor, or if the sensor
    /// cannot measure.
    Result<Sample> read(RobotId robot, std::size_t sensor);
    /// The messages that a radio received since the last call for it, or since the run began, was reset or
    /// restored; by time of arrival. Messages are kept for a second (docs/radio.md): ask as often. An Error
    /// as read(). read() gives all that are still kept.
    Result<std::vector<RadioMessage>> received(RobotId robot, std::size_t sensor);
    /// As read(), of several robots, in their order; lasers and other sensors of rays on all threads.
    /// `sensors`: one for each robot.
    std::vector<Result<Sample>> read_all(std::span<const std::uint32_t> robots,
                                         std::span<const std::size_t> sensors);
    /// All contact points of the tick that begins at tick(), as long as no order takes effect at it
    /// (physics/probe.h). Valid until the world is changed.
    std::span<const ContactReport> contacts() { return step_probe().contacts(); }
    /// Sets the visuals that cameras render, and the number of threads that render them. Before, cameras
    /// cannot be read.
    void set_visuals(render::VisualsOf visuals, unsigned threads);
    /// What cameras see at tick(). Valid until the world is changed.
    Result<const CameraScene*> camera_scene() override;
    /// The colours of what a camera at X_WC (x ahead, y left, z up) sees at tick(), with the lens of
    /// `optics`: rows x columns x 3. Errors are those of cameras that are read.
    Result<Image<std::uint8_t>> picture(const Transform& X_WC, const CameraOptics& optics);
    /// What rays meet at tick(). Valid until the world is changed.
    const RayScene& shapes() { return ray_scene(); }
    /// Another number whenever the states are others than before.
    std::uint64_t version() const { return version_; }
    /// What the joints of the robot bear in the same tick.
    std::vector<JointReaction> joint_reactions(RobotId robot) { return step_probe().joint_reactions(robot); }

  protected:
    /// States are others than before.
    void changed() { rays_are_new_ = probe_is_new_ = cameras_are_new_ = false, ++version_; }
    /// What arrived up to tick() was received in another time: after a reset, a rewind, a restore.
    void forget_received() { heard_.clear(), heard_from_ = tick(); }

  private:
    RayScene& ray_scene() override;
    StepProbe& step_probe() override;
    const RobotState& state_of(RobotId robot) override { return state(robot); }
    std::vector<const RobotState*> pointers() const;

    std::shared_ptr<const Model> model_;
    // made by the first question of a tick
    std::unique_ptr<RayScene> rays_;
    std::unique_ptr<StepProbe> probe_;
    std::unique_ptr<CameraScene> cameras_;
    render::VisualsOf visuals_;
    unsigned camera_threads_ = 1;
    bool rays_are_new_ = false, probe_is_new_ = false, cameras_are_new_ = false;
    std::uint64_t version_ = 1;
    std::map<std::pair<RobotId, std::size_t>, Tick> heard_;  // up to where a radio was asked
    Tick heard_from_ = 0;                                    // of those that were not
};

}  // namespace roboss
