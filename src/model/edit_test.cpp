// A Model made of Models is the one that a world with all of it compiles to; what stays keeps every bit.
#include "model/edit.h"

#include <gtest/gtest.h>

#include <support/meshes.h>
#include <support/robots.h>

namespace roboss::test {
namespace {

std::shared_ptr<const Model> made(const World& world) {
    Diagnostics diagnostics;
    auto model = compile(world, {}, diagnostics);
    EXPECT_FALSE(diagnostics.has_errors());
    return model;
}

World base_world() {
    World world = empty_world(1e-3);
    place(world, ground(surface(0.5)), "ground");
    place(world, car(), "car", {{0, 0, 0.1}, {}});
    place(world, arm(), "arm", {{3, 0, 0}, {}});
    place(world, solid_box(1, {0.2, 0.2, 0.2}, surface(0.5)), "box", {{0, 2, 0.1}, {}});
    return world;
}

World a_spider(const std::string& name, const Pose& X = {}) {
    World world = empty_world(1e-3);
    place(world, spider(), name, X);
    return world;
}

TEST(ModelEdit, AddingGivesTheModelOfTheWholeWorld) {
    const Pose X{{1, -2, 0.5}, from_rpy(0.1, 0.2, 0.3)};
    World whole = base_world();
    place(whole, spider(), "guest", X);
    const Result<ModelEdit> edit = with_models(*made(base_world()), *made(a_spider("spider")), X, "guest");
    ASSERT_TRUE(edit.ok()) << edit.error().text();
    const auto expected = made(whole);
    ASSERT_EQ(edit.value().model->robots.size(), expected->robots.size());
    EXPECT_EQ(edit.value().model->robots.back().name, "guest");
    EXPECT_EQ(edit.value().model->types.back().hash, expected->types.back().hash);
    EXPECT_EQ(initial_state(*edit.value().model, RobotId(3u)), initial_state(*expected, RobotId(3u)));
    EXPECT_EQ(edit.value().model->hash, expected->hash);
}

TEST(ModelEdit, EqualTypesAreSharedAndNamesAreUnique) {
    World box = empty_world(1e-3);
    place(box, solid_box(1, {0.2, 0.2, 0.2}, surface(0.5)), "box");
    const auto model = made(base_world());
    EXPECT_FALSE(with_models(*model, *made(box), {}, "").ok()) << "there is a box already";
    const Result<ModelEdit> edit = with_models(*model, *made(box), {{5, 5, 1}, {}}, "other");
    ASSERT_TRUE(edit.ok());
    EXPECT_EQ(edit.value().model->types.size(), model->types.size());
    EXPECT_EQ(edit.value().model->robots[3].type, edit.value().model->robots[2].type);
}

TEST(ModelEdit, ManyCopiesInOneEditAreThoseOfAsManyEdits) {
    const auto model = made(base_world()), spiders = made(a_spider("spider"));
    std::vector<CopyPlace> places;
    for (int i = 0; i < 5; ++i)
        places.push_back({"s" + std::to_string(i), {{1.0 * i, 9, 1}, from_rpy(0, 0, 0.3 * i)}});
    auto one_by_one = model;
    for (const CopyPlace& place : places)
        one_by_one = with_models(*one_by_one, *spiders, place.X_WA, place.name).value().model;
    const Result<ModelEdit> edit = with_models(*model, *spiders, places);
    ASSERT_TRUE(edit.ok()) << edit.error().text();
    EXPECT_EQ(edit.value().model->hash, one_by_one->hash);
    EXPECT_EQ(edit.value().now.size(), model->robots.size());
    const Result<ModelEdit> gone = without_robots(*edit.value().model, {"s*"});
    EXPECT_EQ(gone.value().model->hash, model->hash);
}

TEST(ModelEdit, ATakenNameRefusesAllCopies) {
    const auto model = made(base_world()), spiders = made(a_spider("spider"));
    const std::vector<CopyPlace> old{{"a", {}}, {"car", {}}}, twice{{"a", {}}, {"b", {}}, {"a", {}}};
    const Result<ModelEdit> taken = with_models(*model, *spiders, old);
    ASSERT_FALSE(taken.ok());
    EXPECT_EQ(taken.error().code, "name-taken");
    EXPECT_NE(taken.error().message.find("there is a robot 'car'"), std::string::npos);
    const Result<ModelEdit> same = with_models(*model, *spiders, twice);
    ASSERT_FALSE(same.ok());
    EXPECT_EQ(same.error().code, "name-taken");
    EXPECT_NE(same.error().message.find("two of the added robots are called 'a'"), std::string::npos);
}

TEST(ModelEdit, ACopyThatIsTurnedMovesTheWayItIsTurned) {
    World moving = a_spider("spider");
    moving.instances[0].links = {{moving.prototypes[0].links[0].name, std::nullopt, {1, 0, 0}, {0, 2, 0}}};
    const auto addition = made(moving);
    ASSERT_FALSE(addition->robots[0].start_v.empty());
    const Pose X{{0, 0, 5}, from_rpy(0, 0, 1.5707963267948966)};
    const auto model = with_models(*made(base_world()), *addition, X, "guest").value().model;
    const RobotState state = initial_state(*model, RobotId(3u)),
                     as_it_was = initial_state(*addition, RobotId(0u));
    EXPECT_NEAR(state.v[0], -as_it_was.v[1], 1e-12);
    EXPECT_NEAR(state.v[1], as_it_was.v[0], 1e-12);
    EXPECT_NEAR(state.v[4], as_it_was.v[3], 1e-12);
}

TEST(ModelEdit, RemovingKeepsTheOthersAndTheirOrder) {
    const auto model = made(base_world());
    const Result<ModelEdit> edit = without_robots(*model, {"arm"});
    ASSERT_TRUE(edit.ok());
    ASSERT_EQ(edit.value().model->robots.size(), 2u);
    EXPECT_EQ(edit.value().model->robots[1].name, "box");
    EXPECT_FALSE(edit.value().now[1].valid());
    std::vector<RobotState> states;
    for (std::size_t i = 0; i < 3; ++i) states.push_back(initial_state(*model, RobotId(i)));
    states[0].v[0] = 7;
    states[0].contacts = {
        {1, 0, 0, 0, 5, 5, {}}, {2, 0, 0, 0, 6, 6, {}}, {RobotId::kNone, 0, 0, 0, 7, 7, {}}};
    states[0].rest = {9, true, {2}, {}};
    states[2].rest = {9, true, {0, 1}, {}};
    const std::vector<RobotState> now = carry_over(edit.value(), states);
    ASSERT_EQ(now.size(), 2u);
    EXPECT_EQ(now[0].v, states[0].v);
    ASSERT_EQ(now[0].contacts.size(), 2u) << "that with the arm is forgotten";
    EXPECT_EQ(now[0].contacts[0].other_robot, 1u) << "the box is robot 1 now";
    EXPECT_EQ(now[0].contacts[1].other_robot, std::uint32_t{RobotId::kNone});
    EXPECT_EQ(now[0].rest.neighbours, std::vector<std::uint32_t>{1}) << "it did not sleep against the arm";
    EXPECT_FALSE(now[1].rest.asleep) << "the box did";
    Order for_box{1, {}, 1, RobotId(2u), SetVelocity{}}, for_arm{1, {}, 1, RobotId(1u), SetVelocity{}};
    EXPECT_TRUE(carry_over(edit.value(), for_box));
    EXPECT_EQ(for_box.robot, RobotId(1u));
    EXPECT_FALSE(carry_over(edit.value(), for_arm));
    EXPECT_FALSE(without_robots(*model, {"nobody"}).ok());
}

TEST(ModelEdit, ComingAndGoingLeavesTheModelAsItWas) {
    const auto model = made(base_world());
    const Result<ModelEdit> come = with_models(*model, *made(a_spider("spider")), {}, "guest");
    ASSERT_TRUE(come.ok());
    const Result<ModelEdit> gone = without_robots(*come.value().model, {"guest"});
    ASSERT_TRUE(gone.ok());
    ASSERT_EQ(gone.value().model->robots.size(), model->robots.size());
    for (std::size_t i = 0; i < model->robots.size(); ++i)
        EXPECT_EQ(gone.value().model->type_of(RobotId(i)).hash, model->type_of(RobotId(i)).hash);
    EXPECT_EQ(gone.value().model->types.size(), model->types.size()) << "nobody is a spider any more";
    EXPECT_EQ(gone.value().model->hash, model->hash);
}

TEST(ModelEdit, RemovingByTheBeginningOfANameRemovesAllOfThem) {
    World boxes = base_world();
    for (int i = 0; i < 3; ++i)
        place(boxes, solid_box(1, {0.2, 0.2, 0.2}, surface(0.5)), "crowd::" + std::to_string(i),
              {{1.0 * i, 5, 1}, {}});
    const auto model = made(boxes);
    const Result<ModelEdit> edit = without_robots(*model, {"crowd::*", "arm"});
    ASSERT_TRUE(edit.ok()) << edit.error().text();
    ASSERT_EQ(edit.value().model->robots.size(), 2u);
    EXPECT_EQ(edit.value().model->robots[1].name, "box");
    EXPECT_FALSE(without_robots(*model, {"nobody*"}).ok());
}

/// Hulls come with every addition; those of a type that is there already are not kept.
TEST(ModelEdit, ManyRoundsOfComingAndGoingLeaveNothingBehind) {
    World guests = empty_world(1e-3);
    ModelSpec gem = solid_box(1, {0.2, 0.2, 0.2}, surface(0.5));
    gem.name = "gem";
    gem.links[0].collisions = {mesh_shape(ball_mesh(0.1, 0), surface(0.5))};
    for (int i = 0; i < 20; ++i) place(guests, gem, "gem" + std::to_string(i), {{1.0 * i, 5, 1}, {}});
    const auto addition = made(guests);
    ASSERT_GT(addition->hulls.size(), 0u);
    const auto start = made(base_world());
    std::shared_ptr<const Model> model = start;
    for (int round = 0; round < 100; ++round) {
        const Result<ModelEdit> come = with_models(*model, *made(guests), {}, "guests");
        ASSERT_TRUE(come.ok()) << come.error().text();
        const Result<ModelEdit> more = with_models(*come.value().model, *made(guests), {}, "others");
        ASSERT_TRUE(more.ok()) << more.error().text();
        EXPECT_EQ(more.value().model->hulls.size(), addition->hulls.size());
        const Result<ModelEdit> gone = without_robots(*more.value().model, {"guests::*", "others::*"});
        ASSERT_TRUE(gone.ok()) << gone.error().text();
        model = gone.value().model;
        ASSERT_EQ(model->hash, start->hash);
        ASSERT_EQ(model->types.size(), start->types.size());
        ASSERT_EQ(model->hulls.size(), start->hulls.size());
    }
}

TEST(ModelEdit, ACopyIsARobotOfItsOwnWithTheJointPositionsThatItIsGiven) {
    const auto model = made(base_world());
    const RobotId arm = *model->find_robot("arm");
    std::vector<double> q(initial_state(*model, arm).q.size() - 7, 0.25);
    const Pose X{{7, 8, 0.5}, from_rpy(0, 0, 1)};
    const std::vector<RobotFrom> copies{{model, arm, "arm_2", X, q}, {model, arm, "arm_3", {}, {}}};
    const Result<ModelEdit> edit = with_robots(*model, copies);
    ASSERT_TRUE(edit.ok()) << edit.error().text();
    const Model& now = *edit.value().model;
    ASSERT_EQ(now.robots.size(), model->robots.size() + 2);
    EXPECT_EQ(now.types.size(), model->types.size());
    const RobotState state = initial_state(now, *now.find_robot("arm_2"));
    EXPECT_EQ(std::vector<double>(state.q.begin() + 7, state.q.end()), q);
    EXPECT_EQ(base_pose(state).p, X.p);
    EXPECT_EQ(base_pose(initial_state(now, *now.find_robot("arm_3"))).p, Vec3{});
    EXPECT_NE(now.robots.back().family, model->robots[arm.index()].family) << "copies collide";
    EXPECT_FALSE(edit.value().scenery_changed);
    const Result<ModelEdit> gone = without_robots(now, {"arm_2", "arm_3"});
    ASSERT_TRUE(gone.ok());
    EXPECT_EQ(gone.value().model->hash, model->hash);
}

TEST(ModelEdit, ARobotThatReturnsIsTheOneThatLeft) {
    World world = empty_world(1e-3);
    place(world, car(), "car", {{0, 0, 0.1}, {}});
    ModelSpec gem = solid_box(1, {0.2, 0.2, 0.2}, surface(0.5));
    gem.links[0].collisions = {mesh_shape(ball_mesh(0.1, 0), surface(0.5))};
    place(world, gem, "gem", {{3, 0, 1}, {}});  // the last one: it is back where it was
    const auto model = made(world);
    const Result<ModelEdit> gone = without_robots(*model, {"gem"});
    ASSERT_TRUE(gone.ok());
    const RobotId gem_id = *model->find_robot("gem");
    const Robot& robot = model->robots[gem_id.index()];
    const std::vector<RobotFrom> back{{model, gem_id, robot.name, robot.X_WR, robot.start_q, true}};
    const Result<ModelEdit> again = with_robots(*gone.value().model, back);
    ASSERT_TRUE(again.ok()) << again.error().text();
    EXPECT_EQ(again.value().model->hash, model->hash);
    EXPECT_EQ(again.value().model->hulls.size(), model->hulls.size());
    const Result<ModelEdit> twice = with_robots(*again.value().model, back);
    ASSERT_FALSE(twice.ok());
    EXPECT_EQ(twice.error().code, "name-taken");
}

TEST(ModelEdit, AccuracyIsSetWithinItsBounds) {
    const auto model = made(base_world());
    AccuracySpec finer;
    finer.numbers.push_back({"tolerance", 1e-11});
    const Result<ModelEdit> edit = with_accuracy(*model, finer);
    ASSERT_TRUE(edit.ok());
    EXPECT_EQ(edit.value().model->accuracy.tolerance, 1e-11);
    EXPECT_NE(edit.value().model->hash, model->hash);
    finer.numbers.push_back({"tolerance", 7});
    EXPECT_FALSE(with_accuracy(*model, finer).ok());
    finer.numbers = {{"no_such_number", 1}};
    EXPECT_FALSE(with_accuracy(*model, finer).ok());
}

}  // namespace
}  // namespace roboss::test
