// Orders of pages reach the Client as orders of a Client, or are refused in words.
#include "gateway/page_order.h"

#include <gtest/gtest.h>
#include <support/robots.h>
#include <support/simulation.h>

#include "client/bus_client.h"

namespace roboss {
namespace {

class PageOrderTest : public testing::Test {
  protected:
    PageOrderTest() {
        World world;
        world.prototypes.push_back(test::car());
        world.prototypes[0].onboard.push_back({"drive", VelocityControlSpec{}, {}});
        world.prototypes.push_back(test::car());
        world.instances.push_back({"driven", 0, {{0, 0, 0}, {}}, {}});
        world.instances.push_back({"plain", 1, {{5, 0, 0}, {}}, {}});
        client =
            std::make_unique<BusClient>(test::compiled(world), Address{Role::kClient, 7}, BusClientOptions{});
    }
    Result<> command(std::uint32_t robot, const std::string& name, std::vector<double> values) {
        return give(*client, {RobotId(robot), PageCommand{name, std::move(values)}});
    }
    std::unique_ptr<BusClient> client;
};

TEST_F(PageOrderTest, CommandsAreFoundByName) {
    EXPECT_TRUE(command(0, "cmd_vel", {1, 0, 0, 0, 0, 0.5}).ok());
    const auto few = command(0, "cmd_vel", {1, 0});
    ASSERT_FALSE(few.ok());
    EXPECT_NE(few.error().text().find("2 values; it takes 6"), std::string::npos) << few.error().text();
    const auto unknown = command(0, "fly", {1});
    ASSERT_FALSE(unknown.ok());
    EXPECT_NE(unknown.error().text().find("'driven' has no command 'fly'"), std::string::npos);
    EXPECT_NE(unknown.error().text().find("it has 'cmd_vel'"), std::string::npos);
    const auto none = command(1, "cmd_vel", {1, 0, 0, 0, 0, 0});
    ASSERT_FALSE(none.ok());
    EXPECT_NE(none.error().text().find("takes no commands"), std::string::npos);
    EXPECT_FALSE(command(99, "cmd_vel", {}).ok()) << "no such robot";
}

TEST_F(PageOrderTest, BondsAreCheckedAsForEveryClient) {
    Attach attach;
    attach.link = attach.other_link = LinkId(0u);
    attach.other = RobotId(1u);
    EXPECT_TRUE(give(*client, {RobotId(0u), attach}).ok());
    EXPECT_TRUE(give(*client, {RobotId(0u), Detach{RobotId(1u)}}).ok());
    attach.other = RobotId(0u);
    EXPECT_FALSE(give(*client, {RobotId(0u), attach}).ok()) << "itself";
    attach.other = RobotId(1u), attach.max_force = 0;
    EXPECT_FALSE(give(*client, {RobotId(0u), attach}).ok()) << "no force";
}

TEST_F(PageOrderTest, NumbersOfJointsAndLinksAreCheckedAsForEveryClient) {
    const auto code = [&](const auto& action) {
        const Result<> given = give(*client, {RobotId(1u), action});
        return given.ok() ? std::string() : given.error().code;
    };
    using enum JointParameter;
    const JointId wheel(0u);
    EXPECT_EQ(code(SetJointParameters{wheel, 0, false, {{kDamping, 0.4}}}), "");
    EXPECT_EQ(code(SetJointParameters{wheel, 0, true, {}}), "");
    EXPECT_EQ(code(SetJointParameters{JointId(9u), 0, true, {}}), "no-joint");
    EXPECT_EQ(code(SetJointParameters{wheel, 1000, true, {}}), "no-axis");
    EXPECT_EQ(code(SetJointParameters{wheel, 0, false, {}}), "no-parameter");
    EXPECT_EQ(code(SetJointParameters{wheel, 0, false, {{kDamping, -1}}}), "bad-parameter");
    EXPECT_EQ(code(SetJointParameters{wheel, 0, false, {{kLower, 0}}}), "half-limits");
    const LinkId tyre(1u);
    EXPECT_EQ(code(SetLinkParameters{tyre, false, {{LinkParameter::kMass, 0.75}}}), "");
    EXPECT_EQ(code(SetLinkParameters{tyre, false, {{LinkParameter::kInertiaXx, 1}}}), "half-inertia");
    EXPECT_EQ(code(SetLinkParameters{LinkId(9u), true, {}}), "no-link");
    EXPECT_EQ(code(SetSurroundings{false, {Vec3{0, 0, -1.62}, std::nullopt}}), "");
    EXPECT_EQ(code(SetSurroundings{false, {std::nullopt, Vec3{2000, 0, 0}}}), "beyond-limit");
    EXPECT_EQ(code(SetSurroundings{}), "no-parameter");
}

}  // namespace
}  // namespace roboss
