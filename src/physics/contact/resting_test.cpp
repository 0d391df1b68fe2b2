// Bodies that stand, slide and creep: stack, slope, spawn inside another body.
#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/simulation.h>

#include "geometry/collide.h"

namespace roboss::test {
namespace {

constexpr double kEdge = 0.2;

World stack(int boxes, double sideways) {
    World world = empty_world(2e-3);
    place(world, ground(surface(0.6)), "ground");
    const std::size_t prototype = world.prototypes.size();
    world.prototypes.push_back(solid_box(1.0, {kEdge, kEdge, kEdge}, surface(0.6)));
    for (int i = 0; i < boxes; ++i)
        world.instances.push_back(
            {"box_" + std::to_string(i), prototype, {{sideways * (i % 2), 0, kEdge * (0.5 + i)}, {}}, {}});
    return world;
}

double largest_move(const Simulation& sim, const std::vector<RobotState>& from) {
    double move = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const Pose now = base_pose(sim.states[i]), before = base_pose(from[i]);
        move = std::fmax(move, norm(now.p - before.p));
        move = std::fmax(move, norm(logarithm(now.q * conjugate(before.q))) * kEdge);
    }
    return move;
}

TEST(Resting, TenBoxesStandForTenSeconds) {
    for (const double sideways : {0.0, 0.01}) {
        Simulation sim(stack(10, sideways));
        const std::vector<RobotState> start = sim.states;
        sim.run(10);
        tell("largest move of ten boxes in 10 s, m", largest_move(sim, start));
        tell("worst residual", sim.residual_max);
        EXPECT_LT(largest_move(sim, start), 1e-3);
        EXPECT_LE(sim.residual_max, sim.model->accuracy.tolerance);
    }
}

/// A box on a plane tilted by `degrees` about y; the way down is +x of the plane.
struct Slope {
    Slope(double degrees, double mu, double dt_s) : angle(degrees * kPi / 180) {
        World world = empty_world(dt_s);
        const Quat tilt = from_rpy(0, angle, 0);
        place(world, ground(surface(mu)), "slope", {{}, tilt});
        place(world, solid_box(1.0, {kEdge, kEdge, kEdge}, surface(mu)), "box",
              {rotate(tilt, Vec3{0, 0, 0.5 * kEdge}), tilt});
        sim = std::make_unique<Simulation>(world);
        down = rotate(tilt, Vec3{1, 0, 0});
    }
    double displacement() const { return dot(base_pose(sim->states[0]).p, down); }
    double speed() const {
        return dot(Vec3{sim->states[0].v[3], sim->states[0].v[4], sim->states[0].v[5]}, down);
    }

    double angle;
    Vec3 down;
    std::unique_ptr<Simulation> sim;
};

TEST(Resting, BoxSlidesDownASteepSlopeByCoulombsLaw) {
    for (const double dt_s : {1e-3, 2e-3}) {
        Slope slope(20, 0.2, dt_s);
        slope.sim->run(2);
        const double a = 9.81 * (std::sin(slope.angle) - 0.2 * std::cos(slope.angle));
        tell("relative error of the speed after 2 s", slope.speed() / (a * 2) - 1);
        tell("relative error of the way after 2 s", slope.displacement() / (0.5 * a * 4) - 1);
        EXPECT_NEAR(slope.speed() / (a * 2), 1, 1e-10);
        // Less by what the first contact yields in the first tick: compliance * a * dt^2.
        EXPECT_NEAR(slope.displacement() / (0.5 * a * 4), 1, 5e-6);
    }
}

/// Two cylinders on an axle stand on four points of a line, of which two would do. A file turns them by
/// 1.5707963, not pi / 2: one end of each is 1e-10 m lower.
TEST(Resting, PointsThatAreNotNeededShareTheLoad) {
    World world = empty_world(2e-3);
    place(world, ground(surface(1)), "ground");
    LinkSpec axle = link("axle", 1, box_inertia(1, {0.05, 0.1, 0.05}));
    for (const double y : {-0.05, 0.05})
        axle.collisions.push_back(
            cylinder_shape(0.03, 0.02, surface(1), {{0, y, 0}, from_rpy(1.5707963, 0, 0)}));
    place(world, one_link(axle), "axle", {{0, 0, 0.03}, {}});
    Simulation sim(world);
    sim.run(0.5);
    const std::vector<ContactMemory>& points = sim.states[0].contacts;
    ASSERT_EQ(points.size(), 4u);
    for (const ContactMemory& point : points) EXPECT_NEAR(point.load / (9.81 * 2e-3), 0.25, 0.01);
}

TEST(Resting, BoxBelowTheFrictionAngleDoesNotCreep) {
    Slope slope(20, 0.4, 2e-3);
    slope.sim->run(1);
    const double before = slope.displacement();
    slope.sim->run(10);
    tell("creep below the friction angle, m/s", (slope.displacement() - before) / 10);
    EXPECT_LT(std::fabs(slope.displacement() - before) / 10, 1e-6);
    EXPECT_LT(std::fabs(slope.speed()), 1e-6);
}

TEST(Resting, SlidingBoxStopsWhereFrictionSaysAndStays) {
    World world = empty_world(1e-3);
    place(world, ground(surface(0.5)), "ground");
    place(world, solid_box(1.0, {0.4, 0.4, 0.1}, surface(0.5)), "box", {{0, 0, 0.05}, {}});
    Simulation sim(world);
    sim.states[0].v = {0, 0, 0, 1.2, 1.6, 0};  // diagonal to both tangents: friction must be isotropic
    sim.run(2);
    const double displacement = 2.0 * 2.0 / (2 * 0.5 * 9.81);
    const double x = sim.states[0].q[0], y = sim.states[0].q[1];
    EXPECT_NEAR(std::hypot(x, y) / displacement, 1, 5e-3);
    EXPECT_NEAR(y / x, 1.6 / 1.2, 1e-4) << "stays on its line";
    EXPECT_LT(std::hypot(sim.states[0].v[3], sim.states[0].v[4]), 1e-9);
}

TEST(Resting, OverlappingBoxesPartWithoutGainingSpeed) {
    World world = empty_world(1e-3, {});
    place(world, solid_box(1.0, {kEdge, kEdge, kEdge}, surface(0.6)), "lower");
    place(world, solid_box(2.0, {kEdge, kEdge, kEdge}, surface(0.6)), "upper",
          {{0.03, 0.02, kEdge - 0.05}, from_rpy(0, 0, 0.3)});
    Simulation sim(world);
    sim.run(1);
    const auto placed = [&](std::size_t i) {
        return link_pose(sim.type(i), sim.states[i], LinkId(std::size_t{0}));
    };
    const Shape& shape = sim.type(0).shapes[0].shape;
    const Manifold manifold = collide(shape, placed(0), shape, placed(1), 0.01);
    double gap = 1;
    for (int i = 0; i < manifold.count; ++i)
        gap = std::fmin(gap, manifold.points[static_cast<std::size_t>(i)].gap);
    tell("energy gained while parting, J", sim.energy());
    EXPECT_LT(sim.energy(), 1e-12);
    EXPECT_GT(gap, -2e-5) << "mended but for the slop";
    EXPECT_LT(gap, 1e-3) << "not thrown apart";
}

TEST(Resting, BoxSpawnedInsideTheGroundRisesWithoutJumping) {
    World world = empty_world(1e-3);
    place(world, ground(surface(0.6)), "ground");
    place(world, solid_box(1.0, {kEdge, kEdge, kEdge}, surface(0.6)), "box",
          {{0, 0, 0.5 * kEdge - 0.03}, {}});
    Simulation sim(world);
    double highest = 0;
    for (int i = 0; i < 1000; ++i) {
        sim.step();
        highest = std::fmax(highest, sim.states[0].q[2]);
    }
    EXPECT_LT(highest, 0.5 * kEdge + 1e-4);
    EXPECT_NEAR(sim.states[0].q[2], 0.5 * kEdge, 2e-5);
}

TEST(Resting, SpinningCoinOnAPlaneLosesEnergyAndComesToRest) {
    World world = empty_world(1e-3);
    place(world, ground(surface(0.5)), "ground");
    place(world, solid_cylinder(0.1, 0.05, 0.01, surface(0.5)), "coin",
          {{0, 0, 0.06}, from_rpy(kPi / 2 - 0.2, 0, 0)});
    Simulation sim(world);
    sim.states[0].v = {3, 0, 40, 0.2, 0, 0};
    double energy = sim.energy(), gain = 0;
    for (int i = 0; i < 8000; ++i) {
        sim.step();
        const double now = sim.energy();
        gain = std::fmax(gain, now - energy);
        energy = std::fmin(energy, now);
        ASSERT_FALSE(sim.report.not_finite.valid());
    }
    tell("largest rise of the coin's energy, J, of 0.16 J at the start", gain);
    EXPECT_LT(gain, 2e-3);
}

}  // namespace
}  // namespace roboss::test
