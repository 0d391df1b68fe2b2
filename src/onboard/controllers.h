// What each kind of on-board controller does in a tick: one function and one file a kind. A kind may also
// have `rests`: whether it would change nothing while its robot is at rest (without it, it does not).
#pragma once

#include "onboard/onboard_context.h"

namespace roboss {

void run(const VelocityControlSpec& spec, OnboardContext& c);

// Air and water. Force laws are evaluated by the dynamics (physics/dynamics/fluid_forces.h).
void run(const MotorModelSpec& spec, OnboardContext& c);
void run(const MulticopterControlSpec& spec, OnboardContext& c);
void run(const ThrusterSpec& spec, OnboardContext& c);
void run(const BuoyancyEngineSpec& spec, OnboardContext& c);
void run(const WindEffectsSpec& spec, OnboardContext& c);
inline void run(const LiftDragSpec&, OnboardContext&) {}
inline void run(const AdvancedLiftDragSpec&, OnboardContext&) {}
inline void run(const HydrodynamicsSpec&, OnboardContext&) {}

}  // namespace roboss
