// What a page reads of a robot is what a Client reads of the same states.
#include "gateway/inspector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "model/order.h"
#include "sensors/test_model.h"
#include "wire/state_block.h"

namespace roboss {
namespace {

using Json = nlohmann::json;

using sensors_test::sensor;

class InspectorTest : public testing::Test {
  protected:
    InspectorTest() {
        RobotType type = sensors_test::cart_type();
        LaserSpec laser;
        laser.samples = 3;
        laser.min_angle = -1, laser.max_angle = 1;
        laser.range_min = 0.1, laser.range_max = 20;
        laser.noise.stddev = 0.01;
        sensors_test::add_sensor(type, 1, sensor("scan", laser));
        sensors_test::add_sensor(type, 1, sensor("position", GpsSpec{}));
        sensors_test::add_sensor(type, 1, sensor("north", CompassSpec{}));
        OdometerSpec odometer;
        odometer.joints = {"axle"};
        odometer.wheel_radius = 0.1;
        sensors_test::add_sensor(type, 0, sensor("distance", odometer));
        const auto made = sensors_test::model_of(type, 2);
        Transform wall;
        wall.p = {6, 0, 0};
        sensors_test::add_static(*made, {ShapeKind::kBox, {0.1, 5, 5}, 0, 0}, wall);
        model = made;
        SceneFile file;
        file.seed = 77;
        scene = std::make_shared<const ShownScene>(ShownScene{9, model, file, ViewLayout(*model)});
        states = {sensors_test::cart_at({{0, 0, 1}, from_rpy(0, 0, 0.1)}),
                  sensors_test::cart_at({{0, 9, 1}, {}})};
        states[0].q[7] = 0.5;
        states[0].v = {0, 0, 0.5, 1, 2, 3, 4};
        states[0].motors[0] = {MotorMode::kVelocity, 10, 0.5, 0.002 * model->dt_s, 0};
        states[0].contacts.push_back({RobotId::kNone, 0, 0, 0, 3 * model->dt_s, 0, {}});
        inspector.begin(scene);
    }
    StateBlock block(std::vector<std::uint32_t> robots, Tick tick) const {
        StateBlock block;
        block.tick = tick;
        for (const std::uint32_t robot : robots) append(block, RobotId(robot), states[robot]);
        return block;
    }
    std::shared_ptr<const Model> model;
    std::shared_ptr<const ShownScene> scene;
    std::vector<RobotState> states;
    Inspector inspector;
};

TEST_F(InspectorTest, WaitsForEverybodyWhereALaserLooks) {
    inspector.take(block({0}, 40));
    EXPECT_FALSE(inspector.shows(RobotId(0u))) << "the other cart may stand in its beams";
    inspector.take(block({1}, 40));
    EXPECT_TRUE(inspector.complete());
    inspector.take(block({0}, 41));
    EXPECT_FALSE(inspector.complete());
    EXPECT_FALSE(inspector.shows(RobotId(99u)));
}

TEST_F(InspectorTest, TellsOfARobotWhatAClientReads) {
    inspector.take(block({0, 1}, 40));
    const Json robot = Json::parse(inspector.robot(RobotId(0u)));
    EXPECT_EQ(robot["scene"], 9);
    EXPECT_EQ(robot["tick"], 40);
    EXPECT_EQ(robot["pose"][2], 1);
    EXPECT_EQ(robot["linear"], Json({1, 2, 3}));
    EXPECT_EQ(robot["angular"], Json({0, 0, 0.5}));
    EXPECT_TRUE(robot["joints"][0]["position"].empty()) << "a fixed joint";
    EXPECT_EQ(robot["joints"][1]["position"][0], 0.5);
    EXPECT_EQ(robot["joints"][1]["velocity"][0], 4);
    EXPECT_EQ(robot["joints"][1]["motors"][0]["mode"], "velocity");
    EXPECT_NEAR(robot["joints"][1]["motors"][0]["effort"], 0.002, 1e-12);
    EXPECT_EQ(robot["contacts"][0]["other"], -1);
    EXPECT_NEAR(robot["contacts"][0]["normal_force"], 3, 1e-12);
    EXPECT_EQ(robot["all_contacts"], true);

    const std::vector<const RobotState*> all = {&states[0], &states[1]};
    const auto laser = sensors_test::read_as<LaserReading>(model, all, 0, 40, 77);
    ASSERT_EQ(robot["sensors"][0]["ranges"].size(), 3u);
    EXPECT_EQ(robot["sensors"][0]["ranges"][1], laser.ranges[1]) << "noise included";
    EXPECT_NEAR(laser.ranges[1], 5.9, 0.2);
    EXPECT_TRUE(robot["sensors"][0]["ranges"][0].is_null()) << "nothing there: JSON has no infinity";
    const auto gps = sensors_test::read_as<GpsReading>(model, all, 1, 40, 77);
    EXPECT_EQ(robot["sensors"][1]["position"][2], gps.p_W.z);
    EXPECT_EQ(robot["sensors"][1]["geodetic"], false);
    EXPECT_NEAR(robot["sensors"][2]["yaw"], 0.1, 1e-9);
    EXPECT_NEAR(robot["sensors"][3]["distance"], 0.025, 1e-12);
}

TEST_F(InspectorTest, TellsOfCommandsSurfacesAndBondsWhereThereAreSome) {
    auto acting = std::make_shared<Model>(*model);
    RobotType& type = acting->types[0];
    OnboardInfo onboard;
    onboard.spec.parameters = VelocityControlSpec{};
    type.onboard.push_back(onboard);
    type.channels.resize(2);
    type.channels[0].channel = {"cmd_vel", "", {{"linear", "m/s"}, {"angular", "rad/s"}}, false};
    type.channels[1].channel = {"path", "", {{"x", "m"}, {"y", "m"}}, true};
    type.channels[1].index = 3, type.channels[1].list_index = 0;
    type.onboard_size = 4, type.list_count = 1;
    for (RobotState& state : states) {
        state.onboard = {12, 0.5, -1, -1};
        state.lists = {{}};
    }
    states[1].onboard[3] = 30;
    states[1].lists = {{1, 2, 3, 4}};
    SurfaceMotion belt;
    belt.link = LinkId(1u), belt.linear_L = {0.3, 0, 0}, belt.angular_L = {0, 0, 2};
    states[1].surfaces = {belt};
    Bond bond;
    bond.phase = BondPhase::kHolds;
    bond.link = LinkId(1u), bond.other = 0, bond.other_link = LinkId(0u);
    bond.max_force = 50, bond.max_torque = std::numeric_limits<double>::infinity();
    bond.force_impulse = Vec3{0, 3, 4} * model->dt_s;
    Bond wall = bond, seeking;
    wall.other = RobotId::kNone, wall.other_link = LinkId();
    seeking.link = LinkId(0u);
    states[1].bonds = {bond, wall, seeking};
    scene = std::make_shared<const ShownScene>(ShownScene{11, acting, scene->file, ViewLayout(*acting)});
    inspector.begin(scene);
    inspector.take(block({0, 1}, 40));
    ASSERT_TRUE(inspector.complete());
    const Json held = Json::parse(inspector.robot(RobotId(0u)));
    const Json holder = Json::parse(inspector.robot(RobotId(1u)));
    EXPECT_EQ(held["channels"][0], Json({{"tick", 12}, {"values", {0.5, -1}}}));
    EXPECT_EQ(held["channels"][1], Json({{"tick", -1}, {"values", Json::array()}}));
    EXPECT_EQ(holder["channels"][1], Json({{"tick", 30}, {"values", {1, 2, 3, 4}}})) << "row by row";
    EXPECT_FALSE(held.contains("surfaces"));
    EXPECT_EQ(holder["surfaces"][0]["link"], 1);
    EXPECT_EQ(holder["surfaces"][0]["linear"], Json({0.3, 0, 0}));
    EXPECT_EQ(holder["surfaces"][0]["angular"], Json({0, 0, 2}));
    ASSERT_EQ(holder["bonds"].size(), 2u) << "what holds nothing yet is no bond";
    EXPECT_EQ(holder["bonds"][1]["other"], -1) << "the scenery";
    EXPECT_EQ(holder["bonds"][0]["other"], 0);
    EXPECT_NEAR(holder["bonds"][0]["force"], 5, 1e-12);
    EXPECT_EQ(holder["bonds"][0]["max_force"], 50);
    EXPECT_TRUE(holder["bonds"][0]["max_torque"].is_null()) << "it never lets go: JSON has no infinity";
    EXPECT_FALSE(held.contains("bonds"));
    EXPECT_EQ(held["held_by"][0]["other"], 1);
    EXPECT_EQ(held["held_by"][0]["other_link"], 1) << "of the holder";
}

TEST_F(InspectorTest, TellsWhoHeardWhomByRadioSinceTheLastLook) {
    auto talking = std::make_shared<Model>(*model);
    RobotType& type = talking->types[0];
    sensors_test::add_sensor(type, 1, sensor("radio", RadioSpec{}));
    const auto radio = static_cast<std::uint32_t>(type.sensors.size() - 1);
    type.radios = {radio};
    for (RobotState& state : states) state.radios.resize(1);
    scene = std::make_shared<const ShownScene>(ShownScene{12, talking, scene->file, ViewLayout(*talking)});
    inspector.begin(scene);
    const auto send = [&](Tick tick) {
        const Order order{tick, ClientId(0u), 0, RobotId(0u), Transmit{0, RobotId(), {1, 2, 3}}};
        apply_order(*talking, order, states[0]);
    };
    const auto look = [&](Tick tick) {
        inspector.take(block({0, 1}, tick));
        return Json::parse(inspector.radio())["radio"];
    };
    send(38);
    const Json first = look(60), quiet = look(61);
    ASSERT_EQ(first["links"].size(), 1u);
    const Json& link = first["links"][0];
    EXPECT_EQ(link["from"], 0);
    EXPECT_EQ(link["to"], 1);
    EXPECT_EQ(link["antenna"], radio);
    EXPECT_EQ(link["sensor"], radio);
    EXPECT_EQ(link["messages"], 1);
    const double strength = 20 - 40 - 25 * std::log10(9.0);  // antennas 9 m apart
    EXPECT_NEAR(link["strength"], strength, 0.2) << "the cart is tilted";
    EXPECT_NEAR(link["margin"], strength + 90, 0.2);
    EXPECT_NEAR(link["time"], 39 * talking->dt_s, 1e-12);
    EXPECT_EQ(first["senders"],
              Json::parse(R"([{"robot": 0, "sensor": )" + std::to_string(radio) + R"(, "messages": 1}])"));
    EXPECT_EQ(first["all"], true);
    EXPECT_TRUE(quiet["links"].empty()) << "told already";
    EXPECT_TRUE(quiet["senders"].empty());
    send(62), send(63);
    EXPECT_EQ(look(80)["links"][0]["messages"], 2);
    EXPECT_EQ(look(70)["links"][0]["messages"], 3) << "after a rewind, all of the last second";
}

TEST_F(InspectorTest, SensorsWithARateAreReadNoOftenerAndShowWhatTheyHold) {
    auto slow = std::make_shared<Model>(*model);
    slow->types[0].sensors[1].spec.update_rate_hz = 1 / (10 * model->dt_s);  // the GPS: each tenth tick
    scene = std::make_shared<const ShownScene>(ShownScene{10, slow, scene->file, ViewLayout(*slow)});
    inspector.begin(scene);
    const auto look = [&](Tick tick) {
        states[0].q[4] = static_cast<double>(tick);  // x
        inspector.take(block({0, 1}, tick));
        return Json::parse(inspector.robot(RobotId(0u)))["sensors"];
    };
    const Json first = look(40), held = look(49), next = look(53), back = look(41);
    EXPECT_EQ(held[1], first[1]);
    EXPECT_NEAR(first[1]["taken"], 40 * model->dt_s, 1e-12);
    EXPECT_NE(held[2]["taken"], first[2]["taken"]) << "the compass has no rate";
    EXPECT_NEAR(next[1]["taken"], 53 * model->dt_s, 1e-12);
    EXPECT_NE(next[1]["world"], first[1]["world"]);
    EXPECT_NEAR(back[1]["taken"], 41 * model->dt_s, 1e-12) << "a rewind";
}

TEST_F(InspectorTest, ContactsThatTheOtherRobotRemembersAreToldWhereItIsKnown) {
    states[0].contacts.push_back({1, 0, 0, 0, 2 * model->dt_s, 0, {}});
    inspector.take(block({0, 1}, 40));
    const Json upper = Json::parse(inspector.robot(RobotId(1u)));
    ASSERT_EQ(upper["contacts"].size(), 1u);
    EXPECT_EQ(upper["contacts"][0]["other"], 0);
    EXPECT_NEAR(upper["contacts"][0]["normal_force"], 2, 1e-12);
}

TEST_F(InspectorTest, NumbersThatAreNotFiniteAreNull) {
    states[1].contacts.push_back({RobotId::kNone, 0, 0, 0, std::numeric_limits<double>::infinity(), 0, {}});
    inspector.take(block({0, 1}, 40));
    const Json contacts = Json::parse(inspector.robot(RobotId(1u)))["contacts"];
    ASSERT_FALSE(contacts.empty());
    EXPECT_TRUE(contacts.back()["normal_force"].is_null());
}

TEST_F(InspectorTest, AStateThatIsNotFiniteIsNotShown) {
    states[1].v[3] = std::numeric_limits<double>::quiet_NaN();
    inspector.take(block({0, 1}, 40));
    EXPECT_FALSE(inspector.shows(RobotId(1u)));
}

}  // namespace
}  // namespace roboss
