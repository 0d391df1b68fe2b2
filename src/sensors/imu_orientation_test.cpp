// The orientation of an IMU in the reference frames of SDFormat (REP 145), against rotations worked out by
// hand.
#include <gtest/gtest.h>

#include <cmath>

#include <support/robots.h>
#include <support/simulation.h>

#include "sensors/geodesy.h"
#include "sensors/test_model.h"

namespace roboss {
namespace {

constexpr double kG = 9.81;

/// A box that starts at `start` and now is at `now`, both roll, pitch and yaw, in free flight.
Mat3 orientation(const ImuSpec& imu, const Vec3& start, const Vec3& now, const Pose& X_LS = {},
                 const World& around = test::empty_world(1e-3, {0, 0, -kG})) {
    World world = around;
    ModelSpec box = test::solid_box(2, {0.4, 0.2, 0.1}, test::surface(0.5));
    box.links[0].sensors = {sensors_test::sensor("imu", imu, X_LS)};
    test::place(world, box, "box", {{0, 0, 10}, from_rpy(start.x, start.y, start.z)});
    test::Simulation sim(world);
    const Quat q = from_rpy(now.x, now.y, now.z);
    sim.states[0].q = {0, 0, 10, q.w, q.x, q.y, q.z};
    return to_matrix(sensors_test::read_as<ImuReading>(sim.model, {&sim.states[0]}, 0).orientation);
}

Mat3 turned(const Vec3& rpy) {
    return to_matrix(from_rpy(rpy.x, rpy.y, rpy.z));
}

double apart(const Mat3& a, const Mat3& b) {
    return norm(a.r0 - b.r0) + norm(a.r1 - b.r1) + norm(a.r2 - b.r2);
}

ImuSpec in_frame(const std::string& localization) {
    ImuSpec imu;
    imu.localization = localization;
    return imu;
}

const Vec3 kStart{0.1, -0.2, 0.7}, kNow{-0.4, 0.3, 2};

TEST(ImuOrientation, WithoutAReferenceFrameItIsAgainstTheStart) {
    const Pose X_LS{{0.1, 0, 0}, from_rpy(0, 0.5, 0)};
    const Mat3 mount = to_matrix(X_LS.q);
    const Mat3 expected = transpose(turned(kStart) * mount) * (turned(kNow) * mount);
    EXPECT_LT(apart(orientation({}, kStart, kNow, X_LS), expected), 1e-12);
    EXPECT_LT(apart(orientation({}, kStart, kStart, X_LS), Mat3::identity()), 1e-12);
}

TEST(ImuOrientation, EnuNedAndNwuNameTheirAxes) {
    EXPECT_LT(apart(orientation(in_frame("ENU"), kStart, kNow), turned(kNow)), 1e-12);
    // NED: level with the nose to the north (world y): x ahead is north, z down. Rows are north, east, down.
    const Mat3 ned = orientation(in_frame("NED"), kStart, {0, 0, kPi / 2});
    EXPECT_LT(apart(ned, {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}), 1e-12);
    const Mat3 nwu = orientation(in_frame("NWU"), kStart, {0, 0, kPi / 2});
    EXPECT_LT(apart(nwu, Mat3::identity()), 1e-12);
}

TEST(ImuOrientation, NorthIsTrueNorthAtTheWorldsOrigin) {
    World world = test::empty_world(1e-3, {0, 0, -kG});
    world.spherical = SphericalCoordinates{0.8, 0.3, 100, 0.6};
    const Mat3 world_in_enu = transpose(east_north_up(0.8, 0.3)) * world_to_earth(*world.spherical);
    const Mat3 enu = orientation(in_frame("ENU"), kStart, kNow, {}, world);
    EXPECT_LT(apart(enu, world_in_enu * turned(kNow)), 1e-12);
    EXPECT_GT(apart(enu, turned(kNow)), 0.5) << "the world's heading counts";
}

TEST(ImuOrientation, CustomTurnsTheFrameThatItNames) {
    ImuSpec imu;
    imu.custom_rpy = {0.3, 0.2, -1};
    const Mat3 turn = turned(imu.custom_rpy);
    imu.custom_rpy_frame = "world";
    EXPECT_LT(apart(orientation(imu, kStart, kNow), transpose(turn) * turned(kNow)), 1e-12);
    imu.custom_rpy_frame = "";
    EXPECT_LT(apart(orientation(imu, kStart, kNow), transpose(turned(kStart) * turn) * turned(kNow)), 1e-12);
    imu.custom_rpy_frame = test::solid_box(2, {0.4, 0.2, 0.1}, test::surface(0.5)).links[0].name;
    EXPECT_LT(apart(orientation(imu, kStart, kNow, {{}, from_rpy(0, 0, 1)}),
                    transpose(turned(kStart) * turn) * turned(kNow) * turned({0, 0, 1})),
              1e-12);
}

TEST(ImuOrientation, GravityGivesTheVerticalAndADirectionTheHeading) {
    World tilted = test::empty_world(1e-3, {0, kG * std::sin(0.3), -kG * std::cos(0.3)});
    ImuSpec imu = in_frame("GRAV_UP");
    imu.gravity_x = {2, 0, 1}, imu.gravity_x_frame = "world";
    const Vec3 up{0, -std::sin(0.3), std::cos(0.3)};
    const Vec3 x = normalized(imu.gravity_x - up * dot(imu.gravity_x, up));
    const Mat3 expected{x, cross(up, x), up};  // world to frame
    EXPECT_LT(apart(orientation(imu, kStart, kNow, {}, tilted), expected * turned(kNow)), 1e-12);
    imu.localization = "GRAV_DOWN";
    const Mat3 down{x, cross(-up, x), -up};
    EXPECT_LT(apart(orientation(imu, kStart, kNow, {}, tilted), down * turned(kNow)), 1e-12);
}

TEST(ImuOrientation, ADirectionAlongGravityIsAnError) {
    World world = test::empty_world(1e-3, {0, 0, -kG});
    ImuSpec imu = in_frame("GRAV_UP");
    imu.gravity_x = {0, 0, 1}, imu.gravity_x_frame = "world";
    ModelSpec box = test::solid_box(2, {0.4, 0.2, 0.1}, test::surface(0.5));
    box.links[0].sensors = {sensors_test::sensor("imu", imu)};
    imu.gravity_x = {1, 0, 0}, imu.gravity_x_frame = "nowhere";
    box.links[0].sensors.push_back(sensors_test::sensor("lost", imu));
    test::place(world, box, "box", {{0, 0, 10}, {}});
    test::Simulation sim(world);
    sensors_test::KnownStates sources(sim.model, {&sim.states[0]});
    for (const std::size_t sensor : {0u, 1u})
        EXPECT_FALSE(measure({*sim.model, RobotId(0U), sensor, sim.states[0], 0, 1, sources}).ok()) << sensor;
}

TEST(ImuOrientation, IsNothingWhereTheFileTurnsItOff) {
    ImuSpec imu;
    imu.enable_orientation = false;
    World world = test::empty_world(1e-3, {0, 0, -kG});
    ModelSpec box = test::solid_box(2, {0.4, 0.2, 0.1}, test::surface(0.5));
    box.links[0].sensors = {sensors_test::sensor("imu", imu)};
    test::place(world, box, "box", {{0, 0, 10}, {}});
    test::Simulation sim(world);
    EXPECT_EQ(sensors_test::read_as<ImuReading>(sim.model, {&sim.states[0]}, 0).orientation,
              (Quat{0, 0, 0, 0}));
}

}  // namespace
}  // namespace roboss
