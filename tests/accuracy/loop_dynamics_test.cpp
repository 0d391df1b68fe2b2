// Accelerations of mechanisms with loops, gearboxes and mimic joints, and of screws, against the dense solve
// of dense_dynamics.h at random states on their loops.
#include <gtest/gtest.h>

#include <support/mechanisms.h>
#include <support/simulation.h>

#include "dense_dynamics.h"
#include "model/coordinates.h"
#include "physics/equality.h"
#include "physics/tree_factor.h"

namespace roboss::test {
namespace {

constexpr int kStates = 50;
constexpr double kRelative = 1e-9;

struct Case {
    const char* name;
    ModelSpec model;
    double spread = 0.3;  // of the random coordinates before the loops are closed
};

/// Our acceleration: the pieces of the free step, explicit damping as in a continuous-time model.
std::vector<double> our_acceleration(const Model& model, RobotState& state,
                                     const std::vector<double>& joint_force) {
    const RobotType& type = model.types[0];
    RobotWork work;
    work.type = &type;
    work.state = &state;
    place_bodies(type, state.q, work);
    move_bodies(type, state.v, work);
    compute_impulse(model, 1.0, 0.0, state.q, state.v, work);
    compute_mass_matrix(type, 0.0, work);
    for (std::size_t d = 0; d < type.dofs.size(); ++d) {
        const std::size_t i = d + static_cast<std::size_t>(type.base_nv());
        work.impulse[i] += joint_force[d] - type.dofs[d].damping * state.v[i];
    }
    tree_factor(type.dof_parent, work.mass_matrix);
    tree_solve(type.dof_parent, work.mass_matrix, work.impulse.data());
    Equalities equalities;
    gather_equalities(work, state.q, equalities);
    EqualitySolver solver;
    solver.prepare(type, work.mass_matrix, equalities);
    std::vector<double> wanted, change(work.impulse.size());
    for (const EqualityRow& row : equalities.rows)
        wanted.push_back(-row.curvature - times_row(equalities, row, work.impulse));
    solver.solve(wanted, change);
    for (std::size_t i = 0; i < change.size(); ++i) change[i] += work.impulse[i];
    return change;
}

/// Near the start, on the loops, with velocities along them.
RobotState random_state(const Model& model, Random& random, double spread) {
    const RobotType& type = model.types[0];
    RobotState state = initial_state(model, RobotId(std::size_t{0}));
    if (type.free_base) set_base_pose(state, {random.vector(1), random.rotation()});
    std::vector<double> way(state.v.size());
    for (std::size_t i = static_cast<std::size_t>(type.base_nv()); i < way.size(); ++i)
        way[i] = random.uniform(-spread, spread);
    advance_coordinates(type, way, 1.0, state.q);
    EqualityProjection projection;
    for (int i = 0; i < 5; ++i) projection.close_coordinates(type, state.q);
    for (double& v : state.v) v = random.uniform(-2, 2);
    projection.close_velocities(type, state.q, state.v);
    for (std::size_t l = 0; l < type.links.size(); ++l)
        if (type.links[l].body >= 0)
            state.wrenches.push_back({LinkId(l), random.vector(10), random.vector(3), 1000});
    return state;
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

/// A tick's rows hold half a tick before and after it: velocities as the tick before would have left them.
void shift_half_a_tick(const Model& model, RobotState& state) {
    const RobotType& type = model.types[0];
    RobotWork work;
    work.type = &type;
    Equalities equalities;
    EqualitySolver solver;
    std::vector<double> wanted, change(state.v.size());
    for (int i = 0; i < 4; ++i) {
        place_bodies(type, state.q, work);
        move_bodies(type, state.v, work);
        compute_inertias(type, work);
        compute_mass_matrix(type, 0.0, work);
        tree_factor(type.dof_parent, work.mass_matrix);
        gather_equalities(work, state.q, equalities);
        solver.prepare(type, work.mass_matrix, equalities);
        wanted.clear();
        for (const EqualityRow& row : equalities.rows)
            wanted.push_back(0.5 * model.dt_s * row.curvature - times_row(equalities, row, state.v));
        solver.solve(wanted, change);
        for (std::size_t k = 0; k < change.size(); ++k) state.v[k] += change[k];
    }
}

class LoopDynamics : public testing::TestWithParam<Case> {
  protected:
    LoopDynamics() : world_(empty_world(1e-3, {0.3, -0.2, -9.81})) {
        place(world_, GetParam().model, "robot", {{0.5, -0.3, 0.2}, from_rpy(0.2, -0.4, 1.1)});
    }
    std::vector<double> random_forces(const RobotType& type) {
        std::vector<double> forces(type.dofs.size());
        for (double& f : forces) f = random_.uniform(-4, 4);
        return forces;
    }
    World world_;
    Random random_{11};
};

TEST_P(LoopDynamics, AccelerationsAgreeWithADenseSolve) {
    const auto model = compiled(world_);
    double worst = 0;
    for (int i = 0; i < kStates; ++i) {
        RobotState state = random_state(*model, random_, GetParam().spread);
        const std::vector<double> forces = random_forces(model->types[0]);
        const std::vector<double> theirs = dense_acceleration(*model, world_.prototypes[0], state, forces);
        worst = std::fmax(worst, relative_error(our_acceleration(*model, state, forces), theirs));
    }
    std::printf("%s: worst relative error %.2e over %d states\n", GetParam().name, worst, kStates);
    EXPECT_LE(worst, kRelative);
}

/// Acceleration of one tick through the contact island's solver, efforts as motors.
std::vector<double> tick_acceleration(const Model& model, RobotState state,
                                      const std::vector<double>& forces) {
    for (std::size_t d = 0; d < forces.size(); ++d) state.motors[d] = {MotorMode::kEffort, forces[d], 100};
    std::vector<double> change = state.v;
    RobotState* pointer = &state;
    const RobotId id(std::size_t{0});
    Aabb bound;
    StepScratch scratch;
    step_island(model, 0, {&id, 1}, {&pointer, 1}, {}, {&bound, 1}, scratch);
    for (std::size_t v = 0; v < change.size(); ++v) change[v] = (state.v[v] - change[v]) / model.dt_s;
    return change;
}

/// The solver's hard rows give way in proportion to Accuracy::compliance: from two small ones follows what
/// none would give, and that is the dense solve. Without damping and springs, which a tick takes implicitly.
TEST_P(LoopDynamics, OneTickOfTheSolverGivesTheSameBesideItsCompliance) {
    world_.dt_s = 1e-5;
    for (JointSpec& j : world_.prototypes[0].joints)
        for (AxisSpec& axis : j.axes) axis.damping = axis.spring_stiffness = 0;
    Model soft = *compiled(world_);
    soft.accuracy.tolerance = 1e-14;
    soft.accuracy.compliance = 1e-8;
    Model hard = soft;
    hard.accuracy.compliance = 1e-9;
    double worst = 0, worst_hard = 0;
    for (int i = 0; i < 20; ++i) {
        RobotState state = random_state(hard, random_, GetParam().spread);
        shift_half_a_tick(hard, state);
        const std::vector<double> forces = random_forces(hard.types[0]);
        const std::vector<double> theirs = dense_acceleration(hard, world_.prototypes[0], state, forces);
        const std::vector<double> a = tick_acceleration(soft, state, forces);
        std::vector<double> ours = tick_acceleration(hard, state, forces);
        worst_hard = std::fmax(worst_hard, relative_error(ours, theirs));
        for (std::size_t k = 0; k < a.size(); ++k) ours[k] = (10 * ours[k] - a[k]) / 9;
        worst = std::fmax(worst, relative_error(ours, theirs));
    }
    std::printf("%s: compliance 1e-9: %.2e, extrapolated to none: %.2e\n", GetParam().name, worst_hard,
                worst);
    EXPECT_LE(worst, kRelative);
}

std::vector<Case> cases() {
    FourBarOptions floating, ball;
    floating.free_base = true;
    ball.last = JointSpecKind::kBall;
    ModelSpec mimic = two_wheels(true);
    mimic.joints[1].axes[0].mimic = MimicSpec{"small", 0, -0.5, 0.1, 0.2};
    std::vector<Case> all{{"four_bar", four_bar()},
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

INSTANTIATE_TEST_SUITE_P(Mechanisms, LoopDynamics, testing::ValuesIn(cases()),
                         [](const auto& mechanism) { return std::string(mechanism.param.name); });

}  // namespace
}  // namespace roboss::test
