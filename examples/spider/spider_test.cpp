// The spider's gait as functions, its files, and walks on the ground.
#include <gtest/gtest.h>
#include <support/world_text.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <vector>

#include "app/worlds/spider_world.h"
#include "client/plugin.h"
#include "core/noise.h"
#include "gait_file.h"
#include "simulation/simulation.h"

namespace spider {
namespace {

TEST(SpiderLeg, ItsAnglesBringTheFootWhereItIsWanted) {
    std::uint64_t index = 0;
    const auto between = [&](double low, double high) {
        return low + (high - low) * roboss::random_uniform({1, 0, 0, 0}, index++);
    };
    for (int i = 0; i < 600; ++i) {
        const std::size_t leg = static_cast<std::size_t>(i) % kLegs;
        const std::array<double, kLegJoints> angles{between(-0.7, 0.7), between(-0.9, 0.5), between(-0.5, 1)};
        const Point wanted = foot_of_angles(leg, angles);
        const double out = std::hypot(wanted.x - kHips[leg].x, wanted.y - kHips[leg].y);
        if (out < kPartLengths[0] + 0.01) continue;  // below the trunk the coxa would turn round
        const auto found = leg_angles(leg, wanted);
        for (std::size_t j = 0; j < kLegJoints; ++j)
            EXPECT_NEAR(found[j], angles[j], 1e-9) << leg << ' ' << j;
    }
}

TEST(SpiderLeg, StandsAtZeroAndReachesNoFurtherThanItIsLong) {
    const Gait gait;
    for (std::size_t leg = 0; leg < kLegs; ++leg) {
        for (const double angle : leg_angles(leg, foot(gait, leg, 0.25, 0, 0))) EXPECT_NEAR(angle, 0, 1e-2);
        const Point there = foot_of_angles(leg, leg_angles(leg, {kHips[leg].x, kHips[leg].y * 20, -0.1}));
        const double length = kPartLengths[0] + kPartLengths[1] + kPartLengths[2];
        EXPECT_LT(std::hypot(there.x - kHips[leg].x, there.y - kHips[leg].y), length);
    }
}

TEST(SpiderGait, AFootStandsAtTheSpeedOfTheGroundAndReturnsThroughTheAir) {
    Gait gait;
    gait.duty = 0.6, gait.ease = 1;
    const double step = 1e-6, speed = gait.stride / gait.duty;  // m a cycle
    for (std::size_t leg = 0; leg < kLegs; ++leg) {
        for (double phase = 0.001; phase < 0.999; phase += 0.01) {
            const Point a = foot(gait, leg, phase, 1, 0), b = foot(gait, leg, phase + step, 1, 0);
            if (phase < gait.duty - step) {
                EXPECT_NEAR((b.x - a.x) / step, -speed, 1e-6);
                EXPECT_EQ(a.z, kFootRadius - gait.height);
            } else if (phase > gait.duty) {
                EXPECT_GT(a.z, kFootRadius - gait.height);
                EXPECT_LE(a.z, kFootRadius - gait.height + gait.lift + 1e-12);
            }
            EXPECT_NEAR(a.y, b.y, 1e-12);
        }
        // It lands and takes off with the ground: no jump of position or speed.
        for (const double seam : {gait.duty, 1.0}) {
            const auto at = [&](double phase) { return foot(gait, leg, phase - std::floor(phase), 1, 0); };
            const Point before = at(seam - step), here = at(seam), after = at(seam + step);
            EXPECT_NEAR((here.x - before.x) / step, (after.x - here.x) / step, 1e-4);
            EXPECT_NEAR((here.z - before.z) / step, (after.z - here.z) / step, 1e-4);
        }
    }
}

TEST(SpiderGait, FeetThatStandTurnAboutTheTrunkTogether) {
    Gait gait;
    gait.stride = 0;
    const double turn = 0.3;
    for (std::size_t leg = 0; leg < kLegs; ++leg) {
        const Point begin = foot(gait, leg, 0, 1, turn),
                    end = foot(gait, leg, gait.duty * (1 - 1e-12), 1, turn);
        EXPECT_NEAR(std::hypot(begin.x, begin.y), std::hypot(end.x, end.y), 1e-9);
        const double angle = std::atan2(begin.x * end.y - begin.y * end.x, begin.x * end.x + begin.y * end.y);
        EXPECT_NEAR(angle, -turn, 1e-9) << "to the right, so that the trunk turns to the left";
    }
}

TEST(SpiderFile, SaysWhatItIsAndWhatIsWrongWithIt) {
    const Gait gait =
        gait_of_text("# a comment\nstride = 0.1 # m\n\nphases = [0, 0.5, 0.5, 0, 0, 0.25]\n", "a.toml");
    EXPECT_EQ(gait.stride, 0.1);
    EXPECT_EQ(gait.phases[5], 0.25);
    EXPECT_EQ(gait.lift, Gait{}.lift);
    for (const char* bad :
         {"strid = 0.1", "stride 0.1", "stride = far", "stride = 5", "stride = nan", "duty = 0", "",
          "# nothing\n", "stride = 0.1\nstride = 0.2", "stride = \"0.1\"", "[gait]\nstride = 0.1",
          "phases = [0, 1]", "phases = [0, 0.5, 0.5, 0, 0, 1]", "stride = [0.1, 0.2]"}) {
        EXPECT_THROW((void)gait_of_text(bad, "b.toml"), std::runtime_error) << bad;
    }
    EXPECT_THROW((void)load_gait("no_such.toml"), std::runtime_error);
    for (const auto& file : std::filesystem::directory_iterator(ROBOSS_SPIDER_GAITS))
        EXPECT_GT(load_gait(file.path().string()).stride, 0) << file.path();
    const Gait walk = load_gait(ROBOSS_SPIDER_GAITS "/walk.toml");
    for (const GaitField& field : gait_fields())
        EXPECT_NEAR(walk.*field.member, Gait{}.*field.member, 1e-12)
            << field.name << ": walk.toml is the default";
}

std::shared_ptr<const roboss::Model> spiders_on_flat_ground(int spiders) {
    roboss::SpiderOptions options;
    options.spiders = spiders;
    return roboss::test::compiled_text(roboss::spider_sdf(options), "spiders.sdf");
}

/// A walk on the course; `from`: a saved run that it continues.
std::unique_ptr<roboss::Simulation> walk(const std::shared_ptr<const roboss::Model>& model,
                                         const char* course, double until_s, std::size_t simulators = 1,
                                         const roboss::SavedRun* from = nullptr) {
    ::setenv("ROBOSS_SPIDER_COURSE", course, 1);
    std::vector<roboss::NamedProgram> programs;
    programs.push_back({"spider", roboss::load_control_program(ROBOSS_SPIDER).value()});
    roboss::SimulationOptions options;
    options.simulators = simulators;
    auto simulation = roboss::Simulation::create(model, options, std::move(programs), from).value();
    EXPECT_TRUE(simulation->run_until(roboss::Tick(std::llround(until_s / model->dt_s))).ok());
    ::unsetenv("ROBOSS_SPIDER_COURSE");
    return simulation;
}

double heading_of(const roboss::RobotState& state) {
    const roboss::Vec3 ahead = roboss::rotate(base_pose(state).q, roboss::Vec3{1, 0, 0});
    return std::atan2(ahead.y, ahead.x);
}

TEST(Spider, WalksStraightAheadAsFastAsItsGaitSays) {
    const auto model = spiders_on_flat_ground(1);
    const auto simulation = walk(model, "", 2);
    const double begin = base_pose(simulation->states()[0]).p.x;
    ASSERT_TRUE(simulation->run_until(roboss::Tick(std::llround(5 / model->dt_s))).ok());
    const roboss::Pose X_WB = base_pose(simulation->states()[0]);
    const Gait gait;
    EXPECT_NEAR((X_WB.p.x - begin) / 3, gait.stride / gait.duty / gait.period_s, 0.03);
    EXPECT_NEAR(X_WB.p.y, 0, 0.01);
    EXPECT_NEAR(X_WB.p.z, gait.height, 0.006);
}

TEST(Spider, TurnsToTheHeadingsOfItsCourse) {
    const auto simulation = walk(spiders_on_flat_ground(1), "0 90, 4.5 20", 4.5);
    EXPECT_NEAR(heading_of(simulation->states()[0]), 1.571, 0.05);
    ASSERT_TRUE(simulation->run_until(4500).ok());
    EXPECT_NEAR(heading_of(simulation->states()[0]), 0.349, 0.05);
}

TEST(Spider, TheSameBitsOnOneAndFourSimulators) {
    const auto model = spiders_on_flat_ground(6);
    EXPECT_EQ(walk(model, "0 30", 0.8)->hash(), walk(model, "0 30", 0.8, 4)->hash());
}

TEST(Spider, ASavedWalkContinuesAsIfItHadNotBeenSaved) {
    const auto model = spiders_on_flat_ground(2);
    const auto whole = walk(model, "0.5 60", 1.6), first = walk(model, "0.5 60", 1.0);
    const roboss::SavedRun saved = first->saved_run();
    const auto second = walk(model, "0.5 60", 1.6, 1, &saved);
    EXPECT_EQ(second->hash(), whole->hash());
    EXPECT_EQ(second->tick(), whole->tick());
}

}  // namespace
}  // namespace spider
