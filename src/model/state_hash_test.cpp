// The state hash: every bit of a state, and where each of its lists ends, changes it.
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include <support/robots.h>

#include "model/robot_state.h"

namespace roboss::test {
namespace {

const RobotId kRobot(0u);
constexpr Tick kTick = 5;

/// A car in a state in which no list is empty.
class HashOfAState : public testing::Test {
  protected:
    HashOfAState() {
        World world = empty_world(1e-3);
        place(world, car(), "car", {{1, 2, 3}, from_rpy(0.1, 0.2, 0.3)});
        Diagnostics diagnostics;
        model = compile(world, {}, diagnostics);
        state = initial_state(*model, kRobot);
        for (std::size_t i = 0; i < state.v.size(); ++i) state.v[i] = 0.1 * static_cast<double>(i);
        state.motors[1] = {MotorMode::kPosition, 0.5, 3, 0.3, -0.2};
        state.wrenches = {{LinkId(1u), {1, 2, 3}, {4, 5, 6}, 1000}, {LinkId(2u), {6, 5, 4}, {3, 2, 1}, 7}};
        state.contacts = {{RobotId::kNone, 1, 2, 3, 0.25, 0.125, {0.1, -0.2, 0.3}},
                          {4, 5, 6, 7, 0.5, 0.25, {0.4, 0.5, 0.6}}};
        state.rest = {17, true, {3, 9}, {{1, 2, 3}, {4, 5, 6}}};
    }
    static std::uint64_t hash_of(const RobotState& s) { return state_hash(kRobot, kTick, s); }

    std::shared_ptr<const Model> model;
    RobotState state;
};

/// Every field is encoded (robot_state.cpp names all of them); so every bit of the bytes that leads to
/// another state must lead to another hash.
TEST_F(HashOfAState, ChangesWithEveryBitOfEveryField) {
    std::vector<std::uint8_t> bytes;
    encode(state, bytes);
    const std::uint64_t hash = hash_of(state);
    std::set<std::size_t> words;
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
        bytes[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
        if (const Result<RobotState> other = decode_state(bytes, model->types[0])) {
            EXPECT_NE(hash_of(other.value()), hash) << "bit " << bit % 64 << " of word " << bit / 64;
            words.insert(bit / 64);
        }
        bytes[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
    }
    constexpr std::size_t kLengths = 6;  // of which no other fits the bytes
    EXPECT_EQ(words.size(), bytes.size() / 8 - kLengths) << "a word was not tested";
}

TEST_F(HashOfAState, ChangesWithEachNumberAndFlag) {
    const std::function<void(RobotState&)> changes[] = {
        [](RobotState& s) { s.q[0] = -s.q[0]; },
        [](RobotState& s) { s.v[0] = -0.0; },
        [](RobotState& s) { s.motors[1].mode = MotorMode::kPassive; },
        [](RobotState& s) { s.motors[1].load = 0; },
        [](RobotState& s) { s.wrenches[1].until = 8; },
        [](RobotState& s) { s.contacts[1].load = 0; },
        [](RobotState& s) { s.contacts[1].friction.z = 0; },
        [](RobotState& s) { s.contacts[0].other_robot = 0; },
        [](RobotState& s) { s.rest.still_ticks = 16; },
        [](RobotState& s) { s.rest.asleep = false; },
        [](RobotState& s) { s.rest.neighbours[1] = 10; },
        [](RobotState& s) { s.rest.bound.max.z = 7; },
    };
    std::set<std::uint64_t> hashes{hash_of(state)};
    for (const auto& change : changes) {
        RobotState other = state;
        change(other);
        EXPECT_TRUE(hashes.insert(hash_of(other)).second) << "change " << &change - changes;
    }
}

TEST_F(HashOfAState, ChangesWithTickAndRobot) {
    EXPECT_NE(state_hash(kRobot, kTick + 1, state), hash_of(state));
    EXPECT_NE(state_hash(RobotId(1u), kTick, state), hash_of(state));
}

/// The same words in the same order, and only one list ends elsewhere.
TEST_F(HashOfAState, ChangesWithWhereAListEnds) {
    RobotState moved = state;
    moved.v.insert(moved.v.begin(), moved.q.back());
    moved.q.pop_back();
    EXPECT_NE(hash_of(moved), hash_of(state)) << "coordinates and velocities";

    RobotState awake = state, other = state;
    awake.rest = {0, false, {0, 0}, {}};
    awake.contacts.clear();
    other.rest = {0, false, {}, {}};
    other.contacts.clear();
    EXPECT_NE(hash_of(other), hash_of(awake)) << "neighbours";

    RobotState sleeps = state;  // a bound of zeros is six words, as six neighbours 0 are
    sleeps.contacts.clear();
    RobotState sleeps_too = sleeps;
    sleeps.rest = {1, true, {0, 0, 0, 0, 0, 0}, {{}, {}}};
    sleeps_too.rest = {1, true, {0, 0, 0, 0, 0}, {{}, {}}};
    EXPECT_NE(hash_of(sleeps_too), hash_of(sleeps));

    RobotState none = state, wrench = state;
    none.motors.clear(), none.wrenches.clear(), none.contacts.clear(), none.rest = {};
    wrench = none;
    wrench.wrenches.emplace_back();
    wrench.wrenches[0].link = LinkId(0u);
    EXPECT_NE(hash_of(wrench), hash_of(none));
}

/// Before lengths were hashed, these two had one hash: what ends the wrenches of one begins the contacts of
/// the other.
TEST_F(HashOfAState, TellsAWrenchFromAContactOfTheSameWords) {
    RobotState wrench, contact;
    wrench.wrenches = {{LinkId(0u), {}, {}, 0}};  // eight words: link, force, torque, until
    contact.contacts = {{0, 0, 0, 0, 0, 0, {}}};  // seven words
    contact.rest.still_ticks = 0;
    wrench.rest = {}, contact.rest.neighbours = {0};  // and one more
    EXPECT_NE(hash_of(wrench), hash_of(contact));
}

}  // namespace
}  // namespace roboss::test
