// What a robot's radios have sent, as a part of its state: orders, bytes, hash, edits.
#include <gtest/gtest.h>

#include <cmath>

#include <support/robots.h>

#include "model/addressee.h"
#include "model/edit.h"
#include "model/order.h"

namespace roboss::test {
namespace {

const RobotId kFirst(0u), kSecond(1u), kThird(2u);

/// Three cars, each with a laser and two radios; the first one's radio has an address.
std::shared_ptr<const Model> talking_cars() {
    World world = empty_world(1e-3);
    ModelSpec plain = car(), named = car();
    for (ModelSpec* model : {&plain, &named}) {
        SensorSpec laser, radio, other;
        laser.name = "laser", laser.parameters = LaserSpec{};
        RadioSpec spec;
        spec.bit_rate = 8e4;  // ten bytes in a tick
        if (model == &named) spec.address = "base";
        radio.name = "radio", radio.parameters = spec;
        other.name = "other", other.parameters = RadioSpec{};
        model->links[0].sensors = {laser, radio, other};
    }
    place(world, named, "one");
    place(world, plain, "two", {{5, 0, 0}, {}});
    place(world, plain, "three", {{9, 0, 0}, {}});
    Diagnostics diagnostics;
    auto model = compile(world, {}, diagnostics);
    EXPECT_FALSE(diagnostics.has_errors());
    return model;
}

class RadioStates : public testing::Test {
  protected:
    Result<> check(RobotId robot, const Transmit& message) const {
        return check_order(*model, {5, ClientId(0u), 1, robot, message});
    }
    void send(Tick tick, std::vector<std::uint8_t> payload, RobotId to = {}, std::uint32_t radio = 0) {
        const Order order{tick, ClientId(0u), 1, kFirst, Transmit{radio, to, std::move(payload)}};
        ASSERT_TRUE(check_order(*model, order).ok());
        apply_order(*model, order, state);
    }
    std::shared_ptr<const Model> model = talking_cars();
    RobotState state = initial_state(*model, kFirst);
};

TEST_F(RadioStates, OrdersThatMakeNoSenseAreRefused) {
    EXPECT_TRUE(check(kFirst, {0, {}, {}}).ok());
    EXPECT_TRUE(check(kFirst, {1, kThird, std::vector<std::uint8_t>(RadioState::kMostPayload)}).ok());
    const auto code = [&](const Transmit& message) { return check(kFirst, message).error().code; };
    EXPECT_EQ(code({2, {}, {1}}), "no-radio");
    EXPECT_EQ(code({0, kFirst, {1}}), "no-robot") << "to oneself";
    EXPECT_EQ(code({0, RobotId(3u), {1}}), "no-robot");
    EXPECT_EQ(code({0, {}, std::vector<std::uint8_t>(RadioState::kMostPayload + 1)}), "long-message");
}

TEST_F(RadioStates, RadiosAndAddresseesAreFoundByName) {
    EXPECT_EQ(find_addressee(*model, "two"), kSecond);
    EXPECT_EQ(find_addressee(*model, "base"), kFirst);
    EXPECT_FALSE(find_addressee(*model, ""));
    EXPECT_FALSE(find_addressee(*model, "nobody"));
    const RobotType& type = model->type_of(kFirst);
    EXPECT_EQ(radio_number(*model, kFirst, *type.find_sensor("radio")).value(), 0u);
    EXPECT_EQ(radio_number(*model, kFirst, *type.find_sensor("other")).value(), 1u);
    EXPECT_EQ(radio_number(*model, kFirst, *type.find_sensor("laser")).error().code, "no-radio");
}

TEST_F(RadioStates, TransmissionsOfARadioFollowEachOther) {
    send(3, {1, 2, 3, 4, 5}), send(3, {6}, kThird), send(50, {});
    ASSERT_EQ(state.radios.size(), 2u);
    const std::vector<Transmission>& sent = state.radios[0].sent;
    ASSERT_EQ(sent.size(), 3u);
    EXPECT_DOUBLE_EQ(sent[0].begin_s, 3e-3);
    EXPECT_DOUBLE_EQ(sent[0].end_s, 3.5e-3);
    EXPECT_EQ(sent[1].begin_s, sent[0].end_s);
    EXPECT_EQ(sent[1].to, kThird.value);
    EXPECT_DOUBLE_EQ(sent[2].begin_s, 50e-3) << "the radio was idle";
    EXPECT_EQ(state.radios[0].bytes, (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6}));
    EXPECT_TRUE(state.radios[1].sent.empty());
}

TEST_F(RadioStates, AMessageWakesNobody) {
    state.rest.asleep = true, state.rest.still_ticks = 99;
    send(3, {1});
    EXPECT_TRUE(state.rest.asleep);
}

TEST_F(RadioStates, BytesKeepEverything) {
    for (std::size_t size = 0; size < 20; ++size) {
        send(static_cast<Tick>(size), std::vector<std::uint8_t>(size, static_cast<std::uint8_t>(size)),
             kSecond);
        send(static_cast<Tick>(size), {9}, {}, 1);
        std::vector<std::uint8_t> bytes;
        encode(state, bytes);
        const auto again = decode_state(bytes, model->type_of(kFirst), 3);
        ASSERT_TRUE(again.ok()) << again.error().text();
        EXPECT_EQ(again.value(), state);
    }
}

TEST_F(RadioStates, EveryBitIsInTheHashOrRefused) {
    send(3, {1, 2, 3}, kSecond), send(4, {}, {}, 1);
    std::vector<std::uint8_t> bytes;
    encode(state, bytes);
    const std::uint64_t hash = state_hash(kFirst, 5, state);
    std::size_t accepted = 0;
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
        bytes[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
        if (const auto other = decode_state(bytes, model->type_of(kFirst), 3)) {
            ++accepted;
            EXPECT_NE(state_hash(kFirst, 5, other.value()), hash) << "bit " << bit;
            std::vector<std::uint8_t> again;
            encode(other.value(), again);
            EXPECT_EQ(again, bytes);
        }
        bytes[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    }
    EXPECT_GT(accepted, 100u);
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_FALSE(decode_state({bytes.data(), size}, model->type_of(kFirst), 3).ok());
}

TEST_F(RadioStates, StatesThatOrdersCannotReachAreRefused) {
    send(3, {1, 2, 3}, kSecond);
    const auto refused = [&](auto change) {
        RobotState other = state;
        change(other.radios[0]);
        std::vector<std::uint8_t> bytes;
        encode(other, bytes);
        return !decode_state(bytes, model->type_of(kFirst), 3).ok();
    };
    EXPECT_FALSE(refused([](RadioState&) {}));
    EXPECT_TRUE(refused([](RadioState& r) { r.bytes.push_back(1); }));
    EXPECT_TRUE(refused([](RadioState& r) { r.sent[0].to = 3; }));
    EXPECT_TRUE(refused([](RadioState& r) { r.sent[0].end_s = std::nan(""); }));
    EXPECT_TRUE(refused([](RadioState& r) { r.sent[0].X_WB.p.x = std::nan(""); }));
    EXPECT_TRUE(refused([](RadioState& r) { r.sent[0].number = 7; }));
    EXPECT_TRUE(refused([](RadioState& r) { r.sent.resize(RadioState::kMostKept + 1); }));
}

TEST_F(RadioStates, MessagesForWhoIsRemovedAreForNobody) {
    send(3, {1}, kSecond), send(3, {2}, kThird), send(3, {3});
    const auto edit = without_robots(*model, {"two"});
    ASSERT_TRUE(edit.ok()) << edit.error().text();
    std::vector<RobotState> states{state, initial_state(*model, kSecond), initial_state(*model, kThird)};
    const RobotState carried = carry_over(edit.value(), states)[0];
    EXPECT_EQ(carried.radios[0].sent[0].to, kFirst.value) << "the sender hears nothing of its own";
    EXPECT_EQ(carried.radios[0].sent[1].to, 1u) << "the third is the second now";
    EXPECT_EQ(carried.radios[0].sent[2].to, RobotId::kNone);
    Order gone{4, ClientId(0u), 1, kFirst, Transmit{0, kSecond, {}}};
    EXPECT_FALSE(carry_over(edit.value(), gone));
    Order moved{4, ClientId(0u), 1, kFirst, Transmit{0, kThird, {}}};
    ASSERT_TRUE(carry_over(edit.value(), moved));
    EXPECT_EQ(std::get<Transmit>(moved.action).to, kSecond);
}

}  // namespace
}  // namespace roboss::test
