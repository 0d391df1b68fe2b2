// See soft_body.h.
#include "physics/soft/soft_body.h"

#include <cmath>

#include "model/coordinates.h"
#include "physics/dynamics/body_impulses.h"
#include "physics/dynamics/lone_body.h"

namespace roboss::soft {
namespace {

Motion motion_of(const Vec3& linear, const Vec3& turning) {
    return {{linear.x, linear.y, linear.z, turning.x, turning.y, turning.z, 0, 0}};
}
Vec3 linear_of(const Motion& m) {
    return {m.x[0], m.x[1], m.x[2]};
}
Vec3 turning_of(const Motion& m) {
    return {m.x[3], m.x[4], m.x[5]};
}

/// A with A A^T = I (Cholesky). False if there is none.
bool take_root(const Sym3& I, Body& body) {
    const double d1 = I.xx;
    if (!(d1 > 0)) return false;
    const double a11 = std::sqrt(d1), i11 = 1 / a11, a21 = I.xy * i11, a31 = I.xz * i11;
    const double d2 = I.yy - a21 * a21;
    if (!(d2 > 0)) return false;
    const double a22 = std::sqrt(d2), i22 = 1 / a22, a32 = (I.yz - a21 * a31) * i22;
    const double d3 = (I.zz - a31 * a31) - a32 * a32;
    if (!(d3 > 0)) return false;
    const double a33 = std::sqrt(d3);
    body.a_1 = {a11, 0, 0}, body.a_2 = {a21, a22, 0}, body.a_3 = {a31, a32, a33};
    body.inverse = {i11, i22, 1 / a33};
    return true;
}

}  // namespace

bool may_be_soft(const RobotType& type) {
    if (type.nv == 0) return true;
    return is_free_body(type) && type.bodies.size() == 1 && !type.has_equalities() && type.drags.empty() &&
           !type.feels_flow;
}

bool take_body(RobotWork& robot, Body& body) {
    const roboss::Body& info = robot.type->bodies[0];
    const BodyWork& placed = robot.bodies[0];
    body.robot = &robot, body.touched = false;
    body.mass = info.mass;
    if (!(body.mass > 0) || !take_root(rotated_inertia(info, placed), body)) return false;
    body.inverse_mass = 1 / body.mass;
    body.centre = robot.origin + placed.centre;
    body.angular = placed.velocity.angular;
    body.linear = placed.velocity.linear + cross(body.angular, placed.centre);
    return true;
}

Motion kick_of(const Model& model, const Body& body, double h) {
    const RobotWork& robot = *body.robot;
    const roboss::Body& info = robot.type->bodies[0];
    Vec3 force = gravity_of(model, *robot.type) * info.gravity_mass, torque;
    if (info.gravity_mass != info.mass) torque = cross(robot.bodies[0].X_WB * info.p_BG - body.centre, force);
    for (const TimedWrench& w : robot.state->wrenches) {
        const Link& link = robot.type->links[w.link.index()];
        if (link.body < 0) continue;
        force += w.force;
        torque += w.torque + cross(robot.bodies[0].X_WB * link.p_BC - body.centre, w.force);
    }
    return motion_of(force * (body.inverse_mass * h), body.turned_by(torque * h));
}

Motion velocity_of(const Body& body) {
    return motion_of(body.linear, body.whitened(body.angular));
}

void put_motion(const Motion& motion, const Body& body, double factor, std::span<double> to) {
    const Vec3 angular = body.turning(turning_of(motion)),
               linear = linear_of(motion) - cross(angular, body.robot->bodies[0].centre);
    for (std::size_t i = 0; i < 3; ++i) to[i] = factor * angular[i], to[3 + i] = factor * linear[i];
}

void move_body(const Motion& velocity, const Motion& moved, double dt, const Body& body) {
    RobotState& state = *body.robot->state;
    const roboss::Body& info = body.robot->type->bodies[0];
    const Vec3 momentum = body.angular_momentum(turning_of(velocity));
    const auto turned = [&](const Vec3& by) {
        return normalized(exponential(by) * get_quat(state.q.data() + 3));
    };
    const auto spin = [&](const Quat& q) {
        BodyWork after;
        after.X_WB.R = to_matrix(q);
        const Sym3 inertia = rotated_inertia(info, after);
        Body there;
        return take_root(inertia, there) ? there.turning(there.turned_by(momentum)) : body.angular;
    };
    // The body turns by the mean of its velocities at both ends, with the angular momentum that it has at the
    // end.
    const Vec3 turn = body.turning(turning_of(moved)), before = body.turning(turning_of(velocity));
    const Vec3 first = spin(turned(turn));
    const Quat q = turned(turn + (first - before) * (0.5 * dt));
    const Vec3 angular = spin(q), arm = rotate(q, info.p_BC), origin = body.centre + linear_of(moved) - arm,
               linear = linear_of(velocity) - cross(angular, arm);
    put_quat(state.q.data() + 3, q);
    for (std::size_t i = 0; i < 3; ++i)
        state.q[i] = origin[i], state.v[i] = angular[i], state.v[3 + i] = linear[i];
}

}  // namespace roboss::soft
