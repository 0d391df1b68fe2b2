// Batteries and the monitor of kinetic energy in the step, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

constexpr double kDt = 1e-3, kHour = 3600;
const RobotId kFirst(std::size_t{0});

LinearBatterySpec battery() {
    LinearBatterySpec spec;
    spec.battery_name = "cell";
    spec.voltage = spec.constant_coefficient = 12;
    spec.capacity = 0.01, spec.power_load = 24, spec.smooth_current_tau = 0.5;
    return spec;
}

World world_of(const LinearBatterySpec& spec, bool drives = true) {
    ModelSpec model = pendulum();
    JointControllerSpec turn;
    turn.joints = {"hinge"}, turn.initial_velocity = 3;
    if (drives) model.onboard.push_back({"turn", turn, {}});
    model.onboard.push_back({"battery", spec, {}});
    World world = empty_world(kDt, {});
    place(world, model, "robot");
    return world;
}

double memory(const Simulation& sim, int k) {
    const OnboardInfo& info = sim.type(0).onboard.back();
    return sim.states[0].onboard[static_cast<std::size_t>(info.memory_index + k)];
}

std::uint32_t channel(const Simulation& sim, const std::string& name) {
    return static_cast<std::uint32_t>(sim.type(0).find_channel(name).value());
}

void give(Simulation& sim, const std::string& name, double value) {
    const Order order{sim.tick, ClientId(std::size_t{0}), 0, kFirst, Command{channel(sim, name), {value}}};
    sim.step({&order, 1});
}

using Spec = LinearBatterySpec;

TEST(Battery, CurrentAndChargeFollowTheClosedFormOfItsTimeConstant) {
    Simulation sim(world_of(battery()));
    sim.run(2);
    const double amps = 24.0 / 12, tau = 0.5, t = 2;
    EXPECT_NEAR(memory(sim, Spec::kCurrent), amps * (1 - std::exp(-t / tau)), 1e-3);
    const double drawn = amps * (t - tau * (1 - std::exp(-t / tau))) / kHour;
    EXPECT_NEAR(memory(sim, Spec::kCharge), 0.01 - drawn, 1e-3 * drawn);
    EXPECT_EQ(memory(sim, Spec::kVoltage), 12);
}

TEST(Battery, VoltageFallsWithChargeAndCurrent) {
    LinearBatterySpec spec = battery();
    spec.linear_coefficient = -2, spec.resistance = 0.1, spec.capacity = 1, spec.initial_charge = 0.5;
    Simulation sim(world_of(spec));
    sim.run(10);
    const double charge = memory(sim, Spec::kCharge), current = memory(sim, Spec::kCurrent);
    EXPECT_NEAR(memory(sim, Spec::kVoltage), 12 - 2 * (1 - charge) - 0.1 * current, 1e-12);
    // at a constant power, the current settles where current * voltage is the power
    EXPECT_NEAR(memory(sim, Spec::kVoltage) * current, 24, 0.01);
}

TEST(Battery, DrainsOnlyOnceAMotorIsDriven) {
    Simulation still(world_of(battery(), false));
    still.run(1);
    EXPECT_EQ(memory(still, Spec::kCharge), 0.01);
    LinearBatterySpec started = battery();
    started.start_draining = true;
    Simulation drains(world_of(started, false));
    drains.run(1);
    EXPECT_LT(memory(drains, Spec::kCharge), 0.01);
}

TEST(Battery, TopicsStartAndStopTheDraining) {
    LinearBatterySpec spec = battery();
    spec.draining_topics = {"/battery/go"}, spec.stop_topics = {"/battery/stop"};
    Simulation sim(world_of(spec, false));
    sim.run(0.1);
    EXPECT_EQ(memory(sim, Spec::kCurrent), 0);
    give(sim, "battery/go", 1);
    sim.run(5);
    EXPECT_NEAR(memory(sim, Spec::kCurrent), 2, 1e-3);
    give(sim, "battery/stop", 1);
    sim.run(15);
    EXPECT_EQ(memory(sim, Spec::kCurrent), 0);
}

TEST(Battery, EmptySwitchesTheMotorsOffAndRechargedOnAgain) {
    LinearBatterySpec spec = battery();
    spec.initial_charge = 0.002;  // 3.6 s at 2 A
    spec.enable_recharge = true, spec.charging_time = 1e-3;
    Simulation sim(world_of(spec));
    sim.run(3);
    EXPECT_NEAR(sim.states[0].v[0], 3, 1e-6);
    sim.run(3);
    EXPECT_EQ(memory(sim, Spec::kCharge), 0);
    EXPECT_EQ(sim.states[0].motors[0].mode, MotorMode::kPassive);
    give(sim, "battery/cell/recharge/start", 1);
    sim.run(12);
    EXPECT_EQ(sim.states[0].motors[0].mode, MotorMode::kVelocity);
    EXPECT_NEAR(memory(sim, Spec::kCharge), 0.9 * 0.01, 1e-3);
    const double before = memory(sim, Spec::kCharge);
    give(sim, "battery/cell/recharge/stop", 1);
    sim.run(6);
    EXPECT_LT(memory(sim, Spec::kCharge), before - 1e-3);
}

TEST(Battery, TheCommandedPowerReplacesItsLoad) {
    Simulation sim(world_of(battery()));
    give(sim, "battery/cell/power_load", 6);
    sim.run(5);
    EXPECT_NEAR(memory(sim, Spec::kCurrent), 0.5, 1e-3);
}

TEST(Battery, ThrustersLoadItAndStopWhenItIsEmpty) {
    ModelSpec boat;
    boat.name = "boat", boat.canonical_link = "hull";
    const Mat3 inertia = Mat3::diagonal(0.1, 0.1, 0.1);
    boat.links = {link("hull", 1.0, inertia), link("propeller", 1.0, inertia)};
    boat.joints = {joint(JointSpecKind::kPrismatic, "slide", "world", "hull", {}, {1, 0, 0}),
                   joint(JointSpecKind::kContinuous, "spin", "hull", "propeller", {}, {1, 0, 0})};
    ThrusterSpec thruster;
    thruster.joint = {"spin"}, thruster.battery = "cell", thruster.power_load = 12;
    LinearBatterySpec cell = battery();
    cell.power_load = 0, cell.initial_charge = 3 / kHour, cell.smooth_current_tau = 0.01;
    boat.onboard = {{"thruster", thruster, {}}, {"battery", cell, {}}};
    World world = empty_world(kDt, {});
    place(world, boat, "robot");
    Simulation sim(world);
    give(sim, "joint/spin/cmd_thrust", 4);
    sim.run(1.999);
    EXPECT_NEAR(memory(sim, Spec::kCurrent), 1, 1e-6);
    EXPECT_NEAR(sim.states[0].v[0], 4.0 / 2 * 2, 0.01);
    sim.run(1.5);  // after 3 s at 1 A it is empty
    EXPECT_EQ(memory(sim, Spec::kCharge), 0);
    const double kept = sim.states[0].v[0];
    EXPECT_NEAR(kept, 4.0 / 2 * 3, 0.1);
    sim.run(1);
    EXPECT_EQ(sim.states[0].v[0], kept);
}

TEST(Battery, ARobotWhoseCurrentFlowsDoesNotSleep) {
    LinearBatterySpec spec = battery();
    spec.draining_topics = {"go"}, spec.stop_topics = {"stop"};
    ModelSpec box = solid_box(1, {0.2, 0.2, 0.2}, surface(0.5));
    box.onboard.push_back({"battery", spec, {}});
    World world = empty_world(kDt);
    world.sleep = true;
    place(world, box, "robot", {{0, 0, 0.1}, {}});
    place(world, ground(surface(0.5)), "ground");
    Simulation sim(world);
    sim.run(2);
    EXPECT_TRUE(sim.states[0].rest.asleep);
    give(sim, "go", 1);
    sim.run(3);
    EXPECT_FALSE(sim.states[0].rest.asleep);
    give(sim, "stop", 1);
    sim.run(15);
    EXPECT_TRUE(sim.states[0].rest.asleep);
}

TEST(KineticEnergyMonitor, NotesWhatAnImpactTakes) {
    KineticEnergyMonitorSpec spec;
    spec.threshold = 3;
    ModelSpec ball = solid_sphere(2, 0.1, surface(0.5));
    spec.links = {ball.links[0].name};
    ball.onboard.push_back({"monitor", spec, {}});
    World world = empty_world(kDt);
    place(world, ball, "robot", {{0, 0, 1.1}, {}});
    place(world, ground(surface(0.5)), "ground");
    Simulation sim(world);
    using Monitor = KineticEnergyMonitorSpec;
    sim.run(0.4);
    const double fallen = 2 * 9.81 * (1.1 - sim.states[0].q[2]);
    EXPECT_NEAR(memory(sim, Monitor::kEnergy), fallen, 0.01 * fallen);
    EXPECT_EQ(memory(sim, Monitor::kLostAt), -1);
    double lost = 0, losses = 0;  // an impact may take two ticks: to the ground, then on it
    for (int i = 0; i < 1000; ++i) {
        sim.step();
        if (memory(sim, Monitor::kLosses) > losses) lost += memory(sim, Monitor::kLost);
        losses = memory(sim, Monitor::kLosses);
    }
    EXPECT_GE(losses, 1);
    EXPECT_LE(losses, 2);
    EXPECT_NEAR(lost, 2 * 9.81 * 1.0, 0.2);
    EXPECT_NEAR(memory(sim, Monitor::kEnergy), 0, 1e-6);
    EXPECT_NEAR(memory(sim, Monitor::kLostAt) * kDt, std::sqrt(2 / 9.81), 3e-3);
}

}  // namespace
}  // namespace roboss::test
