// Pulls against closed forms: a critically damped spring on a point mass, hanging weight, apparent mass of a
// rod and of a pendulum, bounds, and a force that is replaced instead of added.
#include "physics/dynamics/pull.h"

#include <gtest/gtest.h>

#include <cmath>

#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

const RobotId kFirst(0u);
const LinkId kLink(0u);
constexpr double kMass = 2, kDt = 1e-3;

Order order(Tick tick, Action action) {
    return {tick, ClientId(0u), static_cast<std::uint64_t>(tick), kFirst, std::move(action)};
}

World floating_box(const Vec3& gravity = {}) {
    World world = empty_world(kDt, gravity);
    place(world, solid_box(kMass, {0.1, 0.1, 0.1}, surface(0.5)), "box", {{0, 0, 1}, {}});
    return world;
}

void give(Simulation& sim, Action action) {
    const Order one = order(sim.tick, std::move(action));
    const Result<> checked = check_order(*sim.model, one);
    ASSERT_TRUE(checked.ok()) << checked.error().text();
    sim.step(std::span(&one, 1));
}

TEST(Pull, OfAPointMassIsACriticallyDampedSpring) {
    Simulation sim(floating_box());
    const double rate = 10;
    give(sim, Pull{kLink, {}, {0.1, 0, 1}, rate, 1e6, 100'000});
    for (int i = 1; i < 1000; ++i) {
        sim.step();
        const double t = sim.time(), expected = 0.1 * (1 - (1 + rate * t) * std::exp(-rate * t));
        ASSERT_NEAR(sim.states[0].q[0], expected, 1e-3) << t;
        ASSERT_LT(sim.states[0].q[0], 0.1 + 1e-9) << "it never overshoots";
    }
    EXPECT_NEAR(sim.states[0].q[0], 0.1, 1e-4);
    EXPECT_NEAR(sim.states[0].q[2], 1, 1e-12);
}

TEST(Pull, LiftsAndHoldsWhileTheHandRests) {
    Simulation sim(floating_box({0, 0, -9.81}));
    const double rate = 15;
    give(sim, Pull{kLink, {}, {0, 0, 2}, rate, 200 * kMass, 100'000});
    sim.run(3);
    EXPECT_NEAR(sim.states[0].q[2], 2 - 9.81 / (rate * rate), 1e-4) << "the spring carries the weight";
    EXPECT_NEAR(sim.states[0].v[5], 0, 1e-6);
    const double z = sim.states[0].q[2];
    sim.run(3);
    EXPECT_NEAR(sim.states[0].q[2], z, 1e-6);
    EXPECT_FALSE(sim.states[0].rest.asleep);
}

TEST(Pull, ForceIsBoundedAndTheApproachDoesNotOvershoot) {
    Simulation sim(floating_box());
    const double most = 10, rate = 15;
    give(sim, Pull{kLink, {}, {5, 0, 1}, rate, most, 100'000});
    EXPECT_NEAR(sim.states[0].v[3], most / kMass * kDt, 1e-12);
    double fastest = 0, farthest = 0;
    for (int i = 1; i < 40'000; ++i) {
        const double before = sim.states[0].v[3];
        sim.step();
        ASSERT_LE(std::fabs(sim.states[0].v[3] - before), most / kMass * kDt * (1 + 1e-9));
        fastest = std::max(fastest, sim.states[0].v[3]);
        farthest = std::max(farthest, sim.states[0].q[0]);
    }
    EXPECT_NEAR(fastest, most / (2 * kMass * rate), 1e-6);
    EXPECT_LT(farthest, 5 + 1e-6);
    EXPECT_NEAR(sim.states[0].q[0], 5, 1e-3);
}

TEST(Pull, OfACornerIsScaledByTheApparentMassThere) {
    Simulation sim(floating_box());
    const Vec3 corner{0.05, 0.05, 0.05};
    const double rate = 10, d = 1e-4, inertia = kMass * 0.01 / 6;
    give(sim, Pull{kLink, corner, corner + Vec3{d, 0, 1}, rate, 1e6, 10});
    // trace(J M^-1 J^T) = 3 / m + (2 |r|^2) / I for a sphere-like inertia
    const double mass = 3 / (3 / kMass + 2 * 3 * 0.05 * 0.05 / inertia);
    EXPECT_NEAR(sim.states[0].v[3], mass * rate * rate * d / kMass * kDt, 1e-12);
}

TEST(Pull, HangsARodByItsEnd) {
    World world = empty_world(kDt, {0, 0, -9.81});
    place(world, solid_box(1, {1, 0.05, 0.05}, surface(0.5)), "rod", {{0, 0, 3}, {}});
    Simulation sim(world);
    give(sim, Pull{kLink, {0.5, 0, 0}, {0.5, 0, 3}, 15, 200, 1'000'000});
    sim.run(20);
    const Transform X = link_pose(sim.type(0), sim.states[0], kLink);
    EXPECT_NEAR((X * Vec3{0.5, 0, 0}).x, 0.5, 0.3);
    EXPECT_LT(X.p.z, (X * Vec3{0.5, 0, 0}).z);
    for (const double v : sim.states[0].v) EXPECT_LT(std::fabs(v), 20) << "it swings, and does not blow up";
}

/// Light links on heavy ones, large steps, the stiffest pull.
TEST(Pull, IsStableOnEveryLinkOfATreeAtLargeSteps) {
    World world = empty_world(0.01);
    place(world, car(), "car", {{0, 0, 1}, {}});
    for (std::size_t link = 0; link < 5; ++link) {
        Simulation sim(world);
        const Vec3 target = link_pose(sim.type(0), sim.states[0], LinkId(link)).p + Vec3{0, 0, 1};
        give(sim, Pull{LinkId(link), {}, target, 1000, 1e9, 1'000'000});
        sim.run(20);
        for (const double v : sim.states[0].v) ASSERT_LT(std::fabs(v), 100) << link;
        EXPECT_NEAR(link_pose(sim.type(0), sim.states[0], LinkId(link)).p.z, target.z, 0.5) << link;
    }
}

TEST(Pull, EndsWithItsDurationOrWhenTheHandLetsGoAndReplacesTheOneBefore) {
    Simulation sim(floating_box());
    give(sim, Pull{kLink, {}, {1, 0, 1}, 15, 10, 50});
    EXPECT_EQ(sim.states[0].pulls.size(), 1u);
    give(sim, Pull{kLink, {}, {-1, 0, 1}, 15, 10, 50});
    EXPECT_EQ(sim.states[0].pulls.size(), 1u);
    sim.run(0.1);
    EXPECT_TRUE(sim.states[0].pulls.empty());
    EXPECT_TRUE(sim.states[0].wrenches.empty());
    give(sim, Pull{kLink, {}, {1, 0, 1}, 15, 10, 1000});
    give(sim, Pull{kLink, {}, {1, 0, 1}, 15, 0, 1});
    EXPECT_TRUE(sim.states[0].pulls.empty());
    const double v = sim.states[0].v[3];
    sim.run(0.1);
    EXPECT_EQ(sim.states[0].v[3], v);
}

TEST(Pull, AStateWithOneTravelsAsBytesAndCountsInTheHash) {
    Simulation sim(floating_box());
    const std::uint64_t before = state_hash(kFirst, 0, sim.states[0]);
    sim.states[0].pulls.push_back({kLink, {1, 2, 3}, {4, 5, 6}, 7, 8, 9});
    EXPECT_NE(state_hash(kFirst, 0, sim.states[0]), before);
    std::vector<std::uint8_t> bytes;
    encode(sim.states[0], bytes);
    const Result<RobotState> decoded = decode_state(bytes, sim.type(0), 1);
    ASSERT_TRUE(decoded.ok()) << decoded.error().text();
    EXPECT_EQ(decoded.value(), sim.states[0]);
    sim.states[0].pulls[0].link = LinkId(7u);
    bytes.clear();
    encode(sim.states[0], bytes);
    EXPECT_FALSE(decode_state(bytes, sim.type(0), 1).ok());
}

/// A hand pushes with 1 N for 3 s, by orders that are renewed long before they end: 3 N s, and no more.
TEST(Push, ThatIsRenewedIsTheForceThatItSays) {
    World world = empty_world(kDt, {});
    place(world, solid_box(1, {0.1, 0.1, 0.1}, surface(0.5)), "box", {{0, 0, 1}, {}});
    for (const bool replaces : {true, false}) {
        Simulation sim(world);
        for (int i = 0; i < 60; ++i) {
            give(sim, ApplyWrench{kLink, {1, 0, 0}, {}, 100, replaces});
            for (int k = 1; k < 50; ++k) sim.step();
        }
        give(sim, ApplyWrench{kLink, {}, {}, 1, true});
        sim.run(0.2);
        EXPECT_NEAR(sim.states[0].v[3], replaces ? 3.0 : 5.95, 1e-9);
    }
}

}  // namespace
}  // namespace roboss::test
