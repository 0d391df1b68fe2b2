// Questions of control programs about what does not exist are refused in words; they harm nothing.
#include "client/client.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

#include <support/robots.h>

namespace roboss::test {
namespace {

const RobotId kRover(0u);

/// A car with a laser, a GPS receiver of 10 Hz, a compass, an odometer, a camera and an IMU.
std::shared_ptr<const Model> rover_world() {
    ModelSpec rover = car();
    LaserSpec laser;
    laser.range_max = 10;
    for (const SensorParameters& parameters :
         {SensorParameters(laser), SensorParameters(GpsSpec{}), SensorParameters(CompassSpec{}),
          SensorParameters(OdometerSpec{}), SensorParameters(UnsupportedSensor{}),
          SensorParameters(ImuSpec{})}) {
        SensorSpec sensor;
        sensor.name = "sensor_" + std::to_string(rover.links[0].sensors.size());
        sensor.parameters = parameters, sensor.sdf_type = "thermal_camera";
        if (sensor.as<GpsSpec>() != nullptr) sensor.update_rate_hz = 10;
        rover.links[0].sensors.push_back(sensor);
    }
    World world = empty_world(1e-3);
    place(world, rover, "rover");
    Diagnostics diagnostics;
    return compile(world, {}, diagnostics);
}

/// Sees the start of the world, for ever.
class StillClient : public Client {
  public:
    const Model& model() const override { return *model_; }
    Tick tick() const override { return 0; }
    const RobotState& state(RobotId robot) const override {
        (void)known(robot);
        return state_;
    }
    std::uint64_t seed() const override { return 1; }
    Result<> order(RobotId, const Action&) override { return Ok{}; }
    void control(ControlAction) override {}
    std::vector<ControlAnswer> take_control_answers() override { return {}; }

  protected:
    RayScene& ray_scene() override { return rays_; }

  private:
    std::shared_ptr<const Model> model_ = rover_world();
    RobotState state_ = initial_state(*model_, kRover);
    RayScene rays_{model_};
};

class Questions : public testing::Test {
  protected:
    void expect_refused(const std::function<void()>& question, const std::vector<std::string>& words) {
        try {
            question();
            ADD_FAILURE() << "was answered; expected: " << words[0];
        } catch (const std::invalid_argument& e) {
            const std::string text = e.what();
            for (const std::string& word : words)
                EXPECT_NE(text.find(word), std::string::npos) << word << " is not in: " << text;
        }
    }
    StillClient client;
};

TEST_F(Questions, AnswersSensorsOfTheRightKind) {
    EXPECT_EQ(client.laser(kRover, 0).ranges.size(), 1u);
    EXPECT_NO_THROW((void)client.gps(kRover, 1));
    EXPECT_NO_THROW((void)client.gps(kRover, 1)) << "a held sample";
    EXPECT_NO_THROW((void)client.compass(kRover, 2));
    EXPECT_NO_THROW((void)client.odometer(kRover, 3));
    EXPECT_NEAR(norm(client.imu(kRover, 5).specific_force_S), 0, 1e-9) << "it falls";
}

TEST_F(Questions, RefusesASensorThatTheRobotDoesNotHave) {
    for (const std::size_t sensor : {std::size_t{6}, std::size_t{99}, ~std::size_t{0}})
        expect_refused(
            [&] { (void)client.laser(kRover, sensor); },
            {"robot 'rover' has no sensor number " + std::to_string(sensor), "0 'sensor_0'", "4 'sensor_4'"});
}

TEST_F(Questions, RefusesASensorOfAnotherKind) {
    expect_refused([&] { (void)client.gps(kRover, 0); },
                   {"sensor 0 'sensor_0'", "'rover' is read as a GPS receiver", "it is a laser"});
    expect_refused([&] { (void)client.laser(kRover, 3); }, {"sensor 3", "as a laser", "it is an odometer"});
    expect_refused([&] { (void)client.odometer(kRover, 2); }, {"sensor 2", "as an odometer", "a compass"});
    expect_refused([&] { (void)client.compass(kRover, 1); }, {"sensor 1", "as a compass", "a GPS receiver"});
    (void)client.gps(kRover, 1);
    expect_refused([&] { (void)client.laser(kRover, 1); }, {"sensor 1", "as a laser", "a GPS receiver"});
}

TEST_F(Questions, RefusesASensorThatMeasuresNothing) {
    expect_refused([&] { (void)client.laser(kRover, 4); },
                   {"sensor 4 'sensor_4' of robot 'rover'", "measures nothing (thermal_camera)"});
}

TEST_F(Questions, RefusesUnknownRobotsLinksJointsAndAxes) {
    for (const RobotId robot : {RobotId(1u), RobotId()}) {
        const std::string number = "no robot number " + std::to_string(robot.value);
        expect_refused([&] { (void)client.state(robot); }, {number, "1 robots"});
        expect_refused([&] { (void)client.gps(robot, 1); }, {number});
        expect_refused([&] { (void)client.pose(robot, LinkId(0u)); }, {number});
        expect_refused([&] { (void)client.twist(robot, LinkId(0u)); }, {number});
        expect_refused([&] { (void)client.joint(robot, JointId(0u)); }, {number});
        expect_refused([&] { (void)client.joint_reactions(robot); }, {number});
    }
    expect_refused([&] { (void)client.pose(kRover, LinkId(5u)); },
                   {"robot 'rover' has no link number 5", "0 'chassis'"});
    expect_refused([&] { (void)client.twist(kRover, LinkId()); }, {"robot 'rover' has no link number"});
    expect_refused([&] { (void)client.joint(kRover, JointId(4u)); },
                   {"robot 'rover' has no joint number 4", "3 'wheel_3'"});
    expect_refused([&] { (void)client.joint(kRover, JointId(0u), 1); },
                   {"joint 'wheel_0' of robot 'rover' has no axis 1", "1 degrees of freedom"});
    expect_refused([&] { (void)client.joint(kRover, JointId(0u), -1); }, {"no axis -1"});
}

TEST_F(Questions, AnswersByName) {
    EXPECT_EQ(client.robot("rover"), kRover);
    EXPECT_EQ(client.link(kRover, "chassis"), LinkId(0u));
    EXPECT_EQ(client.joint_id("rover", std::string("wheel_3")), JointId(3u));
    EXPECT_EQ(client.sensor("rover", std::string_view("sensor_2")), 2u);
    EXPECT_EQ(client.pose("rover", "chassis").p.x, client.pose(kRover, LinkId(0u)).p.x);
    EXPECT_EQ(client.joint("rover", "wheel_0").position, client.joint(kRover, JointId(0u)).position);
    EXPECT_EQ(client.laser("rover", "sensor_0").ranges.size(), 1u);
    EXPECT_TRUE(client.set_joint("rover", "wheel_0", MotorMode::kVelocity, 1).ok());
    EXPECT_NO_THROW(client.set_pose("rover", Pose{}).value());
}

TEST_F(Questions, RefusesUnknownNamesAndSaysWhatWasProbablyMeant) {
    expect_refused([&] { (void)client.pose("rovr", "chassis"); }, {"no robot 'rovr'", "mean 'rover'?"});
    expect_refused([&] { (void)client.pose("rover", "chasis"); }, {"no link 'chasis'", "mean 'chassis'?"});
    expect_refused([&] { (void)client.laser("rover", "lidar"); },
                   {"no sensor 'lidar'", "it has 0 'sensor_0'"});
    const auto turn = [&] { client.set_joint("rover", "weel_1", MotorMode::kVelocity, 1).value(); };
    expect_refused(turn, {"robot 'rover' has no joint 'weel_1'", "did you mean 'wheel_1'?", "0 'wheel_0'"});
    expect_refused(
        [&] {
            client.command("rover", "cmd_vel", {1, 0}).value();
        },
        {"no command 'cmd_vel'", "none"});
}

}  // namespace
}  // namespace roboss::test
