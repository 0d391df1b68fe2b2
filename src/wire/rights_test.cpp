// Rights as text, and what they permit.
#include "wire/rights.h"

#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

const RobotId kCar0(0u), kCar1(1u), kSpider(2u);

World three_robots() {
    World world = empty_world(1e-3);
    for (const char* name : {"car_0", "car_1", "spider"})
        place(world, solid_sphere(1.0, 0.1, surface(0.5)), name, {});
    return world;
}

/// One order of each sort, with the kind that it is of.
std::vector<std::pair<OrderKind, Action>> every_action(RobotId other) {
    return {{OrderKind::kPose, SetPose{}},
            {OrderKind::kPose, SetJointState{}},
            {OrderKind::kVelocity, SetVelocity{}},
            {OrderKind::kForce, ApplyWrench{}},
            {OrderKind::kForce, Pull{}},
            {OrderKind::kActuators, SetJoint{}},
            {OrderKind::kActuators, Command{}},
            {OrderKind::kBonds, Attach{LinkId(0u), other, LinkId(0u)}},
            {OrderKind::kBonds, Detach{other}},
            {OrderKind::kRadio, Transmit{}},
            {OrderKind::kActuators, SetJointParameters{}},
            {OrderKind::kActuators, SetLinkParameters{}},
            {OrderKind::kForce, SetSurroundings{}}};
}

class ClientRights : public testing::Test {
  protected:
    std::string code(const Rights& rights, RobotId robot, const Action& action) const {
        const Result<> permitted = permit(&rights, *sim.model, Order{0, ClientId(0u), 0, robot, action});
        return permitted ? "" : permitted.error().code;
    }
    const Simulation sim{three_robots()};
};

TEST_F(ClientRights, PermitTheKindsOfOrdersThatTheyListAndNoOther) {
    ASSERT_EQ(every_action(kCar1).size(), std::variant_size_v<Action>);
    for (std::size_t k = 0; k < kOrderKinds; ++k) {
        const auto kind = static_cast<OrderKind>(k);
        const Rights rights = make_rights({"*"}, {order_kind_name(kind)}, false).value();
        for (const auto& [its_kind, action] : every_action(kCar1)) {
            EXPECT_EQ(kind_of(action), its_kind) << action.index();
            EXPECT_EQ(code(rights, kCar0, action), its_kind == kind ? "" : "not-permitted") << action.index();
        }
    }
}

TEST_F(ClientRights, PermitTheRobotsWhoseNamesFit) {
    const Rights rights = make_rights({"car_?"}, {"velocity", "bonds"}, false).value();
    EXPECT_EQ(code(rights, kCar0, SetVelocity{}), "");
    EXPECT_EQ(code(rights, kSpider, SetVelocity{}), "not-permitted");
    EXPECT_EQ(code(rights, kCar0, Attach{LinkId(0u), kCar1, LinkId(0u)}), "");
    EXPECT_EQ(code(rights, kCar0, Attach{LinkId(0u), kSpider, LinkId(0u)}), "not-permitted") << "it is held";
    EXPECT_EQ(code(rights, kCar0, Detach{kSpider}), "") << "a holder may always let go";
    EXPECT_EQ(code(rights, kCar0, Detach{}), "");
}

TEST_F(ClientRights, RefusalsNameTheKeyAndTheRobot) {
    Rights rights = make_rights({"car_0"}, {"velocity"}, false).value();
    rights.key = "pilot";
    const Result<> refused = permit(&rights, *sim.model, Order{0, ClientId(0u), 0, kSpider, SetVelocity{}});
    ASSERT_FALSE(refused.ok());
    for (const char* word : {"'pilot'", "'spider'"})
        EXPECT_NE(refused.error().message.find(word), std::string::npos) << refused.error().message;
    EXPECT_NE(refused.error().remedy.find("robots=car_0;orders=velocity"), std::string::npos);
}

TEST_F(ClientRights, LetEverybodyAskAndSomeSteer) {
    const Rights orders = make_rights({"*"}, {"force"}, false).value(),
                 steers = make_rights({}, {}, true).value();
    for (const ControlAction& request : {ControlAction(GetStatus{}), ControlAction(PreviewRun{})})
        EXPECT_TRUE(permit(&orders, request).ok());
    for (const ControlAction& request :
         {ControlAction(PauseRun{}), ControlAction(SaveRun{}), ControlAction(QuitRun{}),
          ControlAction(RewindRun{}), ControlAction(RemoveRobots{}), ControlAction(AddModels{}),
          ControlAction(AddBookmark{})}) {
        EXPECT_FALSE(permit(&orders, request).ok()) << control_verb(request);
        EXPECT_TRUE(permit(&steers, request).ok());
        EXPECT_TRUE(permit(nullptr, request).ok());
    }
}

TEST_F(ClientRights, AreTheSameAfterTheirText) {
    const std::vector<std::string> some{"car_*", "a b", "?x"};
    for (const auto& [rights, text] : std::initializer_list<std::pair<Rights, std::string>>{
             {Rights{}, "everything"},
             {make_rights({"*"}, {}, false).value(), "look-only"},
             {make_rights(some, {"radio", "pose"}, true).value(),
              "robots=car_*,a b,?x;orders=pose,radio;steer=yes"},
             {make_rights({"*"}, {}, true).value(), "robots=*;orders=;steer=yes"}}) {
        EXPECT_EQ(rights_text(rights), text);
        ASSERT_TRUE(rights_of(text).ok()) << text;
        EXPECT_EQ(rights_of(text).value(), rights);
    }
}

TEST_F(ClientRights, AreNoneInABadText) {
    for (const char* text : {"", "all", "robots=*", "robots=*;orders=pose",
                             "robots=*;orders=pose;steer=perhaps", "robots=*;orders=pose;steer=no;steer=yes",
                             "orders=pose;robots=*;steer=no", "robots=*;orders=fly;steer=no",
                             "robots=a,,b;orders=pose;steer=no", "robots=a\n;orders=pose;steer=no"})
        EXPECT_FALSE(rights_of(text).ok()) << text;
    for (const std::string& pattern : {std::string("car;steer=yes"), std::string(5'000, 'x')}) {
        const Result<Rights> rights = make_rights({pattern}, {"force"}, false);
        ASSERT_FALSE(rights.ok()) << pattern;
        EXPECT_EQ(rights.error().code, "bad-rights");
    }
}

}  // namespace
}  // namespace roboss::test
