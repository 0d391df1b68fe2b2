// See lone_body.h.
#include "physics/dynamics/lone_body.h"

#include <algorithm>

#include "model/joint_motion.h"
#include "physics/dynamics/body_impulses.h"
#include "physics/dynamics/integrate.h"

namespace roboss {
namespace {

constexpr double kGrowth = 1e-6;  // of the energy of the rotation in a tick: more is not taken

/// True if its axes are principal axes and no moment is much smaller than another: the momentum divided by a
/// small one would enlarge the errors of the orientation.
bool is_compact(const Body& body) {
    constexpr double kLeast = 0.2;  // of the greatest moment
    const Mat3& I = body.inertia_C;
    const auto [least, greatest] = std::minmax({I.r0.x, I.r1.y, I.r2.z});
    return has_principal_axes(body) && least > kLeast * greatest;
}

/// Torque-free rotation: dq/dt = w q / 2 with w = R I^-1 R^T L and the angular momentum L constant.
struct Rotation {
    Vec3 inverse;   // of the principal moments
    Vec3 momentum;  // kg m^2/s, world axes

    Vec3 velocity(const Mat3& R) const {
        const Vec3 L = transpose_times(R, momentum);
        return R * Vec3{inverse.x * L.x, inverse.y * L.y, inverse.z * L.z};
    }

    Quat rate(const Quat& q) const {
        const Vec3 half = velocity(to_matrix(q)) * 0.5;
        return Quat{0, half.x, half.y, half.z} * q;
    }

    Quat after(const Quat& q, double dt) const {
        const auto from = [&](const Quat& rate, double h) {
            return normalized(Quat{q.w + h * rate.w, q.x + h * rate.x, q.y + h * rate.y, q.z + h * rate.z});
        };
        const Quat a = rate(q), b = rate(from(a, 0.5 * dt)), c = rate(from(b, 0.5 * dt)),
                   d = rate(from(c, dt));
        const auto sum = [](double w, double x, double y, double z) { return (w + z) + 2 * (x + y); };
        return from({sum(a.w, b.w, c.w, d.w), sum(a.x, b.x, c.x, d.x), sum(a.y, b.y, c.y, d.y),
                     sum(a.z, b.z, c.z, d.z)},
                    dt / 6);
    }
};

}  // namespace

bool is_lone_body(const Model& model, const RobotWork& work) {
    const RobotType& type = *work.type;
    if (type.bodies.size() != 1 || type.bodies[0].joint != JointKind::kFree || type.has_equalities())
        return false;
    if (!work.state->wrenches.empty() || !type.drags.empty() || type.feels_flow) return false;
    const Body& body = type.bodies[0];
    if (!is_compact(body)) return false;
    return body.gravity_mass == body.mass || body.gravity_mass == 0 || gravity_of(model, type) == Vec3{};
}

bool advance_lone_body(const Model& model, double fastest, RobotWork& work) {
    const Body& body = work.type->bodies[0];
    const BodyWork& start = work.bodies[0];
    RobotState& state = *work.state;
    const double dt = model.dt_s;
    const Sym3T<double> inertia = rotated_inertia(body, start);
    const Mat3& I = body.inertia_C;
    const Rotation rotation{{1 / I.r0.x, 1 / I.r1.y, 1 / I.r2.z}, inertia * start.velocity.angular};
    const int parts = parts_of_tick(*work.type, fastest, dt);
    Quat q = get_quat(state.q.data() + 3);
    for (int i = 0; i < parts; ++i) q = rotation.after(q, dt / parts);
    const Mat3 R = to_matrix(q);
    const Vec3 angular = rotation.velocity(R), arm = R * body.p_BC;
    const double energy_before = 0.5 * dot(start.velocity.angular, rotation.momentum),
                 energy = 0.5 * dot(angular, rotation.momentum);
    if (!(energy <= (1 + kGrowth) * energy_before)) return false;
    const Vec3 acceleration = gravity_of(model, *work.type) * (body.gravity_mass / body.mass);
    const Vec3 before = start.velocity.linear + cross(start.velocity.angular, start.centre);
    const Vec3 linear = before + acceleration * dt - cross(angular, arm);
    const Vec3 moved = start.centre - arm + before * dt + acceleration * (0.5 * dt * dt);
    put_quat(state.q.data() + 3, q);
    for (std::size_t i = 0; i < 3; ++i)
        state.q[i] += moved[i], state.v[i] = angular[i], state.v[3 + i] = linear[i];
    return true;
}

}  // namespace roboss
