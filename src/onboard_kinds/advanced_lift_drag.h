// AdvancedLiftDrag of Gazebo: the aerodynamics of a whole aeroplane, by stability derivatives. A force law:
// the dynamics evaluate it (physics/dynamics/fluid_forces.h), nothing is done once a tick.
#pragma once

#include <string>
#include <vector>

#include "math/vec3.h"
#include "onboard_kinds/kind.h"

namespace roboss {

/// Lift, drag, side force, rolling, pitching and yawing moment, as coefficients or their derivatives.
struct AeroCoefficients {
    double lift = 0,  ///< along -z of the stability axes
        drag = 0,     ///< along -x of the stability axes
        side = 0,     ///< along y
        roll = 0,     ///< moment about x
        pitch = 0,    ///< moment about y
        yaw = 0;      ///< moment about z
    /// Compares all members.
    friend bool operator==(const AeroCoefficients&, const AeroCoefficients&) = default;
};

/// A control surface: derivatives by its angle in degrees.
struct ControlSurfaceSpec {
    JointNames joint;            ///< of the surface
    int index = 0;               ///< Gazebo's number of it
    double direction = 1;        ///< sign of the angle
    AeroCoefficients by_degree;  ///< 1/degree

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"joint", "name"}, s.joint);
        visit({"index", "index"}, s.index);
        visit({"direction", "direction"}, s.direction);
        visit({"drag", "CD_ctrl"}, s.by_degree.drag);
        visit({"side", "CY_ctrl"}, s.by_degree.side);
        visit({"lift", "CL_ctrl"}, s.by_degree.lift);
        visit({"roll", "Cell_ctrl"}, s.by_degree.roll);
        visit({"pitch", "Cem_ctrl"}, s.by_degree.pitch);
        visit({"yaw", "Cen_ctrl"}, s.by_degree.yaw);
    }
    /// Compares all members.
    friend bool operator==(const ControlSurfaceSpec&, const ControlSurfaceSpec&) = default;
};

/// Names of the coefficients are those of the plugin: p, q, r are the roll, pitch and yaw rates.
struct AdvancedLiftDragSpec {
    LinkNames link;                            ///< that the flow pushes
    double lift_0 = 0,                         ///< lift at zero angle of attack
        drag_0 = 0,                            ///< drag without lift
        pitch_0 = 0;                           ///< moment at zero angle of attack
    AeroCoefficients by_alpha,                 ///< 1/rad, angle of attack
        by_beta,                               ///< 1/rad, angle of sideslip
        by_p,                                  ///< by the dimensionless rate of roll
        by_q,                                  ///< by the dimensionless rate of pitch
        by_r;                                  ///< by the dimensionless rate of yaw
    double alpha_stall = 1.5707963267948966,   ///< rad
        pitch_stall = 0,                       ///< 1/rad, slope of the pitching moment beyond stall
        aspect_ratio = 0,                      ///< span^2 / area
        chord = 0,                             ///< m, mean aerodynamic; 0: area / span
        efficiency = 0,                        ///< Oswald's, of the induced drag
        density = 1.2041,                      ///< kg/m^3, of the air
        area = 1;                              ///< m^2
    Vec3 centre,                               ///< m, of pressure, in the link's frame
        forward{1, 0, 0},                      ///< link axes
        upward{0, 0, 1};                       ///< link axes
    std::vector<ControlSurfaceSpec> surfaces;  ///< control surfaces

    /// Elements that have no effect.
    static constexpr IgnoredElement kIgnored[] = {
        {"a0", "0", "Gazebo does not read it either", "Write <CL0>."}};
    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 63,
                                       .name = "advanced-lift-drag",
                                       .phrase = "an advanced lift and drag",
                                       .classes = "AdvancedLiftDrag",
                                       .files = "advanced-lift-drag-system",
                                       .ignored = kIgnored};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"link", "link_name"}, s.link);
        visit({"lift_0", "CL0"}, s.lift_0);
        visit({"drag_0", "CD0"}, s.drag_0);
        visit({"pitch_0", "Cem0"}, s.pitch_0);
        visit({"lift_alpha", "CLa"}, s.by_alpha.lift);
        visit({"side_alpha", "CYa"}, s.by_alpha.side);
        visit({"roll_alpha", "Cella"}, s.by_alpha.roll);
        visit({"pitch_alpha", "Cema"}, s.by_alpha.pitch);
        visit({"yaw_alpha", "Cena"}, s.by_alpha.yaw);
        visit({"lift_beta", "CLb"}, s.by_beta.lift);
        visit({"side_beta", "CYb"}, s.by_beta.side);
        visit({"roll_beta", "Cellb"}, s.by_beta.roll);
        visit({"pitch_beta", "Cemb"}, s.by_beta.pitch);
        visit({"yaw_beta", "Cenb"}, s.by_beta.yaw);
        rates(visit, s.by_p, {"CDp", "CYp", "CLp", "Cellp", "Cemp", "Cenp"});
        rates(visit, s.by_q, {"CDq", "CYq", "CLq", "Cellq", "Cemq", "Cenq"});
        rates(visit, s.by_r, {"CDr", "CYr", "CLr", "Cellr", "Cemr", "Cenr"});
        visit({"alpha_stall", "alpha_stall"}, s.alpha_stall);
        visit({"pitch_stall", "Cema_stall"}, s.pitch_stall);
        visit({"aspect_ratio", "AR"}, s.aspect_ratio);
        visit({"chord", "mac", "m"}, s.chord);
        visit({"efficiency", "eff"}, s.efficiency);
        visit({"density", "air_density", "kg/m^3"}, s.density);
        visit({"area", "area", "m^2"}, s.area);
        visit({"centre", "cp", "m"}, s.centre);
        visit({"forward", "forward"}, s.forward);
        visit({"upward", "upward"}, s.upward);
        visit({"surfaces", "control_surface"}, s.surfaces);
    }
    /// It takes no command.
    std::vector<Channel> channels() const { return {}; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const;
    /// Compares all members.
    friend bool operator==(const AdvancedLiftDragSpec&, const AdvancedLiftDragSpec&) = default;

  private:
    struct Names {
        const char *drag, *side, *lift, *roll, *pitch, *yaw;
    };
    template <class Visitor, class Values>
    static void rates(Visitor&& visit, Values& values, const Names& names) {
        visit({names.drag, names.drag}, values.drag);
        visit({names.side, names.side}, values.side);
        visit({names.lift, names.lift}, values.lift);
        visit({names.roll, names.roll}, values.roll);
        visit({names.pitch, names.pitch}, values.pitch);
        visit({names.yaw, names.yaw}, values.yaw);
    }
};

}  // namespace roboss
