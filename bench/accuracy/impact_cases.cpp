// Impacts: heights of bounces, exchanged momentum, a coin that rolls on its rim, a fast ball and a thin wall.
#include <support/bodies.h>

#include "accuracy/figures.h"
#include "accuracy/trial.h"

namespace roboss::bench {
namespace {

/// Largest relative error of the first three peaks of a ball dropped from 1 m.
Outcome bounce(const Contender& contender, double restitution) {
    constexpr double kRadius = 0.05;
    constexpr std::size_t kBounces = 3;
    World world = test::empty_world(contender.dt_s);
    const SurfaceSpec surface = test::surface(0.5, restitution);
    test::place(world, test::ground(surface), "ground");
    test::place(world, test::solid_sphere(1.0, kRadius, surface), "ball", {{0, 0, 1 + kRadius}, {}});
    Trial trial(contender, world);
    if (!trial.possible()) return Trial::impossible(kBounces);
    std::vector<double> peaks;
    double peak = 0, speed_before = 0;
    trial.run(5, contender.dt_s, [&] {
        const double speed = trial.link(1).v_WC.z;
        peak = speed > 0 ? std::fmax(peak, trial.centre(1).z - kRadius) : peak;
        if (speed <= 0 && speed_before > 0 && peaks.size() < kBounces) {
            peaks.push_back(peak);
            peak = 0;
        }
        speed_before = speed;
    });
    peaks.resize(kBounces, 0.0);  // it lies
    double expected = 1;
    for (double& height : peaks) {
        expected *= restitution * restitution;
        height = std::fabs(height / expected - 1);
    }
    return trial.outcome(peaks);
}

Outcome collide_boxes(const Contender& contender) {
    World world = test::empty_world(contender.dt_s, {});
    const SurfaceSpec surface = test::surface(0.5, 0.3);
    const Pose a{{}, from_rpy(0.3, 0.5, 0.2)}, b{{0.8, 0.08, -0.05}, from_rpy(1, 0.2, 0.7)};
    test::place(world, test::solid_box(1.0, {0.2, 0.3, 0.4}, surface), "a", a);
    test::place(world, test::solid_box(2.5, {0.3, 0.2, 0.2}, surface), "b", b);
    Trial trial(contender, world);
    if (!trial.possible()) return Trial::impossible(3);
    trial.engine().set_base(0, a, {1, 2, -1}, {2, 0.2, 0});
    trial.engine().set_base(1, b, {-1, 0.5, 2}, {-1, 0, 0.1});
    trial.begin();
    const Trial::Momentum before = trial.momentum();
    const double energy = trial.energy();
    trial.run(1);
    const Trial::Momentum after = trial.momentum();
    return trial.outcome({norm(after.linear - before.linear) / norm(before.linear),
                          norm(after.angular - before.angular) / norm(before.angular),
                          trial.energy() / energy});
}

/// A sphere at 1 m/s meets four in a row, `gap` apart; the last one leaves with its speed.
Outcome cradle(const Contender& contender, double gap) {
    constexpr int kSpheres = 5;
    constexpr double kRadius = 0.1;
    World world = test::empty_world(contender.dt_s, {});
    const SurfaceSpec surface = test::surface(0, 1.0);
    for (int i = 0; i < kSpheres; ++i) {
        const double x = i * (2 * kRadius + gap) - (i == 0 ? 0.3 : 0);
        test::place(world, test::solid_sphere(1.0, kRadius, surface), "sphere_" + std::to_string(i),
                    {{x, 0, 0}, {}});
    }
    Trial trial(contender, world);
    if (!trial.possible()) return Trial::impossible(1);
    trial.engine().set_base(0, {{-0.3, 0, 0}, {}}, {}, {1, 0, 0});
    trial.run(1);
    double error = 0;
    for (std::size_t i = 0; i < kSpheres; ++i) {
        const Vec3 exact{i + 1 == kSpheres ? 1.0 : 0.0, 0, 0};
        error = largest(error, norm(trial.link(i).v_WC - exact));
    }
    return trial.outcome({error});
}

/// Steady rolling of a coin on its lower edge, leaning inward, in a circle: Euler's equations in the frame
/// that turns with it.
struct RollingCoin {
    double radius = 0.1, thickness = 0.01, mass = 0.5, lean = 0.3, circle = 0.5, gravity = 9.81;
    Vec3 axis{std::cos(lean), 0, std::sin(lean)};
    Vec3 p_CE = Vec3{std::sin(lean), 0, -std::cos(lean)} * radius - axis * (0.5 * thickness);  // to the edge
    double turn = 0;  // rad/s about the vertical
    double spin = 0;  // rad/s about its axis, beyond that

    RollingCoin() {
        const Mat3 inertia = test::cylinder_inertia(mass, radius, thickness);
        const double across = inertia(0, 0), along = inertia(2, 2);
        // No slip: spin = ratio * turn.
        const double ratio = -(circle + p_CE.x) / (axis.z * p_CE.x - axis.x * p_CE.z);
        const Vec3 w = Vec3{0, 0, 1} + axis * ratio;  // per turn
        const Vec3 momentum = w * across + axis * (dot(w, axis) * (along - across));
        turn = std::sqrt(-mass * gravity * p_CE.x / (momentum.x + mass * p_CE.z * circle));
        spin = ratio * turn;
    }
    Vec3 angular() const { return Vec3{0, 0, turn} + axis * spin; }
};

Outcome roll_coin(const Contender& contender) {
    const RollingCoin coin;
    World world = test::empty_world(contender.dt_s, {0, 0, -coin.gravity});
    const SurfaceSpec surface = test::surface(0.9);
    test::place(world, test::ground(surface), "ground");
    const Pose X{{coin.circle, 0, -coin.p_CE.z}, from_rpy(0, kPi / 2 - coin.lean, 0)};
    test::place(world, test::solid_cylinder(coin.mass, coin.radius, coin.thickness, surface), "coin", X);
    Trial trial(contender, world);
    if (!trial.possible()) return Trial::impossible(3);
    trial.engine().set_base(1, X, coin.angular(), {0, coin.turn * coin.circle, 0});
    trial.begin();
    const double energy = trial.energy();
    double height = 0, drift = 0, way_off = 0;
    trial.run(5, 0.05, [&] {
        const double angle = coin.turn * trial.time_s();
        const Vec3 now = trial.centre(1), exact = Vec3{std::cos(angle), std::sin(angle), 0} * coin.circle;
        height = largest(height, std::fabs(now.z / X.p.z - 1));
        drift = largest(drift, std::fabs(trial.energy() / energy - 1));
        way_off = largest(way_off, norm(Vec3{now.x, now.y, 0} - exact));
    });
    return trial.outcome({height, drift, way_off});
}

Outcome shoot_at_wall(const Contender& contender) {
    constexpr double kRadius = 0.01, kSpeed = 5, kWall = 0.01;
    World world = test::empty_world(contender.dt_s, {});
    const SurfaceSpec surface = test::surface(0.5);
    test::place(world, test::scenery(test::box_shape({kWall, 2, 2}, surface)), "wall", {{1, 0, 0}, {}});
    test::place(world, test::solid_sphere(0.01, kRadius, surface), "ball", {{0.003, 0.03, 0.01}, {}});
    Trial trial(contender, world);
    if (!trial.possible()) return Trial::impossible(1);
    trial.engine().set_base(1, {{0.003, 0.03, 0.01}, {}}, {}, {kSpeed, 0, 0});
    double deepest = 0;
    trial.run(0.4, contender.dt_s,
              [&] { deepest = largest(deepest, trial.centre(1).x - (1 - 0.5 * kWall - kRadius)); });
    return trial.outcome({deepest});
}

std::vector<Case> bounces() {
    std::vector<Case> cases;
    for (const double restitution : {0.5, 0.9}) {
        const bool half = restitution == 0.5;
        cases.push_back({half ? "bounce-5" : "bounce-9",
                         std::string("Ball dropped from 1 m, restitution ") + (half ? "0.5" : "0.9"),
                         "height of bounce n is e^(2 n) m",
                         {{"first bounce, relative", "", 5e-3},
                          {"second bounce, relative", "", 5e-3},
                          {"third bounce, relative", "", 5e-3}},
                         [restitution](const Contender& c) { return bounce(c, restitution); }});
        cases.back().also_coarse = true;
    }
    return cases;
}

}  // namespace

std::vector<Case> impact_cases() {
    std::vector<Case> cases = bounces();
    cases.push_back({"collision",
                     "Two tumbling boxes collide, restitution 0.3, 1 s, no gravity",
                     "momentum stays (angular: about the origin), energy falls",
                     {{"linear momentum, relative", "", 1e-9},
                      {"angular momentum, relative", "", 5e-3},
                      {"energy kept", "", {}}},
                     collide_boxes,
                     false});
    cases.back().remark =
        "Of first order in the step: the bodies move on while the impact of a tick acts (0.28 % at 1 ms, "
        "0.06 % at "
        "0.25 ms).";
    cases.push_back({"cradle",
                     "Newton's cradle: one sphere meets four, 5 mm apart, restitution 1",
                     "the last one takes the whole speed of 1 m/s",
                     {{"largest error of a velocity", "m/s", 1e-3}},
                     [](const Contender& c) { return cradle(c, 5e-3); },
                     false});
    cases.push_back({"coin",
                     "Coin rolling on its rim in a circle of 0.5 m, leaning 17 degrees, 5 s",
                     "steady rolling, by Euler's equations (no slip, no loss)",
                     {{"height of the centre, relative", "", 0.01},
                      {"energy, relative", "", 0.01},
                      {"place of the centre", "m", {}}},
                     roll_coin,
                     false});
    cases.back().remark =
        "Motion in contact is of first order in the step: 0.95 % of the height at 1 ms, 0.22 % at 0.25 ms.";
    cases.push_back({"bullet",
                     "Ball of 2 cm at 5 m/s against a wall of 1 cm, dt 2 ms",
                     "it stays before the wall",
                     {{"deepest in the wall", "m", 1e-4}},
                     shoot_at_wall,
                     false});
    cases.back().dt_s = 2e-3;
    return cases;
}

}  // namespace roboss::bench
