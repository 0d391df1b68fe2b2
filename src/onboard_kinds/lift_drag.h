// LiftDrag of Gazebo: lift, drag and pitching moment of a wing, fin, sail or blade. A force law: the dynamics
// evaluate it (physics/dynamics/fluid_forces.h), nothing is done once a tick.
#pragma once

#include <string>
#include <vector>

#include "math/vec3.h"
#include "onboard_kinds/kind.h"

namespace roboss {

/// Coefficients are linear in the angle of attack up to stall, and linear with another slope beyond.
struct LiftDragSpec {
    LinkNames link;                        ///< that the flow pushes
    JointNames control_joint;              ///< whose angle adds lift; at most one
    double density = 1.2041,               ///< kg/m^3, of the fluid
        area = 1,                          ///< m^2
        a0 = 0,                            ///< rad, angle of attack at rest
        cla = 1,                           ///< 1/rad, slope of lift
        cda = 0.01,                        ///< 1/rad, slope of drag
        cma = 0,                           ///< m/rad, slope of the moment
        alpha_stall = 1.5707963267948966,  ///< rad
        cla_stall = 0,                     ///< 1/rad, beyond stall
        cda_stall = 1,                     ///< 1/rad, beyond stall
        cma_stall = 0,                     ///< m/rad, beyond stall
        cm_delta = 0,                      ///< m/rad, moment by the angle of the control joint
        control_lift = 4;                  ///< 1/rad, lift by the angle of the control joint
    Vec3 centre,                           ///< m, of pressure, in the link's frame
        forward{1, 0, 0},                  ///< link axes
        upward{0, 0, 1};                   ///< link axes
    bool radial_symmetry = false,          ///< a body of revolution about `forward`
        reversible = false;                ///< acts in flow from behind too

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 62,
                                       .name = "lift-drag",
                                       .phrase = "a lift and drag",
                                       .classes = "LiftDrag",
                                       .files = "lift-drag-system"};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"link", "link_name"}, s.link);
        visit({"control_joint", "control_joint_name"}, s.control_joint);
        visit({"density", "air_density", "kg/m^3"}, s.density);
        visit({"area", "area", "m^2"}, s.area);
        visit({"a0", "a0"}, s.a0);
        visit({"cla", "cla"}, s.cla);
        visit({"cda", "cda"}, s.cda);
        visit({"cma", "cma"}, s.cma);
        visit({"alpha_stall", "alpha_stall"}, s.alpha_stall);
        visit({"cla_stall", "cla_stall"}, s.cla_stall);
        visit({"cda_stall", "cda_stall"}, s.cda_stall);
        visit({"cma_stall", "cma_stall"}, s.cma_stall);
        visit({"cm_delta", "cm_delta"}, s.cm_delta);
        visit({"control_lift", "control_joint_rad_to_cl"}, s.control_lift);
        visit({"centre", "cp", "m"}, s.centre);
        visit({"forward", "forward"}, s.forward);
        visit({"upward", "upward"}, s.upward);
        visit({"radial_symmetry", "radial_symmetry"}, s.radial_symmetry);
        visit({"reversible", "reversible"}, s.reversible);
    }
    /// It takes no command.
    std::vector<Channel> channels() const { return {}; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const;
    /// Compares all members.
    friend bool operator==(const LiftDragSpec&, const LiftDragSpec&) = default;
};

}  // namespace roboss
