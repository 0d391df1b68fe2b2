// Rotors, thrusters and buoyancy engines against closed forms.
#include <gtest/gtest.h>

#include <support/own_numbers.h>
#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

constexpr double kG = 9.81;
constexpr double kThrust = 8.5e-6, kMoment = 0.016;

/// A body of 1.4 kg and four rotors of 5 g at its corners.
ModelSpec quadcopter(bool with_control) {
    ModelSpec m;
    m.name = "quadcopter";
    m.canonical_link = "body";
    m.links.push_back(link("body", 1.4, box_inertia(1.4, {0.4, 0.3, 0.1}), {}));
    m.links[0].collisions.push_back(box_shape({0.4, 0.3, 0.1}, surface(0.5)));
    const Vec3 places[] = {{0.15, -0.2, 0.05}, {-0.15, 0.2, 0.05}, {0.15, 0.2, 0.05}, {-0.15, -0.2, 0.05}};
    MulticopterControlSpec control;
    control.link = {"body"};
    control.velocity_gain = {2.7, 2.7, 2.7};
    control.attitude_gain = {2, 3, 0.15};
    control.angular_rate_gain = {0.4, 0.52, 0.18};
    for (int i = 0; i < 4; ++i) {
        const std::string name = "rotor_" + std::to_string(i);
        m.links.push_back(link(name, 0.005, cylinder_inertia(0.005, 0.1, 0.01), {places[i], {}}));
        m.joints.push_back(joint(JointSpecKind::kContinuous, "joint_" + std::to_string(i), "body", name,
                                 {places[i], {}}, {0, 0, 1}));
        MotorModelSpec motor;
        motor.joint = {"joint_" + std::to_string(i)}, motor.link = {name};
        motor.actuator = i, motor.direction = i < 2 ? "ccw" : "cw";
        motor.motor_constant = kThrust, motor.moment_constant = kMoment;
        motor.rotor_drag = 8e-5, motor.max_velocity = 2000;
        m.onboard.push_back({"motor", motor, {}});
        RotorSpec rotor;
        rotor.joint = motor.joint;
        rotor.force_constant = kThrust, rotor.moment_constant = kMoment, rotor.direction = i < 2 ? 1 : -1;
        control.rotors.push_back(rotor);
    }
    if (with_control) m.onboard.push_back({"control", control, {}});
    return m;
}

void command(Simulation& sim, const std::string& channel, std::vector<double> values, std::size_t robot = 0) {
    Order order;
    order.apply_at = sim.tick, order.robot = RobotId(robot);
    const auto found = sim.type(robot).find_channel(channel);
    ASSERT_TRUE(found) << channel;
    order.action = Command{static_cast<std::uint32_t>(*found), std::move(values)};
    const auto checked = check_order(*sim.model, order);
    ASSERT_TRUE(checked.ok());
    sim.step({&order, 1});
}

Mat3 attitude(const Simulation& sim, std::size_t robot = 0) {
    const std::vector<double>& q = sim.states[robot].q;
    return to_matrix(Quat{q[3], q[4], q[5], q[6]});
}

TEST(Rotors, ThrustThatEqualsTheWeightHovers) {
    World world = empty_world(1e-3, {0, 0, -kG});
    place(world, quadcopter(false), "quad", {{0, 0, 5}, {}});
    Simulation sim(world);
    const double hover = std::sqrt(1.42 * kG / (4 * kThrust));
    for (int i = 0; i < 4; ++i) {  // they turn as fast from the start
        const double dir = i < 2 ? 1 : -1;
        sim.states[0].v[6 + static_cast<std::size_t>(i)] = dir * hover / 10;
    }
    const RobotType& type = sim.type(0);
    for (const OnboardInfo& info : type.onboard)
        sim.states[0].onboard[static_cast<std::size_t>(info.memory_index)] = hover;
    command(sim, "command/motor_speed", {hover, hover, hover, hover});
    sim.run(5);
    EXPECT_NEAR(sim.states[0].q[2], 5, 1e-3);
    EXPECT_NEAR(sim.states[0].v[5], 0, 1e-3);
    EXPECT_NEAR(attitude(sim).r2.z, 1, 1e-9);
    EXPECT_NEAR(sim.states[0].v[2], 0, 1e-6);  // the drag torques of the rotors cancel
}

TEST(Rotors, SpeedFollowsTheCommandWithItsLag) {
    World world = empty_world(1e-3, {});
    place(world, quadcopter(false), "quad");
    Simulation sim(world);
    command(sim, "command/motor_speed", {100, 0, 0, 0});
    for (int i = 0; i < 12; ++i) sim.step();
    const double t = 12e-3;  // the joint follows in the tick after
    const auto lagged = [](double time) { return 100 * (1 - std::exp(-80 * time)); };
    EXPECT_GT(sim.states[0].v[6], 0);
    EXPECT_NEAR(sim.states[0].motors[0].target * 10, lagged(t + 1e-3), 1e-9);
}

TEST(Rotors, AControlledQuadcopterHoversAndKeepsItsVelocity) {
    World world = empty_world(1e-3, {0, 0, -kG});
    place(world, quadcopter(true), "quad", {{0, 0, 5}, from_rpy(0.1, -0.1, 0.3)});
    Simulation sim(world);
    command(sim, "cmd_vel", {0, 0, 0, 0, 0, 0});
    sim.run(10);
    EXPECT_NEAR(sim.states[0].v[5], 0, 2e-3);
    const double z = sim.states[0].q[2];
    sim.run(5);
    EXPECT_NEAR(sim.states[0].q[2], z, 1e-2);
    double thrust = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const double w = 10 * sim.states[0].v[6 + i];
        thrust += kThrust * w * w;
    }
    EXPECT_NEAR(thrust, 1.42 * kG, 1e-3 * 1.42 * kG);
    command(sim, "cmd_vel", {0, 0, 0.5, 0, 0, 0});
    sim.run(10);
    EXPECT_NEAR(sim.states[0].v[5], 0.5, 5e-3);
    command(sim, "cmd_vel", {0, 0, 0, 0, 0, 0.4});
    sim.run(10);
    EXPECT_NEAR(sim.states[0].v[2], 0.4, 0.04);  // rotor drag holds it back a little
    command(sim, "cmd_vel", {1, 0, 0, 0, 0, 0});
    sim.run(10);
    const Vec3 forward =
        transpose_times(attitude(sim), Vec3{sim.states[0].v[3], sim.states[0].v[4], sim.states[0].v[5]});
    EXPECT_NEAR(forward.x, 1, 0.1);
    EXPECT_NEAR(forward.y, 0, 0.02);
}

TEST(Rotors, AControlledQuadcopterHoversByItsOwnGravity) {
    World world = empty_world(1e-3, {0, 0, -kG});
    place(world, quadcopter(true), "quad", {{0, 0, 50}, {}});
    Simulation sim(world);
    give(sim, 0, SetSurroundings{false, {Vec3{0, 0, -4}, std::nullopt}});
    command(sim, "cmd_vel", {0, 0, 0, 0, 0, 0});
    sim.run(10);
    EXPECT_NEAR(sim.states[0].v[5], 0, 2e-3);
}

TEST(Rotors, SwitchedOffTheyFall) {
    World world = empty_world(1e-3, {0, 0, -kG});
    place(world, quadcopter(true), "quad", {{0, 0, 100}, {}});
    Simulation sim(world);
    command(sim, "cmd_vel", {0, 0, 0, 0, 0, 0});
    sim.run(3);
    command(sim, "enable", {0});
    sim.run(1);
    command(sim, "enable", {1});
    const double before = sim.states[0].v[5];
    sim.run(1);
    EXPECT_NEAR(sim.states[0].v[5] - before, -kG, 0.05);  // a new velocity is needed
    command(sim, "cmd_vel", {0, 0, 0, 0, 0, 0});
    sim.run(12);
    EXPECT_NEAR(sim.states[0].v[5], 0, 0.05);
}

/// A hull of 20 kg in the water's damping, with a propeller that pushes along x.
ModelSpec boat(const ThrusterSpec& spec, double damping) {
    ModelSpec m;
    m.name = "boat";
    m.canonical_link = "hull";
    m.links.push_back(link("hull", 20, box_inertia(20, {1, 0.4, 0.3}), {}));
    m.links.push_back(
        link("propeller", 0.2, cylinder_inertia(0.2, 0.1, 0.05), {{-0.5, 0, 0}, from_rpy(0, kPi / 2, 0)}));
    m.joints.push_back(joint(JointSpecKind::kContinuous, "shaft", "hull", "propeller",
                             {{-0.5, 0, 0}, from_rpy(0, kPi / 2, 0)}, {0, 0, 1}));
    HydrodynamicsSpec water;
    water.link = {"hull"};
    water.linear[0] = -damping;  // xU
    for (const std::size_t i : {21u, 28u, 35u}) water.linear[i] = -20;
    m.onboard.push_back({"water", water, {}});
    ThrusterSpec own = spec;
    own.joint = {"shaft"};
    m.onboard.push_back({"thruster", own, {}});
    return m;
}

TEST(Thruster, DrivesABoatToItsTerminalSpeed) {
    for (const bool servo : {false, true}) {
        ThrusterSpec spec;
        spec.servo = servo, spec.coefficient = 0.3, spec.diameter = 0.2;
        World world = empty_world(1e-3, {});
        place(world, boat(spec, 15), "boat");
        Simulation sim(world);
        command(sim, "joint/shaft/cmd_thrust", {45});
        const double mass = 20.2;
        sim.run(2);
        EXPECT_NEAR(sim.states[0].v[3], 3 * (1 - std::exp(-15 / mass * sim.time())), 1e-6);
        sim.run(20);
        EXPECT_NEAR(sim.states[0].v[3], 3, 1e-5);
        const double turning = std::sqrt(45 / (1000 * 0.3 * 0.0016));
        EXPECT_NEAR(sim.states[0].v[6], turning, servo ? 1e-6 : 0.2);
    }
}

TEST(Thruster, ByAngularVelocityGivesItsThrust) {
    ThrusterSpec spec;
    spec.by_velocity = spec.servo = true, spec.coefficient = 0.3, spec.diameter = 0.2;
    World world = empty_world(1e-3, {});
    place(world, boat(spec, 15), "boat");
    Simulation sim(world);
    command(sim, "joint/shaft/cmd_vel", {-8});
    sim.run(20);
    EXPECT_NEAR(sim.states[0].v[3], -1000 * 0.3 * 0.0016 * 64 / 15, 1e-5);
}

TEST(Thruster, TheDeadbandStopsSmallThrusts) {
    ThrusterSpec spec;
    spec.deadband = 10, spec.servo = true;
    World world = empty_world(1e-3, {});
    place(world, boat(spec, 15), "boat");
    Simulation sim(world);
    command(sim, "joint/shaft/cmd_thrust", {9});
    sim.run(1);
    EXPECT_EQ(sim.states[0].v[3], 0);
    command(sim, "joint/shaft/enable_deadband", {0});
    sim.run(1);
    EXPECT_GT(sim.states[0].v[3], 0.3);
    command(sim, "joint/shaft/cmd_thrust", {5000});  // bounded to 1000 N
    sim.run(20);
    EXPECT_NEAR(sim.states[0].v[3], 1000.0 / 15, 1e-3);
}

TEST(BuoyancyEngine, VolumeMovesAtItsRateAndCarries) {
    BuoyancyEngineSpec spec;
    spec.min_volume = 0, spec.max_volume = 0.003, spec.neutral_volume = spec.default_volume = 0.002;
    spec.max_rate = 0.0003;
    ModelSpec m = solid_box(10, {0.2, 0.2, 0.25}, surface(0.5));
    spec.link = {m.links[0].name};
    m.onboard.push_back({"engine", spec, {}});
    m.links[0].buoyant = true;
    World world = empty_world(1e-3, {0, 0, -kG});
    world.buoyancy.emplace();
    place(world, m, "box");
    Simulation sim(world);
    sim.run(2);
    EXPECT_NEAR(sim.states[0].v[5], 0, 1e-9);  // neutral
    command(sim, "buoyancy_engine", {0.0026});
    sim.run(2 - 1e-3);
    // for 2 s the volume grows evenly to 0.0026
    EXPECT_NEAR(sim.states[0].onboard[static_cast<std::size_t>(sim.type(0).onboard[0].memory_index)], 0.0026,
                1e-9);
    EXPECT_NEAR(sim.states[0].v[5], 1000 * kG * 0.0003 * 2 * 2 / 2 / 10, 1e-3);
    const double v = sim.states[0].v[5];
    sim.run(1);
    EXPECT_NEAR(sim.states[0].v[5] - v, 1000 * kG * 0.0006 / 10, 1e-6);
}

TEST(Rotors, BitsDoNotDependOnLanesOrCompany) {
    World few = empty_world(2e-3, {0, 0, -kG}), many = few;
    for (int i = 0; i < 9; ++i) {
        if (i < 2) place(few, quadcopter(true), "q" + std::to_string(i), {{3.0 * i, 0, 5}, {}});
        place(many, quadcopter(true), "q" + std::to_string(i), {{3.0 * i, 0, 5}, {}});
    }
    Simulation a(few), b(many);
    a.scratch.use_lanes(1);
    command(a, "cmd_vel", {0.3, 0.1, 0.2, 0, 0, 0.3});
    command(b, "cmd_vel", {0.3, 0.1, 0.2, 0, 0, 0.3});
    a.run(3), b.run(3);
    EXPECT_EQ(a.states[0], b.states[0]);
    EXPECT_EQ(a.states[1], b.states[1]);
}

}  // namespace
}  // namespace roboss::test
