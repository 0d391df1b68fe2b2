// OnboardSpec: an on-board controller of a model with the parameters of its kind. Here a kind is registered;
// hash, wire, SDF, checks and Clients reach all kinds through the list below (ARCHITECTURE.md, "A new
// on-board controller").
#pragma once

#include <concepts>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/diagnostics.h"
#include "onboard_kinds/ackermann_steering.h"
#include "onboard_kinds/actor.h"
#include "onboard_kinds/advanced_lift_drag.h"
#include "onboard_kinds/apply_joint_force.h"
#include "onboard_kinds/apply_link_wrench.h"
#include "onboard_kinds/audio_source.h"
#include "onboard_kinds/breadcrumbs.h"
#include "onboard_kinds/buoyancy_engine.h"
#include "onboard_kinds/command_timeout.h"
#include "onboard_kinds/detachable_joint.h"
#include "onboard_kinds/diff_drive.h"
#include "onboard_kinds/drive_to_pose.h"
#include "onboard_kinds/elevator.h"
#include "onboard_kinds/follow_actor.h"
#include "onboard_kinds/gripper.h"
#include "onboard_kinds/hydrodynamics.h"
#include "onboard_kinds/joint_controller.h"
#include "onboard_kinds/joint_pose_trajectory.h"
#include "onboard_kinds/joint_position_controller.h"
#include "onboard_kinds/joint_trajectory_controller.h"
#include "onboard_kinds/kind.h"
#include "onboard_kinds/kinetic_energy_monitor.h"
#include "onboard_kinds/lift_drag.h"
#include "onboard_kinds/lighter_than_air.h"
#include "onboard_kinds/linear_battery.h"
#include "onboard_kinds/lookup_wheel_slip.h"
#include "onboard_kinds/mecanum_drive.h"
#include "onboard_kinds/message_board.h"
#include "onboard_kinds/motor_model.h"
#include "onboard_kinds/multicopter_control.h"
#include "onboard_kinds/planar_move.h"
#include "onboard_kinds/ros_ackermann.h"
#include "onboard_kinds/ros_diff_drive.h"
#include "onboard_kinds/surface_velocity.h"
#include "onboard_kinds/thruster.h"
#include "onboard_kinds/track_controller.h"
#include "onboard_kinds/tracked_vehicle.h"
#include "onboard_kinds/trajectory_follower.h"
#include "onboard_kinds/velocity_control.h"
#include "onboard_kinds/wheel_slip.h"
#include "onboard_kinds/wind_effects.h"

namespace roboss {

/// Parameters of any kind. The order does not count; the number of each kind does.
using OnboardParameters =
    std::variant<VelocityControlSpec, DiffDriveSpec, AckermannSteeringSpec, MecanumDriveSpec,
                 TrackedVehicleSpec, RosDiffDriveSpec, RosSkidSteerSpec, RosAckermannSpec, DriveToPoseSpec,
                 TrajectoryFollowerSpec, ApplyLinkWrenchSpec, PlanarMoveSpec, JointControllerSpec,
                 JointPositionControllerSpec, JointTrajectoryControllerSpec, ApplyJointForceSpec,
                 JointPoseTrajectorySpec, LinearBatterySpec, KineticEnergyMonitorSpec, DetachableJointSpec,
                 GripperSpec, MotorModelSpec, MulticopterControlSpec, LiftDragSpec, AdvancedLiftDragSpec,
                 ThrusterSpec, BuoyancyEngineSpec, HydrodynamicsSpec, WindEffectsSpec, TrackControllerSpec,
                 SurfaceVelocitySpec, ActorSpec, MessageBoardSpec, WheelSlipSpec, LookupWheelSlipSpec,
                 LighterThanAirSpec, AudioSourceSpec, BreadcrumbsSpec, CrumbSpec, ElevatorSpec,
                 FollowActorSpec, CommandTimeoutSpec>;

/// An on-board controller of a model.
struct OnboardSpec {
    std::string name;              ///< of the plugin, as in the file
    OnboardParameters parameters;  ///< of its kind
    SourceLocation where;          ///< in the file

    /// A controller of the first kind with its defaults.
    OnboardSpec();
    /// A controller of the kind of its parameters.
    OnboardSpec(std::string name, OnboardParameters parameters, SourceLocation where);
    // Copies are compiled in onboard_spec.cpp only: 42 kinds take seconds in each file that copies a World.
    OnboardSpec(const OnboardSpec& other);
    OnboardSpec(OnboardSpec&& other) noexcept;
    OnboardSpec& operator=(const OnboardSpec& other);
    OnboardSpec& operator=(OnboardSpec&& other) noexcept;
    ~OnboardSpec();

    /// The kind that it is of.
    const OnboardKind& kind() const;
};

/// A parameter that is a list of records: a struct with parameters of its own, for which the element of the
/// parameter is repeated.
template <class T>
concept ParameterRecord = requires(T& record) {
    T::parameters([](const Parameter&, auto&) {}, record);
};

/// Calls visitor(Parameter, value) for each parameter, always in the same order. Values are double, int,
/// bool, std::string, Vec3, Pose, JointNames, LinkNames, vectors of double or string, and vectors of records.
template <class Visitor>
void visit_parameters(const OnboardParameters& parameters, Visitor&& visitor) {
    std::visit([&](const auto& p) { p.parameters(visitor, p); }, parameters);
}
/// The same with values that may be changed.
template <class Visitor>
void visit_parameters(OnboardParameters& parameters, Visitor&& visitor) {
    std::visit([&](auto& p) { p.parameters(visitor, p); }, parameters);
}

/// Calls visit(std::in_place_type<Kind>) for each kind.
template <class Visit>
void for_each_onboard_kind(Visit&& visit) {
    [&]<class... Kinds>(std::in_place_type_t<std::variant<Kinds...>>) {
        (visit(std::in_place_type<Kinds>), ...);
    }(std::in_place_type<OnboardParameters>);
}

/// The joints that it names, in the order of its parameters.
std::vector<std::string> joints_named(const OnboardParameters& parameters);
/// The links that it names, in the order of its parameters.
std::vector<std::string> links_named(const OnboardParameters& parameters);

/// The links whose surfaces it moves.
std::vector<std::string> surfaces_moved(const OnboardParameters& parameters);

/// Whether it is a force law, which the dynamics evaluate in place of its `run`.
bool is_force_law(const OnboardParameters& parameters);

/// The commands that it takes, in the order in which it counts them.
std::vector<Channel> channels_of(const OnboardParameters& parameters);
/// Names of channels of the same robot that it commands itself; a kind may have none.
std::vector<std::string> channels_commanded(const OnboardParameters& parameters);
/// Its memory at the start, behind its commands; empty: it remembers nothing.
std::vector<double> memory_at_start(const OnboardParameters& parameters);

/// The controllers that a plugin becomes: most kinds are one, a kind with parts() is as many.
std::vector<OnboardParameters> parts_of(const OnboardParameters& parameters);
/// Whether the kind is a plugin of the world, which acts on its models.
bool is_of_world(const OnboardParameters& parameters);
/// The controllers that a plugin of the world means for one of its models.
std::vector<OnboardParameters> controllers_for(const OnboardParameters& parameters, const std::string& world,
                                               const std::string& model);

/// Why it cannot work; empty: it can.
std::vector<OnboardProblem> problems_of(const OnboardSpec& spec);

}  // namespace roboss
