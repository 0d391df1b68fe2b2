// When samples are due, and that held ones survive being bytes.
#include "client/held_samples.h"

#include <gtest/gtest.h>

#include <cmath>

namespace roboss {
namespace {

/// The ticks at which a sensor of this rate has a new sample, up to `last`.
std::vector<Tick> due(double rate_hz, double dt_s, Tick last) {
    std::vector<Tick> ticks{0};
    for (Tick t = 1; t <= last; ++t)
        if (samples_begun(rate_hz, dt_s, t) != samples_begun(rate_hz, dt_s, t - 1)) ticks.push_back(t);
    return ticks;
}

TEST(SamplesBegun, ARateThatDividesTheTicksIsEvenlySpaced) {
    EXPECT_EQ(due(20, 1e-3, 200), (std::vector<Tick>{0, 50, 100, 150, 200}));
    EXPECT_EQ(due(1, 2e-3, 1500), (std::vector<Tick>{0, 500, 1000, 1500}));
    for (const double rate : {10.0, 20.0, 25.0, 40.0, 50.0, 100.0, 200.0, 250.0, 500.0})
        for (Tick k = 1; k < 100000; k = 3 * k + 1) {
            const auto ticks = static_cast<Tick>(std::floor(1000 / rate + 0.5));
            EXPECT_EQ(samples_begun(rate, 1e-3, k * ticks), k) << rate << " Hz";
            EXPECT_EQ(samples_begun(rate, 1e-3, k * ticks - 1), k - 1) << rate << " Hz";
        }
}

TEST(SamplesBegun, ARateThatDoesNotIsExactInTheLongRun) {
    EXPECT_EQ(due(30, 1e-3, 140), (std::vector<Tick>{0, 34, 67, 100, 134}));
    EXPECT_EQ(samples_begun(30, 1e-3, 3'600'000), 108'000) << "an hour";
    EXPECT_EQ(samples_begun(60, 5e-3, 720'000), 216'000);
}

TEST(SamplesBegun, ThereIsAtMostOneSampleATick) {
    for (const double rate : {1000.0, 1500.0, 1e9})
        EXPECT_EQ(due(rate, 1e-3, 3), (std::vector<Tick>{0, 1, 2, 3}));
}

LaserReading laser(Tick tick) {
    return {2, 1, {0.5, std::numeric_limits<double>::infinity()}, {0.5, 3}, tick};
}

TEST(HeldSamples, ALasersSampleHasARangeForEachBeam) {
    LaserSpec spec;
    spec.samples = 2;
    SensorSpec sensor;
    sensor.parameters = spec;
    LaserReading reading = laser(10);
    EXPECT_TRUE(has_its_beams(sensor, reading));
    reading.intensities.clear();
    EXPECT_TRUE(has_its_beams(sensor, reading));
    reading.intensities = {1};
    EXPECT_FALSE(has_its_beams(sensor, reading));
    reading = laser(10);
    reading.ranges.push_back(1);
    EXPECT_FALSE(has_its_beams(sensor, reading));
    EXPECT_TRUE(has_its_beams(sensor, GpsReading{}));
}

HeldSamples some() {
    HeldSamples held;
    held.put({3, 1}, laser(10));
    GpsReading gps;
    gps.p_W = {1, -2, 0.1}, gps.geodetic = true, gps.altitude_m = 30, gps.tick = 11;
    held.put({3, 0}, gps);
    CompassReading compass;
    compass.q_WS = {0.8, 0, 0.6, 0}, compass.heading_rad = 1.5, compass.tick = 12;
    held.put({0, 7}, compass);
    OdometerReading odometer;
    odometer.joint_positions = {1, 2}, odometer.joint_velocities = {3, 4}, odometer.speed = -0.0,
    odometer.tick = 13;
    held.put({5, 0}, odometer);
    LogicalCameraReading camera;
    camera.names = {"a", "", "wall"}, camera.models = {2, 3, -1}, camera.tick = 13;
    held.put({6, 2}, camera);
    return held;
}

TEST(HeldSamples, SurviveBeingBytes) {
    const std::string bytes = some().bytes_before(14);
    HeldSamples back;
    const Result<> restored = back.restore(bytes);
    ASSERT_TRUE(restored.ok()) << restored.error().text();
    EXPECT_EQ(back.bytes_before(14), bytes);
    ASSERT_NE(back.find({3, 1}), nullptr);
    EXPECT_EQ(std::get<LaserReading>(*back.find({3, 1})).ranges, laser(10).ranges);
    EXPECT_EQ(std::get<GpsReading>(*back.find({3, 0})).p_W, (Vec3{1, -2, 0.1}));
    EXPECT_EQ(taken_at(*back.find({0, 7})), 12);
    EXPECT_EQ(std::get<OdometerReading>(*back.find({5, 0})).joint_velocities, (std::vector<double>{3, 4}));
    ASSERT_NE(back.find({6, 2}), nullptr);
    EXPECT_EQ(std::get<LogicalCameraReading>(*back.find({6, 2})).names,
              (std::vector<std::string>{"a", "", "wall"}));
}

TEST(HeldSamples, GoBackToWhatWasHeldBeforeAnObservation) {
    HeldSamples held;
    held.put({0, 0}, laser(10));
    const std::string before = held.bytes_before(20);
    held.put({0, 0}, laser(20));
    held.put({0, 1}, laser(20));
    EXPECT_EQ(held.bytes_before(20), before);
    EXPECT_NE(held.bytes_before(21), before);
    EXPECT_EQ(HeldSamples().bytes_before(20), "");
}

TEST(HeldSamples, BytesThatAreDamagedAreRefusedAndChangeNothing) {
    HeldSamples held = some();
    const std::string good = held.bytes_before(14);
    for (std::size_t length = 1; length < good.size(); ++length) {
        HeldSamples part;
        if (part.restore(good.substr(0, length)).ok()) {
            EXPECT_EQ(part.bytes_before(14).size(), length == 4 ? 0 : length) << "whole samples only";
        }
    }
    std::string bad = good;
    bad[12] = 9;  // the kind of the first sample
    const Result<> refused = held.restore(bad);
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().message.find("no known kind"), std::string::npos) << refused.error().text();
    EXPECT_EQ(held.bytes_before(14), good);
    bad[12] = static_cast<char>(ColorCameraSpec::kKind.number);
    EXPECT_FALSE(held.restore(bad).ok()) << "images are never held";
    EXPECT_EQ(held.bytes_before(14), good);
}

}  // namespace
}  // namespace roboss
