// See robot_energy.h.
#include "physics/dynamics/robot_energy.h"

#include <algorithm>
#include <cmath>

#include "math/spatial_shift.h"
#include "model/joint_motion.h"
#include "physics/dynamics/body_impulses.h"
#include "physics/dynamics/body_walk.h"

namespace roboss {
namespace {

/// I about the centre of mass from I about O: the parallel-axis theorem backwards.
Sym3 about_centre(const SpatialInertia& I, const Vec3& centre) {
    const double x = I.moment.x * centre.x, y = I.moment.y * centre.y, z = I.moment.z * centre.z;
    Sym3 a = I.inertia;
    a.xx -= y + z, a.yy -= x + z, a.zz -= x + y;
    a.xy += I.moment.x * centre.y, a.xz += I.moment.x * centre.z, a.yz += I.moment.y * centre.z;
    return a;
}

/// The inertia about O of bodies that were moved by `displacement`.
void move_inertia(const Vec3& displacement, SpatialInertia& I) {
    if (!(I.mass > 0)) return;
    const Vec3 centre = I.moment * (1.0 / I.mass);
    I = spatial_inertia(I.mass, centre + displacement, about_centre(I, centre));
}

/// Energy of the springs of a joint and of its soft limits, J.
double joint_potential(const Dof& dof, double q) {
    const double stretch = q - dof.spring_reference;
    double energy = 0.5 * dof.spring_stiffness * stretch * stretch;
    if (!std::isfinite(dof.limit_stiffness)) return energy;
    const double beyond = std::max(std::max(dof.lower - q, q - dof.upper), 0.0);
    return energy + 0.5 * dof.limit_stiffness * beyond * beyond;
}

/// x := I^-1 b by Cramer's rule. False if I is singular (a point, bodies on a line).
bool solve(const Sym3& I, const Vec3& b, Vec3& x) {
    constexpr double kSingular = 1e-12;  // of the trace cubed
    const Vec3 c0{I.yy * I.zz - I.yz * I.yz, I.xz * I.yz - I.xy * I.zz, I.xy * I.yz - I.xz * I.yy};
    const Vec3 c1{c0.y, I.xx * I.zz - I.xz * I.xz, I.xy * I.xz - I.xx * I.yz};
    const Vec3 c2{c0.z, c1.z, I.xx * I.yy - I.xy * I.xy};
    const double determinant = I.xx * c0.x + I.xy * c0.y + I.xz * c0.z;
    const double trace = I.xx + I.yy + I.zz;
    if (!(determinant > kSingular * trace * trace * trace)) return false;
    x = Vec3{dot(c0, b), dot(c1, b), dot(c2, b)} * (1.0 / determinant);
    return true;
}

}  // namespace

bool BodySums::rigid_motion(Spatial& motion) const {
    if (!(inertia.mass > 0)) return false;
    const Vec3 centre = inertia.moment * (1.0 / inertia.mass);
    const Vec3 velocity = momentum.linear * (1.0 / inertia.mass);
    if (!solve(about_centre(inertia, centre), momentum.angular - cross(centre, momentum.linear),
               motion.angular))
        return false;
    motion.linear = velocity - cross(motion.angular, centre);
    return true;
}

BodySums sum_placed_bodies(const Model& model, std::span<const double> q, std::span<const double> v,
                           const Vec3& origin, RobotWork& work, BodyWalk* walk) {
    const RobotType& type = *work.type;
    const Vec3 arm = work.origin - origin, gravity = gravity_of(model, type);
    BodySums sums;
    const auto terms_of = [&](std::size_t b) -> BodyWalk::Terms {
        const BodyWork& body = work.bodies[b];
        const Spatial momentum = body.inertia * body.velocity;
        const Vec3 heavy = body.X_WB * type.bodies[b].p_BG - origin;
        return {momentum, 0.5 * dot(momentum, body.velocity),
                type.bodies[b].gravity_mass * dot(gravity, heavy)};
    };
    const auto add = [&](std::size_t b, const BodyWalk::Terms& terms) {
        sums.momentum += terms.momentum;
        sums.kinetic += terms.kinetic;
        sums.inertia += work.bodies[b].inertia;
        sums.potential -= terms.potential;
    };
    if (walk != nullptr && walk->shares(type)) {  // no flows: compute_inertias would set the inertias alone
        std::vector<BodyWalk::Terms>& terms = walk->terms(type);
        walk->each_block(type, [&](std::size_t first, std::size_t last) {
            for (std::size_t b = first; b < last; ++b) {
                set_inertia(type.bodies[b], work.bodies[b]);
                terms[b] = terms_of(b);
            }
        });
        work.flows.clear();
        for (std::size_t b = 0; b < type.bodies.size(); ++b) add(b, terms[b]);
    } else {
        compute_inertias(type, work);
        for (std::size_t b = 0; b < type.bodies.size(); ++b) add(b, terms_of(b));
    }
    const std::span<const Dof> dofs = work.type->dofs;
    for (std::size_t d = 0; d < dofs.size(); ++d) {
        const Dof& dof = dofs[d];
        const double rate = v[d + static_cast<std::size_t>(type.base_nv())];
        sums.kinetic += 0.5 * dof.armature * rate * rate;
        const Body& body = type.bodies[static_cast<std::size_t>(dof.body)];
        if (joint_traits(body.joint).has_positions())
            sums.potential += joint_potential(dof, q[static_cast<std::size_t>(body.q_index)]);
    }
    if (arm == Vec3{}) return sums;
    sums.momentum = force_about(sums.momentum, -arm);
    move_inertia(arm, sums.inertia);
    return sums;
}

void translate(const Vec3& displacement, const Vec3& gravity, BodySums& sums) {
    sums.momentum.angular += cross(displacement, sums.momentum.linear);
    move_inertia(displacement, sums.inertia);
    sums.potential -= sums.inertia.mass * dot(gravity, displacement);
}

void add_motion(const Spatial& change, BodySums& sums) {
    const Spatial added = sums.inertia * change;
    sums.kinetic += dot(change, sums.momentum) + 0.5 * dot(added, change);
    sums.momentum += added;
}

void add_rigid_motion(const Spatial& motion, const Vec3& origin, double share, RobotState& state) {
    const Vec3 arm = Vec3{state.q[0], state.q[1], state.q[2]} - origin;
    const Vec3 at_base = motion.linear + cross(motion.angular, arm);
    for (std::size_t i = 0; i < 3; ++i)
        state.v[i] += share * motion.angular[i], state.v[i + 3] += share * at_base[i];
}

void Slowdown::apply(const RobotType& type, const Vec3& origin, RobotState& state) const {
    if (share == 1) return;
    for (double& x : state.v) x *= share;
    if (type.free_base) add_rigid_motion(rigid, origin, 1.0 - share, state);
}

Slowdown slowdown_to(double kinetic, const BodySums& sums, bool anchored) {
    Slowdown slowdown;
    if (!(sums.kinetic > kinetic)) return slowdown;
    double locked = 0;
    if (!anchored && sums.rigid_motion(slowdown.rigid))
        locked = 0.5 * dot(sums.inertia * slowdown.rigid, slowdown.rigid);
    else
        slowdown.rigid = {};
    const double inner = sums.kinetic - locked;
    slowdown.share = kinetic > locked && inner > 0 ? std::sqrt((kinetic - locked) / inner) : 0.0;
    return slowdown;
}

BodySums sum_bodies(const Model& model, std::span<const double> q, std::span<const double> v,
                    const Vec3& origin, RobotWork& work, BodyWalk* walk) {
    if (walk != nullptr) {
        walk->place(*work.type, q, work);
        walk->move(*work.type, v, work);
    } else {
        forward_kinematics<double>(*work.type, q, work);
        forward_velocities<double>(*work.type, v, work);
    }
    return sum_placed_bodies(model, q, v, origin, work, walk);
}

}  // namespace roboss
