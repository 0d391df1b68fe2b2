// Buoyancy, damping in water and added mass against closed forms.
#include <gtest/gtest.h>

#include <support/own_numbers.h>
#include <support/robots.h>
#include <support/simulation.h>

#include "geometry/submerged.h"

namespace roboss::test {
namespace {

constexpr double kG = 9.81, kWater = 1000;

/// Water up to z = 0, nothing above.
World sea(double dt_s = 1e-3) {
    World world = empty_world(dt_s, {0, 0, -kG});
    world.air_density = 0;
    BuoyancySpec fluid;
    fluid.graded = true, fluid.lowest_density = kWater;
    fluid.layers = {{0, 0}};
    world.buoyancy = fluid;
    return world;
}

ModelSpec afloat(ModelSpec m) {
    for (LinkSpec& link : m.links) link.buoyant = true;
    return m;
}

/// Damping and added mass of the first link, by name of the element.
ModelSpec in_water(ModelSpec m, const std::vector<std::pair<std::string, double>>& values) {
    HydrodynamicsSpec spec;
    spec.link = {m.links[0].name};
    const auto set = [&](const std::vector<std::string>& names, std::vector<double>& into) {
        for (const auto& [name, value] : values)
            for (std::size_t i = 0; i < names.size(); ++i)
                if (names[i] == name) into[i] = value;
    };
    set(HydrodynamicsSpec::names().linear, spec.linear);
    set(HydrodynamicsSpec::names().absolute, spec.absolute);
    set(HydrodynamicsSpec::names().square, spec.square);
    set(HydrodynamicsSpec::names().added_mass, spec.added_mass);
    m.onboard.push_back({"hydrodynamics", spec, {}});
    return m;
}

std::vector<std::pair<std::string, double>> strong_damping() {
    return {{"xU", -200}, {"yV", -200}, {"zW", -200}, {"kP", -4}, {"mQ", -4}, {"nR", -4}};
}

void expect_depth(const ModelSpec& model, double expected, double tolerance) {
    World world = sea();
    place(world, in_water(afloat(model), strong_damping()), "body", {{0, 0, 0.3}, {}});
    Simulation sim(world);
    sim.run(30);
    EXPECT_NEAR(sim.states[0].q[2], expected, tolerance) << model.name;
    EXPECT_LT(std::fabs(sim.states[0].v[5]), 1e-7) << model.name;
}

/// The water that a body displaces weighs by the gravity that the body feels.
TEST(Water, ABallRisesByItsOwnGravity) {
    constexpr double kMass = 2, kRadius = 0.1, kOwn = 1.62;
    World world = sea();
    place(world, afloat(solid_sphere(kMass, kRadius, surface(0.5))), "ball", {{0, 0, -50}, {}});
    Simulation sim(world);
    give(sim, 0, SetSurroundings{false, {Vec3{0, 0, -kOwn}, std::nullopt}});
    sim.run(1);
    const double displaced = kWater * 4 / 3 * kPi * kRadius * kRadius * kRadius;
    EXPECT_NEAR(sim.states[0].v[5], kOwn * (displaced / kMass - 1), 1e-9);
}

TEST(Water, ABoxFloatsAtItsDepth) {
    const Vec3 size{0.6, 0.8, 0.3};
    const double mass = 0.4 * kWater * size.x * size.y * size.z;
    expect_depth(solid_box(mass, size, surface(0.5)), 0.15 - 0.4 * 0.3, 1e-8);
}

TEST(Water, ASphereFloatsAtItsDepth) {
    const double r = 0.25, fraction = 0.3;
    // cap of height h: pi h^2 (3 r - h) / 3
    double low = 0, high = 2 * r;
    for (int i = 0; i < 100; ++i) {
        const double h = 0.5 * (low + high);
        (kPi * h * h * (3 * r - h) / 3 < fraction * 4.0 / 3 * kPi * r * r * r ? low : high) = h;
    }
    expect_depth(solid_sphere(fraction * kWater * 4.0 / 3 * kPi * r * r * r, r, surface(0.5)), r - low, 1e-8);
}

TEST(Water, ACylinderFloatsAtItsDepth) {
    ModelSpec m;
    m.name = m.canonical_link = "disc";
    const double r = 0.5, length = 0.2, mass = 0.55 * kWater * kPi * r * r * length;
    m.links.push_back(link("disc", mass, cylinder_inertia(mass, r, length), {}));
    m.links[0].collisions.push_back(cylinder_shape(r, length, surface(0.5)));
    expect_depth(m, 0.1 - 0.55 * length, 1e-8);
}

/// A flat raft turns upright; a square log of half the water's density floats on its edge.
TEST(Water, TiltedBoxesComeToTheirStableAttitude) {
    World world = sea();
    const auto box = [&](const Vec3& size, double density, double tilt, double x) {
        const double mass = density * size.x * size.y * size.z;
        place(world, in_water(afloat(solid_box(mass, size, surface(0.5))), strong_damping()),
              "box" + std::to_string(x), {{x, 0, 0}, from_rpy(tilt, 0, 0)});
    };
    box({0.8, 0.8, 0.2}, 500, 0.5, 0);
    box({1.5, 0.3, 0.3}, 500, 0.3, 5);
    Simulation sim(world);
    sim.run(30);
    const auto up = [&](std::size_t i) {
        const std::vector<double>& q = sim.states[i].q;
        return to_matrix(Quat{q[3], q[4], q[5], q[6]}).r2;
    };
    EXPECT_NEAR(up(0).z, 1, 1e-8);
    EXPECT_NEAR(sim.states[0].q[2], 0, 1e-8);
    EXPECT_NEAR(std::fabs(up(1).y), std::sqrt(0.5), 1e-5);
    EXPECT_NEAR(std::fabs(up(1).z), std::sqrt(0.5), 1e-5);
}

/// Small roll of a box: righting moment rho g V GM with Bouguer's metacentre GM = I / V - GB.
TEST(Water, ATiltedBoxRollsWithThePeriodOfItsMetacentre) {
    const Vec3 size{2.0, 1.0, 0.3};
    const double fraction = 0.5, mass = fraction * kWater * size.x * size.y * size.z;
    World world = sea(1e-3);
    place(world, afloat(solid_box(mass, size, surface(0.5))), "box", {{0, 0, 0}, from_rpy(1e-3, 0, 0)});
    Simulation sim(world);
    const double volume = size.x * size.y * size.z * fraction;
    const double metacentre = size.x * size.y * size.y * size.y / 12 / volume - 0.25 * size.z;
    const double inertia = mass * (size.y * size.y + size.z * size.z) / 12;
    const double period = 2 * kPi * std::sqrt(inertia / (kWater * kG * volume * metacentre));
    int crossings = 0;
    double first = 0, last = 0, before = 1;
    while (crossings < 21) {
        sim.step();
        const double now = sim.states[0].q[4];
        if ((before > 0) != (now > 0)) {
            const double at = sim.time() - sim.model->dt_s * now / (now - before);
            (crossings == 0 ? first : last) = at;
            ++crossings;
        }
        before = now;
    }
    EXPECT_NEAR((last - first) / 10 / period, 1, 1e-4);
}

/// Heave of an upright cylinder with added mass: T = 2 pi sqrt((m + A) / (rho g pi r^2)).
TEST(Water, HeaveHasThePeriodOfMassAndAddedMass) {
    for (const bool by_element : {false, true}) {
        const double r = 0.5, length = 0.3, mass = 0.5 * kWater * kPi * r * r * length, added = 300;
        ModelSpec m;
        m.name = m.canonical_link = "buoy";
        m.links.push_back(link("buoy", mass, cylinder_inertia(mass, r, length), {}));
        m.links[0].collisions.push_back(cylinder_shape(r, length, surface(0.5)));
        m = afloat(m);
        if (by_element) {
            m.links[0].added_mass.assign(kAddedMassNumbers, 0.0);
            m.links[0].added_mass[11] = added;  // zz
        } else {
            m = in_water(m, {{"zDotW", -added}});
        }
        World world = sea(2e-3);
        place(world, m, "buoy", {{0, 0, 0.05}, {}});
        Simulation sim(world);
        const double rate = std::sqrt(kWater * kG * kPi * r * r / (mass + added));
        for (int i = 1; i <= 10; ++i) {
            sim.run(1);
            EXPECT_NEAR(sim.states[0].q[2], 0.05 * std::cos(rate * sim.time()), 1e-8) << sim.time();
        }
    }
}

TEST(Water, NeutralBuoyancyStays) {
    World world = sea();
    const Vec3 size{0.5, 0.4, 0.3};
    place(world, afloat(solid_box(kWater * size.x * size.y * size.z, size, surface(0.5))), "box",
          {{0, 0, -5}, from_rpy(0.3, 0.2, 0.1)});
    Simulation sim(world);
    sim.run(10);
    EXPECT_NEAR(sim.states[0].q[2], -5, 1e-9);
    EXPECT_NEAR(norm(Vec3{sim.states[0].v[0], sim.states[0].v[1], sim.states[0].v[2]}), 0, 1e-12);
}

TEST(Water, LayersCarryWithTheirOwnDensities) {
    World world = sea();
    world.buoyancy->lowest_density = 1200;
    world.buoyancy->layers = {{-2, 1000}, {0, 1}};
    // 1100 kg/m^3 comes to rest between the layers: half in each
    place(world, in_water(afloat(solid_box(1100 * 0.064, {0.4, 0.4, 0.4}, surface(0.5))), strong_damping()),
          "box", {{0, 0, -1}, {}});
    Simulation sim(world);
    sim.run(30);
    EXPECT_NEAR(sim.states[0].q[2], -2, 1e-7);
}

/// Floating and passive bodies with added mass and damping: kinetic energy with the water's, weight and the
/// fluid's potential never gain.
TEST(Water, EnergyOfAPassiveBodyNeverGrows) {
    const double mass = 60, added = 45;
    World world = sea(2e-3);
    ModelSpec m =
        in_water(afloat(solid_box(mass, {0.6, 0.5, 0.4}, surface(0.5))),
                 {{"xU", -2}, {"yVabsV", -9}, {"zW", -1}, {"kP", -0.3}, {"mQabsQ", -0.4}, {"nR", -0.2}});
    m.links[0].added_mass.assign(kAddedMassNumbers, 0.0);
    for (const std::size_t diagonal : {0u, 6u, 11u}) m.links[0].added_mass[diagonal] = added;
    place(world, m, "box", {{0, 0, 0.4}, from_rpy(0.9, 0.4, 0.1)});
    Simulation sim(world);
    sim.states[0].v[0] = 2, sim.states[0].v[4] = 1.5;
    const RobotType& type = sim.type(0);
    const auto energy = [&] {
        const std::vector<double>&q = sim.states[0].q, &v = sim.states[0].v;
        const Transform X{to_matrix(Quat{q[3], q[4], q[5], q[6]}), {q[0], q[1], q[2]}};
        const Submerged part = submerged_part(type.shapes[0].shape, X * type.shapes[0].X_BS, 0);
        // potential of the fluid: rho g times the sunk volume times its depth
        const double depth = -(part.moment.z + X.p.z * part.volume);
        return sim.energy(0) + 0.5 * added * norm_squared(Vec3{v[3], v[4], v[5]}) + kWater * kG * depth;
    };
    double most = energy();
    const double start = most;
    for (int i = 0; i < 10000; ++i) {
        sim.step();
        const double now = energy();
        ASSERT_LE(now, most + 1e-6) << "tick " << i;
        most = now;
    }
    EXPECT_LT(most, start - 50);
}

ModelSpec submarine(const std::vector<std::pair<std::string, double>>& values) {
    return in_water(solid_box(10, {0.6, 0.3, 0.2}, surface(0.5)), values);
}

TEST(Hydrodynamics, LinearDampingDecaysExponentially) {
    World world = empty_world(1e-3, {});
    place(world, submarine({{"xU", -5}, {"xDotU", -6}}), "sub");
    Simulation sim(world);
    sim.states[0].v[3] = 2;
    sim.run(3);
    EXPECT_NEAR(sim.states[0].v[3], 2 * std::exp(-5.0 * 3 / 16), 1e-9);
}

TEST(Hydrodynamics, QuadraticDampingDecaysHyperbolically) {
    World world = empty_world(1e-3, {});
    place(world, submarine({{"xUabsU", -8}}), "sub");
    Simulation sim(world);
    sim.states[0].v[3] = 3;
    sim.run(4);
    EXPECT_NEAR(sim.states[0].v[3], 3 / (1 + 8.0 / 10 * 3 * 4), 1e-9);
}

TEST(Hydrodynamics, ASinkingBodyComesToItsTerminalSpeed) {
    World world = empty_world(1e-3, {0, 0, -kG});
    place(world, submarine({{"zW", -10}, {"zWabsW", -20}}), "sub");
    Simulation sim(world);
    sim.run(30);
    const double weight = 10 * kG;
    EXPECT_NEAR(-sim.states[0].v[5], (-10 + std::sqrt(100 + 4 * 20 * weight)) / 40, 1e-9);
}

TEST(Hydrodynamics, AnyStrengthIsStable) {
    for (const double strength : {1e3, 1e5, 1e7, 1e9}) {  // from 1e4 on explicit steps explode
        World world = empty_world(1e-2, {0, 0, -kG});
        place(world,
              submarine({{"xU", -strength},
                         {"yVabsV", -strength},
                         {"zW", -strength},
                         {"kPabsP", -strength},
                         {"mQ", -strength},
                         {"nR", -strength},
                         {"xR", 0.3 * strength},
                         {"nU", -0.3 * strength}}),
              "sub");
        Simulation sim(world);
        sim.states[0].v = {3, -2, 1, 4, -5, 1};
        double before = 1e9;
        for (int i = 0; i < 500; ++i) {
            sim.step();
            double sum = 0;
            for (const double x : sim.states[0].v) sum += x * x;
            ASSERT_LT(sum, before + 1e-1) << strength << ", tick " << i;
            before = sum;
        }
        EXPECT_NEAR(-sim.states[0].v[5], 10 * kG / strength, 2e-2 * 10 * kG / strength);
    }
}

TEST(Hydrodynamics, TheCurrentCarriesAlong) {
    World world = empty_world(1e-3, {});
    ModelSpec m =
        submarine({{"xU", -30}, {"yV", -30}, {"zW", -30}, {"xDotU", -5}, {"yDotV", -9}, {"nR", -1}});
    std::get<HydrodynamicsSpec>(m.onboard[0].parameters).current = {0.5, -0.2, 0.1};
    place(world, m, "sub", {{}, from_rpy(0, 0, 0.7)});
    Simulation sim(world);
    sim.run(40);
    EXPECT_NEAR(sim.states[0].v[3], 0.5, 1e-6);
    EXPECT_NEAR(sim.states[0].v[4], -0.2, 1e-6);
    EXPECT_NEAR(sim.states[0].v[5], 0.1, 1e-6);
    Order order;
    order.apply_at = sim.tick, order.robot = RobotId(std::size_t{0});
    order.action = Command{0, {0, 0, -0.3}};
    ASSERT_TRUE(check_order(*sim.model, order));
    sim.step({&order, 1});
    sim.run(40);
    EXPECT_NEAR(sim.states[0].v[3], 0, 1e-6);
    EXPECT_NEAR(sim.states[0].v[5], -0.3, 1e-6);
}

/// In ideal fluid a body that moves askew is turned broadside on by the moment (A_y - A_x) u v (Munk).
TEST(Hydrodynamics, TheMunkMomentIsThatOfTheAddedMasses) {
    World world = empty_world(1e-5, {});
    place(world, submarine({{"xDotU", -2}, {"yDotV", -12}, {"nDotR", -0.4}}), "sub");
    Simulation sim(world);
    const double u = 2, v = 1;
    sim.states[0].v[3] = u, sim.states[0].v[4] = v;
    sim.run(1e-3);
    const double inertia = 10 * (0.36 + 0.09) / 12 + 0.4;
    EXPECT_NEAR(sim.states[0].v[2] / 1e-3, -(12 - 2) * u * v / inertia, 1e-3);
}

/// Kirchhoff's equations keep the energy of body and water, and their momentum.
TEST(Hydrodynamics, IdealFluidTakesNoEnergy) {
    World world = empty_world(1e-3, {});
    ModelSpec m = solid_box(10, {0.6, 0.3, 0.2}, surface(0.5));
    m.links[0].p_LC = {0.02, -0.01, 0.03};
    std::vector<double>& A = m.links[0].added_mass;
    A.assign(kAddedMassNumbers, 0.0);
    A[0] = 3, A[6] = 9, A[11] = 14, A[15] = 0.2, A[18] = 0.3, A[20] = 0.4;
    A[1] = 0.5, A[10] = 0.7, A[9] = -0.4;  // xy, yr, yq
    place(world, m, "body");
    Simulation sim(world);
    sim.states[0].v = {2, 1, -3, 1, -2, 1.5};
    const auto energy = [&] {
        const std::vector<double>&q = sim.states[0].q, &v = sim.states[0].v;
        const Mat3 R = to_matrix(Quat{q[3], q[4], q[5], q[6]});
        const Vec3 l = transpose_times(R, Vec3{v[3], v[4], v[5]}),
                   w = transpose_times(R, Vec3{v[0], v[1], v[2]});
        const double s[6] = {l.x, l.y, l.z, w.x, w.y, w.z};
        double water = 0;
        for (std::size_t i = 0, k = 0; i < 6; ++i)
            for (std::size_t j = i; j < 6; ++j, ++k) water += (i == j ? 0.5 : 1.0) * A[k] * s[i] * s[j];
        return sim.energy(0) + water;
    };
    const double start = energy();
    sim.run(20);
    EXPECT_NEAR(energy() / start, 1, 1e-8);
}

/// Added mass on a link that hangs on a joint: a pendulum in water swings slower.
TEST(Hydrodynamics, APendulumWithAddedMassSwingsSlower) {
    ModelSpec m = pendulum(1.0, 1.0);
    m.links[0].added_mass.assign(kAddedMassNumbers, 0.0);
    m.links[0].added_mass[0] = 0.5;   // xx, at the hinge: of no effect
    m.links[0].added_mass[18] = 0.2;  // qq
    World world = empty_world(1e-3, {0, 0, -kG});
    place(world, m, "pendulum");
    Simulation sim(world);
    sim.states[0].q[7] = 1e-4;
    const double inertia = m.links[0].inertia_C.r1.y + 0.25 + 0.2;
    const double rate = std::sqrt(kG * 0.5 / inertia);
    sim.run(5);
    EXPECT_NEAR(sim.states[0].q[7], 1e-4 * std::cos(rate * 5), 1e-9);
}

TEST(Water, BitsDoNotDependOnWhoSharesTheStep) {
    const auto world_of = [](int count) {
        World world = sea(2e-3);
        for (int i = 0; i < count; ++i)
            place(world,
                  in_water(afloat(solid_box(30 + i, {0.6, 0.5, 0.4}, surface(0.5))),
                           {{"xU", -2}, {"zW", -30}, {"zDotW", -20}}),
                  "box" + std::to_string(i), {{3.0 * i, 0, 0.4}, from_rpy(0.3, 0.4, 0.1 * i)});
        return world;
    };
    Simulation alone(world_of(1)), many(world_of(4));
    alone.run(3), many.run(3);
    EXPECT_EQ(alone.states[0], many.states[0]);
}

}  // namespace
}  // namespace roboss::test
