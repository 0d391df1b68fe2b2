// The accuracy settings: what each gives, and that the car whose motors are too weak to turn stands at every
// setting that is allowed.
#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/simulation.h>

#include "model/accuracy.h"

namespace roboss::test {
namespace {

AccuracySpec named(const std::string& setting) {
    AccuracySpec spec;
    spec.setting = setting;
    return spec;
}

/// The skid-steer car of the issue, wheels at 4 and 10 rad/s: its yaw rate after `seconds`.
double yaw_rate(const AccuracySpec& accuracy, const CarOptions& options, double seconds, double dt_s = 2e-3) {
    World world = empty_world(dt_s);
    world.accuracy.push_back(accuracy);
    place(world, ground(surface(options.mu)), "ground");
    place(world, car(options), "car");
    Simulation sim(world);
    sim.run(0.2);
    for (std::size_t wheel = 0; wheel < 4; ++wheel)
        sim.set_motor(0, wheel, MotorMode::kVelocity, wheel % 2 == 0 ? 4 : 10);
    sim.run(seconds);
    return sim.states[0].v[2];
}

/// Each number at its loosest and at its strictest, then all together, on top of each setting.
std::vector<AccuracySpec> corners() {
    std::vector<AccuracySpec> all;
    for (const char* setting : {"fast", "standard", "high"}) {
        all.push_back(named(setting));
        AccuracySpec loosest = named(setting);
        for (const AccuracyNumber& n : accuracy_numbers()) {
            for (const double value : {n.low, n.high}) {
                all.push_back(named(setting));
                all.back().numbers = {{n.name, value}};
            }
            loosest.numbers.push_back({n.name, n.whole != nullptr ? n.low : n.high});
        }
        all.push_back(loosest);
    }
    return all;
}

std::string text(const AccuracySpec& spec) {
    std::string all = spec.setting;
    for (const auto& n : spec.numbers) all += ", " + n.name + " " + std::to_string(n.value);
    return all;
}

TEST(AccuracySettings, WeakMotorsDoNotTurnTheCarAtAnyAllowedSetting) {
    double worst = 0;
    for (const AccuracySpec& accuracy : corners()) {
        for (const bool spheres : {false, true}) {
            for (const double dt_s : {1e-3, 5e-3}) {
                const double rate = std::fabs(yaw_rate(accuracy, {spheres, 0.9, 0.5}, 3, dt_s));
                worst = std::fmax(worst, rate);
                EXPECT_LE(rate, 1e-3)
                    << text(accuracy) << (spheres ? ", spheres" : ", cylinders") << ", dt " << dt_s;
            }
        }
    }
    tell("worst yaw rate at 0.5 N m of all corners, rad/s", worst);
}

TEST(AccuracySettings, StrongMotorsTurnItAtTheAnalyticRate) {
    for (const char* setting : {"fast", "standard", "high"}) {
        const double rate = yaw_rate(named(setting), {true, 0.9, 2.0}, 10);
        tell(std::string(setting) + ": error of the yaw rate against .495", rate / 0.495 - 1);
        EXPECT_NEAR(rate / 0.495, 1, 5e-3);
    }
}

struct Pile {
    double iterations = 0, creep = 0, residual = 0;
};

/// Six cars driving into each other and a dozen boxes falling on a heap: half a second of hard work; then the
/// creep of a braked car on a slope.
Pile measure(const AccuracySpec& accuracy) {
    Pile pile;
    World world = empty_world(2e-3);
    world.accuracy.push_back(accuracy);
    place(world, ground(surface(0.9)), "ground");
    for (int i = 0; i < 6; ++i)
        place(world, car(), "car_" + std::to_string(i),
              {{0.45 * (i % 3), 0.35 * (i / 3), 0}, from_rpy(0, 0, i % 2 == 0 ? 0 : kPi)});
    for (int i = 0; i < 12; ++i)
        place(world, solid_box(1.0, {0.2, 0.2, 0.2}, surface(0.6)), "box_" + std::to_string(i),
              {{8 + 0.13 * (i % 4), 0.11 * (i / 4 % 3), 0.12 + 0.21 * (i / 12)}, {}});
    Simulation sim(world);
    for (std::size_t c = 0; c < 6; ++c)
        for (std::size_t wheel = 0; wheel < 4; ++wheel) sim.set_motor(c, wheel, MotorMode::kVelocity, 6);
    for (int i = 0; i < 250; ++i) pile.iterations += sim.step().iterations;
    pile.residual = sim.residual_max;

    World slope = empty_world(2e-3);
    slope.accuracy.push_back(accuracy);
    const Quat tilt = from_rpy(0, 15 * kPi / 180, 0);
    place(slope, ground(surface(0.9)), "slope", {{}, tilt});
    place(slope, car(), "car", {{}, tilt});
    Simulation braked(slope);
    for (std::size_t wheel = 0; wheel < 4; ++wheel) braked.set_motor(0, wheel, MotorMode::kVelocity, 0);
    braked.run(1);
    const Vec3 before = base_pose(braked.states[0]).p;
    braked.run(4);
    pile.creep = norm(base_pose(braked.states[0]).p - before) / 4;
    return pile;
}

TEST(AccuracySettings, MoreAccuracyIsMoreTruth) {
    const Pile fast = measure(named("fast")), standard = measure(named("standard")),
               high = measure(named("high"));
    for (const auto& [name, pile] : {std::pair{"fast", fast}, {"standard", standard}, {"high", high}}) {
        tell(std::string(name) + ": Newton iterations a tick", pile.iterations / 250);
        tell(std::string(name) + ": worst residual", pile.residual);
        tell(std::string(name) + ": creep of the braked car, m/s", pile.creep);
        EXPECT_LT(pile.creep, 1e-6);
    }
    EXPECT_LE(high.creep, standard.creep);
    EXPECT_LE(standard.creep, fast.creep * 1.01);
}

TEST(AccuracySettings, NumbersOutOfRangeAreRefusedByName) {
    for (const AccuracyNumber& n : accuracy_numbers()) {
        for (const double value :
             {0.5 * n.low - 1e-15, 2 * n.high, std::numeric_limits<double>::quiet_NaN()}) {
            AccuracySpec spec;
            spec.numbers = {{n.name, value}};
            spec.where = {"world.sdf", 12};
            Accuracy accuracy;
            Diagnostics diagnostics;
            apply(spec, accuracy, diagnostics);
            ASSERT_EQ(diagnostics.items().size(), 1u) << n.name << " " << value;
            EXPECT_NE(to_text(diagnostics.items()[0]).find(n.name), std::string::npos);
            EXPECT_NE(to_text(diagnostics.items()[0]).find("world.sdf:12"), std::string::npos);
            EXPECT_EQ(n.get(accuracy), n.get(Accuracy{})) << "left as it was";
        }
        EXPECT_GE(n.get(*accuracy_setting("fast")), n.low);
        EXPECT_LE(n.get(*accuracy_setting("fast")), n.high);
        EXPECT_GE(n.get(*accuracy_setting("high")), n.low);
        EXPECT_LE(n.get(*accuracy_setting("high")), n.high);
    }
    AccuracySpec spec = named("fastest");
    spec.numbers = {{"newton_max", 20.5}, {"speed", 3}};
    Accuracy accuracy;
    Diagnostics diagnostics;
    apply(spec, accuracy, diagnostics);
    EXPECT_EQ(diagnostics.count(Severity::kError), 3u);
}

}  // namespace
}  // namespace roboss::test
