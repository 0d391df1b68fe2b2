// Continuous safety: what is fast, small or thin does not pass thin walls, whatever these are made of. Shots
// from random places and directions at a step of 2 ms.
#include <gtest/gtest.h>

#include <support/meshes.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

constexpr double kWallX = 1.0, kWallSize = 4.0, kThickness = 0.01;

enum class Wall { kBox, kSheet, kMeshBox, kHeightmap, kFreePlate };

/// A wall across x, 1 cm thick or a sheet without thickness; robot 0 if it is free.
void add_wall(World& world, Wall kind) {
    const SurfaceSpec s = surface(0.5);
    const Pose across{{kWallX, 0, 0}, {}};
    const Pose laid{{kWallX, 0, 0}, from_rpy(0, -kPi / 2, 0)};  // its z is -x
    const Vec3 size{kThickness, kWallSize, kWallSize};
    switch (kind) {
        case Wall::kBox:
            return place(world, scenery(box_shape(size, s)), "wall", across);
        case Wall::kSheet:
            return place(
                world,
                scenery(mesh_shape(
                    sheet_mesh(kWallSize, kWallSize, 20, 20, [](double, double) { return 0.0; }), s)),
                "wall", laid);
        case Wall::kMeshBox:
            return place(world, scenery(mesh_shape(box_mesh(size), s)), "wall", across);
        case Wall::kHeightmap: {
            std::vector<double> heights(21 * 21);
            Random random(3);
            for (double& h : heights) h = random.uniform(0, 0.05);
            return place(world, scenery(heightmap_shape(21, 21, heights, kWallSize, kWallSize, s)), "wall",
                         laid);
        }
        case Wall::kFreePlate:
            return place(world, solid_box(5, size, s), "wall", across);
    }
}

struct Shots {
    double speed = 5, spin = 0;  // m/s towards the wall, rad/s
    int count = 40;
};

/// How many of the shots come out behind the wall.
int passed(Wall wall, const ModelSpec& body, const Shots& shots) {
    int through = 0;
    for (int seed = 0; seed < shots.count; ++seed) {
        Random random(static_cast<std::uint64_t>(seed) * 31 + 7);
        World world = empty_world(2e-3, {});
        add_wall(world, wall);
        place(world, body, "body",
              {{random.uniform(-0.2, 0.6), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)},
               random.rotation()});
        Simulation sim(world);
        RobotState& state = sim.states.back();
        for (std::size_t i = 0; i < 3; ++i) state.v[i] = shots.spin * random.uniform(-1, 1);
        state.v[3] = shots.speed;
        for (const std::size_t i : {4u, 5u}) state.v[i] = 0.5 * shots.speed * random.uniform(-1, 1);
        while (sim.time() < 2.0 / shots.speed + 0.05) {
            sim.step();
            Pose X_WP{{kWallX, 0, 0}, {}};
            if (wall == Wall::kFreePlate) X_WP = base_pose(sim.states[0]);
            const Vec3 at = rotate(conjugate(X_WP.q), base_pose(state).p - X_WP.p);
            if (std::fmax(std::fabs(at.y), std::fabs(at.z)) > 0.45 * kWallSize) break;  // past the wall's rim
            if (at.x <= kThickness) continue;
            ++through;
            break;
        }
    }
    return through;
}

TEST(ThinWall, NoBallBoxOrHullPassesAWallAtUpToTwentyMetresASecond) {
    LinkSpec hull = link("hull", 0.05, sphere_inertia(0.05, 0.03));
    hull.collisions.push_back(mesh_shape(ball_mesh(0.03, 1), surface(0.5)));
    const ModelSpec bodies[] = {solid_sphere(0.01, 0.01, surface(0.5)),
                                solid_box(0.05, {0.03, 0.02, 0.04}, surface(0.5)), one_link(hull)};
    for (const Wall wall : {Wall::kBox, Wall::kSheet, Wall::kMeshBox, Wall::kHeightmap, Wall::kFreePlate})
        for (const ModelSpec& body : bodies)
            for (const double speed : {5.0, 20.0})
                EXPECT_EQ(passed(wall, body, {speed, 100}), 0)
                    << body.name << " at " << speed << " m/s, wall " << static_cast<int>(wall);
}

TEST(ThinWall, NoSpinningRodOfFortyPassesAWallWithThickness) {
    for (const ModelSpec& rod :
         {solid_box(0.05, {0.3, 0.005, 0.005}, surface(0.5)), solid_cylinder(0.05, 0.005, 0.3, surface(0.5))})
        for (const Wall wall : {Wall::kBox, Wall::kHeightmap, Wall::kFreePlate})
            for (const double speed : {2.0, 5.0, 10.0})
                EXPECT_EQ(passed(wall, rod, {speed, 20}), 0)
                    << rod.name << " at " << speed << " m/s, wall " << static_cast<int>(wall);
}

TEST(ThinWall, NoSpinningRodPassesAClosedMeshOfACentimetre) {
    for (const ModelSpec& rod :
         {solid_box(0.05, {0.3, 0.005, 0.005}, surface(0.5)), solid_cylinder(0.05, 0.005, 0.3, surface(0.5))})
        for (const double speed : {2.0, 5.0, 10.0})
            EXPECT_EQ(passed(Wall::kMeshBox, rod, {speed, 20, 150}), 0)
                << rod.name << " at " << speed << " m/s";
}

TEST(ThinWall, NoSlowSpinningRodPassesASheetWithoutThickness) {
    for (const ModelSpec& rod :
         {solid_box(0.05, {0.3, 0.005, 0.005}, surface(0.5)), solid_cylinder(0.05, 0.005, 0.3, surface(0.5))})
        EXPECT_EQ(passed(Wall::kSheet, rod, {2, 20, 100}), 0) << rod.name;
}

TEST(ThinWall, NoSmallBallPassesAWallAtUpToAHundredMetresASecond) {
    for (const Wall wall : {Wall::kBox, Wall::kSheet, Wall::kMeshBox, Wall::kHeightmap, Wall::kFreePlate})
        for (const double speed : {5.0, 50.0, 100.0})
            EXPECT_EQ(passed(wall, solid_sphere(0.004, 0.01, surface(0.5)), {speed, 100}), 0)
                << speed << " m/s, wall " << static_cast<int>(wall);
}

}  // namespace
}  // namespace roboss::test
