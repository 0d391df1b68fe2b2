// Runs whose sanity is known.
#include "corpus/sanity.h"

#include <gtest/gtest.h>

#include <support/bodies.h>
#include "onboard_kinds/onboard_spec.h"

namespace roboss::corpus {
namespace {

std::shared_ptr<const Model> compiled(const World& world, bool sleep = true) {
    Diagnostics diagnostics;
    return compile(world, {.sleep = sleep}, diagnostics);
}

Sanity judged(const World& world, double seconds) {
    return judge(*compiled(world), *compiled(world, false), seconds);
}

World box_world(const Pose& X) {
    World world = test::empty_world(2e-3);
    test::place(world, test::ground(test::surface(0.7, 0.5)), "ground");
    test::place(world, test::solid_box(2, {0.4, 0.3, 0.2}, test::surface(0.7, 0.5)), "box", X);
    return world;
}

TEST(Sanity, AFallThatBouncesAndAPushOutOfTheGroundAreSane) {
    for (const double z : {1.0, 0.05, -0.3}) {
        const Sanity sanity = judged(box_world({{0, 0, z}, from_rpy(0.3, 0.2, 0)}), 2);
        EXPECT_TRUE(sanity.is_sane()) << z << ": " << sanity.groups.front().gain;
    }
}

TEST(Sanity, AMotorsWorkExplainsWhatItLifts) {
    World world = test::empty_world(2e-3);
    ModelSpec arm;
    arm.name = "arm", arm.canonical_link = "base";
    arm.links = {test::link("base", 1, test::box_inertia(1, {0.1, 0.1, 0.1})),
                 test::link("rod", 1, test::box_inertia(1, {1, 0.1, 0.1}), {{0.5, 0, 0}, {}})};
    arm.joints = {test::joint(JointSpecKind::kFixed, "weld", "world", "base", {}),
                  test::joint(JointSpecKind::kRevolute, "hinge", "base", "rod", {}, {0, -1, 0})};
    JointPositionControllerSpec servo;
    servo.joints = {"hinge"}, servo.pid.p = 60, servo.pid.d = 5, servo.initial_position = 1.5;
    arm.onboard.push_back({"servo", servo, {}});
    test::place(world, arm, "arm");
    const Sanity sanity = judged(world, 2);
    EXPECT_TRUE(sanity.is_sane()) << sanity.groups.front().gain;
    EXPECT_GT(sanity.groups.front().speed, 0.3);
}

TEST(Sanity, EnergyThatNothingExplainsIsInsane) {
    Figures figures;
    figures.gain = 2, figures.explained = 1.9;
    EXPECT_TRUE(figures.is_sane());
    figures.gain = 2.2;
    EXPECT_FALSE(figures.is_sane());
    figures.driven = true;
    EXPECT_TRUE(figures.is_sane());
}

TEST(Sanity, ASleeperThatWouldMoveIsInsane) {
    // Stepped with sleep the box lies still on the ground; the other world has no ground.
    const World world = box_world({{0, 0, 0.1}, {}});
    World without = world;
    without.instances.erase(without.instances.begin());
    without.sleep = false;
    const Sanity sanity = judge(*compiled(world), *compiled(without, false), 2);
    ASSERT_EQ(sanity.asleep, 1u);
    EXPECT_FALSE(sanity.is_sane());
    EXPECT_GT(sanity.groups.front().sleeper_moves, 4);
}

}  // namespace
}  // namespace roboss::corpus
