// Wheels: rolling without slipping, and a skid-steer car that turns as the geometry of its friction says.
#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

constexpr double kRadius = 0.1;

/// Rolls a body down 10 degrees for 2 s and compares with g sin(angle) / (1 + k), k = inertia / (m r^2).
void expect_rolling(const ModelSpec& model, const Quat& q_WM, double k, const std::string& name) {
    const double angle = 10 * kPi / 180;
    World world = empty_world(1e-3, {9.81 * std::sin(angle), 0, -9.81 * std::cos(angle)});
    place(world, ground(surface(0.8)), "ground");
    place(world, model, name, {{0, 0, kRadius}, q_WM});
    Simulation sim(world);
    sim.run(2);
    const double a = 9.81 * std::sin(angle) / (1 + k);
    const std::vector<double>& v = sim.states[0].v;
    tell(name + ": relative error of the way", sim.states[0].q[0] / (2 * a) - 1);
    tell(name + ": slip, m/s", v[3] - v[1] * kRadius);
    EXPECT_NEAR(v[3] / (2 * a), 1, 1e-3);
    EXPECT_NEAR(sim.states[0].q[0] / (2 * a), 1, 1e-3);
    EXPECT_LT(std::fabs(v[3] - v[1] * kRadius), 1e-6);
    EXPECT_LT(std::fabs(sim.states[0].q[1]), 1e-6);
}

TEST(Rolling, SphereRollsDownAnIncline) {
    expect_rolling(solid_sphere(2.0, kRadius, surface(0.8)), {}, 0.4, "sphere");
}

TEST(Rolling, CylinderRollsDownAnIncline) {
    expect_rolling(solid_cylinder(2.0, kRadius, 0.3, surface(0.8)), from_rpy(-kPi / 2, 0, 0), 0.5,
                   "cylinder");
}

struct Drive {
    Drive(const CarOptions& options, double left, double right, double dt_s = 2e-3) {
        World world = empty_world(dt_s);
        place(world, ground(surface(options.mu)), "ground");
        place(world, car(options), "car");
        sim = std::make_unique<Simulation>(world);
        sim->run(0.2);
        for (std::size_t wheel = 0; wheel < 4; ++wheel)
            sim->set_motor(0, wheel, MotorMode::kVelocity, wheel % 2 == 0 ? left : right);
    }
    double yaw_rate() const { return sim->states[0].v[2]; }
    double height() const { return sim->states[0].q[2]; }
    std::unique_ptr<Simulation> sim;
};

TEST(SkidSteer, SphereWheelsTurnAtTheAnalyticRate) {
    Drive drive({true, 0.9, 2.0}, 4, 10);
    drive.sim->run(10);
    tell("yaw rate with sphere wheels, analytic .495, rad/s", drive.yaw_rate());
    EXPECT_NEAR(drive.yaw_rate() / 0.495, 1, 5e-3);
}

TEST(SkidSteer, CylinderWheelsTurnAtTheAnalyticRate) {
    Drive drive({false, 0.9, 2.0}, 4, 10);
    drive.sim->run(10);
    tell("yaw rate with cylinder wheels, analytic .4907, rad/s", drive.yaw_rate());
    EXPECT_NEAR(drive.yaw_rate() / 0.4907, 1, 2e-3);
}

TEST(SkidSteer, WeakMotorsDoNotTurnTheCar) {
    for (const bool spheres : {false, true}) {
        Drive drive({spheres, 0.9, 0.5}, 4, 10);
        drive.sim->run(10);
        tell("yaw rate at 0.5 N m, rad/s", drive.yaw_rate());
        EXPECT_LE(std::fabs(drive.yaw_rate()), 1e-3);
    }
}

TEST(SkidSteer, CarDrivesStraightAtTheSpeedOfItsWheels) {
    Drive drive({}, 10, 10);
    drive.sim->run(5);
    tell("speed of the car, wheels at .5 m/s", drive.sim->states[0].v[3]);
    EXPECT_NEAR(drive.sim->states[0].v[3], 0.5, 1e-6);
    EXPECT_LT(std::fabs(drive.sim->states[0].q[1]), 1e-6);
    EXPECT_LT(std::fabs(drive.yaw_rate()), 1e-9);
}

TEST(SkidSteer, BrakedCarStandsOnASlope) {
    World world = empty_world(2e-3);
    const Quat tilt = from_rpy(0, 15 * kPi / 180, 0);
    place(world, ground(surface(0.9)), "slope", {{}, tilt});
    place(world, car(), "car", {{}, tilt});
    Simulation sim(world);
    for (std::size_t wheel = 0; wheel < 4; ++wheel) sim.set_motor(0, wheel, MotorMode::kVelocity, 0);
    sim.run(1);
    const Pose before = base_pose(sim.states[0]);
    sim.run(10);
    const double creep = norm(base_pose(sim.states[0]).p - before.p) / 10;
    tell("creep of the braked car on 15 degrees, m/s", creep);
    EXPECT_LT(creep, 1e-6);
}

}  // namespace
}  // namespace roboss::test
