// Orders files: what is right becomes orders, what is wrong becomes a diagnostic with its line, and nothing
// else is lost.
#include "app/worlds/orders_file.h"

#include <gtest/gtest.h>

#include "world/joint_type.h"

namespace roboss {
namespace {

/// A world with one robot "cart": a free base with one joint "slide".
World cart_world() {
    World world;
    ModelSpec cart;
    cart.canonical_link = "base";
    LinkSpec base, top;
    base.name = "base", top.name = "top";
    SensorSpec radio;
    radio.name = "radio", radio.parameters = RadioSpec{};
    top.sensors = {radio};
    cart.links = {base, top};
    JointSpec slide;
    slide.name = "slide", slide.kind = JointSpecKind::kPrismatic, slide.parent = "base", slide.child = "top";
    slide.axes.resize(1);
    slide.axes[0].max_effort = 20;
    cart.joints = {slide};
    world.prototypes = {cart};
    world.instances = {{"cart", 0, {}, {}}};
    world.dt_s = 0.002;
    return world;
}

std::shared_ptr<const Model> cart_model() {
    Diagnostics diagnostics;
    return compile(cart_world(), {}, diagnostics);
}

TEST(OrdersFile, EveryLevelIsRead) {
    Diagnostics d;
    const auto orders = parse_orders(
        "# a comment, then an empty line\n\n"
        R"({"t":0.5,"robot":"cart","set_pose":{"position":[1,2,3],"orientation":[1,0,0,0]}})"
        "\n"
        R"({"t":0.501,"robot":"cart","set_velocity":{"linear":[1,0,0]}})"
        "\n"
        R"({"t":1,"robot":"cart","wrench":{"link":"top","force":[0,0,9],"duration":0.1}})"
        "\n"
        R"({"t":1,"robot":"cart","joint":{"name":"slide","velocity":-2,"max_effort":5}})"
        "\n",
        "f.jsonl", *cart_model(), d);
    ASSERT_TRUE(d.items().empty());
    ASSERT_EQ(orders.size(), 4u);
    EXPECT_EQ(orders[0].apply_at, 250);
    EXPECT_EQ(std::get<SetPose>(orders[0].action).X_WR.p, (Vec3{1, 2, 3}));
    EXPECT_EQ(orders[1].apply_at, 251)
        << "0.501 s is nearer to tick 251 (0.502 s) than any other but 250: rounding half up";
    EXPECT_EQ(std::get<SetVelocity>(orders[1].action).angular, Vec3{});
    EXPECT_EQ(std::get<ApplyWrench>(orders[2].action).duration, 50);
    EXPECT_EQ(std::get<SetJoint>(orders[3].action).mode, MotorMode::kVelocity);
    EXPECT_EQ(orders[3].sequence, 6u) << "the line number";
}

TEST(OrdersFile, AnOrderToAJointWithALimitOfZeroIsLeftOutWithAWarning) {
    Diagnostics d;
    for (double AxisSpec::*const limit : {&AxisSpec::max_effort, &AxisSpec::max_velocity}) {
        World world = cart_world();
        world.prototypes[0].joints[0].axes[0].*limit = 0;
        const auto model = compile(world, {}, d);
        Diagnostics found;
        const auto orders = parse_orders(R"({"t":0,"robot":"cart","joint":{"name":"slide","velocity":1}})"
                                         "\n"
                                         R"({"t":0,"robot":"cart","set_velocity":{"linear":[1,0,0]}})",
                                         "f.jsonl", *model, found);
        EXPECT_EQ(orders.size(), 1u) << "the other one";
        ASSERT_EQ(found.items().size(), 1u);
        EXPECT_EQ(found.items()[0].severity, Severity::kWarning);
        EXPECT_EQ(found.items()[0].where.line, 1);
    }
}

TEST(OrdersFile, AQuaternionIsReadInTheOrderThatItsKeyNames) {
    Diagnostics d;
    const auto orders =
        parse_orders(R"({"t":0,"robot":"cart","set_pose":{"position":[0,0,0],"quat_xyzw":[0.6,0,0,0.8]}})"
                     "\n"
                     R"({"t":0,"robot":"cart","set_pose":{"position":[0,0,0],"quat_wxyz":[0.8,0.6,0,0]}})"
                     "\n"
                     R"({"t":0,"robot":"cart","set_pose":{"position":[0,0,0],"orientation":[0.8,0.6,0,0]}})",
                     "f.jsonl", *cart_model(), d);
    ASSERT_TRUE(d.items().empty());
    ASSERT_EQ(orders.size(), 3u);
    for (const Order& order : orders) {
        const Quat q = std::get<SetPose>(order.action).X_WR.q;
        EXPECT_NEAR(q.w, 0.8, 1e-15);
        EXPECT_NEAR(q.x, 0.6, 1e-15);
    }
}

TEST(OrdersFile, APullAndAReplacingWrenchAreReadAndWrittenAlike) {
    Diagnostics d;
    const auto model = cart_model();
    const auto orders = parse_orders(
        R"({"t":1,"robot":"cart","pull":{"link":"top","point":[0,0,1],"target":[4,5,6],"max_force":50,"duration":0.1}})"
        "\n"
        R"({"t":1,"robot":"cart","wrench":{"link":"top","force":[0,0,9],"replaces":true}})",
        "f.jsonl", *model, d);
    ASSERT_TRUE(d.items().empty());
    ASSERT_EQ(orders.size(), 2u);
    const Pull& pull = std::get<Pull>(orders[0].action);
    EXPECT_EQ(pull.p_L, (Vec3{0, 0, 1}));
    EXPECT_EQ(pull.target_W, (Vec3{4, 5, 6}));
    EXPECT_EQ(pull.max_force, 50);
    EXPECT_EQ(pull.rate, 15) << "not given";
    EXPECT_EQ(pull.duration, 50);
    EXPECT_TRUE(std::get<ApplyWrench>(orders[1].action).replaces);
    for (const Order& order : orders) {
        const auto again = parse_orders(order_line(order, *model), "f.jsonl", *model, d);
        ASSERT_EQ(again.size(), 1u);
        EXPECT_EQ(again[0].action, order.action);
    }
}

/// Two robots "a" and "b" with a message board that knows the topic "/key" and the word "go".
std::shared_ptr<const Model> board_model() {
    World world;
    ModelSpec car;
    car.canonical_link = "base";
    car.links.emplace_back().name = "base";
    VelocityControlSpec control;
    control.topic = "/cmd_vel";
    car.onboard.push_back({"c", control, {}});
    MessageBoardSpec board;
    board.words = {{"go"}};
    board.topics = {{"key", "/key", "", {{"data"}, {"text", 0, true}}}};
    ModelSpec messages;
    messages.is_static = true, messages.canonical_link = "base";
    messages.links = car.links;
    messages.onboard.push_back({"m", board, {}});
    world.prototypes = {car, messages};
    world.instances = {{"a", 0, {}, {}}, {"b", 0, {}, {}}, {"message_board", 1, {}, {}}};
    Diagnostics diagnostics;
    return compile(world, {}, diagnostics);
}

TEST(OrdersFile, StatesOfJointsAreReadAndWrittenAlike) {
    const auto model = cart_model();
    Diagnostics d;
    const auto orders = parse_orders(
        R"({"t":0.5,"robot":"cart","joint_state":{"name":"slide","position":0.25}})"
        "\n"
        R"({"t":1,"robot":"cart","joint_state":{"name":"slide","position":[0.5],"velocity":[-1]}})"
        "\n",
        "f.jsonl", *model, d);
    ASSERT_TRUE(d.items().empty());
    ASSERT_EQ(orders.size(), 2u);
    EXPECT_EQ(orders[0].action, Action(SetJointState{JointId(0u), {0.25}, {}}));
    EXPECT_EQ(orders[1].action, Action(SetJointState{JointId(0u), {0.5}, {-1}}));
    for (const Order& order : orders) {
        const auto again = parse_orders(order_line(order, *model), "g.jsonl", *model, d);
        ASSERT_EQ(again.size(), 1u);
        EXPECT_EQ(again[0].action, order.action);
    }
}

TEST(OrdersFile, ParametersOfJointsAreReadAndWrittenAlike) {
    const auto model = cart_model();
    Diagnostics d;
    const auto orders = parse_orders(
        R"({"t":0.5,"robot":"cart","joint_parameters":{"name":"slide","damping":0.25,"max_effort":null}})"
        "\n"
        R"({"t":1,"robot":"cart","joint_parameters":{"name":"slide","reset":true}})"
        "\n",
        "f.jsonl", *model, d);
    ASSERT_TRUE(d.items().empty()) << to_text(d.items()[0]);
    ASSERT_EQ(orders.size(), 2u);
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(orders[0].action, Action(SetJointParameters{JointId(0u),
                                                          0,
                                                          false,
                                                          {{JointParameter::kDamping, 0.25},
                                                           {JointParameter::kMaxEffort, infinity}}}));
    EXPECT_EQ(orders[1].action, Action(SetJointParameters{JointId(0u), 0, true, {}}));
    for (const Order& order : orders) {
        const auto again = parse_orders(order_line(order, *model), "g.jsonl", *model, d);
        ASSERT_EQ(again.size(), 1u);
        EXPECT_EQ(again[0].action, order.action);
    }
}

TEST(OrdersFile, ParametersOfJointsThatCannotBeSetAreNamedWithTheirLine) {
    for (const char* line : {R"({"t":1,"robot":"cart","joint_parameters":{"name":"glide","damping":1}})",
                             R"({"t":1,"robot":"cart","joint_parameters":{"name":"slide","mass":1}})",
                             R"({"t":1,"robot":"cart","joint_parameters":{"name":"slide","damping":null}})",
                             R"({"t":1,"robot":"cart","joint_parameters":{"name":"slide","damping":-1}})",
                             R"({"t":1,"robot":"cart","joint_parameters":{"name":"slide","reset":1}})",
                             R"({"t":1,"robot":"cart","joint_parameters":{"name":"slide","upper":1}})",
                             R"({"t":1,"robot":"cart","joint_parameters":{"name":"slide"}})",
                             R"({"t":1,"robot":"cart","joint_parameters":7})"}) {
        Diagnostics d;
        EXPECT_TRUE(parse_orders(line, "f.jsonl", *cart_model(), d).empty()) << line;
        ASSERT_EQ(d.items().size(), 1u) << line;
        EXPECT_EQ(d.items()[0].where.line, 1);
    }
}

TEST(OrdersFile, ParametersOfLinksAreReadAndWrittenAlike) {
    const auto model = cart_model();
    Diagnostics d;
    const std::string link = model->types[0].links[0].name;
    const auto orders = parse_orders(R"({"t":0.5,"robot":"cart","link_parameters":{"name":")" + link +
                                         R"(","mass":2.5,"centre_x":-0.125}})"
                                         "\n"
                                         R"({"t":1,"robot":"cart","link_parameters":{"name":")" +
                                         link + R"(","reset":true}})",
                                     "f.jsonl", *model, d);
    ASSERT_TRUE(d.items().empty()) << to_text(d.items()[0]);
    ASSERT_EQ(orders.size(), 2u);
    EXPECT_EQ(orders[0].action,
              Action(SetLinkParameters{
                  LinkId(0u), false, {{LinkParameter::kCentreX, -0.125}, {LinkParameter::kMass, 2.5}}}));
    EXPECT_EQ(orders[1].action, Action(SetLinkParameters{LinkId(0u), true, {}}));
    for (const Order& order : orders) {
        const auto again = parse_orders(order_line(order, *model), "g.jsonl", *model, d);
        ASSERT_EQ(again.size(), 1u);
        EXPECT_EQ(again[0].action, order.action);
    }
}

TEST(OrdersFile, ParametersOfLinksThatCannotBeSetAreNamedWithTheirLine) {
    const std::string link = cart_model()->types[0].links[0].name;
    for (const std::string& numbers :
         {std::string(R"("name":"glide","mass":1)"), R"("name":")" + link + R"(","damping":1)",
          R"("name":")" + link + R"(","mass":0)", R"("name":")" + link + R"(","mass":null)",
          R"("name":")" + link + R"(","inertia_xx":1)", R"("name":")" + link + R"(","reset":1)",
          R"("name":")" + link + R"(")", std::string(R"("mass":1)")}) {
        Diagnostics d;
        const std::string line = R"({"t":1,"robot":"cart","link_parameters":{)" + numbers + "}}";
        EXPECT_TRUE(parse_orders(line, "f.jsonl", *cart_model(), d).empty()) << line;
        ASSERT_EQ(d.items().size(), 1u) << line;
        EXPECT_EQ(d.items()[0].where.line, 1);
    }
}

TEST(OrdersFile, SurroundingsAreReadAndWrittenAlike) {
    const auto model = cart_model();
    Diagnostics d;
    const auto orders = parse_orders(R"({"t":0.5,"robot":"*","surroundings":{"gravity":[0,0,-1.62]}})"
                                     "\n"
                                     R"({"t":1,"robot":"cart","surroundings":{"wind":[3,0,-1],"reset":true}})"
                                     "\n"
                                     R"({"t":2,"robot":"cart","surroundings":{"reset":true}})",
                                     "f.jsonl", *model, d);
    ASSERT_TRUE(d.items().empty()) << to_text(d.items()[0]);
    ASSERT_EQ(orders.size(), model->robots.size() + 2);
    EXPECT_EQ(orders.front().action, Action(SetSurroundings{false, {Vec3{0, 0, -1.62}, std::nullopt}}));
    EXPECT_EQ(orders.end()[-2].action, Action(SetSurroundings{true, {std::nullopt, Vec3{3, 0, -1}}}));
    EXPECT_EQ(orders.back().action, Action(SetSurroundings{true, {}}));
    for (const Order& order : orders) {
        const auto again = parse_orders(order_line(order, *model), "g.jsonl", *model, d);
        ASSERT_EQ(again.size(), 1u);
        EXPECT_EQ(again[0].action, order.action);
    }
}

TEST(OrdersFile, SurroundingsThatCannotBeAreNamedWithTheirLine) {
    for (const char* values : {R"({})", R"({"gravity":-9.8})", R"({"gravity":[0,0]})", R"({"gravity":null})",
                               R"({"wind":[0,0,"1"]})", R"({"wind":[2000,0,0]})", R"({"gravity":[0,0,-1e4]})",
                               R"({"reset":1})", R"({"air":[0,0,0]})", R"(7)"}) {
        Diagnostics d;
        const std::string line = std::string(R"({"t":1,"robot":"cart","surroundings":)") + values + "}";
        EXPECT_TRUE(parse_orders(line, "f.jsonl", *cart_model(), d).empty()) << line;
        ASSERT_EQ(d.items().size(), 1u) << line;
        EXPECT_EQ(d.items()[0].where.line, 1);
    }
}

TEST(OrdersFile, StatesOfJointsThatCannotBeSetAreNamedWithTheirLine) {
    for (const char* line : {R"({"t":1,"robot":"cart","joint_state":{"name":"glide","position":1}})",
                             R"({"t":1,"robot":"cart","joint_state":{"name":"slide","position":[1,2]}})",
                             R"({"t":1,"robot":"cart","joint_state":{"name":"slide"}})",
                             R"({"t":1,"robot":"cart","joint_state":{"name":"slide","effort":1}})"}) {
        Diagnostics d;
        EXPECT_TRUE(parse_orders(line, "f.jsonl", *cart_model(), d).empty()) << line;
        ASSERT_EQ(d.items().size(), 1u) << line;
        EXPECT_EQ(d.items()[0].where.line, 1);
    }
}

TEST(OrdersFile, AMessageCommandsAllThatTakeItsTopic) {
    Diagnostics d;
    const auto orders = parse_orders(R"({"t":1,"publish":{"topic":"/cmd_vel","linear_x":2}})"
                                     "\n"
                                     R"({"t":1,"publish":{"topic":"/key","data":true,"text":"go"}})"
                                     "\n"
                                     R"({"t":1,"publish":{"topic":"/key","data":87,"text":"stop"}})"
                                     "\n"
                                     R"({"t":1,"publish":{"topic":"/key","values":[3,1]}})",
                                     "f.jsonl", *board_model(), d);
    ASSERT_TRUE(d.items().empty()) << to_text(d.items().front());
    ASSERT_EQ(orders.size(), 5u);
    EXPECT_EQ(orders[0].robot, RobotId(0u));
    EXPECT_EQ(orders[1].robot, RobotId(1u));
    EXPECT_EQ(std::get<Command>(orders[1].action).values, (std::vector<double>{2, 0, 0, 0, 0, 0}));
    EXPECT_NE(orders[0].sequence, orders[1].sequence) << "equal ones would count as one";
    EXPECT_EQ(std::get<Command>(orders[2].action).values, (std::vector<double>{1, 1}));
    EXPECT_EQ(std::get<Command>(orders[3].action).values, (std::vector<double>{87, 2}))
        << "no word that counts";
    EXPECT_EQ(std::get<Command>(orders[4].action).values, (std::vector<double>{3, 1}));
}

TEST(OrdersFile, AMessageThatNobodyTakesIsRefused) {
    for (const char* line :
         {R"({"t":1,"publish":{"topic":"/nobody"}})", R"({"t":1,"publish":{"topic":"/key","date":1}})",
          R"({"t":1,"publish":7})", R"({"t":1,"robot":"a","publish":{"topic":"/key"}})",
          R"({"t":1,"publish":{"topic":"/key","data":"go"}})"}) {
        Diagnostics d;
        EXPECT_TRUE(parse_orders(line, "f.jsonl", *board_model(), d).empty()) << line;
        EXPECT_EQ(d.count(Severity::kError), 1u) << line;
    }
}

TEST(OrdersFile, RadioMessagesAreReadAndWrittenAlike) {
    Diagnostics d;
    const auto model = cart_model();
    const auto orders =
        parse_orders(R"({"t":1,"robot":"cart","transmit":{"radio":"radio","text":"hi\u00e9"}})"
                     "\n"
                     R"({"t":1,"robot":"cart","transmit":{"radio":"radio","hex":"00fFa1"}})",
                     "f.jsonl", *model, d);
    ASSERT_TRUE(d.items().empty());
    ASSERT_EQ(orders.size(), 2u);
    EXPECT_EQ(std::get<Transmit>(orders[0].action).payload,
              (std::vector<std::uint8_t>{'h', 'i', 0xC3, 0xA9}));
    EXPECT_EQ(std::get<Transmit>(orders[1].action).payload, (std::vector<std::uint8_t>{0, 255, 161}));
    for (const Order& order : orders) {
        const auto again = parse_orders(order_line(order, *model), "f.jsonl", *model, d);
        ASSERT_EQ(again.size(), 1u);
        EXPECT_EQ(again[0].action, order.action);
    }
}

struct BadLine {
    const char* line;
    const char* names;  // the key or value of the line that the message must name; empty: the whole line
};
void PrintTo(const BadLine& bad, std::ostream* out) {
    *out << bad.line;
}

class BadOrder : public testing::TestWithParam<BadLine> {};

TEST_P(BadOrder, IsNamedWithItsLineAndTheRestIsKept) {
    Diagnostics d;
    const std::string good = R"({"t":0,"robot":"cart","joint":{"name":"slide","effort":1}})";
    const auto orders =
        parse_orders(good + "\n" + GetParam().line + "\n" + good + "\n", "f.jsonl", *cart_model(), d);
    EXPECT_EQ(orders.size(), 2u);
    ASSERT_EQ(d.items().size(), 1u);
    EXPECT_EQ(d.items()[0].where.file, "f.jsonl");
    EXPECT_EQ(d.items()[0].where.line, 2);
    EXPECT_EQ(d.items()[0].severity, Severity::kError);
    EXPECT_FALSE(d.items()[0].remedy.empty());
    EXPECT_EQ(d.items()[0].code, "bad-order");
    EXPECT_NE(d.items()[0].message.find(GetParam().names), std::string::npos) << d.items()[0].message;
}

INSTANTIATE_TEST_SUITE_P(
    Lines, BadOrder,
    testing::Values(
        BadLine{"{", ""}, BadLine{"[1]", ""}, BadLine{R"({"robot":"cart"})", "'t'"},
        BadLine{R"({"t":-1,"robot":"cart","joint":{}})", "'t'"},
        BadLine{R"({"t":0,"robot":"carl","joint":{}})", "'carl'"}, BadLine{R"({"t":0,"robot":"cart"})", ""},
        BadLine{R"({"t":0,"robot":"cart","joint":{"name":"slid","velocity":1}})", "'slid'"},
        BadLine{R"({"t":0,"robot":"cart","joint":{"name":"slide","velocity":1,"effort":1}})", ""},
        BadLine{R"({"t":0,"robot":"cart","joint":{"name":"slide","speed":1}})", "'speed'"},
        BadLine{R"({"t":0,"robot":"cart","joint":{"name":"slide","effort":1,"axis":1}})", ""},
        BadLine{R"({"t":0,"robot":"cart","joint":{"name":"slide","effort":1,"max_effort":-1}})",
                "max_effort"},
        BadLine{R"({"t":0,"robot":"cart","set_pose":{"position":[1,2]}})", "position"},
        BadLine{R"({"t":0,"robot":"cart","set_pose":{"position":[0,0,0],"orientation":[1,1,0,0]}})",
                "orientation"},
        BadLine{R"({"t":0,"robot":"cart","set_pose":{"position":[0,0,0],"quat_xyzw":[1,1,0,0]}})",
                "quat_xyzw"},
        BadLine{
            R"({"t":0,"robot":"cart","set_pose":{"position":[0,0,0],"quat_xyzw":[0,0,0,1],"quat_wxyz":[1,0,0,0]}})",
            "several"},
        BadLine{R"({"t":0,"robot":"cart","wrench":{"link":"bottom","force":[0,0,1]}})", "'bottom'"},
        BadLine{R"({"t":0,"robot":"cart","wrench":{"link":"top","force":[0,0,1],"duration":0}})",
                "'duration'"},
        BadLine{"no JSON", "character 2"},
        BadLine{R"({"t":0,"robot":"cart","transmit":{"radio":"ratio","text":""}})", "'ratio'"},
        BadLine{R"({"t":0,"robot":"cart","transmit":{"radio":"radio"}})", "'text'"},
        BadLine{R"({"t":0,"robot":"cart","transmit":{"radio":"radio","hex":"abc"}})", "'hex'"},
        BadLine{R"({"t":0,"robot":"cart","transmit":{"radio":"radio","hex":"0g"}})", "'g'"},
        BadLine{R"({"t":0,"robot":"cart","transmit":{"radio":"radio","text":"a","to":"carl"}})", "'carl'"},
        BadLine{R"({"t":0,"robot":"cart","transmit":{"radio":"radio","text":"a","to":"cart"}})", "'cart'"},
        BadLine{R"({"t":0,"robot":"cart","set_velocity":{"linear":[1e999,0,0]}})", ""}));

/// Robots "X2", "Y1", "X10", "X1" with a velocity control each, whose topics and names of joints are their
/// own.
std::shared_ptr<const Model> swarm_model() {
    World world;
    for (const char* name : {"X2", "Y1", "X10", "X1"}) {
        ModelSpec robot;
        LinkSpec base;
        base.name = robot.canonical_link = "base";
        robot.links = {base};
        VelocityControlSpec control;
        control.topic = std::string("/") + name + "/cmd_vel";
        robot.onboard.push_back({"go", control, {}});
        world.prototypes.push_back(robot);
        world.instances.push_back({name, world.prototypes.size() - 1, {}, {}});
    }
    world.dt_s = 0.002;
    Diagnostics diagnostics;
    return compile(world, {}, diagnostics);
}

TEST(OrdersFile, AMisspeltValueOfACommandIsNamedWithTheOneThatWasMeant) {
    Diagnostics d;
    const std::string line = R"({"t":0,"robot":"X1","command":{"name":"cmd_vel","liner_x":1}})";
    parse_orders(line + "\n", "f.jsonl", *swarm_model(), d);
    ASSERT_EQ(d.items().size(), 1u);
    EXPECT_NE(d.items()[0].message.find("'liner_x'"), std::string::npos) << d.items()[0].message;
    EXPECT_NE(d.items()[0].remedy.find("'linear_x'"), std::string::npos) << d.items()[0].remedy;
}

TEST(OrdersFile, APatternOrdersAllRobotsThatItFitsByTheirOrderInTheWorld) {
    const auto model = swarm_model();
    Diagnostics d;
    const auto orders = parse_orders(R"({"t":1,"robot":"X*","command":{"name":"cmd_vel","linear_x":2}})"
                                     "\n"
                                     R"({"t":1,"robot":"?1","set_velocity":{"linear":[1,0,0]}})",
                                     "f.jsonl", *model, d);
    ASSERT_TRUE(d.items().empty()) << to_text(d.items()[0]);
    ASSERT_EQ(orders.size(), 5u);
    const std::uint32_t robots[] = {0, 2, 3, 1, 3};
    for (std::size_t i = 0; i < orders.size(); ++i) {
        EXPECT_EQ(orders[i].robot.value, robots[i]);
        EXPECT_EQ(orders[i].apply_at, 500);
        for (std::size_t k = 0; k < i; ++k) EXPECT_NE(orders[i].sequence, orders[k].sequence);
    }
    EXPECT_EQ(std::get<Command>(orders[2].action).values[0], 2.0);
}

TEST(OrdersFile, APatternThatFitsNobodyIsAnErrorThatNamesRobots) {
    Diagnostics d;
    EXPECT_TRUE(
        parse_orders(R"({"t":1,"robot":"Z*","set_velocity":{}})", "f.jsonl", *swarm_model(), d).empty());
    ASSERT_EQ(d.items().size(), 1u);
    EXPECT_NE(d.items()[0].message.find("'Z*'"), std::string::npos) << d.items()[0].message;
    EXPECT_NE(d.items()[0].remedy.find("'X2', 'Y1', 'X10' and 1 more"), std::string::npos)
        << d.items()[0].remedy;
}

TEST(OrdersFile, APatternWhereOneRobotIsNamedIsAnErrorUnlessItFitsOne) {
    Diagnostics d;
    const auto fine =
        parse_orders(R"({"t":1,"robot":"X1","attach":{"robot":"Y*"}})", "f.jsonl", *swarm_model(), d);
    ASSERT_EQ(fine.size(), 1u);
    EXPECT_EQ(std::get<Attach>(fine[0].action).other.value, 1u);
    EXPECT_TRUE(parse_orders(R"({"t":1,"robot":"Y1","attach":{"robot":"X*"}})", "f.jsonl", *swarm_model(), d)
                    .empty());
    ASSERT_EQ(d.items().size(), 1u);
    EXPECT_NE(d.items()[0].message.find("fits 3 robots"), std::string::npos) << d.items()[0].message;
}

TEST(OrdersFile, OneRobotOfAPatternThatRefusesRefusesTheLine) {
    Diagnostics d;
    EXPECT_TRUE(
        parse_orders(R"({"t":1,"robot":"*","attach":{"robot":"Y1"}})", "f.jsonl", *swarm_model(), d).empty())
        << "Y1 cannot hold itself";
    EXPECT_EQ(d.items().size(), 1u);
}

TEST(OrdersFile, RobotsOfAPatternThatRefuseForOneCauseAreOneFinding) {
    Diagnostics d;
    EXPECT_TRUE(parse_orders(R"({"t":1,"robot":"*","joint":{"name":"elbow","velocity":1}})", "f.jsonl",
                             *swarm_model(), d)
                    .empty());
    ASSERT_EQ(d.items().size(), 1u);
    EXPECT_NE(d.items()[0].message.find("4 robots refuse it ('X2', 'Y1', 'X10', ...)"), std::string::npos)
        << d.items()[0].message;
    EXPECT_EQ(d.items()[0].where.line, 1);
}

TEST(OrdersFile, RobotsOfAPatternWithoutEffortLeaveTheOrdersOfTheOthers) {
    World world = cart_world();
    world.prototypes.push_back(world.prototypes[0]);
    world.prototypes[1].joints[0].axes[0].max_effort = 0;
    for (int i = 0; i < 6; ++i)
        world.instances.push_back({"cart_" + std::to_string(i), static_cast<std::size_t>(i % 2), {}, {}});
    Diagnostics compiling, d;
    const auto model = compile(world, {}, compiling);
    const auto orders = parse_orders(R"({"t":1,"robot":"cart_*","joint":{"name":"slide","velocity":1}})",
                                     "f.jsonl", *model, d);
    ASSERT_EQ(orders.size(), 3u);
    EXPECT_EQ(orders[2].robot.value, 5u);
    ASSERT_EQ(d.items().size(), 1u);
    EXPECT_EQ(d.items()[0].severity, Severity::kWarning);
    EXPECT_NE(d.items()[0].message.find("3 robots refuse it"), std::string::npos) << d.items()[0].message;
}

TEST(OrdersFile, AFileThatIsNotThereIsAnError) {
    Diagnostics d;
    EXPECT_TRUE(load_orders("no/such/file.jsonl", *cart_model(), d).empty());
    EXPECT_TRUE(d.has_errors());
}

}  // namespace
}  // namespace roboss
