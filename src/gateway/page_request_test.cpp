// Valid requests of pages are understood; anything else is refused by name.
#include "gateway/page_request.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace roboss {
namespace {

TEST(PageRequest, UnderstandsEveryKindOfOrder) {
    const auto order = [](const std::string& rest) {
        Result<PageRequest> request = parse_page_request(R"({"type":"order","id":6,"robot":7,)" + rest + "}");
        EXPECT_TRUE(request.ok()) << request.error().text();
        EXPECT_EQ(request.value().id, 6);
        return std::get<PageOrder>(request.value().what);
    };
    const PageOrder pose = order(R"("action":"pose","pose":[1,2,3,2,0,0,0])");
    EXPECT_EQ(pose.robot, RobotId(7u));
    EXPECT_EQ(std::get<SetPose>(pose.action).X_WR.p, (Vec3{1, 2, 3}));
    EXPECT_EQ(std::get<SetPose>(pose.action).X_WR.q.w, 1) << "normalised";
    const PageOrder push =
        order(R"("action":"wrench","link":2,"force":[0,0,9],"torque":[0,0,0],"duration":0.5)");
    EXPECT_EQ(std::get<PageWrench>(push.action).duration_s, 0.5);
    const PageOrder joint = order(R"("action":"joint","joint":1,"axis":1,"mode":"position","target":-2)");
    EXPECT_EQ(std::get<SetJoint>(joint.action).mode, MotorMode::kPosition);
    EXPECT_EQ(std::get<SetJoint>(joint.action).max_effort, -1) << "the joint's own";
    EXPECT_EQ(std::get<SetVelocity>(order(R"("action":"velocity","linear":[1,0,0],"angular":[0,0,2])").action)
                  .angular,
              (Vec3{0, 0, 2}));
}

TEST(PageRequest, UnderstandsCommandsAndBonds) {
    const auto order = [](const std::string& rest) {
        Result<PageRequest> request = parse_page_request(R"({"type":"order","id":6,"robot":7,)" + rest + "}");
        EXPECT_TRUE(request.ok()) << request.error().text();
        return std::get<PageOrder>(request.value().what);
    };
    const PageOrder drive = order(R"("action":"command","name":"cmd_vel","values":[1,0.5])");
    EXPECT_EQ(std::get<PageCommand>(drive.action).name, "cmd_vel");
    EXPECT_EQ(std::get<PageCommand>(drive.action).values, (std::vector<double>{1, 0.5}));
    const PageOrder empty = order(R"("action":"command","name":"path","values":[])");
    EXPECT_TRUE(std::get<PageCommand>(empty.action).values.empty()) << "a list without rows";
    const Attach grip = std::get<Attach>(
        order(R"("action":"attach","link":2,"other":4,"other_link":1,"reach":0.2,"max_force":50)").action);
    EXPECT_EQ(grip.link, LinkId(2u));
    EXPECT_EQ(grip.other, RobotId(4u));
    EXPECT_EQ(grip.other_link, LinkId(1u));
    EXPECT_EQ(grip.reach, 0.2);
    EXPECT_EQ(grip.max_force, 50);
    EXPECT_TRUE(std::isinf(grip.max_torque)) << "not given: it never lets go";
    EXPECT_EQ(std::get<Detach>(order(R"("action":"detach","other":4)").action).other, RobotId(4u));
    EXPECT_FALSE(std::get<Detach>(order(R"("action":"detach")").action).other.valid()) << "of all";
}

TEST(PageRequest, UnderstandsNumbersOfJointsAndLinks) {
    const auto order = [](const std::string& rest) {
        Result<PageRequest> request = parse_page_request(R"({"type":"order","id":6,"robot":7,)" + rest + "}");
        EXPECT_TRUE(request.ok()) << request.error().text();
        return std::get<PageOrder>(request.value().what);
    };
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(
        std::get<SetJointParameters>(
            order(
                R"("action":"joint_parameters","joint":3,"axis":1,"values":{"damping":0.4,"lower":null,"upper":null})")
                .action),
        (SetJointParameters{JointId(3u),
                            1,
                            false,
                            {{JointParameter::kDamping, 0.4},
                             {JointParameter::kLower, -infinity},
                             {JointParameter::kUpper, infinity}}}))
        << "null is no bound, as in orders files";
    EXPECT_EQ(
        std::get<SetJointParameters>(order(R"("action":"joint_parameters","joint":3,"reset":true)").action),
        (SetJointParameters{JointId(3u), 0, true, {}}));
    EXPECT_EQ(
        std::get<SetLinkParameters>(
            order(R"("action":"link_parameters","link":2,"values":{"mass":3,"friction":0},"reset":true)")
                .action),
        (SetLinkParameters{LinkId(2u), true, {{LinkParameter::kFriction, 0}, {LinkParameter::kMass, 3}}}));
}

TEST(PageRequest, UnderstandsOrdersForSurroundings) {
    const auto order = [](const std::string& rest) {
        Result<PageRequest> request =
            parse_page_request(R"({"type":"order","id":6,"robot":7,"action":"surroundings")" + rest + "}");
        EXPECT_TRUE(request.ok()) << request.error().text();
        return std::get<SetSurroundings>(std::get<PageOrder>(request.value().what).action);
    };
    EXPECT_EQ(order(R"(,"gravity":[0,0,-1.62])"),
              (SetSurroundings{false, {Vec3{0, 0, -1.62}, std::nullopt}}));
    EXPECT_EQ(order(R"(,"wind":[3,0,1],"reset":true)"),
              (SetSurroundings{true, {std::nullopt, Vec3{3, 0, 1}}}));
}

TEST(PageRequest, UnderstandsWhoseNumbersAPageSees) {
    const auto wish = [](const std::string& numbers) {
        const auto request = parse_page_request(R"({"type":"watch","robots":[7],"numbers":)" + numbers + "}");
        EXPECT_TRUE(request.ok()) << request.error().text();
        return std::get<PageWatch>(request.value().what).numbers.value();
    };
    const NumbersWish axis = wish(R"({"robot":7,"joint":4,"axis":1})"),
                      link = wish(R"({"robot":7,"link":2})");
    EXPECT_EQ(axis.robot, RobotId(7u));
    EXPECT_EQ(axis.joint, JointId(4u));
    EXPECT_EQ(axis.axis, 1);
    EXPECT_FALSE(axis.link.valid());
    EXPECT_EQ(link.link, LinkId(2u));
    EXPECT_FALSE(link.joint.valid());
    EXPECT_EQ(wish(R"({"robot":7,"joint":4})").axis, 0);
    EXPECT_FALSE(std::get<PageWatch>(parse_page_request(R"({"type":"watch"})").value().what).numbers);
}

TEST(PageRequest, UnderstandsPullsReplacingPushesAndControl) {
    const auto request = [](const std::string& rest) { return parse_page_request("{" + rest + "}"); };
    const std::string order = R"("type":"order","robot":7,)";
    const auto pull = request(
        order + R"("action":"pull","link":1,"point":[1,2,3],"target":[4,5,6],"max_force":7,"duration":2)");
    ASSERT_TRUE(pull.ok()) << pull.error().text();
    const auto& wanted = std::get<PagePull>(std::get<PageOrder>(pull.value().what).action);
    EXPECT_EQ(wanted.pull.link, LinkId(1u));
    EXPECT_EQ(wanted.pull.p_L, (Vec3{1, 2, 3}));
    EXPECT_EQ(wanted.pull.target_W, (Vec3{4, 5, 6}));
    EXPECT_EQ(wanted.pull.max_force, 7);
    EXPECT_EQ(wanted.duration_s, 2);
    EXPECT_FALSE(request(order + R"("action":"pull","point":[1,2,3],"target":[4,5,6])").ok()) << "no force";
    const std::string push = order + R"("action":"wrench","force":[1,2,3],"torque":[0,0,0],"replaces":)";
    EXPECT_TRUE(
        std::get<PageWrench>(std::get<PageOrder>(request(push + "true").value().what).action).replaces);
    EXPECT_FALSE(request(push + "1").ok());
    EXPECT_EQ(std::get<PageDesk>(request(R"("type":"ask","id":3)").value().what).kind, PageDesk::Kind::kAsk);
    const auto yield = request(R"("type":"yield","id":4,"page":9)");
    EXPECT_EQ(yield.value().id, 4);
    EXPECT_EQ(std::get<PageDesk>(yield.value().what).page, 9u);
    EXPECT_FALSE(std::get<PageDesk>(request(R"("type":"yield")").value().what).page);
    EXPECT_FALSE(request(R"("type":"keep")").ok()) << "from whom?";
}

TEST(PageRequest, UnderstandsWatchesAndBoundsTheirRate) {
    const auto request = parse_page_request(
        R"({"type":"watch","robots":[3,9],"overlays":["contacts","new","profile"],"rate":500})");
    ASSERT_TRUE(request.ok());
    const PageWatch& watch = std::get<PageWatch>(request.value().what);
    EXPECT_EQ(watch.robots, (std::vector<RobotId>{RobotId(3u), RobotId(9u)}));
    EXPECT_TRUE(watch.contacts);
    EXPECT_FALSE(watch.bounds);
    EXPECT_TRUE(watch.profile);
    EXPECT_EQ(watch.rate, 60);
    EXPECT_TRUE(watch.cameras.empty());
}

TEST(PageRequest, UnderstandsWhichCamerasAPageLooksThrough) {
    const auto request = parse_page_request(
        R"({"type":"watch","cameras":[{"robot":3,"sensor":1,"columns":160,"depth":true},{"robot":3,"sensor":0}]})");
    ASSERT_TRUE(request.ok());
    const PageWatch& watch = std::get<PageWatch>(request.value().what);
    EXPECT_EQ(watch.cameras,
              (std::vector<PictureWish>{{RobotId(3u), 1, true, 160}, {RobotId(3u), 0, false, 0}}));
}

TEST(PageRequest, UnderstandsTheWordsOfARequestToTheRun) {
    const auto request = parse_page_request(R"({"type":"control","id":3,"words":["reset"]})");
    ASSERT_TRUE(request.ok());
    EXPECT_EQ(request.value().id, 3);
    EXPECT_EQ(std::get<ControlArguments>(request.value().what).words, std::vector<std::string>{"reset"});
}

TEST(PageRequest, RefusesWhatIsWrongByName) {
    const std::pair<const char*, const char*> wrongs[] = {
        {"", ""},
        {"[]", ""},
        {R"({"type":7})", "\"type\""},
        {R"({"type":"control","words":[]})", "\"words\""},
        {R"({"type":"control","words":["a",1]})", "\"words\""},
        {R"({"type":"control","id":-1,"words":["a"]})", "\"id\""},
        {R"({"type":"order","robot":1.5,"action":"velocity"})", "\"robot\""},
        {R"({"type":"order","robot":1,"action":"explode"})", "\"action\""},
        {R"({"type":"order","robot":1,"action":"pose","pose":[0,0,0,0,0,0,0]})", "\"pose\""},
        {R"({"type":"order","robot":1,"action":"pose","pose":[0,0,"a",1,0,0,0]})", "\"pose\""},
        {R"({"type":"order","robot":1,"action":"joint","joint":0,"mode":"magic"})", "\"mode\""},
        {R"({"type":"order","robot":1,"action":"command","values":[1]})", "\"name\""},
        {R"({"type":"order","robot":1,"action":"command","name":"a"})", "\"values\""},
        {R"({"type":"order","robot":1,"action":"command","name":"a","values":[1,null]})", "\"values\""},
        {R"({"type":"order","robot":1,"action":"attach"})", "\"other\""},
        {R"({"type":"order","robot":1,"action":"attach","other":2,"max_force":"much"})", "\"max_force\""},
        {R"({"type":"order","robot":1,"action":"detach","other":-1})", "\"other\""},
        {R"({"type":"order","robot":1,"action":"joint_parameters","values":{"damping":1}})", "\"joint\""},
        {R"({"type":"order","robot":1,"action":"joint_parameters","joint":0,"values":[1]})", "\"values\""},
        {R"({"type":"order","robot":1,"action":"joint_parameters","joint":0,"values":{"mass":1}})",
         "\"values\""},
        {R"({"type":"order","robot":1,"action":"joint_parameters","joint":0,"values":{"damping":null}})",
         "\"values\""},
        {R"({"type":"order","robot":1,"action":"joint_parameters","joint":0,"values":{"damping":"1"}})",
         "\"values\""},
        {R"({"type":"order","robot":1,"action":"joint_parameters","joint":0,"reset":1})", "\"reset\""},
        {R"({"type":"order","robot":1,"action":"link_parameters","values":{"mass":1}})", "\"link\""},
        {R"({"type":"order","robot":1,"action":"link_parameters","link":0,"values":{"mass":null}})",
         "\"values\""},
        {R"({"type":"order","robot":1,"action":"link_parameters","link":0,"values":{"damping":1}})",
         "\"values\""},
        {R"({"type":"order","robot":1,"action":"surroundings","gravity":-9.8})", "\"gravity\""},
        {R"({"type":"order","robot":1,"action":"surroundings","wind":[1,2]})", "\"wind\""},
        {R"({"type":"order","robot":1,"action":"surroundings","reset":1})", "\"reset\""},
        {R"({"type":"watch","numbers":7})", "\"numbers\""},
        {R"({"type":"watch","numbers":{"robot":1}})", "\"numbers\""},
        {R"({"type":"watch","numbers":{"robot":1,"link":-1}})", "\"numbers\""},
        {R"({"type":"watch","numbers":{"link":1}})", "\"numbers\""},
        {R"({"type":"watch","robots":[1,2,3,4,5,6,7,8,9]})", "\"robots\""},
        {R"({"type":"watch","rate":-3})", "\"rate\""},
        {R"({"type":"watch","cameras":7})", "\"cameras\""},
        {R"({"type":"watch","cameras":[{"robot":1}]})", "\"cameras\""},
        {R"({"type":"watch","cameras":[{"robot":1,"sensor":-1}]})", "\"cameras\""},
        {R"({"a":[[[[[[[[[1]]]]]]]]]})", ""},
    };
    for (const auto& [text, named] : wrongs) {
        const auto request = parse_page_request(text);
        ASSERT_FALSE(request.ok()) << text;
        EXPECT_EQ(request.error().code, "bad-message");
        EXPECT_NE(request.error().message.find(named), std::string::npos)
            << text << ": " << request.error().message;
    }
}

TEST(PageRequest, NoBytesBreakIt) {
    std::mt19937_64 random(20261121);
    const std::string good = R"({"type":"order","id":6,"robot":7,"action":"pose","pose":[1,2,3,1,0,0,0]})";
    int refused = 0;
    for (int i = 0; i < 20'000; ++i) {
        std::string text = good;
        for (std::uint64_t k = 0; k < 1 + random() % 4; ++k)
            text[random() % text.size()] = static_cast<char>(random());
        refused += parse_page_request(text).ok() ? 0 : 1;
    }
    EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace roboss
