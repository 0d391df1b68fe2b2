// What each kind of on-board controller does in a tick: one function and one file a kind. A kind may also
// have `rests`: whether it would change nothing while its robot is at rest (without it, it does not).
#pragma once

#include "onboard/onboard_context.h"

namespace roboss {

void run(const AckermannSteeringSpec& spec, OnboardContext& c);
void run(const ApplyLinkWrenchSpec& spec, OnboardContext& c);
void run(const CommandTimeoutSpec& spec, OnboardContext& c);
void run(const DiffDriveSpec& spec, OnboardContext& c);
void run(const DriveToPoseSpec& spec, OnboardContext& c);
void run(const MecanumDriveSpec& spec, OnboardContext& c);
void run(const PlanarMoveSpec& spec, OnboardContext& c);
void run(const RosAckermannSpec& spec, OnboardContext& c);
void run(const RosDiffDriveSpec& spec, OnboardContext& c);
void run(const RosSkidSteerSpec& spec, OnboardContext& c);
void run(const TrackedVehicleSpec& spec, OnboardContext& c);
void run(const TrajectoryFollowerSpec& spec, OnboardContext& c);
void run(const VelocityControlSpec& spec, OnboardContext& c);
void run(const JointControllerSpec& spec, OnboardContext& c);
void run(const JointPositionControllerSpec& spec, OnboardContext& c);
void run(const JointTrajectoryControllerSpec& spec, OnboardContext& c);
void run(const ApplyJointForceSpec& spec, OnboardContext& c);
void run(const JointPoseTrajectorySpec& spec, OnboardContext& c);
void run(const LinearBatterySpec& spec, OnboardContext& c);
void run(const KineticEnergyMonitorSpec& spec, OnboardContext& c);

/// Whether a battery of the robot is empty.
bool is_out_of_power(OnboardContext& c);
/// The commanded position or velocity of a joint; `initial` before the first command. `actuator`: its place
/// where the command is a list of all actuators.
double joint_target(bool use_actuator_msg, int actuator, double initial, const OnboardContext& c);
void run(const DetachableJointSpec& spec, OnboardContext& c);
void run(const GripperSpec& spec, OnboardContext& c);

// Air and water. Force laws are evaluated by the dynamics (physics/dynamics/fluid_forces.h).
void run(const MotorModelSpec& spec, OnboardContext& c);
void run(const MulticopterControlSpec& spec, OnboardContext& c);
void run(const ThrusterSpec& spec, OnboardContext& c);
void run(const BuoyancyEngineSpec& spec, OnboardContext& c);
void run(const WindEffectsSpec& spec, OnboardContext& c);
inline void run(const LiftDragSpec&, OnboardContext&) {}
inline void run(const AdvancedLiftDragSpec&, OnboardContext&) {}
inline void run(const HydrodynamicsSpec&, OnboardContext&) {}
inline void run(const LighterThanAirSpec&, OnboardContext&) {}
/// Nothing: contacts read it (physics/contact/wheel_slip.h).
inline void run(const WheelSlipSpec&, OnboardContext&) {}
void run(const LookupWheelSlipSpec& spec, OnboardContext& c);
void run(const TrackControllerSpec& spec, OnboardContext& c);
void run(const SurfaceVelocitySpec& spec, OnboardContext& c);
void run(const ActorSpec& spec, OnboardContext& c);
void run(const AudioSourceSpec& spec, OnboardContext& c);
void run(const FollowActorSpec& spec, OnboardContext& c);
void run(const ElevatorSpec& spec, OnboardContext& c);
void run(const BreadcrumbsSpec& spec, OnboardContext& c);
void run(const CrumbSpec& spec, OnboardContext& c);
/// Nothing: a control program reacts to the messages (onboard_kinds/message_board.h).
inline void run(const MessageBoardSpec&, OnboardContext&) {}

}  // namespace roboss
