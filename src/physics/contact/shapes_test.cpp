// Hulls, triangle meshes, height fields, ellipsoids and polylines in motion, against the primitive shapes
// that they stand for.
#include <gtest/gtest.h>

#include <cmath>

#include <support/meshes.h>
#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

const double kFlat = 0;
double flat(double, double) {
    return kFlat;
}

Vec3 position(const Simulation& sim, std::size_t robot = 0) {
    return base_pose(sim.states[robot]).p;
}

TEST(Shapes, ACubeMeshFallsTumblesAndRestsLikeABox) {
    const Vec3 size{0.2, 0.3, 0.1};
    const Pose start{{0, 0, 0.4}, from_rpy(0.3, 0.2, 0.1)};
    World box = empty_world(1e-3), mesh = empty_world(1e-3);
    for (World* w : {&box, &mesh}) place(*w, ground(surface(0.6)), "ground");
    place(box, solid_box(2, size, surface(0.6)), "body", start);
    place(mesh, box_like(2, size, mesh_shape(box_mesh(size), surface(0.6))), "body", start);
    Simulation a(box), b(mesh);
    for (int i = 0; i < 2000; ++i) {
        a.step(), b.step();
        ASSERT_NEAR(norm(position(a) - position(b)), 0, 1e-9) << "tick " << i;
        ASSERT_EQ(a.report.contacts, b.report.contacts) << "tick " << i;
    }
    EXPECT_NEAR(position(b).z, 0.05, 1e-5);
    EXPECT_EQ(b.report.contacts, 4);
}

TEST(Shapes, AnEllipsoidComesToRestOnItsShortAxis) {
    World world = empty_world(2e-3);
    place(world, ground(surface(0.5)), "ground");
    LinkSpec l = link("body", 1, box_inertia(1, {0.4, 0.3, 0.15}));
    l.collisions.push_back(ellipsoid_shape({0.2, 0.15, 0.08}, surface(0.5)));
    place(world, one_link(l), "egg", {{0, 0, 0.08}, {}});
    Simulation sim(world);
    sim.run(1.0);
    EXPECT_NEAR(position(sim).z, 0.08, 2e-5);
    EXPECT_LT(std::fabs(sim.states[0].v[5]), 1e-6);
}

/// Share of a sphere's way down a slope that a ball of triangles falls short, and its drift aside.
double shortfall(int levels) {
    const double angle = 10 * kPi / 180;
    World world = empty_world(1e-3, {9.81 * fixed_sin(angle), 0, -9.81 * fixed_cos(angle)});
    place(world, ground(surface(0.8)), "ground");
    place(world, ball_like(1, 0.1, mesh_shape(ball_mesh(0.1, levels), surface(0.8))), "mesh",
          {{0, 0, 0.1}, {}});
    Simulation sim(world);
    sim.run(1.5);
    EXPECT_NEAR(position(sim).y, 0, 0.05);
    return 1.0 - position(sim).x / (0.5 * (5.0 / 7.0) * 9.81 * fixed_sin(angle) * 1.5 * 1.5);
}

// A polyhedron that rolls loses energy at each edge it falls over, in proportion to the angle there.
TEST(Shapes, ABallOfTrianglesRollsLikeASphereTheMoreTheFinerItIs) {
    const double coarse = shortfall(3), fine = shortfall(4);
    tell("642 corners: short of the sphere's way by", coarse);
    tell("2562 corners: short of the sphere's way by", fine);
    EXPECT_GT(coarse, 0);
    EXPECT_LT(coarse, 0.2);
    EXPECT_LT(fine, 0.6 * coarse);
}

/// A box pushed off at 5 m/s over the ground given.
Simulation& slide(Simulation& sim) {
    sim.states[0].v[3] = 5.0;
    sim.run(2.6);
    return sim;
}

TEST(Shapes, ABoxSlidesOverATriangulatedFloorAsStraightAndFarAsOnAPlane) {
    const double mu = 0.25;
    const auto body = solid_box(1, {0.3, 0.2, 0.1}, surface(mu));
    const Pose start{{-4, 0.03, 0.05}, {}};
    World plane = empty_world(1e-3), mesh = empty_world(1e-3);
    place(plane, ground(surface(mu)), "ground");
    place(mesh, scenery(mesh_shape(sheet_mesh(12, 2, 20, 5, flat), surface(mu))), "ground");
    for (World* w : {&plane, &mesh}) place(*w, body, "box", start);
    Simulation a(plane), b(mesh);
    slide(a), slide(b);
    const double displacement = position(b).x - start.p.x;
    tell("way on the mesh, m", displacement);
    tell("way on the plane, m", position(a).x - start.p.x);
    EXPECT_NEAR(displacement, position(a).x - start.p.x, 1e-4);
    EXPECT_NEAR(displacement, 25 / (2 * mu * 9.81), 0.01);
    EXPECT_NEAR(position(b).y, 0.03, 1e-6);
    EXPECT_NEAR(position(b).z, 0.05, 2e-5);
    const Quat q = base_pose(b.states[0]).q;
    EXPECT_LT(std::fabs(q.z) + std::fabs(q.x) + std::fabs(q.y), 1e-6);
}

TEST(Shapes, AWheelAndABallRollOverATriangulatedFloorWithoutBumps) {
    for (const bool ball : {true, false}) {
        World world = empty_world(1e-3);
        place(world, scenery(mesh_shape(sheet_mesh(12, 2, 37, 5, flat), surface(0.8))), "ground");
        if (ball)
            place(world, solid_sphere(1, 0.1, surface(0.8)), "body", {{-4, 0.013, 0.1}, {}});
        else
            place(world, solid_cylinder(1, 0.1, 0.06, surface(0.8)), "body",
                  {{-4, 0.013, 0.1}, from_rpy(kPi / 2, 0, 0)});
        Simulation sim(world);
        sim.states[0].v[3] = 3.0, sim.states[0].v[1] = 30.0;
        double highest = 0, fastest = 0;
        for (int i = 0; i < 2000; ++i) {
            sim.step();
            highest = std::max(highest, std::fabs(position(sim).z - 0.1));
            fastest = std::max(fastest, std::fabs(sim.states[0].v[5]));
        }
        tell(ball ? "ball: largest bump, m" : "wheel: largest bump, m", highest);
        EXPECT_LT(highest, 2e-5);
        EXPECT_LT(fastest, 1e-3);
        EXPECT_NEAR(position(sim).x, 2.0, 0.01);
        EXPECT_NEAR(position(sim).y, 0.013, 1e-5);
    }
}

TEST(Shapes, ASphereRollsDownARampOfAHeightmapAsOnAnInclinedPlane) {
    const double slope = 0.2, size = 10;
    std::vector<double> heights;
    for (int j = 0; j < 9; ++j)
        for (int i = 0; i < 33; ++i) heights.push_back(slope * (size / 2 - size * i / 32.0));
    World world = empty_world(1e-3);
    place(world, scenery(heightmap_shape(33, 9, heights, size, 2, surface(0.8))), "ramp");
    const double sine = slope / std::sqrt(1 + slope * slope), cosine = 1 / std::sqrt(1 + slope * slope);
    const Vec3 n{sine, 0, cosine};
    const Vec3 start = Vec3{-4, 0.07, slope * 4} + n * 0.1;
    place(world, solid_sphere(1, 0.1, surface(0.8)), "ball", {start, {}});
    Simulation sim(world);
    sim.run(2.0);
    const double exact = 0.5 * (5.0 / 7.0) * 9.81 * sine * 4;
    const Vec3 displacement = position(sim) - start;
    tell("way down the ramp / exact", norm(displacement) / exact);
    EXPECT_NEAR(norm(displacement), exact, 2e-3 * exact);
    EXPECT_NEAR(dot(displacement, n), 0, 3e-5);
    EXPECT_NEAR(displacement.y, 0, 1e-6);
}

TEST(Shapes, AnLShapedPolylineFallsAndStands) {
    World world = empty_world(1e-3);
    place(world, ground(surface(0.6)), "ground");
    const std::vector<Vec3> outline{{0, 0, 0},     {0.3, 0, 0},   {0.3, 0.1, 0},
                                    {0.1, 0.1, 0}, {0.1, 0.4, 0}, {0, 0.4, 0}};
    // The outline stands upright: its y is up.
    LinkSpec l = link("body", 1, box_inertia(1, {0.3, 0.2, 0.4}), {});
    l.p_LC = {0.1, -0.1, 0.15};
    l.collisions.push_back(polyline_shape(outline, 0.2, surface(0.6), {{}, from_rpy(kPi / 2, 0, 0)}));
    place(world, one_link(l), "angle", {{0, 0, 0.05}, {}});
    Simulation sim(world);
    EXPECT_EQ(sim.type(0).shapes.size(), 2u);
    sim.run(2.0);
    const Pose X = base_pose(sim.states[0]);
    EXPECT_NEAR((X * Vec3{0, 0, 0}).z, (X * Vec3{0.3, 0, 0}).z, 1e-5);
    EXPECT_GT(rotate(X.q, Vec3{0, 0, 1}).z, 0.999999);
    EXPECT_LT(norm(Vec3{sim.states[0].v[3], sim.states[0].v[4], sim.states[0].v[5]}), 1e-6);
}

TEST(Shapes, BoxesBallsAndCylindersRestOnAndBesideASolidMesh) {
    World world = empty_world(1e-3);
    place(world, ground(surface(0.6)), "ground");
    place(world, scenery(mesh_shape(box_mesh({1, 1, 0.5}), surface(0.6))), "block", {{0, 0, 0.25}, {}});
    place(world, solid_box(1, {0.2, 0.2, 0.2}, surface(0.6)), "on", {{0.1, 0.1, 0.62}, {}});
    place(world, solid_box(1, {0.2, 0.2, 0.2}, surface(0.6)), "over_the_edge", {{0.45, -0.3, 0.62}, {}});
    place(world, solid_cylinder(1, 0.1, 0.2, surface(0.6)), "can", {{-0.3, 0.3, 0.62}, {}});
    place(world, solid_box(1, {0.2, 0.2, 0.9}, surface(0.6)), "tall", {{0.6000001, 0.2, 0.45}, {}});
    Simulation sim(world);
    sim.run(2.0);
    EXPECT_NEAR(position(sim, 0).z, 0.6, 2e-5);
    EXPECT_NEAR(position(sim, 1).z, 0.6, 2e-5);
    EXPECT_NEAR(position(sim, 2).z, 0.6, 2e-5);
    EXPECT_NEAR(norm(position(sim, 3) - Vec3{0.6, 0.2, 0.45}), 0, 1e-4);
}

TEST(Shapes, ABoxRestsInAValleyAndOnARidgeOfAMesh) {
    const auto ridge = [](double x, double) { return -0.3 * std::fabs(x); };
    const auto valley = [](double x, double) { return std::fabs(x); };
    World world = empty_world(1e-3);
    place(world, scenery(mesh_shape(sheet_mesh(4, 4, 4, 4, ridge), surface(0.9))), "ridge", {{0, 0, 0}, {}});
    place(world, scenery(mesh_shape(sheet_mesh(4, 4, 4, 4, valley), surface(0.0))), "valley",
          {{20, 0, 0}, {}});
    place(world, solid_box(1, {0.4, 0.4, 0.2}, surface(0.9)), "on_ridge", {{0, 0.05, 0.1}, {}});
    place(world, solid_box(1, {0.4, 0.4, 0.4}, surface(0.0)), "in_valley",
          {{20, 0.1, 0.35}, from_rpy(0, kPi / 4, 0)});
    Simulation sim(world);
    sim.run(1.0);
    EXPECT_NEAR(position(sim, 0).z, 0.1, 2e-5) << "balanced";
    EXPECT_NEAR(position(sim, 1).z, 0.2 * std::sqrt(2.0), 1e-4);
    EXPECT_NEAR(position(sim, 1).x, 20, 1e-4);
}

TEST(Shapes, ABallRollsOffAMeshBlockOverItsEdgeWithoutAJump) {
    World world = empty_world(1e-3);
    place(world, scenery(mesh_shape(box_mesh({2, 2, 0.5}), surface(0.8))), "block", {{0, 0, -0.25}, {}});
    World plain = empty_world(1e-3);
    place(plain, scenery(box_shape({2, 2, 0.5}, surface(0.8))), "block", {{0, 0, -0.25}, {}});
    for (World* w : {&world, &plain})
        place(*w, solid_sphere(1, 0.1, surface(0.8)), "ball", {{0.5, 0.02, 0.1}, {}});
    Simulation a(world), b(plain);
    for (Simulation* s : {&a, &b}) s->states[0].v[3] = 0.8, s->states[0].v[1] = 8.0;
    for (int i = 0; i < 1200; ++i) {
        a.step(), b.step();
        ASSERT_NEAR(norm(position(a) - position(b)), 0, 2e-3) << "tick " << i;
    }
    EXPECT_LT(position(a).z, -0.5) << "it has fallen";
}

TEST(Shapes, ACarDrivesOnAMeshAsOnAPlane) {
    World plane = empty_world(2e-3), mesh = empty_world(2e-3);
    place(plane, ground(surface(0.9)), "ground");
    place(mesh, scenery(mesh_shape(sheet_mesh(20, 20, 100, 100, flat), surface(0.9))), "ground");
    for (World* w : {&plane, &mesh}) place(*w, car(), "car", {{0, 0, 0.0}, {}});
    Simulation a(plane), b(mesh);
    for (Simulation* s : {&a, &b})
        for (std::size_t d = 0; d < s->states[0].motors.size(); ++d)
            s->set_motor(0, d, MotorMode::kVelocity, 10);
    a.run(4), b.run(4);
    tell("way on the plane, m", position(a).x);
    EXPECT_GT(norm(position(a)), 1.0);
    EXPECT_NEAR(norm(position(a) - position(b)), 0, 0.01);
}

TEST(Shapes, EqualCornersMeanEqualModelHashesAndAMovedCornerAnother) {
    const auto hash_with = [](double corner) {
        World world = empty_world(1e-3);
        MeshSpec mesh = box_mesh({1, 1, 1});
        mesh.vertices[7].x += corner;
        place(world, scenery(mesh_shape(mesh, surface(1))), "fixed");
        place(world, box_like(1, {1, 1, 1}, mesh_shape(box_mesh({1, 1, 1}), surface(1))), "body",
              {{0, 0, 3}, {}});
        return compiled(world)->hash;
    };
    EXPECT_EQ(hash_with(0), hash_with(0));
    EXPECT_NE(hash_with(0), hash_with(1e-15));
}

}  // namespace
}  // namespace roboss::test
