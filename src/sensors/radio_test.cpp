// Radio links against their formulas: range, loss rate, order and latency, collisions, obstacles.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>

#include "model/order.h"
#include "sensors/radio_link.h"
#include "sensors/test_model.h"

namespace roboss {
namespace {

using namespace sensors_test;

constexpr double kDt = 1e-3;
constexpr Tick kLater = 1000;

/// Carts with a radio on the mast, 1 m above the cart.
class Air {
  public:
    Air(const RadioSpec& spec, std::vector<Vec3> places) : Air({spec}, std::move(places), {}) {}
    /// Robot i has the radio specs[of[i]].
    Air(const std::vector<RadioSpec>& specs, std::vector<Vec3> places, std::vector<std::size_t> of) {
        model_ = model_of(cart_type(), places.size());
        model_->dt_s = kDt;
        model_->types.clear();
        for (const RadioSpec& spec : specs) {
            RobotType type = cart_type();
            add_sensor(type, 1, sensor("radio", spec));
            type.radios = {0};
            model_->types.push_back(type);
        }
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (!of.empty()) model_->robots[i].type = TypeId(of[i]);
            states_.push_back(cart_at({places[i], {}}));
            states_.back().radios.resize(1);
        }
    }

    Model& model() { return *model_; }
    RobotState& state(std::size_t robot) { return states_[robot]; }
    void send(std::size_t robot, Tick tick, std::vector<std::uint8_t> payload, RobotId to = {}) {
        const Order order{tick, ClientId(0u), 0, RobotId(robot), Transmit{0, to, std::move(payload)}};
        ASSERT_TRUE(check_order(*model_, order).ok());
        apply_order(*model_, order, states_[robot]);
    }
    std::vector<RadioMessage> heard(std::size_t robot, Tick since = -1, Tick tick = kLater,
                                    std::uint64_t seed = 1) {
        std::vector<const RobotState*> states;
        for (const RobotState& state : states_) states.push_back(&state);
        KnownStates sources(model_, states, tick);
        return receive({*model_, RobotId(robot), 0, states_[robot], tick, seed, sources, since}).value();
    }

    /// How many messages all robots hear, together.
    std::size_t heard_by_all(Tick since, Tick tick) {
        std::vector<const RobotState*> states;
        for (const RobotState& state : states_) states.push_back(&state);
        KnownStates sources(model_, states, tick);
        std::size_t count = 0;
        for (std::size_t i = 0; i < states_.size(); ++i)
            count += receive({*model_, RobotId(i), 0, states_[i], tick, 1, sources, since}).value().size();
        return count;
    }

  private:
    std::shared_ptr<Model> model_;
    std::vector<RobotState> states_;
};

std::vector<std::uint8_t> bytes(std::size_t count, std::uint8_t value = 7) {
    return std::vector<std::uint8_t>(count, value);
}

/// Within 4.5 standard deviations of a binomial distribution.
void expect_rate(std::size_t hits, std::size_t tries, double probability) {
    const double n = static_cast<double>(tries), deviation = std::sqrt(n * probability * (1 - probability));
    EXPECT_NEAR(static_cast<double>(hits), n * probability, 4.5 * deviation + 1)
        << "of " << tries << ", probability " << probability;
}

TEST(RadioLink, FormulasAgreeWithTheStandardLibrary) {
    for (double x = 0; x < 26; x += 0.0137)
        EXPECT_NEAR(radio_erfc(x) / std::erfc(x), 1, 1e-10) << "erfc of " << x;
    for (double dBm = -200; dBm < 60; dBm += 1.7) {
        EXPECT_NEAR(radio_power(dBm) / std::pow(10, dBm / 10), 1, 1e-12);
        EXPECT_NEAR(radio_log10(std::pow(10, dBm / 10)), dBm / 10, 1e-12);
    }
    for (double ratio = 0.01; ratio < 30; ratio *= 1.1)
        EXPECT_NEAR(radio_success(ratio, 20), std::pow(1 - std::erfc(std::sqrt(ratio)), 20), 1e-10);
    EXPECT_EQ(radio_success(1e-9, 0), 1) << "a message without bytes";
    EXPECT_LT(radio_success(0, 1), 1e-300);
    EXPECT_EQ(radio_success(1e30, 8000), 1);
}

TEST(Radio, StrengthFallsWithTheLogarithmOfTheDistance) {
    RadioSpec spec;
    spec.tx_power = 17, spec.l0 = 33, spec.fading_exponent = 2.7, spec.noise_floor = -200;
    for (const double distance : {0.5, 1.0, 10.0, 100.0, 3000.0}) {
        Air air(spec, {{}, {0, distance, 0}});
        air.send(0, 1, bytes(3));
        const auto heard = air.heard(1);
        ASSERT_EQ(heard.size(), 1u) << distance;
        EXPECT_NEAR(heard[0].strength_dBm, 17 - 33 - 27 * std::log10(distance), 1e-9);
        EXPECT_TRUE(air.heard(0).empty()) << "a radio does not receive its own messages";
    }
}

TEST(Radio, NothingIsHeardBeyondTheRange) {
    RadioSpec spec;
    spec.range = 50;
    Air air(spec, {{}, {49.99, 0, 0}, {0, 50.01, 0}});
    air.send(0, 1, bytes(3));
    EXPECT_EQ(air.heard(1).size(), 1u);
    EXPECT_TRUE(air.heard(2).empty());
}

TEST(Radio, TheAntennaCountsNotTheRobot) {
    RadioSpec spec;
    spec.range = 2.1;
    Air air(spec, {{}, {0, 0, 4}});
    set_base_pose(air.state(1), {{0, 0, 4}, {0, 1, 0, 0}});  // upside down: its mast is at 3 m
    air.send(0, 1, bytes(1));
    ASSERT_EQ(air.heard(1).size(), 1u);
    set_base_pose(air.state(0), {{90, 0, 0}, {}});
    EXPECT_EQ(air.heard(1).size(), 1u) << "the sender moved on after it had sent";
    set_base_pose(air.state(1), {{0, 0, 4}, {}});
    EXPECT_TRUE(air.heard(1).empty());
}

/// Sends `count` messages of `size` bytes and returns how many arrive.
std::size_t arrivals(const RadioSpec& spec, double distance, std::size_t size, std::size_t count) {
    std::size_t arrived = 0;
    for (std::size_t batch = 0; batch * 500 < count; ++batch) {
        Air air(spec, {{}, {distance, 0, 0}});
        for (std::size_t i = 0; i < 500; ++i) air.send(0, static_cast<Tick>(i), bytes(size));
        arrived += air.heard(1, -1, 100'000, batch + 1).size();
    }
    return arrived;
}

TEST(Radio, TheLossRateIsTheProbability) {
    RadioSpec spec;
    spec.tx_power = 20, spec.bit_rate = 1e8;
    for (const double distance : {370.0, 450.0, 540.0}) {
        const double dBm = 20 - 40 - 25 * std::log10(distance);
        const double ratio = std::pow(10, (dBm + 90) / 10);
        const double success = std::pow(1 - std::erfc(std::sqrt(ratio)), 20);
        ASSERT_GT(success, 0.01);
        ASSERT_LT(success, 0.99);
        expect_rate(arrivals(spec, distance, 20, 4000), 4000, success);
    }
    spec.loss = 0.3;
    expect_rate(arrivals(spec, 1, 20, 4000), 4000, 0.7);
}

TEST(Radio, FadingIsADrawForEachMessage) {
    RadioSpec spec;
    spec.bit_rate = 1e8, spec.sigma = 8;
    const double mean = 20 - 40 - 25 * std::log10(210.0);
    double success = 0;  // its expectation over the normal distribution, by the midpoint rule
    constexpr double kStep = 0.001;
    for (double g = -8 + kStep / 2; g < 8; g += kStep)
        success += kStep * std::exp(-g * g / 2) / std::sqrt(2 * M_PI) *
                   std::pow(1 - std::erfc(std::sqrt(std::pow(10, (mean + 8 * g + 90) / 10))), 20);
    expect_rate(arrivals(spec, 210, 20, 4000), 4000, success);
}

TEST(Radio, DrawsDependOnSeedMessageAndReceiverOnly) {
    RadioSpec spec;
    spec.loss = 0.5, spec.bit_rate = 1e8;
    Air air(spec, {{}, {5, 0, 0}, {0, 5, 0}});
    for (Tick t = 0; t < 200; ++t) air.send(0, t, bytes(4));
    const auto numbers = [&](std::size_t robot, std::uint64_t seed, Tick since, Tick until) {
        std::vector<std::uint64_t> all;
        for (const RadioMessage& m : air.heard(robot, since, until, seed)) all.push_back(m.number);
        return all;
    };
    const auto whole = numbers(1, 9, -1, 500);
    EXPECT_EQ(numbers(1, 9, -1, 500), whole);
    EXPECT_NE(numbers(2, 9, -1, 500), whole) << "another receiver";
    EXPECT_NE(numbers(1, 10, -1, 500), whole) << "another seed";
    std::vector<std::uint64_t> parts;  // observed every 7 ticks
    for (Tick t = 0; t < 500; t += 7)
        for (const std::uint64_t n : numbers(1, 9, t - 7, t)) parts.push_back(n);
    EXPECT_EQ(parts, whole) << "each message once, whatever the period";
}

TEST(Radio, MessagesFollowEachOtherAtTheBitRate) {
    RadioSpec spec;
    spec.bit_rate = 8000;  // a byte in a tick
    spec.latency = 0.02;
    Air air(spec, {{}, {3, 0, 0}});
    air.send(0, 10, bytes(5, 1)), air.send(0, 10, bytes(7, 2)), air.send(0, 30, bytes(2, 3));
    const auto heard = air.heard(1);
    ASSERT_EQ(heard.size(), 3u);
    const Tick arrived[] = {35 + 1, 42 + 1, 52 + 1};  // 3 m take 10 ns, so it is the next tick
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(heard[i].number, i);
        EXPECT_EQ(heard[i].payload.front(), i + 1);
        EXPECT_EQ(heard[i].arrived, arrived[i]);
        EXPECT_EQ(heard[i].sent, i < 2 ? 10 : 30);
        EXPECT_EQ(heard[i].from, RobotId(0u));
    }
    EXPECT_TRUE(air.heard(1, -1, arrived[0] - 1).empty());
    EXPECT_EQ(air.heard(1, arrived[0] - 1, arrived[0]).size(), 1u);
    EXPECT_EQ(air.heard(1, arrived[0], arrived[1]).size(), 1u);
}

TEST(Radio, LightNeedsTime) {
    RadioSpec spec;
    spec.bit_rate = 1e9, spec.noise_floor = -300;
    Air air(spec, {{}, {0, 899'377, 0}});  // 3.0000 ms
    air.send(0, 10, {});
    ASSERT_EQ(air.heard(1).size(), 1u);
    EXPECT_EQ(air.heard(1)[0].arrived, 13) << "to a millionth of a tick";
}

TEST(Radio, WhoIsNotAddressedHearsNothing) {
    Air air(RadioSpec{}, {{}, {5, 0, 0}, {0, 5, 0}});
    air.send(0, 1, bytes(4), RobotId(2u));
    EXPECT_TRUE(air.heard(1).empty());
    ASSERT_EQ(air.heard(2).size(), 1u);
    EXPECT_EQ(air.heard(2)[0].to, RobotId(2u));
}

/// Two senders and a receiver at the origin; both send at once, or the second one later.
std::vector<std::uint32_t> heard_of_two(const RadioSpec& spec, double near, double far, Tick later = 0) {
    Air air(spec, {{}, {near, 0, 0}, {0, far, 0}});
    air.send(1, 1, bytes(50)), air.send(2, 1 + later, bytes(50));
    std::vector<std::uint32_t> from;
    for (const RadioMessage& m : air.heard(0)) from.push_back(m.from.value);
    return from;
}

TEST(Radio, TransmissionsThatOverlapCollide) {
    using Senders = std::vector<std::uint32_t>;
    RadioSpec spec;
    spec.bit_rate = 50 * 8 / (20 * kDt);  // 20 ticks each
    EXPECT_EQ(heard_of_two(spec, 10, 10), Senders{});
    EXPECT_EQ(heard_of_two(spec, 10, 10, 19), Senders{}) << "the last tick of twenty overlaps";
    EXPECT_EQ(heard_of_two(spec, 10, 10, 21), (Senders{1, 2}));
    // 10 dB of 25 log10(ratio): a ratio of 2.512
    EXPECT_EQ(heard_of_two(spec, 10, 25.0), Senders{});
    EXPECT_EQ(heard_of_two(spec, 10, 25.2), Senders{1}) << "captured";
    spec.capture = std::numeric_limits<double>::infinity();
    EXPECT_EQ(heard_of_two(spec, 1, 100), Senders{});
    spec.range = 99;
    EXPECT_EQ(heard_of_two(spec, 1, 100), Senders{1}) << "the other one is not heard at all";
    spec.collisions = false, spec.range = 1000;
    EXPECT_EQ(heard_of_two(spec, 10, 10), (Senders{1, 2}));
}

TEST(Radio, OtherChannelsDoNotCollide) {
    RadioSpec first, second;
    first.bit_rate = second.bit_rate = 1e4, second.channel = 2;
    Air air({first, second}, {{}, {5, 0, 0}, {0, 5, 0}}, {0, 0, 1});
    air.send(1, 1, bytes(50)), air.send(2, 1, bytes(50));
    ASSERT_EQ(air.heard(0).size(), 1u);
    EXPECT_EQ(air.heard(0)[0].from, RobotId(1u));
}

TEST(Radio, WhoSendsHearsNothing) {
    RadioSpec spec;
    spec.bit_rate = 1e4;
    Air air(spec, {{}, {5, 0, 0}});
    air.send(0, 1, bytes(10)), air.send(1, 5, bytes(10));
    EXPECT_TRUE(air.heard(0).empty());
    EXPECT_TRUE(air.heard(1).empty());
}

TEST(Radio, ShapesBetweenTheAntennasWeakenTheSignal) {
    RadioSpec spec;
    spec.obstacle_loss = 12, spec.noise_floor = -200;
    Air air(spec, {{}, {20, 0, 0}, {10, 0, 1}});
    const auto strength = [&] {
        const auto heard = air.heard(1);
        return heard.size() == 1 ? heard[0].strength_dBm : 0;
    };
    const double free = 20 - 40 - 25 * std::log10(20.0);
    air.send(0, 1, bytes(1));
    EXPECT_NEAR(strength(), free - 24, 1e-9) << "the other cart and its wheel are in the way";
    set_base_pose(air.state(2), {{10, 5, 1}, {}});
    EXPECT_NEAR(strength(), free, 1e-9) << "neither own carts nor anything beside counts";
    add_static(air.model(), {ShapeKind::kPlane, {}, 0, 0}, {Mat3::identity(), {0, 0, 0.9}});
    EXPECT_NEAR(strength(), free, 1e-9);
    for (int walls = 1; walls <= 3; ++walls) {
        add_static(air.model(), {ShapeKind::kBox, {0.1, 2, 2}, 0, 0},
                   {Mat3::identity(), {4.0 * walls, 0, 0}});
        EXPECT_NEAR(strength(), free - 12 * walls, 1e-9) << walls << " walls";
    }
}

TEST(Radio, PerfectRadiosHearEverythingAtOnce) {
    RadioSpec spec;
    spec.is_perfect = true, spec.range = 1;
    Air air(spec, {{}, {5000, 0, 0}, {0, 5, 0}});
    air.send(0, 7, bytes(100)), air.send(2, 7, bytes(100));
    ASSERT_EQ(air.heard(1).size(), 2u);
    EXPECT_EQ(air.heard(1)[1].arrived, 8);
}

TEST(Radio, AFullRadioDropsWhatItCannotKeep) {
    RadioSpec spec;
    spec.bit_rate = 1e9;
    Air air(spec, {{}, {5, 0, 0}});
    for (std::size_t i = 0; i < RadioState::kMostKept + 9; ++i) air.send(0, 1, bytes(1));
    const RadioState& radio = air.state(0).radios[0];
    EXPECT_EQ(radio.sent.size(), RadioState::kMostKept);
    EXPECT_EQ(radio.dropped, 9u);
    air.send(0, 1 + static_cast<Tick>(RadioState::kKept_s / kDt) + 1, bytes(1));
    EXPECT_EQ(radio.sent.size(), 1u) << "all others are forgotten";
    EXPECT_EQ(radio.bytes.size(), 1u);
    EXPECT_EQ(radio.count, RadioState::kMostKept + 1);
    for (int i = 0; i < 20; ++i) air.send(0, 5000, bytes(RadioState::kMostPayload));
    EXPECT_EQ(radio.bytes.size(), RadioState::kMostBytes);
    EXPECT_EQ(radio.dropped, 9u + 4u);
}

TEST(Radio, AReadingWithoutATimeShowsTheLastSecond) {
    Air air(RadioSpec{}, {{}, {5, 0, 0}});
    for (const Tick tick : {300, 500, 1200}) air.send(0, tick, bytes(2, 0xA5));
    const auto count = [&](Tick tick) {
        const std::vector<const RobotState*> states{&air.state(0), &air.state(1)};
        const auto model = std::shared_ptr<const Model>(std::shared_ptr<const Model>(), &air.model());
        return read_as<RadioReading>(model, states, 0, tick, 1, 1).count();
    };
    EXPECT_EQ(count(50), 0u);
    EXPECT_EQ(count(600), 2u) << "what was sent before is heard, what is sent later is not";
    EXPECT_EQ(count(1450), 2u);
    EXPECT_EQ(count(9000), 0u) << "the sender keeps them until it sends again";
    const std::vector<const RobotState*> states{&air.state(0), &air.state(1)};
    const auto model = std::shared_ptr<const Model>(std::shared_ptr<const Model>(), &air.model());
    const auto reading = read_as<RadioReading>(model, states, 0, 1450, 1, 1);
    EXPECT_EQ(reading.senders, (std::vector<std::string>{"cart_0", "cart_0"}));
    EXPECT_EQ(reading.payloads[0], "a5a5");
    EXPECT_DOUBLE_EQ(reading.sent[1], 1.2);
    EXPECT_DOUBLE_EQ(reading.arrived[1], 1.201);
}

TEST(Radio, FiveHundredRobotsFloodAChannel) {
    constexpr std::size_t kRobots = 500;
    RadioSpec spec;
    spec.collisions = false, spec.bit_rate = 1e6, spec.range = 40, spec.obstacle_loss = 5;
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < kRobots; ++i)
        places.push_back({5.0 * static_cast<double>(i % 25), 5.0 * static_cast<double>(i / 25), 0});
    Air air(spec, places);
    for (Tick t = 0; t < 1000; t += 10)
        for (std::size_t i = 0; i < kRobots; ++i) air.send(i, t, bytes(32, static_cast<std::uint8_t>(i)));
    std::size_t in_range = 0;
    for (const Vec3& a : places)
        for (const Vec3& b : places) in_range += norm(a - b) > 0 && norm(a - b) <= 40 ? 1 : 0;
    const auto start = std::chrono::steady_clock::now();
    const std::size_t heard = air.heard_by_all(980, 990);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(heard, in_range) << "one message of each in ten ticks; 32 dB above the noise nothing is lost";
    RecordProperty("milliseconds", static_cast<int>(1e3 * took.count()));
    EXPECT_LT(took.count(), 60);

    RadioSpec crowded = spec;
    crowded.collisions = true, crowded.capture = 10;
    Air crowd(crowded, places);
    for (std::size_t i = 0; i < kRobots; ++i) crowd.send(i, 0, bytes(32));
    EXPECT_EQ(crowd.heard_by_all(-1, 50), 0u) << "all send at once";
}

}  // namespace
}  // namespace roboss
