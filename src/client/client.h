// Client: the communication library (the paper's section 4.3). One API whether the world runs in this process
// or elsewhere: the whole state, orders on four levels, and sensors, which are computed here to relieve
// Simulators and network.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "client/events.h"
#include "client/held_samples.h"
#include "client/references.h"
#include "core/result.h"
#include "model/model.h"
#include "model/order.h"
#include "model/robot_state.h"
#include "physics/dynamics/kinematics.h"
#include "physics/probe.h"
#include "sensors/readings.h"
#include "wire/control.h"

namespace roboss {

/// Answer to a request to the run.
struct ControlAnswer {
    ControlAction request;                          ///< the request as it was sent
    ControlOutcome outcome;                         ///< its result, or the reason of its refusal
    bool done() const { return is_done(outcome); }  ///< false: the request was refused
};

/// A control program's view of the run: observed states, orders, requests to the run, and sensors.
///
/// Robots, links, joints and sensors are given by name or by id. A name that does not exist, and in queries
/// also an id that does not exist or a sensor of another kind, throws std::invalid_argument, which names what
/// was asked, what there is, and what was probably meant. If a ControlProgram does not catch it, the run ends
/// with that text.
class Client : private SensorSources {
  public:
    // --- the world
    // -------------------------------------------------------------------------------------------------
    virtual const Model& model() const = 0;  ///< the compiled world
    virtual Tick tick() const = 0;           // the tick observed now
    /// Simulated time of the observation since the start of the world, s.
    double time_s() const { return static_cast<double>(tick()) * model().dt_s; }
    /// The robot's whole state at tick().
    virtual const RobotState& state(RobotId robot) const = 0;
    virtual std::uint64_t seed() const = 0;  // of the run; for noise and for the program's own random numbers
    Transform pose(const RobotRef& robot, const LinkRef& link) const;  // X_WL
    Twist twist(const RobotRef& robot, const LinkRef& link) const;     // of the link's origin, world axes

    /// Of any joint, those that close a loop included.
    JointState joint(const RobotRef& robot, const JointRef& joint, int axis = 0) const;

    /// One number of an axis of a joint: the robot's own, or its type's.
    double joint_parameter(const RobotRef& robot, const JointRef& joint, JointParameter parameter,
                           int axis = 0) const;

    /// One number of a link: the robot's own, or its type's. nullopt: the link has none (no mass, no
    /// collision shapes).
    std::optional<double> link_parameter(const RobotRef& robot, const LinkRef& link,
                                         LinkParameter parameter) const;

    /// Gravity, m/s^2, and steady wind, m/s, that the robot feels: its own, or the world's; world axes.
    Vec3 gravity(const RobotRef& robot) const;
    Vec3 wind(const RobotRef& robot) const;

    // --- ids of names, for programs that look them up once. Each throws if there is no such name or id.
    RobotId robot(const RobotRef& robot) const;          ///< id of a robot
    const RobotType& type(const RobotRef& robot) const;  ///< its links, joints, sensors and commands
    LinkId link(const RobotRef& robot, const LinkRef& link) const;             ///< id of a link of the robot
    JointId joint_id(const RobotRef& robot, const JointRef& joint) const;      ///< id of a joint of the robot
    std::size_t sensor(const RobotRef& robot, const SensorRef& sensor) const;  ///< index of a sensor of it

    /// Messages on the world's message boards since the observation before this one: what happened to robots,
    /// and what was published on topics that no robot takes (docs/plugins.md). Of two messages on one topic,
    /// the last. The boards' states have them, so any Client sees the same, also in a replay.
    std::vector<RobotEvent> events() const;

    // --- orders, checked at once: an Error says what is wrong, and nothing is sent. The run reports
    // refusals, so a program may ignore the results.
    /// Puts the robot (SDF model) frame at X_WR; joint coordinates and all velocities stay.
    OrderResult set_pose(const RobotRef& robot, const Pose& X_WR);
    /// Velocity of the base's origin in m/s and angular velocity of the base in rad/s, both in world axes. An
    /// Error if the base is fixed.
    OrderResult set_velocity(const RobotRef& robot, const Vec3& linear, const Vec3& angular);
    /// Force in N at the link's centre of mass and torque in N m, both in world axes. They act for
    /// `duration_s`, in (0, 1e9], rounded to ticks, and for at least one tick.
    OrderResult apply_wrench(const RobotRef& robot, const LinkRef& link, const Vec3& force,
                             const Vec3& torque, double duration_s);
    /// Pulls a point of a link, p_L in the link's frame, to a point of the world, m, by a spring with damping
    /// of at most `max_force`, N, for `duration_s`, in (0, 1e9]. It replaces an earlier pull on this link;
    /// `max_force` 0 lets go. `rate`: natural frequency of the spring, rad/s.
    OrderResult pull(const RobotRef& robot, const LinkRef& link, const Vec3& p_L, const Vec3& target_W,
                     double max_force, double duration_s, double rate = 15);
    /// Converts seconds to ticks, at least one. An Error if it is not in (0, 1e9].
    Result<Tick> ticks_of(double duration_s) const;
    /// Setpoint of one axis of a joint; it holds until the next one. The mode gives the unit of `target`:
    /// kVelocity rad/s or m/s, kPosition rad or m, kEffort N m or N; kPassive ignores it. `max_effort` in N m
    /// or N bounds the motor; negative: the joint's own bound.
    OrderResult set_joint(const RobotRef& robot, const JointRef& joint, MotorMode mode, double target,
                          double max_effort = -1, int axis = 0);
    /// Puts a joint at a position (rad or m, one number for each axis; of a ball joint a rotation vector) and
    /// gives it a velocity (rad/s or m/s); what is empty is kept. Refused for joints that close loops
    /// ("loop-joint").
    OrderResult set_joint_state(const RobotRef& robot, const JointRef& joint, std::vector<double> position,
                                std::vector<double> velocity = {});
    /// Gives the robot own numbers of one axis of a joint: damping, springs, gains and bounds of its motor,
    /// limits (model/joint_parameters.h has names and units). Those that are not named stay; the two limits
    /// come together.
    OrderResult set_joint_parameters(const RobotRef& robot, const JointRef& joint,
                                     std::vector<JointParameterValue> values, int axis = 0);
    /// All numbers of the axis are those of its type again.
    OrderResult reset_joint_parameters(const RobotRef& robot, const JointRef& joint, int axis = 0);
    /// Gives the robot own numbers of one link: mass, centre of mass, inertia, friction, bounce
    /// (model/link_parameters.h has names and units). Those that are not named stay; the six numbers of an
    /// inertia come together.
    OrderResult set_link_parameters(const RobotRef& robot, const LinkRef& link,
                                    std::vector<LinkParameterValue> values);
    /// All numbers of the link are those of its type again.
    OrderResult reset_link_parameters(const RobotRef& robot, const LinkRef& link);
    /// Gives the robot own gravity, m/s^2, or an own steady wind, m/s, in place of the world's; world axes,
    /// at most 1000 in each.
    OrderResult set_gravity(const RobotRef& robot, const Vec3& gravity);
    OrderResult set_wind(const RobotRef& robot, const Vec3& wind);
    /// Gravity and wind are those of the world again.
    OrderResult reset_surroundings(const RobotRef& robot);
    /// Latches a command of the robot's on-board controllers, e.g. "cmd_vel"; `roboss check` lists names,
    /// values and units. Of a list: row by row.
    OrderResult command(const RobotRef& robot, const std::string& name, std::vector<double> values);
    /// The same to all robots that take a command at this topic of Gazebo, and to message boards. An Error if
    /// nobody does.
    OrderResult publish(const std::string& topic, const std::vector<double>& values);
    /// Attaches a link of `other` to a link of the robot, as they stand (model/order.h, Attach).
    OrderResult attach(const RobotRef& robot, const LinkRef& link, const RobotRef& other,
                       const LinkRef& other_link);
    /// Sends a message by a radio, at the tick at which orders of this observation take effect
    /// (docs/radio.md). `to`: the robot that it is for; none: everybody who hears it.
    OrderResult transmit(const RobotRef& robot, const SensorRef& radio, std::vector<std::uint8_t> payload,
                         std::optional<RobotRef> to = {});
    /// The same with the characters of a text.
    OrderResult transmit(const RobotRef& robot, const SensorRef& radio, std::string_view payload,
                         std::optional<RobotRef> to = {});
    /// Loosens the bonds by which the robot holds `other`.
    OrderResult detach(const RobotRef& robot, const RobotRef& other);
    /// Any of the kinds above as data (model/order.h). An Error says why check_order() refuses it.
    virtual Result<> order(RobotId robot, const Action& action) = 0;

    // --- control of the run itself (wire/control.h), as by `roboss control`: control(PauseRun{})
    /// A request takes effect at the end of the current window; its answer comes some time later.
    virtual void control(ControlAction request) = 0;
    /// The answers that have arrived since the last call.
    virtual std::vector<ControlAnswer> take_control_answers() = 0;

    // --- sensors: by name or by index into RobotType::sensors
    /// A reading with the sensor's noise, a pure function of (seed, robot, sensor, tick of the measurement).
    /// Units and frames: src/sensor_kinds. A sensor without `<update_rate>` measures when it is asked. One
    /// with it measures when it is asked for the first time, and from then on at the first observation at
    /// which a new sample is due (samples_begun), asked or not; in between it repeats that one.
    /// @throws std::invalid_argument if there is no such robot or sensor, if the sensor is of another kind,
    /// or if it cannot measure.
    template <class Reading>
    Reading reading(const RobotRef& robot, const SensorRef& sensor) {
        return std::get<Reading>(sample(this->robot(robot), sensor, kind_of_reading<Reading>()));
    }
    /// A new reading of a sensor of any kind, whatever its update rate: for a program that keeps the times
    /// itself. The sensor does not hold it.
    /// @throws std::invalid_argument as reading().
    Sample measure_afresh(const RobotRef& robot, const SensorRef& sensor) {
        return measure(this->robot(robot), this->sensor(robot, sensor));
    }
    /// reading<LaserReading>().
    LaserReading laser(const RobotRef& robot, const SensorRef& sensor) {
        return reading<LaserReading>(robot, sensor);
    }
    /// The image of a colour camera, reading<CameraReading>(). Cameras are measured whenever they are asked.
    CameraReading camera(const RobotRef& robot, const SensorRef& sensor) {
        return reading<CameraReading>(robot, sensor);
    }
    /// reading<OdometerReading>().
    OdometerReading odometer(const RobotRef& robot, const SensorRef& sensor) {
        return reading<OdometerReading>(robot, sensor);
    }
    /// reading<GpsReading>().
    GpsReading gps(const RobotRef& robot, const SensorRef& sensor) {
        return reading<GpsReading>(robot, sensor);
    }
    /// reading<CompassReading>().
    CompassReading compass(const RobotRef& robot, const SensorRef& sensor) {
        return reading<CompassReading>(robot, sensor);
    }
    /// reading<ImuReading>().
    ImuReading imu(const RobotRef& robot, const SensorRef& sensor) {
        return reading<ImuReading>(robot, sensor);
    }

    /// The messages that a radio received since the observation before this one, by time of arrival. A
    /// program that asks at each observation gets each message once.
    /// @throws std::invalid_argument as reading().
    virtual std::vector<RadioMessage> received(const RobotRef& robot, const SensorRef& radio);

    // --- forces, of the tick that begins now as long as no order takes effect at it (physics/probe.h). The
    // first question of a tick costs about as much as a step of the whole world.
    /// All contact points of the world that carry an impulse.
    std::span<const ContactReport> contacts();
    /// Reactions of the robot's joints.
    std::vector<JointReaction> joint_reactions(const RobotRef& robot);

    // --- the held samples of sensors with an <update_rate>, for saved runs
    /// The samples that were held before the observation at `tick`, as bytes; empty: none.
    std::string samples_before(Tick tick) const { return samples_.bytes_before(tick); }
    /// Replaces the held samples by those of samples_before(). An Error if the bytes are damaged, or if a
    /// sensor is missing or of another kind in this world; it changes nothing.
    Result<> restore_samples(const std::string& bytes);

  protected:
    /// What a question asks of a state. A device may know one and not the other.
    enum class StatePart { kPose, kTwist, kJoints };
    /// state(), for a question that needs only this part of it.
    virtual const RobotState& state_with(StatePart, RobotId robot) const { return state(robot); }
    /// A reading of the sensor at tick(). Throws if it cannot measure.
    virtual Sample measure(RobotId robot, std::size_t sensor);
    /// What cameras see at the observed tick; an Error, "no-look", where no visuals are at hand.
    Result<const CameraScene*> camera_scene() override { return SensorSources::camera_scene(); }
    /// The robot; throws if there is none.
    const Robot& known(RobotId robot) const;
    /// Tick of the observation before this one; of the first one, where it would have been.
    virtual Tick observed_before() const { return tick(); }
    /// Implementations call it when a new observation is shown.
    void renew_samples();
    /// Implementations call it when the run went back in time: what was measured is of a discarded time.
    void forget_measured();
    /// The scene for rays at the observed tick; built when the first sensor of a tick asks.
    RayScene& ray_scene() override = 0;

  private:
    StepProbe& step_probe() override;
    const RobotState& state_of(RobotId robot) override { return state(robot); }
    /// Keeps a refusal for the report of the run.
    virtual Error report_refusal(Error error) { return error; }
    RobotId id_for_order(const RobotRef& robot) const;
    const Joint& axis_of_joint(RobotId robot, JointId joint, int axis) const;
    JointId joint_for_order(RobotId robot, const JointRef& joint) const;
    LinkId link_for_order(RobotId robot, const LinkRef& link) const;
    RobotId robot_named(const std::string& name) const;
    Sample sample(RobotId robot, const SensorRef& sensor, const SensorKind& asked);
    HeldSamples samples_;
    std::unique_ptr<StepProbe> probe_;                            // made by the first question
    mutable std::unordered_map<std::string, RobotId> robot_ids_;  // made by the first question by name
};

}  // namespace roboss
