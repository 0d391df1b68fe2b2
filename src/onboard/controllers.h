// What each kind of on-board controller does in a tick: one function and one file a kind. A kind may also
// have `rests`: whether it would change nothing while its robot is at rest (without it, it does not).
#pragma once

#include "onboard/onboard_context.h"

namespace roboss {

void run(const AckermannSteeringSpec& spec, OnboardContext& c);
void run(const ApplyLinkWrenchSpec& spec, OnboardContext& c);
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

}  // namespace roboss
