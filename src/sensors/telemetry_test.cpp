// What plugins publish, read as sensors, against the true poses, velocities and memories.
#include <gtest/gtest.h>

#include <cmath>

#include "sensors/test_model.h"

namespace roboss {
namespace {

using namespace sensors_test;

constexpr double kDegree = 3.14159265358979323846 / 180;

/// A cart that moves with its mast (link 1, 1 m above it), on which the sensor is.
struct MovingCart {
    std::shared_ptr<Model> model;
    RobotState state = cart_at({{1, 2, 3}, from_rpy(0, 0, 30 * kDegree)});

    explicit MovingCart(const SensorParameters& parameters, const Pose& X_LS = {}) {
        RobotType type = cart_type();
        add_sensor(type, 1, sensor("published", parameters, X_LS));
        model = model_of(type, 1);
        const double v[] = {0.1, 0.2, 0.5, 1, -2, 3, 0.7};  // angular, linear, wheel
        state.v.assign(v, v + 7);
    }
    template <class Reading>
    Reading read(Tick tick = 0) const {
        return read_as<Reading>(model, {&state}, 0, tick);
    }
};

void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-12) {
    EXPECT_LT(norm(a - b), tolerance)
        << a.x << " " << a.y << " " << a.z << ", expected " << b.x << " " << b.y << " " << b.z;
}

TEST(Odometry, InThreeDimensionsIsPoseAndBodyVelocityOfItsFrame) {
    OdometrySpec spec;
    spec.dimensions = 3;
    const MovingCart cart(spec, {{0, 0, -1}, {}});  // back down from the mast: the cart's own frame
    const auto reading = cart.read<OdometryReading>();
    const Quat q = from_rpy(0, 0, 30 * kDegree);
    expect_near(reading.position_W, {1, 2, 3});
    expect_near(reading.linear_velocity, rotate(conjugate(q), Vec3{1, -2, 3}));
    expect_near(reading.angular_velocity, rotate(conjugate(q), Vec3{0.1, 0.2, 0.5}));
    EXPECT_NEAR(reading.orientation_W.z, q.z, 1e-12);
}

TEST(Odometry, ItsOffsetMovesAndTurnsTheFrame) {
    OdometrySpec spec;
    spec.dimensions = 3;
    spec.xyz_offset = {0.5, 0, 0}, spec.rpy_offset = {0, 0, 90 * kDegree};
    const MovingCart cart(spec, {{0, 0, -1}, {}});
    const auto reading = cart.read<OdometryReading>();
    const Quat q = from_rpy(0, 0, 30 * kDegree), turned = from_rpy(0, 0, 120 * kDegree);
    const Vec3 arm = rotate(q, Vec3{0.5, 0, 0});
    expect_near(reading.position_W, Vec3{1, 2, 3} + arm);
    expect_near(reading.linear_velocity,
                rotate(conjugate(turned), Vec3{1, -2, 3} + cross(Vec3{0.1, 0.2, 0.5}, arm)));
}

TEST(Odometry, InTwoDimensionsKeepsToThePlaneAndTheHeading) {
    MovingCart cart(OdometrySpec{}, {{0, 0, -1}, {}});
    set_base_pose(cart.state, {{1, 2, 3}, from_rpy(0.2, 0.1, 30 * kDegree)});
    const auto reading = cart.read<OdometryReading>();
    expect_near(reading.position_W, {1, 2, 0});
    const Vec3 ahead = rotate(from_rpy(0, 0, -30 * kDegree), Vec3{1, -2, 0});
    expect_near(reading.linear_velocity, {ahead.x, ahead.y, 0});
    expect_near(reading.angular_velocity, {0, 0, 0.5});
}

TEST(Odometry, OfP3dHasTheAxesOfTheWorld) {
    OdometrySpec spec;
    spec.use_plugin({"gazebo_ros_p3d", "", "mast"});
    spec.xyz_offset = {0, 0, 0.25};
    const MovingCart cart(spec);
    const auto reading = cart.read<OdometryReading>();
    expect_near(reading.position_W, {1, 2, 4.25});
    expect_near(reading.linear_velocity, Vec3{1, -2, 3} + cross(Vec3{0.1, 0.2, 0.5}, Vec3{0, 0, 1}));
    expect_near(reading.angular_velocity, {0.1, 0.2, 0.5});
}

TEST(Odometry, NoiseDisturbsTheVelocitiesOnly) {
    OdometrySpec spec;
    spec.dimensions = 3, spec.gaussian_noise = 0.1;
    const MovingCart cart(spec);
    const auto exact = MovingCart([&] { return spec.gaussian_noise = 0, spec; }()).read<OdometryReading>();
    double sum = 0, squares = 0;
    const int count = 2000;
    for (Tick t = 0; t < count; ++t) {
        const auto reading = cart.read<OdometryReading>(t);
        EXPECT_EQ(reading.position_W.x, exact.position_W.x);
        const double error = reading.angular_velocity.z - exact.angular_velocity.z;
        sum += error, squares += error * error;
    }
    EXPECT_NEAR(sum / count, 0, 0.01);
    EXPECT_NEAR(std::sqrt(squares / count), 0.1, 0.01);
}

TEST(JointStates, AreThoseOfAllMovingJointsOrOfTheChosen) {
    for (const std::vector<std::string>& joints : {std::vector<std::string>{}, {"axle"}}) {
        MovingCart cart(JointStatesSpec{joints});
        cart.model->dt_s = 0.002;
        cart.state.motors[0].mode = MotorMode::kVelocity, cart.state.motors[0].impulse = 0.01;
        const auto reading = cart.read<JointStatesReading>();
        EXPECT_EQ(reading.positions, (std::vector<double>{0.25}));
        EXPECT_EQ(reading.velocities, (std::vector<double>{0.7}));
        EXPECT_EQ(reading.efforts, (std::vector<double>{5}));
    }
    MovingCart pushed(JointStatesSpec{});
    pushed.state.motors[0].mode = MotorMode::kEffort;
    pushed.state.motors[0].target = -7, pushed.state.motors[0].max_effort = 4;
    EXPECT_EQ(pushed.read<JointStatesReading>().efforts, (std::vector<double>{-4})) << "no row acts on it";
    EXPECT_EQ(MovingCart(JointStatesSpec{{"mast_joint"}}).read<JointStatesReading>().positions,
              (std::vector<double>{0}));
}

TEST(LinkPoses, AreThoseInTheModelFrame) {
    LinkPosesSpec spec;
    spec.publish_model_pose = true;
    const auto reading = MovingCart(spec, {{0, 0, -1}, {}}).read<LinkPosesReading>();
    ASSERT_EQ(reading.positions.size(), 12u);  // model, cart, mast, wheel
    const double expected[] = {1, 2, 3, 0, 0, 0, 0, 0, 1, 0.5, 0, 0};
    for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(reading.positions[i], expected[i], 1e-12) << i;
    ASSERT_EQ(reading.orientations.size(), 16u);
    EXPECT_NEAR(reading.orientations[0], std::cos(15 * kDegree), 1e-12);
    EXPECT_NEAR(reading.orientations[12], std::cos(0.125), 1e-12);  // the wheel, turned by 0.25 rad
    EXPECT_NEAR(reading.orientations[14], std::sin(0.125), 1e-12);
}

/// A cart with two batteries, whose second has these numbers.
MovingCart cart_with_batteries(int which) {
    MovingCart cart{BatterySensorSpec{which}};
    LinearBatterySpec first, second;
    first.battery_name = "first", second.battery_name = "second";
    second.capacity = 4, second.invert_current_sign = true;
    RobotType& type = cart.model->types[0];
    for (const LinearBatterySpec& spec : {first, second}) {
        OnboardInfo info;
        info.spec = {"battery", spec, {}};
        info.memory_index = static_cast<int>(cart.state.onboard.size()), info.memory = spec.memory();
        cart.state.onboard.insert(cart.state.onboard.end(), info.memory.begin(), info.memory.end());
        type.onboard.push_back(std::move(info));
    }
    const std::vector<double> numbers{3, 0.5, 11, 1, 1};
    std::copy(numbers.begin(), numbers.end(), cart.state.onboard.begin() + 5);
    return cart;
}

TEST(Battery, IsReadFromTheMemoryOfItsController) {
    const auto reading = cart_with_batteries(1).read<BatteryReading>();
    EXPECT_EQ(reading.charge, 3);
    EXPECT_EQ(reading.current, -0.5);
    EXPECT_EQ(reading.voltage, 11);
    EXPECT_EQ(reading.capacity, 4);
    EXPECT_EQ(reading.percentage, 75);
    EXPECT_TRUE(reading.charging);
}

TEST(Battery, OfARobotThatRunsNoneIsAnError) {
    const MovingCart cart = cart_with_batteries(2);
    KnownStates sources(cart.model, {&cart.state});
    EXPECT_FALSE(measure({*cart.model, RobotId(std::size_t{0}), 0, cart.state, 0, 1, sources}).ok());
}

}  // namespace
}  // namespace roboss
