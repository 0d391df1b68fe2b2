// Energy and momentum of robots, exact sums over their links' own masses and motions, from (Model,
// RobotState) alone: the mass matrix that is under test takes no part. Potential energy: gravity, joint
// springs, soft joint limits. Not included: soft contacts.
#pragma once

#include <cmath>
#include <vector>

#include "model/loop_closure.h"
#include "physics/dynamics/robot_work.h"

namespace roboss::test {

struct MechanicalSums {
    double mass = 0;
    double kinetic = 0;    // J, rotor inertias included
    double stored = 0;     // J, in springs and soft limits; at least 0
    double potential = 0;  // J, of gravity, against the world's origin
    Vec3 linear;           // N s
    Vec3 angular;          // N m s about the world's origin; rotor inertias carry none
    Vec3 first_moment;     // kg m: mass times the common centre
    // What the links' momenta amount to without their signs, about the common centre: the scale of an error.
    double linear_scale = 0, angular_scale = 0;

    double energy() const { return kinetic + stored + potential; }
    Vec3 centre() const { return mass > 0 ? first_moment / mass : Vec3{}; }
    /// Angular momentum about the common centre.
    Vec3 spin() const { return angular - cross(centre(), linear); }
};

/// Sums over robots. Keeps its buffers; one a thread.
class MechanicalSummer {
  public:
    explicit MechanicalSummer(const Model& model) : model_(model) {}

    /// All robots of the world, states by RobotId.
    MechanicalSums operator()(const std::vector<RobotState>& states) {
        clear();
        for (std::size_t r = 0; r < states.size(); ++r) add(model_.type_of(RobotId(r)), states[r]);
        add_scales();
        return sums_;
    }
    /// One robot.
    MechanicalSums of(RobotId robot, const RobotState& state) {
        clear();
        add(model_.type_of(robot), state);
        add_scales();
        return sums_;
    }

  private:
    struct LinkMotion {
        Vec3 centre, momentum, spin;
    };

    void clear() {
        sums_ = {};
        motions_.clear();
    }

    void add(const RobotType& type, const RobotState& state) {
        forward_kinematics<double>(type, state.q, work_);
        forward_velocities<double>(type, state.v, work_);
        for (const Link& link : type.links)
            if (link.body >= 0) add_link(link);
        for (const Dof& dof : type.dofs) add_rotor_and_springs(type, state, dof);
        for (const LoopJoint& loop : type.loops) add_loop_springs(state, loop);
    }

    void add_link(const Link& link) {
        const BodyWork& body = work_.bodies[static_cast<std::size_t>(link.body)];
        const Vec3 arm = body.X_WB * link.p_BC - work_.origin;
        const Vec3 v = body.velocity.linear + cross(body.velocity.angular, arm);
        const Vec3 turning_B = transpose_times(body.X_WB.R, body.velocity.angular);
        const Vec3 spin_B = link.inertia_C * turning_B;
        const LinkMotion motion{work_.origin + arm, v * link.mass, body.X_WB.R * spin_B};
        sums_.mass += link.mass;
        sums_.kinetic += 0.5 * link.mass * norm_squared(v) + 0.5 * dot(turning_B, spin_B);
        if (link.gravity) sums_.potential -= link.mass * dot(model_.gravity, motion.centre);
        sums_.linear += motion.momentum;
        sums_.angular += cross(motion.centre, motion.momentum) + motion.spin;
        sums_.first_moment += motion.centre * link.mass;
        motions_.push_back(motion);
    }

    void add_rotor_and_springs(const RobotType& type, const RobotState& state, const Dof& dof) {
        const Body& body = type.bodies[static_cast<std::size_t>(dof.body)];
        if (body.nv != 1) return;  // a ball joint has neither
        const double v = state.v[static_cast<std::size_t>(body.v_index)];
        sums_.kinetic += 0.5 * dof.armature * v * v;
        add_springs(dof, state.q[static_cast<std::size_t>(body.q_index)]);
    }

    void add_springs(const Dof& dof, double q) {
        const auto stored = [](double stiffness, double way) { return 0.5 * stiffness * way * way; };
        sums_.stored += stored(dof.spring_stiffness, q - dof.spring_reference);
        if (!std::isfinite(dof.limit_stiffness)) return;
        sums_.stored += stored(dof.limit_stiffness, std::fmax(0.0, dof.lower - q));
        sums_.stored += stored(dof.limit_stiffness, std::fmax(0.0, q - dof.upper));
    }

    void add_loop_springs(const RobotState& state, const LoopJoint& loop) {
        const auto placed = [&](int b) {
            return b < 0 ? to_transform(base_pose(state)) : work_.bodies[static_cast<std::size_t>(b)].X_WB;
        };
        const FreeDirections free = free_directions(loop, placed(loop.body_a), placed(loop.body_b));
        if (free.count == 3) return;  // a ball joint
        for (std::size_t k = 0; k < free.count; ++k) add_springs(loop.dofs[k], free.directions[k].position);
    }

    void add_scales() {
        const Vec3 centre = sums_.centre();
        for (const LinkMotion& m : motions_) {
            sums_.linear_scale += norm(m.momentum);
            sums_.angular_scale += norm(cross(m.centre - centre, m.momentum)) + norm(m.spin);
        }
    }

    const Model& model_;
    RobotWork work_;
    MechanicalSums sums_;
    std::vector<LinkMotion> motions_;
};

}  // namespace roboss::test
