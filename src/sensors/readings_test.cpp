// What each sensor reads of a robot in a known state, and the statistics of its noise.
#include "sensors/readings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sensors/test_model.h"

namespace roboss {
namespace {

using namespace sensors_test;

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kDegree = kPi / 180.0;
const RobotId kFirst(std::size_t{0});

Mounted<LaserSpec> laser_spec() {
    Mounted<LaserSpec> spec;
    spec.samples = 5;
    spec.min_angle = -0.5 * kPi, spec.max_angle = 0.5 * kPi;
    spec.range_min = 0.1, spec.range_max = 20;
    return spec;
}

/// A cart with one sensor on its mast (1 m up).
struct OneSensor {
    std::shared_ptr<Model> model;
    RobotState state = cart_at({}), parked = cart_at({{0, 0, -50}, {}});

    template <class Kind>
    explicit OneSensor(const Mounted<Kind>& spec, std::size_t link = 1) {
        RobotType type = cart_type();
        add_sensor(type, link, sensor("sensor", static_cast<const Kind&>(spec), spec.X_LS));
        model = model_of(type, 3);
    }
    template <class Reading>
    Reading read(Tick tick = 0, std::uint64_t seed = 1, std::size_t robot = 0) const {
        std::vector<const RobotState*> states(3, &parked);
        states[robot] = &state;
        return read_as<Reading>(model, states, 0, tick, seed, robot);
    }
    LaserReading laser(Tick tick, std::uint64_t seed, RobotId robot = kFirst) const {
        return read<LaserReading>(tick, seed, robot.index());
    }
    GpsReading gps(Tick tick = 0) const { return read<GpsReading>(tick); }
    CompassReading compass(Tick tick = 0) const { return read<CompassReading>(tick); }
    OdometerReading odometer(Tick tick = 0) const { return read<OdometerReading>(tick); }
};

/// A wall whose near face is at x = 4 (world), 40 m wide and high.
void add_wall(Model& model) {
    add_static(model, {ShapeKind::kBox, {1, 20, 20}, 0, 0}, {Mat3::identity(), {5, 0, 0}});
}

TEST(Laser, BeamsRunFromRightToLeft) {
    OneSensor cart(laser_spec());
    add_wall(*cart.model);
    add_static(*cart.model, {ShapeKind::kSphere, {}, 1, 0}, {Mat3::identity(), {0, 8, 1}});
    const LaserReading reading = cart.laser(0, 1);
    ASSERT_EQ(reading.ranges.size(), 5u);
    EXPECT_EQ(reading.ranges[0], kFar);
    EXPECT_NEAR(reading.ranges[1], 4 * std::sqrt(2.0), 1e-12);
    EXPECT_NEAR(reading.ranges[2], 4.0, 1e-12);
    EXPECT_NEAR(reading.ranges[3], 4 * std::sqrt(2.0), 1e-12);
    EXPECT_NEAR(reading.ranges[4], 7.0, 1e-12);
}

TEST(Laser, RowsRunFromBelowToAbove) {
    Mounted<LaserSpec> spec = laser_spec();
    spec.samples = 1, spec.min_angle = spec.max_angle = 0;
    spec.vertical_samples = 3, spec.vertical_min_angle = -kPi / 4, spec.vertical_max_angle = kPi / 4;
    OneSensor cart(spec, 1);
    add_static(*cart.model, {ShapeKind::kPlane, {}, 0, 0}, {});
    const LaserReading reading = cart.laser(0, 1);
    ASSERT_EQ(reading.ranges.size(), 3u);
    EXPECT_NEAR(reading.ranges[0], std::sqrt(2.0), 1e-12);
    EXPECT_EQ(reading.ranges[1], kFar);
    EXPECT_EQ(reading.ranges[2], kFar);
}

TEST(Laser, FollowsTheRobotAndItsOwnPlaceOnTheLink) {
    Mounted<LaserSpec> spec = laser_spec();
    spec.samples = 1, spec.min_angle = spec.max_angle = 0;
    spec.X_LS = {{0.5, 0, 0}, from_rpy(0, 0, kPi)};  // half a metre ahead, looking back
    OneSensor cart(spec);
    add_wall(*cart.model);
    cart.state =
        cart_at({{1, 0, 0}, from_rpy(0, 0, kPi)});  // the robot is turned, so the sensor looks at the wall
    EXPECT_NEAR(cart.laser(0, 1).ranges[0], 3.5, 1e-12);
}

TEST(Laser, TooNearIsMinusInfinityAndTooFarPlusInfinity) {
    Mounted<LaserSpec> spec = laser_spec();
    spec.samples = 1, spec.min_angle = spec.max_angle = 0;
    spec.range_min = 1, spec.range_max = 3;
    OneSensor cart(spec);
    add_wall(*cart.model);
    EXPECT_EQ(cart.laser(0, 1).ranges[0], kFar);
    cart.state = cart_at({{1.5, 0, 0}, {}});
    EXPECT_NEAR(cart.laser(0, 1).ranges[0], 2.5, 1e-12);
    cart.state = cart_at({{3.5, 0, 0}, {}});
    EXPECT_EQ(cart.laser(0, 1).ranges[0], -kFar);
}

TEST(Laser, RangesAreMultiplesOfTheResolution) {
    Mounted<LaserSpec> spec = laser_spec();
    spec.range_resolution = 0.25;
    OneSensor cart(spec);
    add_wall(*cart.model);
    EXPECT_EQ(cart.laser(0, 1).ranges[1], 5.75);  // of 5.657
}

TEST(Laser, BeamsMayHaveAnglesOfTheirOwn) {
    Mounted<LaserSpec> spec = laser_spec();
    spec.angles = {-0.5, 0, 0.1, 0.7}, spec.vertical_angles = {-0.3, 0.2};
    OneSensor cart(spec);
    add_wall(*cart.model);
    const LaserReading reading = cart.laser(0, 1);
    EXPECT_EQ(reading.samples, 4);
    EXPECT_EQ(reading.vertical_samples, 2);
    ASSERT_EQ(reading.ranges.size(), 8u);
    std::size_t i = 0;
    for (const double e : spec.vertical_angles)
        for (const double a : spec.angles)
            EXPECT_NEAR(reading.ranges[i++], 4 / (std::cos(e) * std::cos(a)), 1e-12);
}

TEST(Laser, IntensitiesAreThoseOfWhatTheBeamsMeet) {
    OneSensor cart(laser_spec());
    add_wall(*cart.model);
    EXPECT_TRUE(cart.laser(0, 1).intensities.empty()) << "nothing in the world has one";
    cart.model->statics.back().laser_retro = 30;
    add_static(*cart.model, {ShapeKind::kSphere, {}, 1, 0}, {Mat3::identity(), {0, 8, 1}});
    EXPECT_EQ(cart.laser(0, 1).intensities, (std::vector<double>{0, 30, 30, 30, 0}));
    cart.model->statics.back().laser_retro = 7;
    const LaserReading reading = cart.laser(0, 1);
    EXPECT_EQ(reading.intensities, (std::vector<double>{0, 30, 30, 30, 7}));
    cart.model->types[0].shapes[0].laser_retro = 2;  // of another cart, before the wall
    cart.parked = cart_at({{2, 0, 1}, {}});
    EXPECT_EQ(cart.laser(0, 1).intensities, (std::vector<double>{0, 30, 2, 30, 7}));
}

TEST(Laser, ScansOfSeveralRobotsOnAllThreadsAreThoseOfOne) {
    Mounted<LaserSpec> spec = laser_spec();
    spec.samples = 900, spec.vertical_samples = 8, spec.vertical_min_angle = -0.5,
    spec.vertical_max_angle = 0.5;
    spec.noise.stddev = 0.1;
    OneSensor cart(spec);
    add_wall(*cart.model);
    cart.parked = cart_at({{2, 3, 1}, from_rpy(0, 0, 1)});
    const std::vector<const RobotState*> states{&cart.state, &cart.parked, &cart.parked};
    const auto scans = [&](unsigned threads, std::size_t robots) {
        KnownStates sources(cart.model, states);
        sources.ray_scene().set_threads(threads);
        std::vector<SensorQuery> queries;
        for (std::size_t r = 0; r < robots; ++r)
            queries.push_back({*cart.model, RobotId(r), 0, *states[r], 5, 1, sources});
        std::vector<std::vector<double>> ranges;
        for (const Result<Sample>& sample : measure_all(queries))
            ranges.push_back(std::get<LaserReading>(sample.value()).ranges);
        return ranges;
    };
    const auto alone = scans(1, 3);
    ASSERT_EQ(alone.size(), 3u);
    EXPECT_EQ(alone[0], cart.laser(5, 1).ranges);
    EXPECT_NE(alone[1], alone[2]) << "each robot has noise of its own";
    EXPECT_EQ(scans(3, 3), alone);
    EXPECT_EQ(scans(4, 1).at(0), alone[0]) << "a single scan in pieces";
}

TEST(Laser, NoiseHasTheMeanAndDeviationOfTheFile) {
    Mounted<LaserSpec> spec = laser_spec();
    spec.samples = 501, spec.min_angle = -0.2, spec.max_angle = 0.2;
    spec.noise.mean = 0.02, spec.noise.stddev = 0.05;
    OneSensor noisy(spec);
    spec.noise = {};
    OneSensor exact(spec);
    add_wall(*noisy.model);
    add_wall(*exact.model);
    const LaserReading truth = exact.laser(0, 1);
    double sum = 0, squares = 0;
    for (Tick tick = 0; tick < 100; ++tick) {
        const LaserReading reading = noisy.laser(tick, 1);
        for (std::size_t i = 0; i < 501; ++i) {
            const double error = reading.ranges[i] - truth.ranges[i];
            sum += error, squares += error * error;
        }
    }
    const double mean = sum / 50100, deviation = std::sqrt(squares / 50100 - mean * mean);
    EXPECT_NEAR(mean, 0.02, 0.001);
    EXPECT_NEAR(deviation, 0.05, 0.001);
}

TEST(Laser, BiasIsDrawnOnceForEachSensorOfARun) {
    Mounted<LaserSpec> spec = laser_spec();
    spec.samples = 1, spec.min_angle = spec.max_angle = 0;
    spec.noise.bias_mean = 0.5, spec.noise.bias_stddev = 0.1;
    OneSensor cart(spec);
    add_wall(*cart.model);
    const double first = cart.laser(0, 1).ranges[0];
    EXPECT_NEAR(first, 4.5, 0.5);
    EXPECT_NE(first, 4.5);
    EXPECT_EQ(cart.laser(999, 1).ranges[0], first);
    EXPECT_NE(cart.laser(0, 2).ranges[0], first);
    EXPECT_NE(cart.laser(0, 1, RobotId(std::size_t{1})).ranges[0], first);
}

TEST(Laser, SameSeedSameReading) {
    Mounted<LaserSpec> spec = laser_spec();
    spec.noise.stddev = 0.05;
    OneSensor cart(spec);
    add_wall(*cart.model);
    EXPECT_EQ(cart.laser(7, 3).ranges, cart.laser(7, 3).ranges);
    EXPECT_NE(cart.laser(7, 3).ranges, cart.laser(8, 3).ranges);
    EXPECT_NE(cart.laser(7, 3).ranges, cart.laser(7, 4).ranges);
}

Mounted<OdometerSpec> odometer_spec() {
    Mounted<OdometerSpec> spec;
    spec.joints = {"axle"};
    spec.wheel_radius = 0.1;
    return spec;
}

TEST(Odometer, WayIsTheWheelsTurnSinceTheStart) {
    OneSensor cart(odometer_spec());
    cart.state.q[7] = 0.25 + 30;  // starts at 0.25
    cart.state.v[6] = 4;
    const OdometerReading reading = cart.odometer();
    ASSERT_EQ(reading.joint_positions.size(), 1u);
    EXPECT_EQ(reading.joint_positions[0], 30.25);
    EXPECT_EQ(reading.joint_velocities[0], 4);
    EXPECT_DOUBLE_EQ(reading.distance, 3.0);
    EXPECT_DOUBLE_EQ(reading.speed, 0.4);
}

TEST(Odometer, WithoutAWheelRadiusThereAreOnlyAngles) {
    Mounted<OdometerSpec> spec = odometer_spec();
    spec.wheel_radius = 0;
    OneSensor cart(spec);
    cart.state.q[7] = 3, cart.state.v[6] = 2;
    const OdometerReading reading = cart.odometer();
    EXPECT_EQ(reading.joint_positions[0], 3);
    EXPECT_EQ(reading.distance, 0);
    EXPECT_EQ(reading.speed, 0);
}

TEST(Odometer, NoiseIsAFractionOfTheWay) {
    Mounted<OdometerSpec> spec = odometer_spec();
    spec.noise.mean = 0.02, spec.noise.stddev = 0.1;
    OneSensor cart(spec);
    cart.state.q[7] = 0.25 + 1000, cart.state.v[6] = 10;
    double sum = 0, squares = 0;
    for (Tick tick = 0; tick < 20000; ++tick) {
        const OdometerReading reading = cart.odometer(tick);
        EXPECT_DOUBLE_EQ(reading.distance, 102);
        sum += reading.speed, squares += reading.speed * reading.speed;
    }
    const double mean = sum / 20000;
    EXPECT_NEAR(mean, 1.02, 0.003);
    EXPECT_NEAR(std::sqrt(squares / 20000 - mean * mean), 0.1, 0.003);
}

Mounted<GpsSpec> gps_spec() {
    Mounted<GpsSpec> spec;
    spec.X_LS.p = {0.3, 0, 0};
    return spec;
}

TEST(Gps, ReadsThePlaceAndSpeedOfTheAntenna) {
    OneSensor cart(gps_spec());
    cart.state = cart_at({{10, 20, 3}, from_rpy(0, 0, 0.5 * kPi)});
    cart.state.v = {0, 0, 2, 1, 0, 0, 0};  // 2 rad/s about z, 1 m/s along x
    const GpsReading reading = cart.gps();
    EXPECT_NEAR(norm(reading.p_W - Vec3{10, 20.3, 4}), 0, 1e-12);
    EXPECT_NEAR(norm(reading.v_W - Vec3{1 - 0.6, 0, 0}), 0, 1e-12);
    EXPECT_FALSE(reading.geodetic);
}

TEST(Gps, GivesLatitudeAndLongitudeWhereTheWorldHasThem) {
    Mounted<GpsSpec> spec = gps_spec();
    spec.X_LS.p = {};
    OneSensor cart(spec);
    cart.model->spherical = SphericalCoordinates{52.25 * kDegree, 21 * kDegree, 100, 0};
    cart.state = cart_at({{0, 1000, -1}, {}});  // a kilometre north; the mast lifts the sensor to 0
    const GpsReading reading = cart.gps();
    EXPECT_TRUE(reading.geodetic);
    const double meridian =
        6335439.327 / std::pow(1 - 0.00669437999014 * std::pow(std::sin(52.25 * kDegree), 2), 1.5);
    EXPECT_NEAR(reading.latitude_rad, 52.25 * kDegree + 1000 / (meridian + 100), 1e-9);
    EXPECT_NEAR(reading.longitude_rad, 21 * kDegree, 1e-14);
    EXPECT_NEAR(reading.altitude_m, 100 + 1000.0 * 1000.0 / (2 * (meridian + 100)), 1e-4);
}

TEST(Gps, TheWorldsHeadingTurnsItsAxes) {
    Mounted<GpsSpec> spec = gps_spec();
    spec.X_LS.p = {};
    OneSensor cart(spec);
    cart.model->spherical = SphericalCoordinates{0, 0, 0, 0.5 * kPi};  // world x points north
    cart.state = cart_at({{1000, 0, -1}, {}});
    const GpsReading reading = cart.gps();
    EXPECT_NEAR(reading.latitude_rad, 1000 / 6335439.327, 1e-10);
    EXPECT_NEAR(reading.longitude_rad, 0, 1e-14);
}

TEST(Gps, NoiseIsApartForHorizontalAndVertical) {
    Mounted<GpsSpec> spec = gps_spec();
    spec.position_horizontal_noise.stddev = 2;
    spec.position_vertical_noise.stddev = 5;
    spec.velocity_vertical_noise.mean = 0.5;
    OneSensor cart(spec);
    Vec3 sum, squares;
    double xy = 0;
    for (Tick tick = 0; tick < 20000; ++tick) {
        const GpsReading reading = cart.gps(tick);
        const Vec3 e = reading.p_W - Vec3{0.3, 0, 1};
        sum += e, squares += Vec3{e.x * e.x, e.y * e.y, e.z * e.z}, xy += e.x * e.y;
        EXPECT_EQ(reading.v_W, (Vec3{0, 0, 0.5}));
    }
    EXPECT_NEAR(norm(sum / 20000.0), 0, 0.1);
    EXPECT_NEAR(std::sqrt(squares.x / 20000), 2, 0.05);
    EXPECT_NEAR(std::sqrt(squares.y / 20000), 2, 0.05);
    EXPECT_NEAR(std::sqrt(squares.z / 20000), 5, 0.12);
    EXPECT_NEAR(xy / 20000, 0, 0.1);
}

Mounted<CompassSpec> compass_spec() {
    Mounted<CompassSpec> spec;
    return spec;
}

TEST(Compass, HeadingIsClockwiseFromWorldYWithoutSphericalCoordinates) {
    OneSensor cart(compass_spec());
    EXPECT_NEAR(cart.compass().heading_rad, 0.5 * kPi, 1e-12);  // x ahead is east
    cart.state = cart_at({{}, from_rpy(0, 0, 0.5 * kPi)});
    EXPECT_NEAR(std::sin(cart.compass().heading_rad), 0.0, 1e-12);
    EXPECT_NEAR(std::cos(cart.compass().heading_rad), 1.0, 1e-12);
    cart.state = cart_at({{}, from_rpy(0, 0, kPi)});
    EXPECT_NEAR(cart.compass().heading_rad, 1.5 * kPi, 1e-12);
}

TEST(Compass, GyroReadsInSensorAxes) {
    Mounted<CompassSpec> spec = compass_spec();
    spec.X_LS.q = from_rpy(0, 0, 0.5 * kPi);
    OneSensor cart(spec);
    cart.state.v = {1, 2, 3, 0, 0, 0, 0};
    EXPECT_NEAR(norm(cart.compass().angular_velocity_S - Vec3{2, -1, 3}), 0, 1e-12);
}

TEST(Compass, TheGyroHasNoiseOfItsOwnOnEachAxis) {
    Mounted<CompassSpec> spec = compass_spec();
    spec.noise.stddev = 0.3;  // of the angle: it leaves the gyro alone
    OneSensor calm(spec);
    EXPECT_EQ(norm(calm.compass(5).angular_velocity_S), 0);
    spec.gyro_noise.stddev = 0.02;
    spec.gyro_noise.bias_mean = 0.1;
    OneSensor cart(spec);
    Vec3 sum, squares;
    constexpr int kDraws = 4000;
    double product = 0;
    for (Tick tick = 0; tick < kDraws; ++tick) {
        const CompassReading reading = cart.compass(tick);
        EXPECT_EQ(reading.heading_rad, calm.compass(tick).heading_rad)
            << "and the gyro's leaves the angle alone";
        const Vec3 w = reading.angular_velocity_S - Vec3{0.1, 0.1, 0.1};
        sum += w;
        for (std::size_t k = 0; k < 3; ++k) squares[k] += w[k] * w[k];
        product += w.x * w.y;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(sum[k] / kDraws, 0, 0.0015);
        EXPECT_NEAR(std::sqrt(squares[k] / kDraws), 0.02, 0.001);
    }
    EXPECT_LT(std::fabs(product) / kDraws, 0.1 * 0.02 * 0.02) << "axes are drawn apart";
}

TEST(Compass, FeelsTheWorldsMagneticField) {
    Mounted<CompassSpec> spec = compass_spec();
    spec.X_LS.q = axis_angle({0, 0, 1}, 0.5 * kPi);
    OneSensor cart(spec);
    cart.model->magnetic_field_T = {2e-5, 1e-6, -4e-5};
    const Vec3 field = cart.model->magnetic_field_T, read = cart.compass().magnetic_field_S;
    EXPECT_NEAR(norm(read - Vec3{field.y, -field.x, field.z}), 0, 1e-18);
}

TEST(Compass, TheWorldsHeadingCounts) {
    OneSensor cart(compass_spec());
    cart.model->spherical =
        SphericalCoordinates{40 * kDegree, 10 * kDegree, 0, 0.5 * kPi};  // world x points north
    const double heading = cart.compass().heading_rad;
    EXPECT_NEAR(wrap_angle(heading), 0, 1e-12);
}

TEST(Compass, NorthIsThatOfTheSensorsOwnPlace) {
    OneSensor cart(compass_spec());
    cart.model->spherical = SphericalCoordinates{60 * kDegree, 0, 0, 0};
    cart.state = cart_at({{10000, 0, 0}, from_rpy(0, 0, 0.5 * kPi)});  // 10 km east, along the origin's north
    // The meridians converge: north is to the left of the origin's north, by the longitude times the
    // latitude's sine.
    const double longitude = 10000 / (6394209.0 * std::cos(60 * kDegree));
    EXPECT_NEAR(wrap_angle(cart.compass().heading_rad), longitude * std::sin(60 * kDegree), 1e-5);
}

TEST(Compass, NoiseTurnsHeadingAndOrientationTogether) {
    Mounted<CompassSpec> spec = compass_spec();
    spec.noise.stddev = 0.1;
    OneSensor cart(spec);
    double squares = 0;
    for (Tick tick = 0; tick < 20000; ++tick) {
        const CompassReading reading = cart.compass(tick);
        const Vec3 ahead = rotate(reading.q_WS, Vec3{1, 0, 0});
        EXPECT_NEAR(wrap_angle(std::atan2(ahead.x, ahead.y) - reading.heading_rad), 0, 1e-12);
        const double error = wrap_angle(reading.heading_rad - 0.5 * kPi);
        squares += error * error;
    }
    EXPECT_NEAR(std::sqrt(squares / 20000), 0.1, 0.003);
}

TEST(Measure, RefusesWhatIsNotThereInWords) {
    OdometerSpec elsewhere, welded;
    elsewhere.joints = {"axle", "tail"};
    welded.joints = {"mast_joint"};
    RobotType type = cart_type();
    add_sensor(type, 0, sensor("gps", GpsSpec{}));
    add_sensor(type, 0, sensor("camera", UnsupportedSensor{}));
    add_sensor(type, 0, sensor("of_another_part", elsewhere));
    add_sensor(type, 0, sensor("of_a_weld", welded));
    const auto model = model_of(type, 1);
    const RobotState state = cart_at({});
    KnownStates sources(model, {&state});
    const auto refused = [&](std::size_t robot, std::size_t number, const std::string& words) {
        const Result<Sample> sample = measure({*model, RobotId(robot), number, state, 0, 1, sources});
        ASSERT_FALSE(sample) << words;
        EXPECT_NE(sample.error().text().find(words), std::string::npos) << sample.error().text();
    };
    refused(1, 0, "no robot number 1");
    refused(0, 4, "'cart_0' has no sensor number 4");
    refused(0, 1, "'camera' of robot 'cart_0' is of a kind that measures nothing");
    refused(0, 2, "reads joint 'tail', which this robot does not have");
    refused(0, 3, "reads joint 'mast_joint', which does not have one axis");
    const SensorQuery gps{*model, kFirst, 0, state, 0, 1, sources};
    EXPECT_TRUE(measure_as<GpsReading>(gps));
    const Result<LaserReading> wrong = measure_as<LaserReading>(gps);
    ASSERT_FALSE(wrong);
    EXPECT_NE(wrong.error().text().find("is read as a laser"), std::string::npos) << wrong.error().text();
}

TEST(Odometer, OfAStaticModelStandsStill) {
    OneSensor cart(odometer_spec());
    RobotType& type = cart.model->types[0];
    type.is_static = true, type.joints.clear();
    EXPECT_EQ(cart.odometer().joint_positions, std::vector<double>{0});
    EXPECT_EQ(cart.odometer().distance, 0);
}

}  // namespace
}  // namespace roboss
