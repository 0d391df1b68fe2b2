// LocalRun and RobotSet: exact save and restore, resets, orders, errors that leave the world intact, arrays.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include <support/bodies.h>
#include <support/robots.h>
#include <support/simulation.h>

#include "local/local_batch.h"
#include "local/robot_set.h"

namespace roboss {
namespace {

/// `cars` in a row, so near that they touch when they turn.
std::shared_ptr<const Model> crowd(int cars) {
    World world;
    world.name = "crowd";
    world.dt_s = 0.002;
    world.prototypes.push_back(test::scenery(test::collision(GeometryKind::kPlane, test::surface(0.9))));
    world.prototypes.push_back(test::car());
    world.instances.push_back({"ground", 0, {}, {}});
    for (int i = 0; i < cars; ++i)
        world.instances.push_back(
            {"car_" + std::to_string(i), 1, {{0.6 * (i % 8), 0.6 * (i / 8), 0}, {}}, {}});
    return test::compiled(world);
}

std::unique_ptr<LocalRun> run_of(const std::shared_ptr<const Model>& model, unsigned threads = 1) {
    Result<std::unique_ptr<LocalRun>> made = LocalRun::create(model, {.threads = threads});
    return std::move(made).value();
}

RobotSet all_of(const std::shared_ptr<const Model>& model) {
    std::vector<RobotId> robots;
    for (std::size_t r = 0; r < model->robots.size(); ++r) robots.emplace_back(r);
    return {model, robots};
}

/// Drives each car in a direction of its own, so that they run into each other.
void drive(LocalRun& run, const RobotSet& cars) {
    std::vector<double> targets;
    for (std::size_t i = 0; i < cars.size(); ++i)
        for (std::size_t k = 0; k < 4; ++k)
            targets.push_back(static_cast<double>((i * 7 + (k % 2) * 3) % 11) * 4 - 20);
    const std::vector<std::size_t> columns{0, 1, 2, 3};
    EXPECT_TRUE(cars.set_joints(run, columns, MotorMode::kVelocity, targets).ok());
}

TEST(LocalRun, ContinuesInAnEditedWorldWithEveryBit) {
    const auto model = crowd(6);
    const auto run = run_of(model);
    drive(*run, all_of(model));
    ASSERT_TRUE(run->step(100).ok());
    ASSERT_TRUE(run->order(RobotId(5u), SetJoint{JointId(0u), 0, MotorMode::kVelocity, -3}).ok());
    const Result<ModelEdit> edit = without_robots(*model, {"car_2"});
    ASSERT_TRUE(edit.ok());
    Result<std::unique_ptr<LocalRun>> edited = run->edited(edit.value());
    ASSERT_TRUE(edited.ok());
    LocalRun& less = *edited.value();
    EXPECT_EQ(less.tick(), 100);
    ASSERT_EQ(less.states().size(), 5u);
    EXPECT_EQ(less.state(RobotId(1u)), run->state(RobotId(1u)));
    EXPECT_EQ(less.state(RobotId(2u)).q, run->state(RobotId(3u)).q);
    ASSERT_EQ(less.save().orders.size(), 1u);
    EXPECT_EQ(less.save().orders[0].robot, RobotId(4u));
    ASSERT_TRUE(less.step(1).ok());
    EXPECT_EQ(less.state(RobotId(4u)).motors[0].target, -3);
    EXPECT_EQ(run->states().size(), 6u) << "the old run stays as it is";
}

TEST(LocalRun, GivesTheSameBitsOnThreadsWhereRobotsCollide) {
    const auto model = crowd(40);
    const RobotSet cars = all_of(model);
    std::vector<std::uint64_t> hashes;
    for (const unsigned threads : {1U, 2U, 5U}) {
        const auto run = run_of(model, threads);
        drive(*run, cars);
        ASSERT_TRUE(run->step(600).ok());
        hashes.push_back(run->hash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(LocalRun, StepsAgainWhatAForecastHadParted) {
    const auto model = crowd(40);
    WorldStepper one(model, 1, kMostLanes), three(model, 3, kMostLanes);
    std::vector<RobotState> a, b;
    for (std::size_t r = 0; r < model->robots.size(); ++r) a.push_back(initial_state(*model, RobotId(r)));
    std::vector<Order> orders;  // cars that shoot through the crowd, which no forecast knows
    for (std::uint32_t i = 0; i < 8; ++i)
        orders.push_back(
            {20, ClientId(0U), i, RobotId(i * 5), ApplyWrench{LinkId(0U), {2000, 1000, 0}, {}, 50}});
    b = a;
    one.step(0, 200, orders, a);
    three.step(0, 200, orders, b);
    EXPECT_EQ(a, b);
    EXPECT_GT(three.repeats(), 0U);
}

TEST(LocalRun, ContinuesExactlyFromASaveWithOrdersThatWait) {
    const auto model = crowd(8);
    const RobotSet cars = all_of(model);
    const auto run = run_of(model);
    ASSERT_TRUE(run->step(50).ok());
    drive(*run, cars);
    const LocalSave save = run->save();
    ASSERT_TRUE(run->step(100).ok());
    const std::uint64_t first = run->hash();
    ASSERT_TRUE(run->restore(save).ok());
    EXPECT_EQ(run->tick(), 50);
    ASSERT_TRUE(run->step(100).ok());
    EXPECT_EQ(run->hash(), first);
    const auto other = run_of(model, 2);
    ASSERT_TRUE(other->restore(save).ok());
    ASSERT_TRUE(other->step(100).ok());
    EXPECT_EQ(other->hash(), first);
}

TEST(LocalRun, RefusesASaveOfAnotherWorld) {
    const auto run = run_of(crowd(2));
    const Result<> restored = run->restore(run_of(crowd(3))->save());
    ASSERT_FALSE(restored.ok());
    EXPECT_EQ(restored.error().code, "other-world");
}

TEST(LocalRun, IsNewAfterAReset) {
    const auto model = crowd(4);
    const auto run = run_of(model);
    const std::uint64_t start = run->hash();
    drive(*run, all_of(model));
    ASSERT_TRUE(run->step(70).ok());
    drive(*run, all_of(model));
    EXPECT_NE(run->hash(), start);
    run->reset(5);
    EXPECT_EQ(run->hash(), start);
    EXPECT_EQ(run->seed(), 5U);
    ASSERT_TRUE(run->step(70).ok());
    const auto fresh = run_of(model);
    ASSERT_TRUE(fresh->step(70).ok());
    EXPECT_EQ(run->hash(), fresh->hash());  // no order is left
}

TEST(LocalRun, StaysAtTheTickBeforeAStateThatIsNotFinite) {
    const auto model = crowd(6);
    std::vector<Tick> ticks;
    for (const unsigned threads : {1U, 3U}) {
        const auto run = run_of(model, threads);
        ASSERT_TRUE(run->step(40).ok());
        LocalSave save = run->save();
        save.states[3].v[0] = 1e150;  // rad/s: its square is in the gyroscopic torque, and grows
        ASSERT_TRUE(run->restore(save).ok());
        const Result<> stepped = run->step(100);
        ASSERT_FALSE(stepped.ok());
        EXPECT_EQ(stepped.error().code, "not-finite");
        for (const RobotState& state : run->states())
            for (const double v : state.v) EXPECT_TRUE(std::isfinite(v));
        const std::uint64_t hash = run->hash();
        EXPECT_FALSE(run->step(1).ok());
        EXPECT_EQ(run->hash(), hash);
        ticks.push_back(run->tick());
    }
    EXPECT_EQ(ticks[0], ticks[1]);
}

TEST(LocalRun, RefusesOrdersThatAreLateOrWrong) {
    const auto run = run_of(crowd(2));
    ASSERT_TRUE(run->step(10).ok());
    EXPECT_EQ(run->submit({9, ClientId(0U), 0, RobotId(0U), SetVelocity{}}).error().code, "late");
    EXPECT_EQ(run->order(RobotId(2U), SetVelocity{}).error().code, "no-robot");
    EXPECT_FALSE(run->order(RobotId(0U), SetJoint{JointId(9U), 0, MotorMode::kVelocity, 1}).ok());
    EXPECT_EQ(run->step(-1).error().code, "bad-ticks");
}

TEST(LocalRun, TellsOfContactsAtItsTick) {
    const auto run = run_of(crowd(1));
    ASSERT_TRUE(run->step(200).ok());
    double impulse = 0;
    for (const ContactReport& contact : run->contacts()) impulse += contact.impulse;
    EXPECT_NEAR(impulse, 6.2 * 9.8 * run->model().dt_s, 1e-3);  // the car's weight over a tick
}

TEST(LocalRun, ChangesAtOnceWhatAnOrderChangesAtTheNextTick) {
    const auto model = crowd(12);
    const Pose over{{0.6, 0, 0.4}, normalized(Quat{1, 0, 0.2, 0.1})};  // above another car
    for (const unsigned threads : {1U, 3U}) {
        const auto now = run_of(model, threads), later = run_of(model, threads);
        for (LocalRun* run : {now.get(), later.get()}) {
            drive(*run, all_of(model));
            ASSERT_TRUE(run->step(30).ok());
        }
        for (const Action& action : {Action{SetPose{over}}, Action{SetVelocity{{0, 1, -2}, {3, 0, 0}}}}) {
            ASSERT_TRUE(now->change(RobotId(5U), action).ok());
            ASSERT_TRUE(later->order(RobotId(5U), action).ok());
        }
        EXPECT_NE(now->hash(), later->hash());
        ASSERT_TRUE(now->step(40).ok());
        ASSERT_TRUE(later->step(40).ok());
        EXPECT_EQ(now->hash(), later->hash()) << threads;
    }
}

TEST(LocalRun, HasAnotherVersionAfterEachChangeOfStates) {
    const auto model = crowd(2);
    const auto run = run_of(model);
    std::uint64_t last = run->version();
    const auto is_new = [&] { return std::exchange(last, run->version()) != last; };
    EXPECT_TRUE(run->step(1).ok());
    EXPECT_TRUE(is_new());
    const LocalSave save = run->save();
    (void)run->hash();
    (void)run->contacts();
    EXPECT_TRUE(run->order(RobotId(0u), SetVelocity{{1, 0, 0}, {}}).ok());
    EXPECT_FALSE(is_new());
    EXPECT_TRUE(run->change(RobotId(0u), SetVelocity{{1, 0, 0}, {}}).ok());
    EXPECT_TRUE(is_new());
    EXPECT_TRUE(run->change(RobotId(0u), SetJointState{JointId(0u), {1.0}, {}}).ok());
    EXPECT_TRUE(is_new());
    EXPECT_TRUE(run->restore(save).ok());
    EXPECT_TRUE(is_new());
    run->reset();
    EXPECT_TRUE(is_new());
}

TEST(LocalRun, RefusesJointsThatCannotBeSet) {
    const auto run = run_of(crowd(1));
    const RobotId car(0U);
    const JointId wheel(0U);
    const auto code = [&](RobotId robot, SetJointState state) {
        return run->change(robot, state).error().code;
    };
    EXPECT_EQ(code(RobotId(1U), {wheel, {1.0}, {}}), "no-robot");
    EXPECT_EQ(code(car, {JointId(9U), {1.0}, {}}), "no-joint");
    EXPECT_EQ(code(car, {wheel, {1.0, 2.0}, {}}), "bad-values");
    EXPECT_EQ(code(car, {wheel, {1.0}, {1.0, 2.0, 3.0}}), "bad-values");
    EXPECT_EQ(code(car, {wheel, {}, {}}), "bad-values");
    EXPECT_EQ(code(car, {wheel, {1e10}, {}}), "beyond-limit");
    EXPECT_EQ(code(car, {wheel, {}, {-1e6}}), "beyond-limit");
    EXPECT_EQ(code(car, {wheel, {NAN}, {}}), "not-finite");
    EXPECT_EQ(code(car, {wheel, {}, {NAN}}), "not-finite");
}

TEST(LocalBatch, EachRunGoesItsOwnWayWithTheBitsOfARunAlone) {
    const auto model = crowd(6);
    const RobotSet cars = all_of(model);
    const std::unique_ptr<LocalBatch> batch =
        LocalBatch::create(model, 5, {.threads = 3, .seed = 10}).value();
    const auto push = [&](LocalRun& run, std::size_t i) {
        EXPECT_TRUE(run.order(RobotId(i), ApplyWrench{LinkId(0U), {100, 0, 50}, {}, 20}).ok());
    };
    for (std::size_t i = 0; i < 5; ++i) push(batch->run(i), i);
    LocalSave save = batch->run(2).save();
    save.states[0].v[0] = 1e150;  // this run ends at once
    ASSERT_TRUE(batch->run(2).restore(save).ok());
    const std::vector<Result<>> results = batch->step(150);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(batch->run(i).seed(), 10 + i);
        EXPECT_EQ(results[i].ok(), i != 2);
        if (i == 2) continue;
        const auto alone = run_of(model);
        push(*alone, i);
        ASSERT_TRUE(alone->step(150).ok());
        EXPECT_EQ(batch->run(i).hash(), alone->hash());
    }
    EXPECT_LT(batch->run(2).tick(), 150);
}

TEST(LocalBatch, RunsOfDifferentWorldsHaveTheBitsOfRunsAlone) {
    const std::vector<std::shared_ptr<const Model>> models{crowd(6), crowd(2), crowd(3)};
    const std::unique_ptr<LocalBatch> batch = LocalBatch::create(models, {.threads = 2, .seed = 4}).value();
    ASSERT_EQ(batch->size(), 3U);
    for (const Result<>& result : batch->step(100)) EXPECT_TRUE(result.ok());
    for (std::size_t i = 0; i < models.size(); ++i) {
        const auto alone = run_of(models[i]);
        ASSERT_TRUE(alone->step(100).ok());
        EXPECT_EQ(batch->run(i).seed(), 4 + i);
        EXPECT_EQ(batch->run(i).hash(), alone->hash());
    }
}

TEST(RobotSet, SetsJointsAtOnceAndForAllRobotsOrNone) {
    const auto model = crowd(2);
    const auto run = run_of(model);
    const RobotSet cars = all_of(model);
    const std::vector<double> angles{1, 2, 3, 4, 5, 6, 7, 8};
    std::vector<double> now(8);
    ASSERT_TRUE(cars.set_joint_positions(*run, angles).ok());
    cars.joint_positions(*run, now);
    EXPECT_EQ(now, angles);
    ASSERT_TRUE(cars.set_joint_velocities(*run, angles).ok());
    cars.joint_velocities(*run, now);
    EXPECT_EQ(now, angles);
    std::vector<double> bad(8, 0.5);
    bad[7] = NAN;
    EXPECT_EQ(cars.set_joint_positions(*run, bad).error().code, "not-finite");
    cars.joint_positions(*run, now);
    EXPECT_EQ(now, angles);
    bad.assign(14, 0.25);
    bad[13] = 0, bad[12] = bad[11] = bad[10] = 0;  // no rotation
    const std::uint64_t hash = run->hash();
    EXPECT_EQ(cars.set_poses(*run, bad).error().code, "not-finite");
    EXPECT_EQ(run->hash(), hash);
}

TEST(RobotSet, GivesPosesAndTwistsOfLinks) {
    const auto model = crowd(2);
    const auto run = run_of(model);
    const RobotSet cars = all_of(model);
    const std::size_t wheel = 1;
    std::vector<double> poses(14), link(14), twists(12);
    cars.poses(*run, poses);
    cars.link_poses(*run, wheel, link);
    EXPECT_NEAR(link[7] - link[0], 0.6, 1e-12);  // the cars' distance
    EXPECT_NE(link[1], poses[1]);
    ASSERT_TRUE(cars.set_twists(*run, std::vector<double>{1, 2, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0}).ok());
    cars.link_twists(*run, wheel, twists);
    EXPECT_NEAR(twists[2], 3, 1e-12);
}

TEST(RobotSet, GivesTheEnergyOfAFallAndTheEffortsOfMotors) {
    const auto model = crowd(2);
    const auto run = run_of(model);
    const RobotSet cars = all_of(model);
    std::vector<double> poses(14), before(4), after(4), efforts(8);
    cars.poses(*run, poses);
    poses[2] += 5, poses[9] += 5;
    ASSERT_TRUE(cars.set_poses(*run, poses).ok());
    ASSERT_TRUE(cars.set_twists(*run, std::vector<double>{0, -1, 1, 0.5, 0, 2, 0, 0, 0, 0, 0, 0}).ok());
    cars.energies(*run, before);
    ASSERT_TRUE(run->step(200).ok());
    cars.energies(*run, after);
    EXPECT_GT(after[0], before[0] + 1);  // it falls
    EXPECT_NEAR(after[0] + after[1], before[0] + before[1], 1e-6 * before[1]);
    EXPECT_EQ(before[2], 0);  // the other one was at rest
    const std::vector<std::size_t> wheel{1};
    ASSERT_TRUE(cars.set_joints(*run, wheel, MotorMode::kEffort, std::vector<double>{0.02, -0.01}).ok());
    ASSERT_TRUE(run->step(1).ok());
    cars.joint_efforts(*run, efforts);
    EXPECT_NEAR(efforts[1], 0.02, 1e-12);
    EXPECT_NEAR(efforts[5], -0.01, 1e-12);
    EXPECT_EQ(efforts[0], 0);
}

TEST(RobotSet, TellsWhoTouchesMoreThanTheGround) {
    const auto model = crowd(3);
    const auto run = run_of(model);
    const RobotSet cars = all_of(model);
    std::array<bool, 3> touching{true, true, true};
    ASSERT_TRUE(run->step(200).ok());  // they stand
    ASSERT_FALSE(run->contacts().empty());
    cars.touching(*run, touching);
    EXPECT_EQ(touching, (std::array<bool, 3>{}));
    std::vector<double> poses(21);
    cars.poses(*run, poses);
    poses[14] = poses[0] - 0.6, poses[15] = poses[1];  // the last one drives at the first from behind
    ASSERT_TRUE(cars.set_poses(*run, poses).ok());
    std::vector<double> twists(18);
    twists[12] = 3;
    ASSERT_TRUE(cars.set_twists(*run, twists).ok());
    for (int tick = 0; tick < 100 && !touching[0]; ++tick) {
        ASSERT_TRUE(run->step(1).ok());
        cars.touching(*run, touching);
    }
    EXPECT_EQ(touching, (std::array<bool, 3>{true, false, true}));
}

TEST(RobotSet, GivesPosesTwistsAndJointsAndTakesThem) {
    const auto model = crowd(3);
    const auto run = run_of(model);
    const RobotSet cars(model, {RobotId(2U), RobotId(0U)});
    ASSERT_EQ(cars.axes().size(), 4U);
    EXPECT_EQ(cars.axes()[1].name, "wheel_1");
    const std::vector<double> poses{1, 2, 0.5, 0, 0, 1, 0,
                                    4, 5, 0.5, 0, 0, 0, 2};  // x y z, x y z w; the last twice too long
    const std::vector<double> twists{1, 0, 0, 0, 0, 3, 0, 2, 0, 0, 0, 0};
    ASSERT_TRUE(cars.set_poses(*run, poses).ok());
    ASSERT_TRUE(cars.set_twists(*run, twists).ok());
    ASSERT_TRUE(run->step(1).ok());
    std::vector<double> now(14), speed(12), joints(8);
    cars.poses(*run, now);
    cars.twists(*run, speed);
    cars.joint_velocities(*run, joints);
    EXPECT_NEAR(now[0], 1.002, 1e-6);
    EXPECT_NEAR(now[5], 1, 1e-4);
    EXPECT_NEAR(now[8], 5.004, 1e-6);
    EXPECT_NEAR(now[13], 1, 1e-12);
    EXPECT_NEAR(speed[0], 1, 1e-9);
    EXPECT_NEAR(speed[5], 3, 1e-2);
    EXPECT_NEAR(speed[2], -9.8 * model->dt_s, 1e-6);
    EXPECT_NEAR(run->state(RobotId(0U)).q[0], 4, 1e-9);
}

}  // namespace
}  // namespace roboss
