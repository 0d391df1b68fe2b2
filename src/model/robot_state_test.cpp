// States as bytes: a round trip keeps every bit, and bytes that do not fit are refused, never half read.
#include "model/robot_state.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include <support/robots.h>

namespace roboss::test {
namespace {

std::shared_ptr<const Model> two_robots() {
    World world = empty_world(1e-3);
    place(world, car(), "car", {{1, 2, 3}, from_rpy(0.1, 0.2, 0.3)});
    place(world, ball_chain(), "chain");
    Diagnostics diagnostics;
    return compile(world, {}, diagnostics);
}

constexpr std::size_t kMotorWords = 5;

class StateBytes : public testing::Test {
  protected:
    StateBytes() : state_(initial_state(*model_, RobotId(std::size_t{0}))) {
        state_.v[3] = 5e-324;  // the smallest denormal
        state_.v[4] = -0.0;
        state_.motors[2] = {MotorMode::kPosition, 1.0 / 3, std::numeric_limits<double>::infinity(), 0.3,
                            -0.2};
        state_.wrenches.push_back({LinkId(std::size_t{3}), {1, 2, 3}, {4, 5, 6}, -7});
        state_.contacts.push_back({RobotId::kNone, 1, 2, 3, 0.25, 0.125, {0.1, -0.2, 0.3}});
        state_.contacts.push_back({4, 0xFFFFFFFFu, 0xFFFFFFFEu, 0xFFFFFFFDu, 1e300, 0, {}});
        state_.rest = {17, true, {3, 9}, {{1, 2, 3}, {4, 5, 6}}};
        encode(state_, bytes_);
    }
    const RobotType& type() const { return model_->types[0]; }
    bool accepts(const std::vector<std::uint8_t>& bytes) const { return decode_state(bytes, type()).ok(); }
    void put_word(std::size_t index, std::uint64_t word) {
        for (std::size_t i = 0; i < 8; ++i)
            bytes_[8 * index + i] = static_cast<std::uint8_t>(word >> (8 * i));
    }
    std::size_t motors_at() const { return 5 + state_.q.size() + state_.v.size(); }
    std::size_t wrenches_at() const { return motors_at() + kMotorWords * state_.motors.size(); }

    std::shared_ptr<const Model> model_ = two_robots();
    RobotState state_;
    std::vector<std::uint8_t> bytes_;
};

TEST_F(StateBytes, RoundTripKeepsEveryBit) {
    const Result<RobotState> back = decode_state(bytes_, type());
    ASSERT_TRUE(back.ok()) << back.error().text();
    EXPECT_EQ(back.value(), state_);
    EXPECT_TRUE(std::signbit(back.value().v[4]));
    std::vector<std::uint8_t> again;
    encode(back.value(), again);
    EXPECT_EQ(again, bytes_);
}

TEST_F(StateBytes, EncodingAppends) {
    std::vector<std::uint8_t> twice = bytes_;
    encode(state_, twice);
    EXPECT_EQ(twice.size(), 2 * bytes_.size());
}

TEST_F(StateBytes, EveryTruncationIsRefused) {
    for (std::size_t n = 0; n < bytes_.size(); ++n)
        EXPECT_FALSE(accepts({bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(n)}))
            << n << " bytes";
}

TEST_F(StateBytes, NumbersThatAreNotFiniteAreRefused) {
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()})
        for (const std::size_t word : {std::size_t{5}, 5 + state_.q.size() - 1, 5 + state_.q.size()}) {
            const std::vector<std::uint8_t> good = bytes_;
            put_word(word, std::bit_cast<std::uint64_t>(bad));
            EXPECT_FALSE(accepts(bytes_)) << word;
            bytes_ = good;
            EXPECT_TRUE(accepts(bytes_));
        }
}

TEST_F(StateBytes, RobotsThatDoNotExistAreRefused) {
    EXPECT_TRUE(decode_state(bytes_, type(), 10).ok());
    EXPECT_FALSE(decode_state(bytes_, type(), 9).ok()) << "it sleeps beside robot 9";
    state_.rest.neighbours = {3};
    std::vector<std::uint8_t> bytes;
    encode(state_, bytes);
    EXPECT_TRUE(decode_state(bytes, type(), 5).ok());
    EXPECT_FALSE(decode_state(bytes, type(), 4).ok()) << "it remembers a contact with robot 4";
}

TEST_F(StateBytes, TrailingBytesAreRefused) {
    for (std::size_t extra : {1u, 7u, 8u, 24u}) {
        std::vector<std::uint8_t> longer = bytes_;
        longer.resize(longer.size() + extra);
        EXPECT_FALSE(accepts(longer)) << extra;
    }
}

TEST_F(StateBytes, StateOfAnotherTypeIsRefusedByName) {
    const Result<RobotState> other = decode_state(bytes_, model_->types[1]);
    ASSERT_FALSE(other.ok());
    EXPECT_NE(other.error().text().find("'ball_chain'"), std::string::npos);
}

TEST_F(StateBytes, HugeCountsAreRefusedWithoutAllocating) {
    const std::vector<std::uint8_t> original = bytes_;
    for (std::size_t count = 0; count < 5; ++count) {
        for (const std::uint64_t value :
             {std::uint64_t{1} << 63, ~std::uint64_t{0}, std::uint64_t{1} << 40, std::uint64_t{1000}}) {
            bytes_ = original;
            put_word(count, value);
            EXPECT_FALSE(accepts(bytes_)) << "count " << count << " = " << value;
        }
    }
}

TEST_F(StateBytes, MotorModesThatDoNotExistAreRefused) {
    const std::vector<std::uint8_t> original = bytes_;
    for (const std::uint64_t mode :
         {std::uint64_t{4}, std::uint64_t{255}, std::uint64_t{1} << 32, ~std::uint64_t{0}}) {
        bytes_ = original;
        put_word(motors_at() + kMotorWords, mode);
        EXPECT_FALSE(accepts(bytes_)) << mode;
    }
}

TEST_F(StateBytes, LinksThatDoNotExistAreRefused) {
    const std::vector<std::uint8_t> original = bytes_;
    for (const std::uint64_t link : {std::uint64_t{5}, std::uint64_t{1} << 32, ~std::uint64_t{0}}) {
        bytes_ = original;
        put_word(wrenches_at(), link);
        EXPECT_FALSE(accepts(bytes_)) << link;
    }
}

TEST_F(StateBytes, WhateverIsAcceptedReadsBackAsTheSameBytes) {
    std::uint64_t s = 1;
    for (int i = 0; i < 20000; ++i) {
        std::vector<std::uint8_t> garbage = bytes_;
        for (int k = 0; k < 3; ++k) {
            s ^= s << 13, s ^= s >> 7, s ^= s << 17;
            garbage[s % garbage.size()] = static_cast<std::uint8_t>(s >> 32);
        }
        const Result<RobotState> decoded = decode_state(garbage, type());
        if (!decoded.ok()) continue;
        std::vector<std::uint8_t> again;
        encode(decoded.value(), again);
        ASSERT_EQ(again, garbage) << "attempt " << i;
    }
}

TEST(InitialState, PutsTheRootLinkWhereTheFileSays) {
    const auto model = two_robots();
    const RobotState state = initial_state(*model, RobotId(std::size_t{0}));
    const Pose expected = Pose{{1, 2, 3}, from_rpy(0.1, 0.2, 0.3)} * Pose{{0, 0, 0.05}, {}};
    EXPECT_LT(norm(base_pose(state).p - expected.p), 1e-15);
    EXPECT_EQ(state.q.size(), 11u);
    EXPECT_EQ(state.v, std::vector<double>(10, 0.0));
    EXPECT_EQ(state.motors, std::vector<MotorSetpoint>(4));
}

}  // namespace
}  // namespace roboss::test
