// Lift and drag against their formulas, wings in free flight, and the wind.
#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/simulation.h>

#include "physics/dynamics/flow_laws.h"

namespace roboss::test {
namespace {

LiftDragSpec wing() {
    LiftDragSpec spec;
    spec.link = {"body"};
    spec.area = 0.4, spec.density = 1.2;
    spec.cla = 4.5, spec.cda = 0.3, spec.cma = 0.2;
    spec.alpha_stall = 0.3, spec.cla_stall = -3, spec.cda_stall = 2, spec.cma_stall = -0.1;
    return spec;
}

/// Flow that meets the wing at the angle of attack: the link moves forward and down.
FlowVelocity at_angle(double alpha, double speed) {
    return {Vec3{std::cos(alpha), 0, -std::sin(alpha)} * speed, {}};
}

TEST(Wing, LiftDragAndMomentFollowTheFormulas) {
    const LiftDragSpec spec = wing();
    const double speed = 20, pressure = 0.5 * 1.2 * speed * speed * 0.4;
    for (const double alpha : {-0.5, -0.29, -0.1, 0.0, 0.05, 0.2, 0.3, 0.35, 0.45, 1.2}) {
        const double beyond = std::fabs(alpha) - 0.3, sign = alpha < 0 ? -1 : 1;
        const bool stalls = beyond > 0;
        const double cl = sign * (stalls ? std::max(0.0, 4.5 * 0.3 - 3 * beyond) : 4.5 * std::fabs(alpha));
        const double cd = stalls ? 0.3 * 0.3 + 2 * beyond : 0.3 * std::fabs(alpha);
        const double cm = sign * (stalls ? std::max(0.0, 0.2 * 0.3 - 0.1 * beyond) : 0.2 * std::fabs(alpha));
        const FlowForce f = lift_drag_force(spec, at_angle(alpha, speed), 0);
        const Vec3 back{-std::cos(alpha), 0, std::sin(alpha)}, up{std::sin(alpha), 0, std::cos(alpha)};
        EXPECT_NEAR(dot(f.force, up), cl * pressure, 1e-9) << alpha;
        EXPECT_NEAR(dot(f.force, back), cd * pressure, 1e-9) << alpha;
        EXPECT_NEAR(norm(f.torque), std::fabs(cm) * pressure, 1e-9) << alpha;
        EXPECT_NEAR(f.force.y, 0, 1e-12);
    }
}

TEST(Wing, ControlSurfacesSweepAndFlowFromBehind) {
    LiftDragSpec spec = wing();
    const double pressure = 0.5 * 1.2 * 400 * 0.4;
    EXPECT_NEAR(lift_drag_force(spec, at_angle(0, 20), 0.1).force.z, 4 * 0.1 * pressure, 1e-9);
    EXPECT_EQ(norm(lift_drag_force(spec, at_angle(kPi - 0.1, 20), 0).force), 0);
    spec.reversible = true;
    EXPECT_GT(norm(lift_drag_force(spec, at_angle(kPi - 0.1, 20), 0).force), 1);
    EXPECT_EQ(norm(lift_drag_force(spec, at_angle(0.1, 0.009), 0).force), 0);
    // sweep: the flow along the span does nothing, and coefficients shrink by cos^2
    const double sweep = 0.4, alpha = 0.1;
    FlowVelocity swept = at_angle(alpha, 20 * std::cos(sweep));
    swept.linear.y = 20 * std::sin(sweep);
    const double c2 = std::cos(sweep) * std::cos(sweep);
    const FlowForce f = lift_drag_force(spec, swept, 0);
    EXPECT_NEAR(norm(f.force), std::hypot(4.5, 0.3) * alpha * c2 * pressure * c2, 1e-9);
}

TEST(Wing, TheCentreOfPressureHasAnArm) {
    LiftDragSpec spec = wing();
    spec.cma = 0;
    spec.centre = {-0.5, 0.3, 0};
    const FlowForce f = lift_drag_force(spec, at_angle(0.1, 20), 0);
    const Vec3 expected = cross(spec.centre, f.force);
    EXPECT_NEAR(norm(f.torque - expected), 0, 1e-9);
}

ModelSpec glider(const LiftDragSpec& spec) {
    ModelSpec m = solid_box(2, {0.5, 1.5, 0.05}, surface(0.5));
    LiftDragSpec own = spec;
    own.link = {m.links[0].name};
    m.onboard.push_back({"wing", own, {}});
    return m;
}

/// A wing whose drag and lift do not depend on the angle falls as drag says: with the speed of balance.
TEST(Wing, AFallingPlateComesToItsTerminalSpeed) {
    LiftDragSpec spec;
    spec.area = 0.5, spec.density = 1.2, spec.cla = 0, spec.alpha_stall = 0.1, spec.cda = 0,
    spec.cda_stall = 1;
    spec.forward = {0, 0, -1}, spec.upward = {-1, 0, 0};
    spec.a0 = 0.6;  // half a radian beyond stall
    World world = empty_world(1e-3, {0, 0, -9.81});
    place(world, glider(spec), "plate");
    Simulation sim(world);
    sim.run(60);
    EXPECT_NEAR(-sim.states[0].v[5], std::sqrt(2 * 9.81 / (0.5 * 1.2 * 0.5 * 0.5)), 1e-6);
}

TEST(Wing, WindIsFlow) {
    LiftDragSpec spec = wing();
    spec.cma = 0;
    World world = empty_world(1e-4, {});
    world.wind = {-20 * std::cos(0.1), 0, 20 * std::sin(0.1)};
    place(world, glider(spec), "glider");
    Simulation sim(world);
    sim.step();
    const FlowForce f = lift_drag_force(spec, at_angle(0.1, 20), 0);
    EXPECT_NEAR(sim.states[0].v[5], f.force.z / 2 * 1e-4, 3e-6);
    EXPECT_NEAR(sim.states[0].v[3], f.force.x / 2 * 1e-4, 3e-6);
}

TEST(Wing, FinsInWaterDoNotFeelTheWind) {
    LiftDragSpec spec = wing();
    spec.density = 1000;
    World world = empty_world(1e-3, {});
    world.wind = {-20, 0, 2};
    place(world, glider(spec), "fin");
    Simulation sim(world);
    sim.run(1);
    EXPECT_EQ(sim.states[0].v, std::vector<double>(6, 0.0));
}

TEST(Wing, StrongLiftIsStable) {
    LiftDragSpec spec = wing();
    spec.area = 5e3, spec.alpha_stall = 2, spec.cma = 0, spec.reversible = true;
    World world = empty_world(1e-2, {0, 0, -9.81});
    place(world, glider(spec), "glider");
    Simulation sim(world);
    sim.states[0].v[3] = 30, sim.states[0].v[5] = -1;
    for (int i = 0; i < 2000; ++i) {
        sim.step();
        const std::vector<double>& v = sim.states[0].v;
        ASSERT_LT(norm(Vec3{v[3], v[4], v[5]}), 300) << i;
    }
}

/// Wings of any size, in air at rest and without gravity: energy only ever falls.
TEST(Wing, NoWingGainsEnergyHoweverLarge) {
    for (const double area : {0.4, 4.0, 40.0, 5e2, 5e4, 5e8}) {
        for (const double stall : {0.05, 0.3, 2.0}) {
            LiftDragSpec spec = wing();
            spec.area = area, spec.alpha_stall = stall, spec.cla_stall = 3, spec.reversible = true;
            spec.cma = spec.cma_stall = 0;  // a moment by itself is no passive law
            World world = empty_world(1e-2, {});
            place(world, glider(spec), "glider");
            Simulation sim(world);
            std::vector<double>& v = sim.states[0].v;
            v[1] = 0.2, v[3] = 30, v[4] = 3, v[5] = -20;
            const double start = sim.energy();
            double most = start;
            for (int i = 0; i < 2000; ++i) {
                sim.step();
                ASSERT_LE(sim.energy(), most * (1 + 5e-3) + 1e-12) << area << " " << stall << " " << i;
                most = std::min(most, sim.energy());
            }
            EXPECT_LT(most, start);
        }
    }
}

/// A light wing that spins fast, in ticks of 5 ms: turning far in a tick adds no energy.
TEST(Wing, ASpinningWingGainsNoEnergy) {
    for (const double area : {0.4, 4.0, 40.0}) {
        for (const Vec3& centre : {Vec3{}, Vec3{-0.1, 0.2, 0.05}}) {
            LiftDragSpec spec = wing();
            spec.area = area, spec.reversible = true, spec.centre = centre;
            spec.cma = spec.cma_stall = 0;
            World world = empty_world(5e-3, {});
            place(world, glider(spec), "glider");
            Simulation sim(world);
            std::vector<double>& v = sim.states[0].v;
            v[0] = -140, v[1] = -20, v[2] = 40, v[3] = 13;
            double most = sim.energy();
            for (int i = 0; i < 1000; ++i) {
                sim.step();
                ASSERT_LE(sim.energy(), most * (1 + 5e-3) + 1e-12) << area << " " << i;
                most = std::min(most, sim.energy());
            }
        }
    }
}

/// A wing of 5e4 m^2 on 2 kg, falling and driven along by wind, in ticks of 10 ms.
TEST(Wing, AnAbsurdWingStaysFinite) {
    for (const double wind : {0.0, 30.0}) {
        for (const Vec3& centre : {Vec3{}, Vec3{-0.1, 0.2, 0.05}}) {
            LiftDragSpec spec = wing();
            spec.area = 5e4, spec.alpha_stall = 0.1, spec.cla_stall = 1, spec.reversible = true;
            spec.centre = centre;
            World world = empty_world(1e-2, {0, 0, -9.81});
            world.wind = {-wind, 0, 0.2 * wind};
            place(world, glider(spec), "glider");
            Simulation sim(world);
            sim.states[0].v[1] = 1, sim.states[0].v[3] = 30, sim.states[0].v[5] = -20;
            for (int i = 0; i < 4000; ++i) {
                sim.step();
                const std::vector<double>& v = sim.states[0].v;
                ASSERT_LT(norm(Vec3{v[3], v[4], v[5]}), 40 + 9.81 * sim.time() + 2 * wind) << i;
                ASSERT_LT(norm(Vec3{v[0], v[1], v[2]}), 1e3) << i;
            }
        }
    }
}

TEST(Wing, AnOrdinaryWingIsLeftAlone) {
    LiftDragSpec spec = wing();
    World world = empty_world(1e-3, {});
    place(world, glider(spec), "glider");
    Simulation sim(world);
    sim.states[0].v[3] = 30 * std::cos(0.5), sim.states[0].v[5] = -30 * std::sin(0.5);  // beyond stall
    const FlowForce f = lift_drag_force(spec, at_angle(0.5, 30), 0);
    sim.step();
    EXPECT_NEAR(sim.states[0].v[3] - 30 * std::cos(0.5), f.force.x / 2 * 1e-3, 2e-2 * norm(f.force) * 1e-3);
    EXPECT_NEAR(sim.states[0].v[5] + 30 * std::sin(0.5), f.force.z / 2 * 1e-3, 2e-2 * norm(f.force) * 1e-3);
}

LighterThanAirSpec hull() {
    LighterThanAirSpec spec;
    spec.link = {"box"};
    spec.density = 1.2754;
    spec.force_inviscid = -0.064, spec.force_viscous = 0.072;
    spec.moment_inviscid = 0.085, spec.moment_viscous = -0.094;
    spec.eps_v = 2.4, spec.axial_drag = 0.1;
    return spec;
}

/// As Gazebo writes the law, by angles.
FlowForce hull_by_angles(const LighterThanAirSpec& s, const FlowVelocity& flow) {
    const Vec3 v = flow.linear + cross(flow.angular, Vec3{-s.eps_v, 0, 0});
    const double q = 0.5 * s.density * dot(v, v), side = std::hypot(v.y, v.z), gamma = std::atan2(side, v.x);
    const double twice = std::sin(2 * gamma), squared = std::sin(gamma) * std::sin(gamma);
    const double f = q * (-s.force_inviscid * twice + s.force_viscous * squared);
    const double m = q * (-s.moment_inviscid * twice + s.moment_viscous * squared);
    const Vec3& u = flow.linear;
    const double attack = std::cos(std::atan2(u.z, u.x));
    const double axial = 0.5 * s.density * dot(u, u) * s.axial_drag * attack * attack;
    FlowForce sum;
    sum.force = Vec3{-axial, -f * v.y / side, -f * v.z / side};
    sum.torque = Vec3{0, m * v.z / side, -m * v.y / side};
    return sum;
}

TEST(Hull, ForcesFollowTheFormulas) {
    const FlowVelocity flows[] = {{{5, 1, -0.5}, {0.1, 0.2, -0.3}}, {{2, -3, 1}, {0, 0.5, 0}}};
    for (const FlowVelocity& flow : flows) {
        const FlowForce f = hull_force(hull(), flow), expected = hull_by_angles(hull(), flow);
        EXPECT_NEAR(norm(f.force - expected.force), 0, 1e-12);
        EXPECT_NEAR(norm(f.torque - expected.torque), 0, 1e-12);
    }
    const FlowForce astern = hull_force(hull(), {{-4, 0, 0}, {}});
    EXPECT_NEAR(astern.force.x, 0.5 * 1.2754 * 16 * 0.1, 1e-12) << "drag brakes backward motion, too";
}

/// du/dt = -k u^2: u = u0 / (1 + k u0 t).
TEST(Hull, AxialDragSlowsDownHyperbolically) {
    World world = empty_world(1e-3, {});
    ModelSpec m = solid_box(5, {3, 0.5, 0.5}, surface(0.5));
    m.onboard.push_back({"hull", hull(), {}});
    place(world, m, "airship");
    Simulation sim(world);
    sim.states[0].v[3] = 10;
    sim.run(20);
    EXPECT_NEAR(sim.states[0].v[3], 10 / (1 + 0.5 * 1.2754 * 0.1 / 5 * 10 * 20), 1e-6);
}

/// With added mass, Munk's moment is the law's own: that of the added masses does not come on top.
TEST(Hull, MunksMomentCountsOnce) {
    World world = empty_world(1e-4, {});
    ModelSpec m = solid_box(5, {3, 0.5, 0.5}, surface(0.5));
    m.links[0].added_mass.assign(kAddedMassNumbers, 0.0);
    m.links[0].added_mass[0] = 0.1, m.links[0].added_mass[6] = m.links[0].added_mass[11] = 3;
    LighterThanAirSpec still = hull();
    still.force_inviscid = still.force_viscous = still.moment_viscous = still.axial_drag = 0;
    for (const double moment : {0.0, 0.085}) {
        still.moment_inviscid = moment;
        m.onboard.assign(1, {"hull", still, {}});
        World own = world;
        place(own, m, "airship");
        Simulation sim(own);
        sim.states[0].v[3] = 5, sim.states[0].v[5] = 1;
        sim.step();
        const double inertia = m.links[0].inertia_C.r1.y;
        EXPECT_NEAR(sim.states[0].v[1] / 1e-4, -moment * 1.2754 * 5 * 1 / inertia, 1e-3);
    }
}

TEST(Hull, AnyStrengthIsStable) {
    for (const double strength : {1.0, 1e2, 1e5}) {
        LighterThanAirSpec spec = hull();
        for (double* c : {&spec.force_inviscid, &spec.force_viscous, &spec.moment_inviscid,
                          &spec.moment_viscous, &spec.axial_drag})
            *c *= strength;
        World world = empty_world(1e-2, {});
        ModelSpec m = solid_box(5, {3, 0.5, 0.5}, surface(0.5));
        m.onboard.push_back({"hull", spec, {}});
        place(world, m, "airship");
        Simulation sim(world);
        sim.states[0].v[1] = 0.5, sim.states[0].v[3] = 8, sim.states[0].v[4] = 2;
        for (int i = 0; i < 3000; ++i) {
            sim.step();
            ASSERT_LT(sim.energy(), 400) << strength << " " << i;
        }
    }
}

/// The wind carries a link where it is: in a layer at 0.5 1/s, above it not at all.
TEST(Wind, PushesByThePlace) {
    World world = empty_world(1e-3, {});
    world.wind = {10, 0, 0};
    WindEffectsSpec wind;
    wind.regions.emplace_back();
    wind.regions[0].lower = {-1e3, -1e3, 0}, wind.regions[0].upper = {1e3, 1e3, 5};
    wind.regions[0].constant = 0.5;
    wind.magnitude_rise = 1e-3;  // blows at once
    world.wind_effects = wind;
    for (const double z : {2.0, 7.0}) {
        ModelSpec m = solid_box(2, {0.5, 0.5, 0.5}, surface(0.5));
        m.links[0].drag.acts = m.links[0].drag.wind = true;
        place(world, m, "at_" + std::to_string(static_cast<int>(z)), {{0, 10 * z, z}, {}});
    }
    Simulation sim(world);
    sim.run(2);
    EXPECT_NEAR(sim.states[0].v[3], 10 * (1 - std::exp(-0.5 * 2.0)), 5e-3);
    EXPECT_EQ(sim.states[1].v[3], 0);
}

/// A factor that grows with x: dv/dt = k x (w - v) at w = 0 is dv/dx = -k x, so v = v0 - k x^2 / 2.
TEST(Wind, TheFactorIsTakenWhereTheLinkIs) {
    World world = empty_world(1e-4, {});
    WindEffectsSpec wind;
    wind.regions.emplace_back();
    wind.regions[0].linear = {0.2, 0, 0};
    world.wind_effects = wind;
    ModelSpec m = solid_box(2, {0.5, 0.5, 0.5}, surface(0.5));
    m.links[0].drag.acts = m.links[0].drag.wind = true;
    place(world, m, "box");
    Simulation sim(world);
    sim.states[0].v[3] = 3;
    sim.run(1);
    const double x = sim.states[0].q[0];
    EXPECT_NEAR(sim.states[0].v[3], 3 - 0.1 * x * x, 1e-3);
}

TEST(Aeroplane, ForcesFollowTheDerivatives) {
    AdvancedLiftDragSpec spec;
    spec.link = {"body"};
    spec.area = 2, spec.aspect_ratio = 8, spec.efficiency = 0.9, spec.chord = 0.5, spec.alpha_stall = 0.4;
    spec.lift_0 = 0.2, spec.by_alpha.lift = 5, spec.drag_0 = 0.03, spec.by_beta.side = -0.4;
    spec.pitch_0 = 0.02, spec.by_alpha.pitch = -0.8, spec.by_p.roll = -0.5, spec.by_beta.yaw = 0.1;
    ControlSurfaceSpec elevator;
    elevator.joint = {"elevator"}, elevator.direction = -1, elevator.by_degree.pitch = 0.01;
    spec.surfaces.push_back(elevator);
    const double speed = 25, alpha = 0.05, pressure = 0.5 * 1.2041 * speed * speed * 2;
    const double angles[] = {3 * kPi / 180};
    const FlowForce f = aeroplane_force(spec, at_angle(alpha, speed), angles);
    const double cl = 0.2 + 5 * alpha, cd = 0.03 + cl * cl / (kPi * 8 * 0.9);
    const Vec3 back{-std::cos(alpha), 0, std::sin(alpha)}, up{std::sin(alpha), 0, std::cos(alpha)};
    // the sigmoid of stall is not quite zero
    EXPECT_NEAR(dot(f.force, up) / pressure, cl, 3e-3);
    EXPECT_NEAR(dot(f.force, back) / pressure, cd, 3e-3);
    EXPECT_NEAR(-f.torque.y / pressure, 0.5 * (0.02 - 0.8 * alpha - 0.01 * 3), 1e-9);
    const double span = std::sqrt(2 * 8.0);
    FlowVelocity rolling = at_angle(alpha, speed);
    rolling.angular.x = 0.3;
    EXPECT_NEAR(aeroplane_force(spec, rolling, angles).torque.x / pressure,
                -0.5 * 0.3 * 0.5 * span / speed * span, 1e-9);
    FlowVelocity slipping = at_angle(alpha, speed);
    slipping.linear.y = -2;
    // y of the aeroplane points to the right, -y of the link
    EXPECT_NEAR(aeroplane_force(spec, slipping, angles).force.y / pressure,
                0.4 * std::atan2(2, speed * std::cos(alpha)), 1e-9);
}

/// Gazebo's wind: acceleration scale * (wind - v), the wind rises with its lag.
TEST(Wind, CarriesInProportionToTheMass) {
    World world = empty_world(1e-3, {});
    world.air_density = 1.2;
    world.wind = {3, 4, -1};
    WindEffectsSpec effects;
    effects.scale = 0.5, effects.magnitude_rise = 2, effects.vertical_rise = 5;
    world.wind_effects = effects;
    ModelSpec m = solid_box(7, {0.5, 0.4, 0.3}, surface(0.5));
    m.links[0].drag.acts = m.links[0].drag.wind = true;
    place(world, m, "box");
    Simulation sim(world);
    sim.run(3);
    // v' = k (W (1 - e^(-t / T)) - v)
    const auto speed = [](double W, double T, double k, double t) {
        return W * (1 - std::exp(-k * t)) - W * k / (k - 1 / T) * (std::exp(-t / T) - std::exp(-k * t));
    };
    EXPECT_NEAR(sim.states[0].v[5], speed(-1, 5, 0.5, 3), 2e-3);
    world.wind_effects->magnitude_rise = 1.9;
    Simulation other(world);
    other.run(3);
    EXPECT_NEAR(other.states[0].v[3], speed(3, 1.9, 0.5, 3), 2e-3);
    EXPECT_NEAR(other.states[0].v[4], speed(4, 1.9, 0.5, 3), 2e-3);
}

TEST(Wind, ObeysCommandsAndIsTheSameForAll) {
    World world = empty_world(1e-3, {});
    world.wind = {3, 0, 0};
    WindEffectsSpec effects;
    effects.magnitude_noise_deviation = 0.3, effects.direction_noise_deviation = 5;
    effects.direction_amplitude = 10, effects.direction_period = 3;
    world.wind_effects = effects;
    ModelSpec m = solid_box(7, {0.5, 0.4, 0.3}, surface(0.5));
    m.links[0].drag.acts = m.links[0].drag.wind = true;
    place(world, m, "a"), place(world, m, "b", {{5, 0, 0}, {}});
    Simulation sim(world);
    sim.run(2);
    EXPECT_EQ(sim.states[0].v, sim.states[1].v);
    Order order;
    order.apply_at = sim.tick, order.robot = RobotId(std::size_t{1});
    order.action = Command{0, {-3, 0, 0, 1}};
    ASSERT_TRUE(check_order(*sim.model, order));
    sim.step({&order, 1});
    sim.run(20);
    EXPECT_NEAR(sim.states[0].v[3], 3, 0.3);
    EXPECT_NEAR(sim.states[1].v[3], -3, 0.3);
}

}  // namespace
}  // namespace roboss::test
