// See accelerations.h.
#include "accuracy/accelerations.h"

#include <cmath>
#include <limits>

#include <support/mechanisms.h>
#include <support/robots.h>

#include "model/coordinates.h"
#include "physics/dynamics/equality.h"
#include "physics/dynamics/robot_work.h"
#include "physics/dynamics/tree_factor.h"

namespace roboss::test {

std::vector<Mechanism> trees() {
    return {{"pendulum", pendulum()},
            {"double_pendulum", double_pendulum()},
            {"arm", arm()},
            {"car", car()},
            {"prismatic_chain", prismatic_chain()},
            {"spider", spider()},
            {"ball_chain", ball_chain()},
            {"mixed_tree", mixed_tree()}};
}

std::vector<Mechanism> constrained_mechanisms() {
    FourBarOptions floating, ball;
    floating.free_base = true;
    ball.last = JointSpecKind::kBall;
    ModelSpec mimic = two_wheels(true);
    mimic.joints[1].axes[0].mimic = MimicSpec{"small", 0, -0.5, 0.1, 0.2, {}};
    std::vector<Mechanism> all{{"four_bar", four_bar()},
                               {"four_bar_ball", four_bar(ball)},
                               {"four_bar_on_a_free_plate", four_bar(floating)},
                               {"stewart", stewart(), 0.1},
                               {"gearbox", geared_wheels(2.5, true)},
                               {"mimic", mimic}};
    const std::pair<const char*, JointSpecKind> kinds[] = {{"ring_revolute", JointSpecKind::kRevolute},
                                                           {"ring_prismatic", JointSpecKind::kPrismatic},
                                                           {"ring_screw", JointSpecKind::kScrew},
                                                           {"ring_universal", JointSpecKind::kUniversal},
                                                           {"ring_ball", JointSpecKind::kBall}};
    for (const auto& [name, kind] : kinds) all.push_back({name, ring_of_all_kinds(kind)});
    ModelSpec open = ring_of_all_kinds(JointSpecKind::kBall);
    open.joints.pop_back();
    all.push_back({"open_chain_of_all_kinds", open, 1.0});
    return all;
}

std::vector<double> free_acceleration(const Model& model, RobotState& state,
                                      const std::vector<double>& joint_force) {
    const RobotType& type = model.types[0];
    RobotWork work;
    work.type = &type;
    work.state = &state;
    forward_kinematics<double>(type, state.q, work);
    forward_velocities<double>(type, state.v, work);
    compute_impulse(model, 1.0, 0.0, state.q, state.v, work);
    compute_mass_matrix<double>(type, 0.0, work);
    for (std::size_t d = 0; d < type.dofs.size(); ++d) {
        const std::size_t i = d + static_cast<std::size_t>(type.base_nv());
        work.impulse[i] += joint_force[d] - type.dofs[d].damping * state.v[i];
    }
    tree_factor(type.paths, work.mass_matrix.data());
    tree_solve(type.paths, work.mass_matrix.data(), work.impulse.data());
    Equalities equalities;
    gather_equalities(work, state.q, equalities);
    EqualitySolver solver;
    solver.prepare(work, {}, equalities);
    std::vector<double> wanted, change(work.impulse.size());
    for (const EqualityRow& row : equalities.rows)
        wanted.push_back(-row.curvature - times_row(equalities, row, work.impulse));
    solver.solve(wanted, change);
    for (std::size_t i = 0; i < change.size(); ++i) change[i] += work.impulse[i];
    return change;
}

RobotState random_tree_state(const Model& model, Random& random) {
    const RobotType& type = model.types[0];
    RobotState state = initial_state(model, RobotId(std::size_t{0}));
    if (type.free_base) set_base_pose(state, {random.vector(10), random.rotation()});
    for (const Body& body : type.bodies) {
        const auto i = static_cast<std::size_t>(body.q_index);
        if (body.joint == JointKind::kBall) {
            const Quat q = random.rotation();
            state.q[i] = q.w, state.q[i + 1] = q.x, state.q[i + 2] = q.y, state.q[i + 3] = q.z;
        } else if (body.joint != JointKind::kFree) {
            state.q[i] = random.uniform(-2, 2);
        }
    }
    for (double& v : state.v) v = random.uniform(-5, 5);
    for (std::size_t l = 0; l < type.links.size(); ++l)
        state.wrenches.push_back({LinkId(l), random.vector(10), random.vector(3), 1000});
    return state;
}

RobotState random_state_on_loops(const Model& model, Random& random, double spread) {
    const RobotType& type = model.types[0];
    RobotState state = initial_state(model, RobotId(std::size_t{0}));
    if (type.free_base) set_base_pose(state, {random.vector(1), random.rotation()});
    std::vector<double> way(state.v.size());
    for (std::size_t i = static_cast<std::size_t>(type.base_nv()); i < way.size(); ++i)
        way[i] = random.uniform(-spread, spread);
    advance_coordinates<double>(type, way, 1.0, state.q);
    EqualityProjection projection;
    RobotWork work;
    work.take(type, state);
    for (int i = 0; i < 5; ++i) projection.close_coordinates(work, state.q);
    for (double& v : state.v) v = random.uniform(-2, 2);
    projection.close_velocities(work, state.q, state.v);
    for (std::size_t l = 0; l < type.links.size(); ++l)
        if (type.links[l].body >= 0)
            state.wrenches.push_back({LinkId(l), random.vector(10), random.vector(3), 1000});
    return state;
}

std::vector<double> random_forces(const RobotType& type, Random& random) {
    std::vector<double> forces(type.dofs.size());
    for (double& f : forces) f = random.uniform(-4, 4);
    return forces;
}

double relative_error(const std::vector<double>& a, const std::vector<double>& b) {
    double error = 0, size = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        error = std::fmax(error, std::fabs(a[i] - b[i]));
        size = std::fmax(size, std::fabs(b[i]));
        if (!std::isfinite(a[i] - b[i])) return std::numeric_limits<double>::infinity();
    }
    return error / size;
}

}  // namespace roboss::test
