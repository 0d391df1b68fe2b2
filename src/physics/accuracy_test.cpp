// The accuracy settings: what each gives, and that the car whose motors are too weak to turn stands at every
// setting that is allowed.
#include <gtest/gtest.h>

#include <cmath>
#include <string_view>
#include <utility>

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

/// Six cars driving into each other and a dozen boxes falling on a heap.
World pile(const AccuracySpec& accuracy) {
    World world = empty_world(2e-3);
    world.accuracy.push_back(accuracy);
    place(world, ground(surface(0.9)), "ground");
    for (int i = 0; i < 6; ++i)
        place(world, car(), "car_" + std::to_string(i),
              {{0.45 * (i % 3), 0.35 * (i / 3), 0}, from_rpy(0, 0, i % 2 == 0 ? 0 : kPi)});
    for (int i = 0; i < 12; ++i)
        place(world, solid_box(1.0, {0.2, 0.2, 0.2}, surface(0.6)), "box_" + std::to_string(i),
              {{8 + 0.13 * (i % 4), 0.11 * (i / 4 % 3), 0.12 + 0.21 * (i / 12)}, {}});
    return world;
}

/// Sixty-four boxes that fall onto each other.
World collapse(const AccuracySpec& accuracy) {
    World world = empty_world(2e-3);
    world.accuracy.push_back(accuracy);
    place(world, ground(surface(0.9)), "ground");
    for (int i = 0; i < 64; ++i) {
        const Vec3 at{0.19 * (i % 4) + 0.01 * (i / 16), 0.19 * (i / 4 % 4), 0.15 + 0.22 * (i / 16)};
        place(world, solid_box(1.0 + i % 3, {0.2, 0.16, 0.12}, surface(0.6)), "box_" + std::to_string(i),
              {at, from_rpy(0.3 * i, 0.2, 0.1 * i)});
    }
    return world;
}

/// The same softness, solved as strictly as is allowed.
AccuracySpec strictly(AccuracySpec spec) {
    for (const AccuracyNumber& n : accuracy_numbers())
        if (!std::string_view(n.name).ends_with("compliance"))
            spec.numbers.push_back({n.name, n.whole != nullptr ? n.high : n.low});
    return spec;
}

/// As hard and as strict as is allowed.
AccuracySpec hardest() {
    AccuracySpec spec = strictly(named("high"));
    for (const AccuracyNumber& n : accuracy_numbers())
        if (std::string_view(n.name).ends_with("compliance")) spec.numbers.push_back({n.name, n.low});
    return spec;
}

/// One tick of the pile from each of a series of states, which are the same for all.
class Trial {
  public:
    /// Velocities after the tick, one after the other.
    explicit Trial(const AccuracySpec& accuracy, World (*world)(const AccuracySpec&) = pile) {
        // From kFirst on: the boxes, which start in each other, stand on the ground then.
        constexpr int kFirst = 60, kTicks = 310, kEvery = 10;
        Simulation path(world(named("standard"))), tried(world(accuracy));
        for (std::size_t c = 0; world == pile && c < 6; ++c)
            for (std::size_t wheel = 0; wheel < 4; ++wheel) path.set_motor(c, wheel, MotorMode::kVelocity, 6);
        for (int i = 0; i < kTicks; ++i) {
            if (i >= kFirst && i % kEvery == 0) {
                tried.states = path.states;
                iterations += static_cast<double>(tried.step().iterations) * kEvery / (kTicks - kFirst);
                for (const RobotState& state : tried.states)
                    velocities.insert(velocities.end(), state.v.begin(), state.v.end());
            }
            path.step();
        }
    }
    /// Root mean square.
    double off(const Trial& truth) const {
        double squares = 0;
        for (std::size_t i = 0; i < velocities.size(); ++i)
            squares += std::pow(velocities[i] - truth.velocities[i], 2);
        return std::sqrt(squares / static_cast<double>(velocities.size()));
    }
    double iterations = 0;  // Newton's, a tick
    std::vector<double> velocities;
};

/// What tolerances leave, against the same problem solved strictly; what softness makes, against hard
/// contacts.
TEST(AccuracySettings, MoreAccuracyIsMoreTruth) {
    const Trial fast(named("fast")), standard(named("standard")), high(named("high")), hard(hardest());
    const double fast_left = fast.off(Trial(strictly(named("fast")))),
                 standard_left = standard.off(Trial(strictly(named("standard"))));
    tell("fast: error left by the tolerances", fast_left);
    tell("standard: error left by the tolerances", standard_left);
    EXPECT_LT(fast_left, 3e-3);  // m/s: soft substeps, of boxes that just landed
    // Newton's method mostly ends far below its tolerance.
    EXPECT_LT(standard_left, 2e-9);
    tell("standard: error by softness", standard.off(hard));
    tell("high: error by softness", high.off(hard));
    EXPECT_LT(1.3 * high.off(hard), standard.off(hard));
    EXPECT_GT(high.off(hard), 0) << "the truth would be compared with itself";
    for (const Trial* trial : {&fast, &standard, &high}) tell("Newton iterations a tick", trial->iterations);
    EXPECT_LT(fast.iterations, 1.2 * standard.iterations);  // it gains where many touch
    EXPECT_LT(standard.iterations, high.iterations);
}

/// A large pile that moves is left to sweeps, which end within a thousandth of its motion.
TEST(AccuracySettings, SweepsSettleALargePileThatMoves) {
    const Trial standard(named("standard"), collapse), strict(strictly(named("standard")), collapse);
    double squares = 0;
    for (const double x : strict.velocities) squares += x * x;
    const double speed = std::sqrt(squares / static_cast<double>(strict.velocities.size()));
    const double left = standard.off(strict);
    tell("standard: error left by sweeps, relative to the motion", left / speed);
    EXPECT_GT(speed, 0.1);
    EXPECT_GT(left, 1e-6 * speed) << "Newton's method finished";
    EXPECT_LT(left, 2e-3 * speed);
    EXPECT_LT(standard.iterations, 0.5 * strict.iterations);
}

/// Bodies fly at each other with nothing else around: whatever a setting leaves of the contacts' laws,
/// momentum stays, and energy is not gained.
TEST(AccuracySettings, PilesKeepMomentumAtEverySetting) {
    for (const char* setting : {"fast", "standard", "high"}) {
        World world = empty_world(2e-3, {});
        world.accuracy.push_back(named(setting));
        for (int i = 0; i < 64; ++i) {  // a part of 32 and more is one that sweeps may settle
            const Vec3 at{0.22 * (i % 4 - 1.5), 0.23 * (i / 4 % 4 - 1.5), 0.21 * (i / 16 - 1.5)};
            const Pose X{at, from_rpy(0.1 * i, 0.2, 0.05 * i)};
            place(world, solid_box(1.0 + i % 3, {0.2, 0.2, 0.2}, surface(0.6)), "box_" + std::to_string(i),
                  X);
        }
        Simulation sim(world);
        for (std::size_t i = 0; i < sim.states.size(); ++i) {
            const Pose X = base_pose(sim.states[i]);
            const Vec3 v = rotate(conjugate(X.q), X.p * -3.0);
            sim.states[i].v[3] = v.x, sim.states[i].v[4] = v.y, sim.states[i].v[5] = v.z;
        }
        const Momentum before = sim.momentum();
        double least = sim.energy(), gained = 0;
        int contacts = 0;
        for (int i = 0; i < 200; ++i) {
            contacts += sim.step().contacts;
            gained = std::fmax(gained, sim.energy() / least - 1);
            least = std::fmin(least, sim.energy());
        }
        const Momentum after = sim.momentum();
        EXPECT_GT(contacts, 400) << setting;
        EXPECT_LT(norm(after.linear - before.linear), 1e-10) << setting;
        EXPECT_LT(norm(after.angular - before.angular), 1e-6) << setting;
        EXPECT_LT(gained, 1e-6) << setting;
        tell(std::string(setting) + ": energy gained, relative to its least before", gained);
        tell(std::string(setting) + ": linear momentum off by", norm(after.linear - before.linear));
        tell(std::string(setting) + ": angular momentum off by", norm(after.angular - before.angular));
    }
}

TEST(AccuracySettings, ACollapsedPileComesToRestAtEverySetting) {
    for (const auto& [setting, most] : {std::pair("fast", 4e-4), std::pair("standard", 1e-9)}) {
        Simulation sim(collapse(named(setting)));
        sim.run(4);
        double fastest = 0;
        for (const RobotState& state : sim.states)
            for (const double v : state.v) fastest = std::fmax(fastest, std::fabs(v));
        tell(std::string(setting) + ": fastest, m/s or rad/s", fastest);
        EXPECT_LT(fastest, most) << setting;
    }
}

TEST(AccuracySettings, ABrakedCarOnASlopeStandsAtEverySetting) {
    for (const char* setting : {"fast", "standard", "high"}) {
        World slope = empty_world(2e-3);
        slope.accuracy.push_back(named(setting));
        const Quat tilt = from_rpy(0, 15 * kPi / 180, 0);
        place(slope, ground(surface(0.9)), "slope", {{}, tilt});
        place(slope, car(), "car", {{}, tilt});
        Simulation braked(slope);
        for (std::size_t wheel = 0; wheel < 4; ++wheel) braked.set_motor(0, wheel, MotorMode::kVelocity, 0);
        braked.run(1);
        const Vec3 before = base_pose(braked.states[0]).p;
        braked.run(4);
        const double creep = norm(base_pose(braked.states[0]).p - before) / 4;
        tell(std::string(setting) + ": creep of the braked car, m/s", creep);
        EXPECT_LT(creep, 1e-6) << setting;
    }
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
