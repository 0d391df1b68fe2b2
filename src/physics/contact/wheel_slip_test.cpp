// Wheels that slip, against the law of their slip: u = compliance * radius * |spin rate| / normal force * f.
#include <gtest/gtest.h>

#include <support/drives.h>
#include <support/scenes.h>

#include "physics/solver/row_math.h"

namespace roboss::test {
namespace {

constexpr double kG = 9.81, kRadius = 0.3;
constexpr double kCarriage = 0.5, kWheel = 2;  // kg

WheelSlipSpec slip(const std::string& link, double lateral, double longitudinal, double normal_force,
                   double radius = kRadius) {
    WheelSlipSpec spec;
    spec.wheels.push_back({{link}, lateral, longitudinal, normal_force, radius});
    return spec;
}

/// A wheel with its axle along y that slides along x, y and z of the world, without turning but about its
/// axle. `drag`: N s/m, along x.
ModelSpec rig(double drag, const SurfaceSpec& s = surface(1)) {
    ModelSpec m;
    m.name = m.canonical_link = "x";
    const Pose X{{0, 0, kRadius}, {}};
    const Mat3 I = box_inertia(kCarriage, {0.1, 0.1, 0.1});
    std::string parent = "world";
    for (const auto& [name, axis] :
         {std::pair("x", Vec3{1, 0, 0}), {"y", Vec3{0, 1, 0}}, {"z", Vec3{0, 0, 1}}}) {
        m.links.push_back(link(name, kCarriage, I, X));
        m.joints.push_back(
            joint(JointSpecKind::kPrismatic, std::string("along_") + name, parent, name, X, axis));
        parent = name;
    }
    m.joints[0].axes[0].damping = drag;
    LinkSpec wheel = link("wheel", kWheel, sphere_inertia(kWheel, kRadius), X);
    wheel.collisions.push_back(sphere_shape(kRadius, s));
    m.links.push_back(wheel);
    m.joints.push_back(joint(JointSpecKind::kContinuous, "axle", "z", "wheel", X, {0, 1, 0}));
    m.joints.back().axes[0].max_effort = 1e3;
    return m;
}

constexpr double kLoad = (kCarriage + kWheel) * kG;   // N, on the ground
constexpr double kSideways = 2 * kCarriage + kWheel;  // kg that move along y
constexpr std::size_t kX = 0, kY = 1, kAxle = 3;      // degrees of freedom
constexpr std::size_t kBase = 7;                      // coordinates of the fixed base

World rig_world(ModelSpec m, double dt_s, const Vec3& gravity = {0, 0, -kG}, double heading = 0) {
    World world = empty_world(dt_s, gravity);
    place(world, ground(surface(1)), "ground");
    place(world, std::move(m), "rig", {{}, from_rpy(0, 0, heading)});
    return world;
}

TEST(WheelSlip, ADrivenWheelSlipsInProportionToItsThrust) {
    constexpr double kDrag = 12, kRate = 8, kCompliance = 0.4;
    for (const double dt_s : {1e-3, 4e-3}) {
        for (const double heading : {0.0, 0.7}) {
            Simulation sim(rig_world(with_onboard(rig(kDrag), slip("wheel", 0.1, kCompliance, kLoad)), dt_s,
                                     {0, 0, -kG}, heading));
            sim.set_motor(0, kAxle, MotorMode::kVelocity, kRate);
            sim.run(6);
            const double v = sim.states[0].v[kX], thrust = kDrag * v;
            const double slipped = sim.states[0].v[kAxle] * kRadius - v;
            const double expected = kCompliance * kRadius * kRate / kLoad * thrust;
            tell("slip against C |w| r / N f", slipped / expected);
            EXPECT_NEAR(slipped / expected, 1, 1e-3);
            EXPECT_GT(slipped, 0.2);
            EXPECT_NEAR(sim.states[0].v[kY], 0, 1e-6);
        }
    }
}

TEST(WheelSlip, ARollingWheelDriftsInProportionToTheForceAlongItsAxle) {
    constexpr double kPull = 1.5, kRate = 8, kCompliance = 0.5;
    for (const double dt_s : {1e-3, 4e-3}) {
        for (const double heading : {0.0, 0.7}) {
            const Vec3 gravity{-kPull * std::sin(heading), kPull * std::cos(heading), -kG};
            Simulation sim(rig_world(with_onboard(rig(0), slip("wheel", kCompliance, 0.2, kLoad)), dt_s,
                                     gravity, heading));
            sim.set_motor(0, kAxle, MotorMode::kVelocity, kRate);
            sim.run(6);
            const double expected = kCompliance * kRadius * kRate / kLoad * kSideways * kPull;
            tell("drift against C |w| r / N f", sim.states[0].v[kY] / expected);
            EXPECT_NEAR(sim.states[0].v[kY] / expected, 1, 1e-3);
            EXPECT_NEAR(sim.states[0].v[kX], kRadius * kRate, 1e-3) << "nothing holds it along x";
        }
    }
}

TEST(WheelSlip, AWheelThatStandsStillDoesNotSlip) {
    Simulation sim(rig_world(with_onboard(rig(0), slip("wheel", 5, 5, kLoad)), 1e-3, {0, 1.5, -kG}));
    sim.set_motor(0, kAxle, MotorMode::kVelocity, 0);
    sim.run(3);
    EXPECT_NEAR(sim.states[0].q[kBase + kY], 0, 1e-6);
}

TEST(WheelSlip, FrictionStaysWithinItsBound) {
    constexpr double kMu = 0.4, kDrag = 2;
    Simulation sim(rig_world(with_onboard(rig(kDrag, surface(kMu)), slip("wheel", 0.01, 0.01, kLoad)), 1e-3));
    sim.set_motor(0, kAxle, MotorMode::kVelocity, 30);
    sim.run(0.2);
    const double v = sim.states[0].v[kX];
    sim.run(0.1);
    const double mass = 3 * kCarriage + kWheel, drag = kDrag * 0.5 * (v + sim.states[0].v[kX]);
    EXPECT_NEAR((sim.states[0].v[kX] - v) / 0.1, (kMu * kLoad - drag) / mass, 1e-2);
}

TEST(WheelSlip, NoComplianceChangesNoBit) {
    for (const double compliance : {0.0, 0.3}) {
        World plain = on_plane(skid_car()), slippery = plain;
        for (int i = 0; i < 4; ++i)
            slippery.prototypes.back().onboard.push_back(
                {"slip", slip("wheel_" + std::to_string(i), compliance, compliance, 10, 0.05), {}});
        Simulation a(plain), b(slippery);
        a.run(0.2), b.run(0.2);
        give(a, "cmd_vel", {0.5, 0, 0, 0, 0, 1});
        give(b, "cmd_vel", {0.5, 0, 0, 0, 0, 1});
        a.run(1), b.run(1);
        EXPECT_EQ(a.states[0].q == b.states[0].q && a.states[0].v == b.states[0].v, compliance == 0);
    }
}

TEST(WheelSlip, CommandsChangeComplianceAndFriction) {
    constexpr double kPull = 1.5, kRate = 8;
    Simulation sim(rig_world(with_onboard(rig(0), slip("wheel", 0, 0, kLoad)), 1e-3, {0, kPull, -kG}));
    sim.set_motor(0, kAxle, MotorMode::kVelocity, kRate);
    sim.run(2);
    EXPECT_NEAR(sim.states[0].v[kY], 0, 1e-6);
    give(sim, "link/wheel/wheel_slip", {0.3, 0.1});
    sim.run(4);
    EXPECT_NEAR(sim.states[0].v[kY] / (0.3 * kRadius * kRate / kLoad * kSideways * kPull), 1, 1e-3);
    give(sim, "link/wheel/wheel_slip", {0, 0});
    sim.run(1);
    EXPECT_NEAR(sim.states[0].v[kY], 0, 1e-6);
    give(sim, "link/wheel/wheel_friction", {0.1, 1});  // along the axle less than the pull
    const double v = sim.states[0].v[kY];
    sim.run(0.5);
    EXPECT_NEAR((sim.states[0].v[kY] - v) / 0.5, (kSideways * kPull - 0.1 * kLoad) / kSideways, 1e-2);
    EXPECT_NEAR(sim.states[0].v[kX], kRadius * kRate, 1e-3);
}

TEST(WheelSlip, NeverGainsEnergy) {
    ModelSpec m = car();
    for (int i = 0; i < 4; ++i)
        m.onboard.push_back({"slip", slip("wheel_" + std::to_string(i), 2, 0.5, 15, 0.05), {}});
    Simulation sim(on_plane(m, 2e-3));
    sim.run(0.3);
    std::vector<double>& v = sim.states[0].v;
    v[2] = 3, v[3] = 2, v[4] = 1.5;  // turns, and slides to the side
    for (std::size_t d = 6; d < 10; ++d) v[d] = 40;
    for (std::size_t d = 0; d < 4; ++d) sim.set_motor(0, d, MotorMode::kEffort, 0);
    double last = sim.energy();
    for (int i = 0; i < 2000; ++i) {
        sim.step();
        const double now = sim.energy();
        ASSERT_LE(now, last + 1e-6) << i;
        last = now;
    }
}

/// The impulse of a disc against a search along its rim.
TEST(WheelSlip, ImpulsesMinimizeTheirPotential) {
    Random random(7);
    for (int i = 0; i < 300; ++i) {
        FrictionDisc disc;
        disc.coefficient = 1, disc.compliance = 1e-4;
        const double a = random.uniform(0, 2), b = i % 3 == 0 ? 1e-7 : random.uniform(0, 0.1);
        const double angle = random.uniform(0, 3);
        const double c = std::cos(angle), s = std::sin(angle);
        disc.slip_11 = a * c * c + b * s * s, disc.slip_22 = a * s * s + b * c * c,
        disc.slip_12 = (a - b) * c * s;
        const double u1 = random.uniform(-1, 1), u2 = random.uniform(-1, 1), bound = random.uniform(0.01, 20);
        const auto potential = [&](double x, double y) {
            return x * u1 + y * u2 +
                   0.5 * ((disc.compliance + disc.slip_11) * x * x + 2 * disc.slip_12 * x * y +
                          (disc.compliance + disc.slip_22) * y * y);
        };
        const Tangential t = impulse_at(disc, u1, u2, bound);
        EXPECT_LE(std::hypot(t.t1, t.t2), bound * (1 + 1e-12));
        const double found = potential(t.t1, t.t2);
        double least = 0;
        for (int k = 0; k < 2000; ++k) {
            const double x = bound * std::cos(k * kPi / 1000), y = bound * std::sin(k * kPi / 1000);
            for (const double share : {0.05, 0.3, 0.7, 1.0})
                least = std::min(least, potential(share * x, share * y));
        }
        EXPECT_LE(found, least + 1e-12 * std::fabs(least));
        // and the curvature is its derivative
        disc.u_1 = u1, disc.u_2 = u2, disc.bound = bound;
        const slip_disc::Sym2 d = slip_disc::curvature(slip_disc::solve(disc, {u1, u2}, bound));
        const double h = 1e-6;
        const Tangential up = impulse_at(disc, u1 + h, u2, bound), down = impulse_at(disc, u1 - h, u2, bound);
        EXPECT_NEAR(-(up.t1 - down.t1) / (2 * h), d.xx, 1e-4 * (1 + std::fabs(d.xx)));
        EXPECT_NEAR(-(up.t2 - down.t2) / (2 * h), d.xy, 1e-4 * (1 + std::fabs(d.xx)));
    }
}

/// A map of 2 x 1 pixels over 8 m: x < 0 red and blue, x > 0 as the wheel is.
LookupWheelSlipSpec lookup() {
    LookupWheelSlipSpec spec;
    spec.map = ColourMap::of(2, 1, {128 + 10, 128, 128 + 2, 128, 128, 128});
    spec.size_x = 16, spec.size_y = 100;
    spec.lateral_delta = 0.02, spec.friction_delta = -0.2;
    spec.wheels = {"wheel"};
    return spec;
}

TEST(LookupWheelSlip, ChangesTheSlipByThePlace) {
    constexpr double kPull = 1.5, kRate = 8;
    for (const bool before : {false, true}) {  // which of the two runs first
        ModelSpec m = rig(0);
        m.onboard.push_back({"slip", slip("wheel", 0.1, 0.2, kLoad), {}});
        m.onboard.insert(before ? m.onboard.begin() : m.onboard.end(), {"lookup", lookup(), {}});
        Simulation sim(rig_world(m, 1e-3, {0, kPull, -kG}));
        // columns begin at -8 and 0, and a wheel takes the nearest: the change is at x = -4
        sim.states[0].q[kBase + kX] = -7.9, sim.states[0].v[kX] = kRadius * kRate;
        sim.states[0].v[kAxle] = kRate;
        sim.set_motor(0, kAxle, MotorMode::kVelocity, kRate);
        const double force = kSideways * kPull, unit = kRadius * kRate / kLoad * force;
        sim.run(1.5);
        EXPECT_LT(sim.states[0].q[kBase + kX], -4.1);
        EXPECT_NEAR(sim.states[0].v[kY] / (0.3 * unit), 1, 1e-3);
        sim.run(1);
        EXPECT_GT(sim.states[0].q[kBase + kX], -3.5);
        EXPECT_NEAR(sim.states[0].v[kY] / (0.1 * unit), 1, 1e-3);
    }
}

TEST(LookupWheelSlip, ChangesTheFriction) {
    Simulation sim(rig_world(
        [] {
            ModelSpec m = rig(0);
            m.onboard.push_back({"slip", slip("wheel", 0, 0, kLoad), {}});
            LookupWheelSlipSpec spec = lookup();
            spec.lateral_delta = 0, spec.friction_delta = -0.45;  // 1 - 2 * 0.45
            m.onboard.push_back({"lookup", spec, {}});
            return m;
        }(),
        1e-3, {0, 1.5, -kG}));
    sim.states[0].q[kBase + kX] = -7.9;
    sim.run(0.5);
    const double v = sim.states[0].v[kY];
    sim.run(0.5);
    EXPECT_NEAR((sim.states[0].v[kY] - v) / 0.5, (kSideways * 1.5 - 0.1 * kLoad) / kSideways, 1e-2);
}

World slippery_fleet(int count, Precision precision) {
    World world = empty_world(2e-3);
    world.precision = precision;
    place(world, ground(surface(0.8)), "ground");
    ModelSpec m = skid_car();
    for (int i = 0; i < 4; ++i)
        m.onboard.push_back({"slip", slip("wheel_" + std::to_string(i), 0.7, 0.2, 12, 0.05), {}});
    LookupWheelSlipSpec by_place = lookup();
    by_place.size_x = 0.2, by_place.friction_delta = 0.1;
    by_place.wheels = {"wheel_0", "wheel_3"};
    m.onboard.push_back({"lookup", by_place, {}});
    world.prototypes.push_back(m);
    for (int i = 0; i < count; ++i)
        world.instances.push_back({"car_" + std::to_string(i), 1, {{0, 1.5 * i, 0.001}, {}}, {}});
    return world;
}

TEST(WheelSlip, BitsDoNotDependOnLanesCompanyOrBytes) {
    for (const Precision precision : {Precision::kDouble, Precision::kFloat}) {
        Simulation lanes(slippery_fleet(9, precision)), single(slippery_fleet(9, precision)),
            alone(slippery_fleet(1, precision));
        single.scratch.use_lanes(1);
        for (int i = 0; i < 400; ++i) {
            std::vector<Order> orders;
            for (std::size_t r = 0; i == 20 && r < 9; ++r)
                orders.push_back(command(lanes, r, "cmd_vel", {0.5, 0, 0, 0, 0, 1.0}));
            lanes.step(orders), single.step(orders);
            alone.step(std::span(orders).first(orders.empty() ? 0 : 1));
            ASSERT_EQ(lanes.hash(), single.hash()) << i;
            ASSERT_EQ(lanes.states[0], alone.states[0]) << i;
            if (i % 100 != 99) continue;
            for (std::size_t r = 0; r < single.states.size();
                 ++r) {  // as if it had moved to another Simulator
                std::vector<std::uint8_t> bytes;
                encode(single.states[r], bytes);
                single.states[r] = decode_state(bytes, single.type(r)).value();
            }
        }
    }
}

}  // namespace
}  // namespace roboss::test
