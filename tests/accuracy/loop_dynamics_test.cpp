// Accelerations of mechanisms with loops, gearboxes and mimic joints, and of screws, against the dense solve
// of dense_dynamics.h at random states on their loops.
#include <gtest/gtest.h>

#include <support/mechanisms.h>
#include <support/simulation.h>

#include "accelerations.h"
#include "dense_dynamics.h"
#include "model/coordinates.h"
#include "physics/dynamics/equality.h"
#include "physics/dynamics/tree_factor.h"

namespace roboss::test {
namespace {

constexpr int kStates = 50;
constexpr double kRelative = 1e-9;

/// A tick's rows hold half a tick before and after it: velocities as the tick before would have left them.
void shift_half_a_tick(const Model& model, RobotState& state) {
    const RobotType& type = model.types[0];
    RobotWork work;
    work.type = &type;
    Equalities equalities;
    EqualitySolver solver;
    std::vector<double> wanted, change(state.v.size());
    for (int i = 0; i < 4; ++i) {
        forward_kinematics<double>(type, state.q, work);
        forward_velocities<double>(type, state.v, work);
        compute_inertias(type, work);
        compute_mass_matrix<double>(type, 0.0, work);
        tree_factor(type.paths, work.mass_matrix.data());
        gather_equalities(work, state.q, equalities);
        solver.prepare(work, {}, equalities);
        wanted.clear();
        for (const EqualityRow& row : equalities.rows)
            wanted.push_back(0.5 * model.dt_s * row.curvature - times_row(equalities, row, state.v));
        solver.solve(wanted, change);
        for (std::size_t k = 0; k < change.size(); ++k) state.v[k] += change[k];
    }
}

class LoopDynamics : public testing::TestWithParam<Mechanism> {
  protected:
    LoopDynamics() : world_(empty_world(1e-3, {0.3, -0.2, -9.81})) {
        place(world_, GetParam().model, "robot", {{0.5, -0.3, 0.2}, from_rpy(0.2, -0.4, 1.1)});
    }
    World world_;
    Random random_{11};
};

class FixedLoops : public LoopDynamics {};
class FloatingLoops : public LoopDynamics {};

/// Those that float freely, or those on a fixed base.
std::vector<Mechanism> mechanisms(bool floats) {
    std::vector<Mechanism> chosen;
    for (Mechanism& mechanism : constrained_mechanisms()) {
        World world = empty_world(1e-3);
        place(world, mechanism.model, "robot");
        if (compiled(world)->types[0].free_base == floats) chosen.push_back(mechanism);
    }
    return chosen;
}

TEST_P(LoopDynamics, AccelerationsAgreeWithADenseSolve) {
    const auto model = compiled(world_);
    double worst = 0;
    for (int i = 0; i < kStates; ++i) {
        RobotState state = random_state_on_loops(*model, random_, GetParam().spread);
        const std::vector<double> forces = random_forces(model->types[0], random_);
        const std::vector<double> theirs = dense_acceleration(*model, world_.prototypes[0], state, forces);
        worst = std::fmax(worst, relative_error(free_acceleration(*model, state, forces), theirs));
    }
    std::printf("%s: worst relative error %.2e over %d states\n", GetParam().name.c_str(), worst, kStates);
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
TEST_P(FixedLoops, OneTickOfTheSolverGivesTheSameBesideItsCompliance) {
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
        RobotState state = random_state_on_loops(hard, random_, GetParam().spread);
        shift_half_a_tick(hard, state);
        const std::vector<double> forces = random_forces(hard.types[0], random_);
        const std::vector<double> theirs = dense_acceleration(hard, world_.prototypes[0], state, forces);
        const std::vector<double> a = tick_acceleration(soft, state, forces);
        std::vector<double> ours = tick_acceleration(hard, state, forces);
        worst_hard = std::fmax(worst_hard, relative_error(ours, theirs));
        for (std::size_t k = 0; k < a.size(); ++k) ours[k] = (10 * ours[k] - a[k]) / 9;
        worst = std::fmax(worst, relative_error(ours, theirs));
    }
    std::printf("%s: compliance 1e-9: %.2e, extrapolated to none: %.2e\n", GetParam().name.c_str(),
                worst_hard, worst);
    EXPECT_LE(worst, kRelative);
}

/// Mechanisms that float freely take the kick-drift step, of high order: from a tick forward and one backward
/// follows the acceleration in between, to the second order.
TEST_P(FloatingLoops, TicksForwardAndBackwardGiveTheSame) {
    world_.dt_s = 1e-6;
    for (JointSpec& j : world_.prototypes[0].joints)
        for (AxisSpec& axis : j.axes) axis.damping = axis.spring_stiffness = 0;
    const auto model = compiled(world_);
    double worst = 0;
    for (int i = 0; i < 20; ++i) {
        RobotState state = random_state_on_loops(*model, random_, GetParam().spread);
        const std::vector<double> forces = random_forces(model->types[0], random_);
        const std::vector<double> theirs = dense_acceleration(*model, world_.prototypes[0], state, forces);
        std::vector<double> ours = tick_acceleration(*model, state, forces);
        for (double& v : state.v) v = -v;
        const std::vector<double> back = tick_acceleration(*model, state, forces);
        for (std::size_t k = 0; k < ours.size(); ++k) ours[k] = 0.5 * (ours[k] + back[k]);
        worst = std::fmax(worst, relative_error(ours, theirs));
    }
    std::printf("%s: worst relative error %.2e\n", GetParam().name.c_str(), worst);
    EXPECT_LE(worst, 1e-8);  // the difference of two velocities loses digits
}

std::string name_of(const testing::TestParamInfo<Mechanism>& mechanism) {
    return mechanism.param.name;
}
INSTANTIATE_TEST_SUITE_P(Mechanisms, LoopDynamics, testing::ValuesIn(constrained_mechanisms()), name_of);
INSTANTIATE_TEST_SUITE_P(Mechanisms, FixedLoops, testing::ValuesIn(mechanisms(false)), name_of);
INSTANTIATE_TEST_SUITE_P(Mechanisms, FloatingLoops, testing::ValuesIn(mechanisms(true)), name_of);

}  // namespace
}  // namespace roboss::test
