// See pull.h. The apparent mass is MuJoCo's "local mass" of its mouse spring (engine_vis_interact.c).
#include "physics/dynamics/pull.h"

#include <algorithm>

#include "model/order.h"
#include "physics/dynamics/dynamics.h"
#include "physics/dynamics/tree_factor.h"

namespace roboss {
namespace {

constexpr double kRatePerTick = 0.25;  // rad

/// Motion and factored mass matrix of a robot, all that a pull needs to know.
void place_and_factor(const Model& model, RobotId robot, RobotState& state, RobotWork& work) {
    const RobotType& type = type_of(model.type_of(robot), state);
    work.id = robot, work.take(type, state);
    forward_kinematics<double>(type, state.q, work);
    forward_velocities<double>(type, state.v, work);
    compute_inertias(type, work);
    compute_mass_matrix<double>(type, model.dt_s, work);
    tree_factor(type.paths, work.mass_matrix.data());
}

/// What a unit impulse along `direction` at `arm` from O gives this point of the body in velocity along it:
/// 1/kg. Overwrites work.impulse.
double mobility(const Vec3& direction, const Vec3& arm, int body, RobotWork& work) {
    const RobotType& type = *work.type;
    const Spatial impulse{cross(arm, direction), direction};
    std::vector<double>& x = work.impulse;
    x.assign(static_cast<std::size_t>(type.nv), 0.0);
    std::vector<double>& row = work.velocity;
    for (int b = body; b >= 0; b = type.bodies[static_cast<std::size_t>(b)].parent) {
        const Body& on_path = type.bodies[static_cast<std::size_t>(b)];
        for (int k = 0; k < on_path.nv; ++k) {
            const auto i = static_cast<std::size_t>(on_path.v_index + k);
            x[i] = dot(work.axes[i], impulse);
        }
    }
    row = x;
    tree_solve(type.paths, work.mass_matrix.data(), x.data());
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += row[i] * x[i];
    return sum;
}

/// At most `most` long.
Vec3 shortened(const Vec3& v, double most) {
    const double length = norm(v);
    return length > most ? v * (most / length) : v;
}

/// The force of the pull on its point, N.
Vec3 pull_force(const TimedPull& pull, const Vec3& p_W, const Vec3& velocity, double mass, double dt_s) {
    const double rate = std::min(pull.rate, kRatePerTick / dt_s);
    const double stiffness = mass * rate * rate;
    const Vec3 distance = shortened(pull.target_W - p_W, pull.max_force / stiffness);
    return shortened(distance * stiffness - velocity * (2 * mass * rate), pull.max_force);
}

}  // namespace

void apply_pulls(const Model& model, Tick tick, RobotId robot, RobotState& state, RobotWork& work) {
    std::erase_if(state.pulls, [&](const TimedPull& p) { return p.until <= tick; });
    const RobotType& type = type_of(model.type_of(robot), state);
    bool placed = false;
    for (const TimedPull& pull : state.pulls) {
        const Link& link = type.links[pull.link.index()];
        if (link.body < 0) continue;  // it stands fast
        if (!placed) place_and_factor(model, robot, state, work);
        placed = true;
        const BodyWork& body = work.bodies[static_cast<std::size_t>(link.body)];
        const Vec3 p_W = body.X_WB * (link.X_BL * pull.p_L);
        const Vec3 arm = p_W - work.origin;
        const double inverse_mass = mobility({1, 0, 0}, arm, link.body, work) +
                                    mobility({0, 1, 0}, arm, link.body, work) +
                                    mobility({0, 0, 1}, arm, link.body, work);
        if (!(inverse_mass > 0)) continue;
        const Vec3 velocity = body.velocity.linear + cross(body.velocity.angular, arm);
        const Vec3 force = pull_force(pull, p_W, velocity, 3 / inverse_mass, model.dt_s);
        if (!is_finite(force)) continue;
        const Vec3 lever = p_W - body.X_WB * link.p_BC;
        state.wrenches.push_back(
            {pull.link, force, shortened(cross(lever, force), kOrderLimits.torque), tick + 1});
    }
}

}  // namespace roboss
