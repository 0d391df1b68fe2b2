// Pages read numbers of joints and links in this form: those of the robot, and those of its file where they
// differ.
#include "gateway/numbers_json.h"

#include <gtest/gtest.h>
#include <support/robots.h>
#include <support/simulation.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "gateway/inspector.h"
#include "model/order.h"
#include "wire/state_block.h"

namespace roboss {
namespace {

using Json = nlohmann::json;

const RobotId kCar(0u), kChain(1u);
const JointId kAxle(0u);
const LinkId kWheel(1u);

class NumbersJsonTest : public testing::Test {
  protected:
    NumbersJsonTest() {
        World world;
        world.prototypes = {test::car(), test::ball_chain()};
        world.instances.push_back({"car", 0, {{0, 0, 0}, {}}, {}});
        world.instances.push_back({"chain", 1, {{5, 0, 3}, {}}, {}});
        model = test::compiled(world);
        states = {initial_state(*model, kCar), initial_state(*model, kChain)};
        inspector.begin(
            std::make_shared<const ShownScene>(ShownScene{9, model, SceneFile{}, ViewLayout(*model)}));
    }
    /// The robots as they are now, to the inspector.
    void look() {
        StateBlock block;
        block.tick = ++tick;
        for (const RobotId robot : {kCar, kChain}) append(block, robot, states[robot.index()]);
        inspector.take(block);
        ASSERT_TRUE(inspector.shows(kCar));
        ASSERT_TRUE(inspector.shows(kChain));
    }
    Json numbers(const NumbersWish& wish) {
        look();
        const std::string text = inspector.numbers(wish);
        return text.empty() ? Json() : Json::parse(text);
    }
    Json robot(RobotId robot) {
        look();
        return Json::parse(inspector.robot(robot));
    }
    void give(const Action& action) {
        const Order order{0, ClientId(0u), 0, kCar, action};
        const Result<> checked = check_order(*model, order);
        ASSERT_TRUE(checked.ok()) << checked.error().text();
        apply_order(*model, order, states[0]);
    }
    /// The row of a number; null: there is none.
    static Json row(const Json& told, const std::string& name) {
        for (const Json& one : told["numbers"])
            if (one["name"] == name) return one;
        return {};
    }

    std::shared_ptr<const Model> model;
    std::vector<RobotState> states;
    Inspector inspector;
    Tick tick = 40;
};

TEST_F(NumbersJsonTest, ThoseOfAnAxisAreOfTheFileUntilAnOrderChangesThem) {
    const NumbersWish axle{kCar, kAxle, 0, {}};
    const Json before = numbers(axle);
    EXPECT_EQ(before["type"], "numbers");
    EXPECT_EQ(before["scene"], 9);
    EXPECT_EQ(before["robot"], 0);
    EXPECT_EQ(before["tick"], tick);
    EXPECT_EQ(before["joint"], 0);
    EXPECT_EQ(before["axis"], 0);
    EXPECT_FALSE(before.contains("link"));
    EXPECT_EQ(before["numbers"].size(), kJointParameters);
    EXPECT_EQ(row(before, "damping"), Json({{"name", "damping"}, {"unit", "N m s/rad"}, {"value", 0}}));
    EXPECT_EQ(row(before, "max_effort"),
              Json({{"name", "max_effort"}, {"unit", "N m"}, {"value", 2}, {"endless", true}}));
    EXPECT_TRUE(row(before, "lower")["value"].is_null()) << "a wheel turns without end";
    EXPECT_FALSE(robot(kCar).contains("own"));

    const double infinity = std::numeric_limits<double>::infinity();
    give(SetJointParameters{
        kAxle, 0, false, {{JointParameter::kDamping, 0.4}, {JointParameter::kMaxEffort, infinity}}});
    const Json after = numbers(axle);
    EXPECT_EQ(row(after, "damping")["value"], 0.4);
    EXPECT_EQ(row(after, "damping")["file"], 0);
    EXPECT_TRUE(row(after, "max_effort")["value"].is_null());
    EXPECT_EQ(row(after, "max_effort")["file"], 2);
    EXPECT_FALSE(row(after, "friction").contains("file"));
    EXPECT_FALSE(row(numbers({kCar, JointId(1u), 0, {}}), "damping").contains("file")) << "another wheel";
}

TEST_F(NumbersJsonTest, ThoseOfALinkAreThoseThatItHasAndItsInertiaGrowsWithItsMass) {
    const NumbersWish wheel{kCar, {}, 0, kWheel};
    const Json before = numbers(wheel);
    EXPECT_EQ(before["link"], 1);
    EXPECT_FALSE(before.contains("joint"));
    EXPECT_EQ(row(before, "mass"), Json({{"name", "mass"}, {"unit", "kg"}, {"value", 0.3}}));
    EXPECT_EQ(row(before, "friction"), Json({{"name", "friction"}, {"unit", ""}, {"value", 0.9}}));
    EXPECT_TRUE(row(before, "friction_across").is_null()) << "its friction is the same in all directions";

    give(SetLinkParameters{kWheel, false, {{LinkParameter::kMass, 0.75}, {LinkParameter::kCentreX, 0.01}}});
    const Json after = numbers(wheel);
    EXPECT_EQ(row(after, "mass")["value"], 0.75);
    EXPECT_EQ(row(after, "mass")["file"], 0.3);
    EXPECT_EQ(row(after, "centre_x")["value"], 0.01) << "as it was given";
    for (const char* name : {"centre_y", "centre_z", "friction", "restitution"})
        EXPECT_EQ(row(after, name), row(before, name)) << "as it was";
    const double of_file = row(before, "inertia_zz")["value"];
    EXPECT_NEAR(row(after, "inertia_zz")["value"], 2.5 * of_file, 1e-12);
    EXPECT_EQ(row(after, "inertia_zz")["file"], of_file);
}

TEST_F(NumbersJsonTest, ReportsOfARobotListWhatDiffersAndNothingElse) {
    const double infinity = std::numeric_limits<double>::infinity();
    give(SetJointParameters{
        JointId(2u), 0, false, {{JointParameter::kMaxEffort, infinity}, {JointParameter::kFriction, 0.5}}});
    give(SetJointParameters{kAxle, 0, false, {{JointParameter::kDamping, 0.4}}});
    give(SetLinkParameters{kWheel, false, {{LinkParameter::kMass, 0.75}}});
    EXPECT_EQ(robot(kCar)["own"], Json::parse(R"({
        "joints": [{"joint": 0, "axis": 0, "values": {"damping": 0.4}},
                   {"joint": 2, "axis": 0, "values": {"max_effort": null, "friction": 0.5}}],
        "links": [{"link": 1, "values": {"mass": 0.75}}]})"));
    EXPECT_FALSE(robot(kChain).contains("own")) << "another robot";
    give(SetJointParameters{kAxle, 0, true, {}});
    give(SetJointParameters{JointId(2u), 0, true, {}});
    EXPECT_EQ(robot(kCar)["own"], Json::parse(R"({"links": [{"link": 1, "values": {"mass": 0.75}}]})"));
    give(SetLinkParameters{kWheel, true, {}});
    EXPECT_FALSE(robot(kCar).contains("own"));
}

TEST_F(NumbersJsonTest, ABallHasNoNumbersAlongAnAxis) {
    const Json told = numbers({kChain, kAxle, 2, {}});
    EXPECT_EQ(told["axis"], 2);
    EXPECT_EQ(row(told, "damping")["unit"], "N m s/rad");
    for (const char* name : {"lower", "upper", "spring_stiffness", "position_gain", "limit_stiffness"})
        EXPECT_TRUE(row(told, name).is_null()) << name;
}

TEST_F(NumbersJsonTest, OfWhatTheRobotLacksNothingIsTold) {
    EXPECT_TRUE(numbers({kCar, JointId(99u), 0, {}}).is_null());
    EXPECT_TRUE(numbers({kCar, kAxle, 1, {}}).is_null());
    EXPECT_TRUE(numbers({kCar, {}, 0, {}}).is_null());
    EXPECT_TRUE(numbers({kCar, {}, 0, LinkId(99u)}).is_null());
}

TEST_F(NumbersJsonTest, OwnGravityAndWindStandBesideThoseOfJointsAndLinks) {
    give(SetSurroundings{false, {Vec3{0, 0, -1.62}, std::nullopt}});
    EXPECT_EQ(robot(kCar)["own"], Json({{"gravity", {0, 0, -1.62}}}));
    give(SetSurroundings{true, {std::nullopt, Vec3{3, 0, 1}}});
    EXPECT_EQ(robot(kCar)["own"], Json({{"wind", {3, 0, 1}}}));
    give(SetSurroundings{true, {}});
    EXPECT_FALSE(robot(kCar).contains("own"));
}

}  // namespace
}  // namespace roboss
