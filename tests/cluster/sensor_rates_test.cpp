// Sensors with an <update_rate>: new samples at that rate and held ones in between, the same over a saved
// run.
#include <gtest/gtest.h>

#include <cmath>

#include <support/bodies.h>
#include <support/robots.h>

#include "simulation/simulation.h"

namespace roboss::test {
namespace {

constexpr double kDt = 2e-3, kGpsRate = 30, kLaserRate = 20;
const RobotId kBox(0u);

/// A box that flies, tumbling, past a wall: GPS (30 Hz, noisy), laser (20 Hz), compass (whenever asked).
std::shared_ptr<const Model> flying_box() {
    ModelSpec box = solid_box(1, {0.4, 0.2, 0.1}, surface(0.5));
    SensorSpec gps, laser, compass;
    GpsSpec antenna;
    antenna.position_horizontal_noise.stddev = 0.1;
    gps.name = "gps", gps.parameters = antenna, gps.update_rate_hz = kGpsRate;
    LaserSpec beams;
    beams.samples = 5, beams.min_angle = -1, beams.max_angle = 1, beams.range_max = 30,
    beams.noise.stddev = 0.01;
    laser.name = "laser", laser.parameters = beams, laser.update_rate_hz = kLaserRate;
    CompassSpec needle;
    needle.noise.stddev = 0.1;
    compass.name = "compass", compass.parameters = needle;
    box.links[0].sensors = {gps, laser, compass};
    World world = empty_world(kDt, {});
    place(world, box, "box");
    ModelSpec wall = solid_box(1, {0.1, 50, 50}, surface(0.5));
    wall.is_static = true;
    place(world, wall, "wall", {{5, 0, 0}, {}});
    Diagnostics diagnostics;
    return compile(world, {}, diagnostics);
}

/// All that the program has read at one observation.
struct Seen {
    Tick tick = 0, gps = 0, laser = 0, compass = 0;
    Vec3 place;
    std::vector<double> ranges;
    friend bool operator==(const Seen&, const Seen&) = default;
};

class Reading : public ControlProgram {
  public:
    Reading(double period_s, Tick every, std::vector<Seen>& seen)
        : period_s_(period_s), every_(every), seen_(seen) {}
    ControlOptions options() const override { return {period_s_, -1, true}; }
    void control(Client& client) override {
        if (client.tick() == 0) (void)client.set_velocity(kBox, {1, 2, 3}, {0.5, -0.4, 0.3});
        if (client.tick() % every_ != 0) return;
        const GpsReading gps = client.gps(kBox, 0);
        const LaserReading laser = client.laser(kBox, 1);
        seen_.push_back(
            {client.tick(), gps.tick, laser.tick, client.compass(kBox, 2).tick, gps.p_W, laser.ranges});
    }

  private:
    double period_s_;
    Tick every_;
    std::vector<Seen>& seen_;
};

std::vector<NamedProgram> reader(double period_s, Tick every, std::vector<Seen>& seen) {
    std::vector<NamedProgram> programs;
    programs.push_back({"reader", std::make_unique<Reading>(period_s, every, seen)});
    return programs;
}

std::vector<Seen> read(double period_s, Tick every, Tick until) {
    std::vector<Seen> seen;
    auto simulation = Simulation::create(flying_box(), {}, reader(period_s, every, seen));
    EXPECT_TRUE(simulation.value()->run_until(until).ok());
    return seen;
}

/// The first tick of a multiple of `period` at or after which sample k is due, for the last k due by `tick`.
Tick last_due(double rate, Tick period, Tick tick) {
    Tick last = 0;
    for (int k = 0;; ++k) {
        const Tick at = static_cast<Tick>(std::ceil(k / (rate * kDt) - 1e-9));
        const Tick seen = (at + period - 1) / period * period;
        if (seen > tick) return last;
        last = seen;
    }
}

TEST(SensorRates, NewSamplesComeAtTheRateAndAreHeldInBetween) {
    for (const Tick period : {Tick{1}, Tick{7}, Tick{40}}) {
        const std::vector<Seen> seen = read(static_cast<double>(period) * kDt, 1, 300);
        ASSERT_FALSE(seen.empty());
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const Seen& s = seen[i];
            EXPECT_EQ(s.gps, last_due(kGpsRate, period, s.tick)) << "tick " << s.tick;
            EXPECT_EQ(s.laser, last_due(kLaserRate, period, s.tick)) << "tick " << s.tick;
            EXPECT_EQ(s.compass, s.tick) << "it has no rate";
            if (i == 0) continue;
            EXPECT_EQ(s.place == seen[i - 1].place, s.gps == seen[i - 1].gps) << "noise included";
            EXPECT_EQ(s.ranges == seen[i - 1].ranges, s.laser == seen[i - 1].laser);
        }
    }
}

TEST(SensorRates, OnceAskedASensorMeasuresOnTimeWhetherAskedOrNot) {
    const std::vector<Seen> all = read(kDt, 1, 300), few = read(kDt, 11, 300);
    ASSERT_GT(few.size(), 20u);
    for (const Seen& s : few) EXPECT_EQ(s, all[static_cast<std::size_t>(s.tick)]);
}

TEST(SensorRates, ASavedRunReadsOnAsIfItHadNeverStopped) {
    const std::vector<Seen> whole = read(4 * kDt, 1, 200);
    for (const Tick stop : {Tick{1}, Tick{49}, Tick{50}, Tick{51}, Tick{52}, Tick{67}, Tick{68}, Tick{100}}) {
        std::vector<Seen> seen;
        SavedRun saved;
        {
            auto first = Simulation::create(flying_box(), {}, reader(4 * kDt, 1, seen));
            ASSERT_TRUE(first.value()->run_until(stop).ok());
            saved = first.value()->saved_run();
        }
        while (!seen.empty() && seen.back().tick >= stop) seen.pop_back();  // it will be asked again
        auto second = Simulation::create(flying_box(), {}, reader(4 * kDt, 1, seen), &saved);
        ASSERT_TRUE(second.ok()) << second.error().text();
        ASSERT_TRUE(second.value()->run_until(200).ok());
        EXPECT_EQ(seen, whole) << "stopped at tick " << stop;
    }
}

TEST(SensorRates, AMemoryThatIsDamagedEndsTheRunAndSaysWhy) {
    std::vector<Seen> seen;
    auto first = Simulation::create(flying_box(), {}, reader(4 * kDt, 1, seen));
    ASSERT_TRUE(first.value()->run_until(50).ok());
    const SavedRun saved = first.value()->saved_run();
    for (const std::size_t length : {std::size_t{3}, std::size_t{20}}) {
        SavedRun damaged = saved;
        damaged.memory.at("reader").resize(length);
        auto second = Simulation::create(flying_box(), {}, reader(4 * kDt, 1, seen), &damaged);
        const Result<> ran = second.value()->run_until(200);
        ASSERT_FALSE(ran.ok());
        EXPECT_EQ(ran.error().code, "client-failed") << ran.error().text();
    }
}

}  // namespace
}  // namespace roboss::test
