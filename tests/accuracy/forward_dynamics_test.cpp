// Forward dynamics, poses and twists against MuJoCo at random states of trees of every joint kind, contacts
// off.
#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/simulation.h>

#include "accelerations.h"
#include "mujoco_oracle.h"
#include "physics/dynamics/robot_work.h"
#include "physics/dynamics/tree_factor.h"

namespace roboss::test {
namespace {

constexpr int kStates = 200;
constexpr double kRelative = 1e-9;

class ForwardDynamics : public testing::TestWithParam<Mechanism> {
  protected:
    ForwardDynamics() {
        world_ = empty_world(1e-3, {0.3, -0.2, -9.81});
        place(world_, GetParam().model, "robot", X_WM_);
        compile_and_load();
    }
    void compile_and_load() {
        model_ = compiled(world_);
        oracle_ =
            std::make_unique<MujocoOracle>(world_.prototypes[0], X_WM_, world_.gravity, model_->types[0]);
    }
    const Pose X_WM_{{0.5, -0.3, 0.2}, from_rpy(0.2, -0.4, 1.1)};
    World world_;
    std::shared_ptr<const Model> model_;
    std::unique_ptr<MujocoOracle> oracle_;
    Random random_{7};
};

TEST_P(ForwardDynamics, AccelerationsAgreeWithMujoco) {
    double worst = 0;
    for (int i = 0; i < kStates; ++i) {
        RobotState state = random_tree_state(*model_, random_);
        const std::vector<double> forces = random_forces(model_->types[0], random_);
        oracle_->set(state, forces);
        const std::vector<double> theirs = oracle_->acceleration();
        worst = std::fmax(worst, relative_error(free_acceleration(*model_, state, forces), theirs));
    }
    std::printf("%s: worst relative error %.2e over %d states\n", GetParam().name.c_str(), worst, kStates);
    EXPECT_LE(worst, kRelative);
}

TEST_P(ForwardDynamics, PosesAndTwistsOfLinksAgreeWithMujoco) {
    for (int i = 0; i < 20; ++i) {
        const RobotState state = random_tree_state(*model_, random_);
        oracle_->set(state, std::vector<double>(model_->types[0].dofs.size()));
        for (std::size_t l = 0; l < model_->types[0].links.size(); ++l) {
            const std::string& name = model_->types[0].links[l].name;
            const Transform X = link_pose(model_->types[0], state, LinkId(l)), Y = oracle_->link_pose(name);
            EXPECT_LE(norm(X.p - Y.p), 1e-11) << name;
            for (std::size_t r = 0; r < 3; ++r) EXPECT_LE(norm(X.R.row(r) - Y.R.row(r)), 1e-11) << name;
            const Twist v = link_twist(model_->types[0], state, LinkId(l)), w = oracle_->link_twist(name);
            EXPECT_LE(norm(v.angular - w.angular), 1e-10) << name;
            EXPECT_LE(norm(v.linear - w.linear), 1e-9) << name;
        }
    }
}

/// What one tick changes the velocities by, over dt.
std::vector<double> tick_acceleration(const Model& model, RobotState state) {
    StepScratch scratch;
    std::vector<double> change = state.v;
    RobotState* pointer = &state;
    const RobotId id(std::size_t{0});
    Aabb bound;
    step_island(model, 0, {&id, 1}, {&pointer, 1}, {}, {&bound, 1}, scratch);
    for (std::size_t k = 0; k < change.size(); ++k) change[k] = (state.v[k] - change[k]) / model.dt_s;
    return change;
}

/// The whole tick, solver included: effort motors change the velocities by dt times MuJoCo's acceleration, in
/// the middle between a tick forward and one backward. Without damping and springs, which a tick takes
/// implicitly.
TEST_P(ForwardDynamics, TicksWithEffortMotorsGiveMujocosAcceleration) {
    world_.dt_s = 1e-6;
    for (JointSpec& j : world_.prototypes[0].joints)
        for (AxisSpec& axis : j.axes) axis.damping = axis.spring_stiffness = 0;
    compile_and_load();
    double worst = 0;
    for (int i = 0; i < 50; ++i) {
        RobotState state = random_tree_state(*model_, random_);
        std::vector<double> forces = random_forces(model_->types[0], random_);
        for (std::size_t d = 0; d < forces.size(); ++d) {
            const double bound = model_->types[0].dofs[d].max_effort;
            forces[d] = std::fmax(-bound, std::fmin(bound, forces[d]));
            state.motors[d] = {MotorMode::kEffort, forces[d], bound};
        }
        oracle_->set(state, forces);
        const std::vector<double> theirs = oracle_->acceleration();
        std::vector<double> ours = tick_acceleration(*model_, state);
        for (double& v : state.v) v = -v;
        const std::vector<double> back = tick_acceleration(*model_, state);
        for (std::size_t k = 0; k < ours.size(); ++k) ours[k] = 0.5 * (ours[k] + back[k]);
        worst = std::fmax(worst, relative_error(ours, theirs));
    }
    EXPECT_LE(worst, 1e-8);  // the difference of two velocities loses digits
}

INSTANTIATE_TEST_SUITE_P(Trees, ForwardDynamics, testing::ValuesIn(trees()),
                         [](const auto& tree) { return tree.param.name; });

}  // namespace
}  // namespace roboss::test
