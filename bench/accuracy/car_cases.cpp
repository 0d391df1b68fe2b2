// A skid-steer car: its turn is decided by friction alone, and at too little torque it must not turn at all.
// Friction pyramids, clamping axis by axis and solvers that stop early all show here.
#include <support/reference/skid_turn.h>
#include <support/robots.h>

#include "accuracy/figures.h"
#include "accuracy/trial.h"
#include "model/accuracy.h"

namespace roboss::bench {
namespace {

constexpr double kLeft = 4, kRight = 10;  // rad/s

World car_world(bool sphere_wheels, double max_effort, double dt_s) {
    World world = test::empty_world(dt_s);
    test::place(world, test::ground(test::surface(0.9)), "ground");
    test::CarOptions options;
    options.sphere_wheels = sphere_wheels;
    options.max_effort = max_effort;
    test::place(world, test::car(options), "car");
    return world;
}

void drive(Engine& engine, double max_effort) {
    for (std::size_t wheel = 0; wheel < 4; ++wheel)
        engine.drive_velocity({1, wheel, 0}, wheel % 2 == 0 ? kLeft : kRight, max_effort);
}

/// rad/s, by the balance of forces; points: one a wheel, or the two ends of a cylinder's line.
double exact_yaw_rate(bool sphere_wheels) {
    constexpr double kRadius = 0.05, kWheelMass = 0.3, kHalfWidth = 0.02;
    test::SkidCar car;
    car.mass = 5 + 4 * kWheelMass;
    car.height = kRadius;
    car.mu = 0.9;
    for (const double x : {0.15, -0.15})
        for (const double y : {0.13, -0.13})
            for (const double side : {-1.0, 1.0}) {
                const double at = y + (sphere_wheels ? 0 : side * kHalfWidth);
                car.points.push_back({x, at, (y > 0 ? kLeft : kRight) * kRadius});
            }
    const double inertia = (sphere_wheels ? 0.4 : 0.5) * kWheelMass * kRadius * kRadius;
    car.wheel_spin = inertia * 2 * (kLeft + kRight);
    return test::skid_turn(car).yaw_rate;
}

/// Mean yaw rate from 2 s to 6 s, and how far the mean wheel speeds are from what was ordered.
Outcome turn(const Contender& contender, bool sphere_wheels) {
    Trial trial(contender, car_world(sphere_wheels, 2.0, contender.dt_s));
    if (!trial.possible()) return Trial::impossible(2);
    drive(trial.engine(), 2.0);
    trial.run(2);
    double yaw_rate = 0, speeds[4] = {}, samples = 0;
    trial.run(4, 0.01, [&] {
        ++samples;
        yaw_rate += trial.link(1).angular.z;
        for (std::size_t wheel = 0; wheel < 4; ++wheel)
            speeds[wheel] += trial.engine().joint({1, wheel, 0}).velocity;
    });
    double worst = 0;
    for (std::size_t wheel = 0; wheel < 4; ++wheel)
        worst = largest(worst, std::fabs(speeds[wheel] / samples / (wheel % 2 == 0 ? kLeft : kRight) - 1));
    return trial.outcome({yaw_rate / samples, worst});
}

/// Largest yaw rate after the first second, at a torque that does not suffice to turn.
Outcome refuse_to_turn(const Contender& contender, bool sphere_wheels, const AccuracySpec& accuracy = {}) {
    World world = car_world(sphere_wheels, 0.5, contender.dt_s);
    world.accuracy = {accuracy};
    Trial trial(contender, world);
    if (!trial.possible()) return Trial::impossible(1);
    drive(trial.engine(), 0.5);
    trial.run(1);
    double yaw_rate = 0;
    trial.run(4, 0.01, [&] { yaw_rate = largest(yaw_rate, std::fabs(trial.link(1).angular.z)); });
    return trial.outcome({yaw_rate});
}

/// The three settings, each number at both ends of its range, and all numbers at their loose ends.
std::vector<AccuracySpec> allowed_settings() {
    std::vector<AccuracySpec> all;
    for (const char* name : {"fast", "standard", "high"}) all.push_back({name, {}, {}});
    AccuracySpec loosest;
    for (const AccuracyNumber& n : accuracy_numbers()) {
        for (const double value : {n.low, n.high}) all.push_back({"", {{n.name, value}}, {}});
        loosest.numbers.push_back({n.name, n.whole != nullptr ? n.low : n.high});
    }
    all.push_back(loosest);
    return all;
}

Outcome refuse_at_every_setting(const Contender& contender) {
    double worst = 0;
    for (const AccuracySpec& accuracy : allowed_settings())
        for (const bool spheres : {true, false}) {
            const Outcome outcome = refuse_to_turn(contender, spheres, accuracy);
            if (!outcome.possible) return outcome;
            worst = largest(worst, outcome.figures[0]);
        }
    return {{worst}};
}

}  // namespace

std::vector<Case> car_cases() {
    std::vector<Case> cases;
    for (const bool spheres : {true, false}) {
        const std::string wheels = spheres ? "sphere" : "cylinder";
        const double exact = exact_yaw_rate(spheres);
        cases.push_back(
            {"turn-" + wheels,
             "Skid-steer car, " + wheels + " wheels, 2 N m: wheels 4 and 10 rad/s",
             "balance of forces with Coulomb friction at each point, load shift included, solved to 1e-12",
             {{"yaw rate", "rad/s", 0.005 * exact, exact}, {"wheel speed, worst, relative", "", {}}},
             [spheres](const Contender& c) { return turn(c, spheres); }});
        cases.push_back({"no-turn-" + wheels,
                         "Skid-steer car, " + wheels + " wheels, 0.5 N m",
                         "it must not turn: the motors cannot break the tires loose",
                         {{"largest yaw rate after 1 s", "rad/s", 1e-3}},
                         [spheres](const Contender& c) { return refuse_to_turn(c, spheres); }});
    }
    cases.push_back({"no-turn-settings",
                     "The same, both kinds of wheels, at every accuracy setting",
                     "it must not turn: fast, standard, high; each number at both ends of its range; all at "
                     "their loose ends",
                     {{"largest yaw rate after 1 s", "rad/s", 1e-3}},
                     refuse_at_every_setting});
    cases.back().ours_only = true;
    for (Case& c : cases) c.also_coarse = true;
    return cases;
}

}  // namespace roboss::bench
