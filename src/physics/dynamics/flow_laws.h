// What flowing air or water does to one link, as a function of the link's motion through it: wings,
// aeroplanes, and the damping of vehicles in water.
#pragma once

#include <array>
#include <span>

#include "math/spatial.h"
#include "onboard_kinds/onboard_spec.h"

namespace roboss {

/// Velocity of a link's origin through the fluid, and its angular velocity: m/s, rad/s, link axes.
struct FlowVelocity {
    Vec3 linear, angular;

    /// Component 0..5: x y z, then the angular velocity.
    double at(std::size_t i) const { return i < 3 ? linear[i] : angular[i - 3]; }
};

/// Matrix of a force (x y z, moment) by a motion (x y z, rotation), row by row.
using Matrix6 = std::array<double, 36>;

/// Force and moment at the link's origin, link axes, and how they brake: near the velocity v0 they are about
/// F - damping (v - v0). The damping is symmetric and takes energy; the step takes it implicitly, which keeps
/// the force's first order for any such matrix.
struct FlowForce {
    Vec3 force,  // N
        torque;  // N m
    Matrix6 damping{};

    /// Adds a force at a point.
    void push(const Vec3& f, const Vec3& p) { force += f, torque += cross(p, f); }
    /// Adds damping of the motion along `direction` of the point p, N s/m.
    void brake(double factor, const Vec3& direction, const Vec3& p) {
        add_damping(factor, direction, cross(p, direction));
    }
    /// Adds damping of the rotation about `axis`, N m s/rad.
    void brake_rotation(double factor, const Vec3& axis) { add_damping(factor, {}, axis); }

  private:
    void add_damping(double factor, const Vec3& f, const Vec3& t);
};

/// The coefficients of LiftDrag and how they change with the angle of attack.
struct WingCoefficients {
    double lift = 0, drag = 0, moment = 0,
           lift_slope = 0;  // 1/rad; 0 beyond stall, where it would feed the motion
};
/// At the angle of attack `alpha` (rad), with the square of the cosine of the sweep angle.
WingCoefficients wing_coefficients(const LiftDragSpec& spec, double alpha, double cos2_sweep);

/// `control_angle`: rad, of the control joint.
FlowForce lift_drag_force(const LiftDragSpec& spec, const FlowVelocity& flow, double control_angle);

/// `angles`: rad, of the control surfaces.
FlowForce aeroplane_force(const AdvancedLiftDragSpec& spec, const FlowVelocity& flow,
                          std::span<const double> angles);

/// Without what the added mass does.
FlowForce hull_force(const LighterThanAirSpec& spec, const FlowVelocity& flow);

/// Linear and quadratic damping of Hydrodynamics.
FlowForce water_damping(const HydrodynamicsSpec& spec, const FlowVelocity& flow);

}  // namespace roboss
