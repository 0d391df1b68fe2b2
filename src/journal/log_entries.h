// What a run says to its log, as plain values, and their bytes. Together with a checkpoint these are all that
// a world needs to be stepped again: who was there, what was ordered, and what the orders answered.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "model/order.h"
#include "model/robot_state.h"

namespace roboss {

/// An order with its place in the run's own history: `given_at` is the tick that it answers (a Client's
/// order) or that the world had reached when it was given. A branch that leaves at a tick takes along what
/// was said before it.
struct LoggedOrder {
    Order order;
    Tick given_at = 0;
};

/// A Client has answered an observation, with or without orders.
struct LoggedReply {
    ClientId client;
    Tick observed = 0;
    friend bool operator==(const LoggedReply&, const LoggedReply&) = default;
};

/// What a Client that leaves has answered: everything.
inline constexpr Tick kGoneForGood = Tick{1} << 61;

/// Something that is no part of the state and worth remembering: pause, speed, a Simulator that came.
struct LogNote {
    Tick tick = 0;
    std::string text;
    friend bool operator==(const LogNote&, const LogNote&) = default;
};

/// What is written at once.
struct LogBatch {
    std::vector<LoggedOrder> orders;
    std::vector<LoggedReply> replies;
    std::vector<LogNote> notes;
    std::map<std::uint32_t, std::string> clients;  // who joined: ClientId, name

    bool empty() const { return orders.empty() && replies.empty() && notes.empty() && clients.empty(); }
    void append(LogBatch&& later);
};

std::vector<std::uint8_t> encode(const LogBatch& batch);
/// Total: any bytes give a batch or an Error that says what is wrong with them.
Result<LogBatch> decode_batch(std::span<const std::uint8_t> bytes);

/// All robots' states as one sequence of bytes, and back.
std::vector<std::uint8_t> encode_states(const std::vector<RobotState>& states);
Result<std::vector<RobotState>> decode_states(std::span<const std::uint8_t> bytes, const Model& model);

/// What control programs remember, by Client name.
using ClientMemory = std::map<std::string, std::string>;
std::vector<std::uint8_t> encode_memory(const ClientMemory& memory);
Result<ClientMemory> decode_memory(std::span<const std::uint8_t> bytes);

}  // namespace roboss
