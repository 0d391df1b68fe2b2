// Robots with many loops that rows act on, solved body by body, move as by the matrix in the coordinates of
// their trees.
#include <gtest/gtest.h>

#include <cmath>

#include <support/joint_net.h>
#include <support/scissors.h>
#include <support/simulation.h>

#include "core/thread_pool.h"

namespace roboss::test {
namespace {

/// A net that hangs on two corners, or falls; its plates collide if they have a surface.
ModelSpec damped_net(std::size_t side, double bowl, bool hangs, bool collides) {
    ModelSpec net = joint_net(side, bowl);
    if (!hangs) std::erase_if(net.joints, [](const JointSpec& joint) { return joint.parent == "world"; });
    for (JointSpec& joint : net.joints) joint.ball_damping = 1e-3;
    if (collides)
        for (LinkSpec& plate : net.links)
            plate.collisions.push_back(box_shape({0.08, 0.08, 0.02}, surface(0.6)));
    return net;
}

/// Hinges with damping, friction and limits; on a free base that stands on the ground.
ModelSpec stiff_scissors() {
    ModelSpec model = scissors(7, true);
    for (std::size_t i = 0; i < model.joints.size(); ++i) {
        AxisSpec& axis = model.joints[i].axes[0];
        axis.damping = 0.05, axis.friction = i % 3 == 0 ? 0.02 : 0;
        axis.lower = i % 4 == 0 ? -0.02 : -1, axis.upper = 1;
    }
    model.links[0].collisions.push_back(box_shape({0.6, 0.3, 0.1}, surface(0.6)));
    return model;
}

World world_of(int scene) {
    World world = empty_world(2e-3);
    const SurfaceSpec rough = surface(0.6);
    if (scene == 3) {
        place(world, ground(rough), "ground");
        place(world, stiff_scissors(), "scissors", {{0, 0, 0.06}, exponential(Vec3{0.02, 0.3, 0})});
        return world;
    }
    if (scene == 0) {
        place(world, damped_net(5, 0.4, true, false), "net");
        return world;
    }
    place(world, ground(rough), "ground");
    place(world, damped_net(4, 0.2, false, true), "net", {{0, 0, scene == 1 ? 0.05 : 0.3}, {}});
    if (scene == 1) return world;
    place(world, solid_box(0.3, {0.1, 0.1, 0.1}, rough), "box", {{0.15, 0.15, 0.37}, {}});
    place(world, solid_sphere(0.1, 0.05, rough), "ball", {{0.05, 0.02, 0.45}, {}});
    place(world, damped_net(4, 0.2, false, true), "second", {{0.02, 0.03, 0.5}, {}});
    return world;
}

/// The same Model, whose robots do not know that they have many loops.
std::shared_ptr<const Model> in_coordinates_of_trees(const Model& model) {
    auto copy = std::make_shared<Model>(model);
    for (RobotType& type : copy->types) type.elimination = {};
    return copy;
}

/// Share of the largest velocity by which the states differ.
double difference(const std::vector<RobotState>& a, const std::vector<RobotState>& b) {
    double most = 0, size = 0.1;
    for (std::size_t r = 0; r < a.size(); ++r)
        for (std::size_t i = 0; i < a[r].v.size(); ++i) {
            most = std::fmax(most, std::fabs(a[r].v[i] - b[r].v[i]));
            size = std::fmax(size, std::fabs(b[r].v[i]));
        }
    return most / size;
}

class NetHessians : public testing::TestWithParam<int> {};

/// Momentum balances in the coordinates of the tree and friction keeps Coulomb's law, after about as many
/// steps of Newton's method as with the matrix there. (After a tick the states differ a little: robots with
/// many loops move by another Runge-Kutta method.)
TEST_P(NetHessians, BalanceAsTheMatrixOfTheTree) {
    Simulation sparse(world_of(GetParam())), dense(world_of(GetParam()));
    sparse.scratch.measure_stages([] { return std::uint64_t{0}; });
    dense.scratch.measure_stages([] { return std::uint64_t{0}; });
    dense.model = in_coordinates_of_trees(*sparse.model);
    double worst = 0, friction = 0, friction_by_tree = 0;
    int contacts = 0, by_parts = 0, by_tree = 0;
    constexpr int kTicks = 400;
    for (int i = 0; i < kTicks; ++i) {
        dense.states = sparse.states;
        for (std::size_t r = 0; r < dense.states.size(); ++r) dense.pointers[r] = &dense.states[r];
        contacts = std::max(contacts, sparse.step().contacts);
        dense.step();
        friction = std::fmax(friction, sparse.report.profile.solver.friction_error);
        by_parts += sparse.report.iterations, by_tree += dense.report.iterations;
        friction_by_tree = std::fmax(friction_by_tree, dense.report.profile.solver.friction_error);
        worst = std::fmax(worst, difference(sparse.states, dense.states));
    }
    tell("largest residual", sparse.residual_max);
    tell("iterations, body by body", by_parts);
    tell("iterations, in the coordinates of the trees", by_tree);
    tell("largest difference after one tick", worst);
    tell("most contacts", contacts);
    tell("largest error of a friction bound", friction);
    tell("the same, in the coordinates of the trees", friction_by_tree);
    EXPECT_LT(sparse.residual_max, 1e-8);
    EXPECT_LT(friction, 2e-4);
    EXPECT_LT(friction_by_tree, 2e-4);
    EXPECT_LT(by_parts, 1.7 * by_tree + kTicks);
    EXPECT_LT(worst, GetParam() == 2 ? 5e-3 : 1e-3);
    EXPECT_GE(contacts, GetParam() == 0 ? 0 : GetParam() == 3 ? 2 : 20);
}

INSTANTIATE_TEST_SUITE_P(Scenes, NetHessians, testing::Range(0, 4));

/// Threads share the fronts of a net, and no bit changes; neither where their number changes mid-run.
TEST(NetHessian, ATeamChangesNoBit) {
    World world = empty_world(2e-3);
    place(world, damped_net(11, 0.4, true, false), "net");
    Simulation alone(world), shared(world);
    for (int i = 0; i < 12; ++i) {
        const unsigned threads[] = {2, 1, 3};
        ThreadPool pool(threads[i / 4]);
        shared.scratch.use_team(Team(pool));
        shared.step(), alone.step();
        shared.scratch.use_team({});
        ASSERT_EQ(shared.hash(), alone.hash()) << i;
    }
}

}  // namespace
}  // namespace roboss::test
