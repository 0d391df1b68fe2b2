// What a turning link carries by friction stays where it lies.
#include <gtest/gtest.h>

#include <cmath>

#include <support/robots.h>
#include <support/scenes.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

constexpr double kRadius = 0.5;

/// An arm that turns about z; at its end a tray, or a jaw and a finger that closes along y.
ModelSpec turning_arm(bool grips) {
    ModelSpec m;
    m.name = "arm";
    m.canonical_link = "beam";
    LinkSpec beam = link("beam", 5, box_inertia(5, {1, 0.1, 0.1}), {});
    if (grips)
        beam.collisions.push_back(box_shape({0.08, 0.02, 0.08}, surface(0.8), {{kRadius, -0.06, 1.05}, {}}));
    else
        beam.collisions.push_back(box_shape({0.3, 0.3, 0.04}, surface(0.8), {{kRadius, 0, 0.98}, {}}));
    m.links.push_back(beam);
    m.joints.push_back(joint(JointSpecKind::kRevolute, "yaw", "world", "beam", {}, {0, 0, 1}));
    if (!grips) return m;
    const Pose X{{kRadius, 0.06, 1.05}, {}};
    LinkSpec finger = link("finger", 0.2, box_inertia(0.2, {0.08, 0.02, 0.08}), X);
    finger.collisions.push_back(box_shape({0.08, 0.02, 0.08}, surface(0.8)));
    m.links.push_back(finger);
    m.joints.push_back(joint(JointSpecKind::kPrismatic, "slide", "beam", "finger", X, {0, -1, 0}));
    return m;
}

/// The largest distance of the box from where it lay on the arm, in m, after two turns at `omega`.
/// `off`: of the box's centre from its link's origin.
double slip(bool grips, double omega, double dt_s, const Vec3& off = {}) {
    World world = empty_world(dt_s);
    place(world, turning_arm(grips), "arm");
    ModelSpec box_model = solid_box(0.5, {0.1, 0.1, 0.1}, surface(0.8));
    box_model.links[0].p_LC = box_model.links[0].collisions[0].X_LS.p = off;
    place(world, box_model, "box", {Vec3{kRadius, 0, 1.05} - off, {}});
    Simulation sim(world);
    RobotState& arm = sim.states[0];
    RobotState& box = sim.states[1];
    if (grips) sim.set_motor(0, 1, MotorMode::kEffort, 20);
    sim.set_motor(0, 0, MotorMode::kVelocity, 0);
    sim.run(0.2);
    arm.v[0] = omega;
    box.v = {0, 0, omega, omega * off.y, omega * (kRadius - off.x), 0};
    sim.set_motor(0, 0, MotorMode::kVelocity, omega);
    const double radius = std::hypot(box.q[0], box.q[1]), z = box.q[2];
    double worst = 0;
    const int ticks = static_cast<int>(4 * kPi / omega / dt_s);
    for (int i = 0; i < ticks; ++i) {
        sim.step();
        worst = std::max(worst, std::hypot(std::hypot(box.q[0], box.q[1]) - radius, box.q[2] - z));
    }
    EXPECT_NEAR(arm.v[0], omega, 1e-6);
    return worst;
}

TEST(Carrying, ABoxOnATurningTrayKeepsItsRadius) {
    for (const double dt_s : {1e-3, 4e-3}) {
        const double slipped = slip(false, 2.0, dt_s);  // holds up to sqrt(mu g / r) = 3.96 rad/s
        tell("slip on the tray in two turns, m", slipped);
        EXPECT_LT(slipped, 1e-4);
    }
    EXPECT_LT(slip(false, 2.0, 2e-3, {0.2, -0.1, -0.05}), 1e-4) << "origin beside the box";
    EXPECT_GT(slip(false, 6.0, 2e-3), 0.1) << "slides off";
}

TEST(Carrying, ABoxBetweenFingersKeepsItsRadius) {
    for (const double dt_s : {1e-3, 4e-3}) {
        const double slipped = slip(true, 3.0, dt_s);
        tell("slip between the fingers in two turns, m", slipped);
        EXPECT_LT(slipped, 1e-4);
    }
}

TEST(Carrying, ABoxOnACarThatTurnsStaysWhereItLies) {
    World world = empty_world(4e-3);
    place(world, ground(surface(0.9)), "ground");
    place(world, car(), "car");
    place(world, solid_box(0.2, {0.06, 0.06, 0.06}, surface(0.9)), "box", {{0.15, 0, 0.15}, {}});
    Simulation sim(world);
    const std::size_t car = sim.model->find_robot("car")->index(),
                      box = sim.model->find_robot("box")->index();
    for (std::size_t wheel = 0; wheel < 4; ++wheel)
        sim.set_motor(car, wheel, MotorMode::kVelocity, wheel % 2 == 0 ? -8 : 8);
    const auto place_on_car = [&] {
        const Pose X = base_pose(sim.states[car]), of_box = base_pose(sim.states[box]);
        return transpose_times(to_transform(X).R, of_box.p - X.p);
    };
    sim.run(1);
    const Vec3 before = place_on_car();
    sim.run(4);
    tell("yaw rate of the car, rad/s", sim.states[car].v[2]);
    EXPECT_GT(std::fabs(sim.states[car].v[2]), 1.0);
    tell("slip on the car in four seconds, m", norm(place_on_car() - before));
    EXPECT_LT(norm(place_on_car() - before), 1e-4);
}

/// A plank on driven wheels does not turn along with them, so they push it as Coulomb's law says.
TEST(Carrying, WheelsUnderAPlankOnlyPushIt) {
    constexpr double kMu = 0.5, kTime = 0.2;
    World world = empty_world(2e-3);
    ModelSpec wheel;
    wheel.name = "wheel", wheel.canonical_link = "tyre";
    LinkSpec tyre = link("tyre", 1, box_inertia(1, {0.2, 0.2, 0.2}), {});
    tyre.collisions.push_back(sphere_shape(0.1, surface(kMu)));
    wheel.links.push_back(tyre);
    wheel.joints.push_back(joint(JointSpecKind::kRevolute, "axle", "world", "tyre", {}, {0, 1, 0}));
    for (const double x : {-0.5, 0.5})
        for (const double y : {-0.15, 0.15})
            place(world, wheel, "wheel_" + std::to_string(world.instances.size()), {{x, y, 0}, {}});
    place(world, solid_box(2, {4, 0.5, 0.05}, surface(kMu)), "plank", {{0, 0, 0.125}, {}});
    Simulation sim(world);
    for (std::size_t r = 0; r < 4; ++r) {
        sim.states[r].v[0] = 20;
        sim.set_motor(r, 0, MotorMode::kVelocity, 20);
    }
    sim.run(kTime);
    const RobotState& plank = sim.states[4];
    EXPECT_NEAR(plank.v[3], kMu * 9.81 * kTime, 1e-2 * kMu * 9.81 * kTime);
    EXPECT_NEAR(plank.v[4], 0, 1e-6);
    EXPECT_NEAR(plank.v[2], 0, 1e-6);
}

}  // namespace
}  // namespace roboss::test
