// Threads that share the bodies of a net change no bit of it.
#include "physics/dynamics/body_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <random>

#include <support/joint_net.h>
#include <support/simulation.h>

#include "core/thread_pool.h"

namespace roboss::test {
namespace {

/// A tree with as many bodies, and an elimination that nothing but its nodes is known of.
RobotType random_tree(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    RobotType type;
    for (std::size_t b = 0; b < count; ++b) {
        Body body;
        body.parent = b == 0 ? -1 : static_cast<int>(b - 1 - random() % std::min<std::size_t>(b, 9));
        type.bodies.push_back(body);
        type.elimination.nodes.push_back({body.parent, static_cast<int>(b), -1});
    }
    type.elimination.pattern.analyse(count, {});
    return type;
}

TEST(BodyBranches, EveryBodyComesAfterItsParentAndBeforeItOnTheWayBack) {
    ThreadPool two(2);
    BodyBranches branches;  // one for all, as in a run
    for (unsigned seed = 0; seed < 20; ++seed) {
        const std::size_t count = 1 + seed * 17;
        const RobotType type = random_tree(count, seed);
        branches.lay_out(type);
        std::vector<std::atomic<int>> visits(count);
        std::atomic<bool> in_order{true};
        branches.walk_to_tips(Team(two), [&](std::size_t b) {
            const int parent = type.bodies[b].parent;
            if (parent >= 0 && visits[static_cast<std::size_t>(parent)] != 1) in_order = false;
            ++visits[b];
        });
        std::vector<std::vector<std::size_t>> heard(count), expected(count);
        for (std::size_t b = count; b-- > 1;)
            expected[static_cast<std::size_t>(type.bodies[b].parent)].push_back(b);
        branches.walk_to_root(
            Team(two),
            [&](std::size_t b) {
                if (heard[b] != expected[b]) in_order = false;
                ++visits[b];
            },
            [&](std::size_t b) {
                if (b > 0) heard[static_cast<std::size_t>(type.bodies[b].parent)].push_back(b);
            });
        EXPECT_TRUE(in_order) << seed;
        EXPECT_TRUE(std::ranges::all_of(visits, [](const auto& n) { return n == 2; })) << seed;
    }
}

/// With joints that give damping, and with free ones; from rest, so that energies are compared with open
/// loops, too.
TEST(BodyWalk, ThreadsThatShareANetChangeNoBit) {
    for (const double damping : {0.0, 1e-3}) {
        World world = empty_world(2e-3);
        ModelSpec net = joint_net(13, 0.5);
        for (JointSpec& joint : net.joints) joint.ball_damping = damping;
        place(world, net, "net");
        Simulation alone(world), shared(world);
        ThreadPool two(2), three(3);
        for (int i = 0; i < 24; ++i) {
            shared.scratch.use_team(i % 3 == 2 ? Team() : Team(i % 3 == 1 ? three : two));
            alone.step();
            shared.step();
            ASSERT_EQ(alone.hash(), shared.hash()) << "tick " << i;
        }
        EXPECT_GT(std::ranges::max(alone.states[0].v), 0.01) << "it swings";
    }
}

}  // namespace
}  // namespace roboss::test
