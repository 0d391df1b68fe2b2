// Entries of a run's log, as plain values, and their encoding. With a checkpoint they are sufficient to step
// the world again: the Clients, their orders, and the observations to which the orders reply.
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

/// An order with its place in the run's history: `given_at` is the observed tick to which it replies (a
/// Client's order), or the tick of the world when it was given. A branch from a tick includes the orders
/// given before it.
struct LoggedOrder {
    Order order;
    Tick given_at = 0;
};

/// A Client has replied to an observation, with or without orders.
struct LoggedReply {
    ClientId client;
    Tick observed = 0;
    friend bool operator==(const LoggedReply&, const LoggedReply&) = default;
};

/// `observed` of a Client that left: nobody waits for it.
inline constexpr Tick kGoneForGood = Tick{1} << 61;

/// An event that is not part of the state: pause, speed, a Simulator that joined.
struct LogNote {
    Tick tick = 0;
    std::string text;
    friend bool operator==(const LogNote&, const LogNote&) = default;
};

/// Entries that are written together.
struct LogBatch {
    std::vector<LoggedOrder> orders;
    std::vector<LoggedReply> replies;
    std::vector<LogNote> notes;
    std::map<std::uint32_t, std::string> clients;  // who joined: ClientId, name

    bool empty() const { return orders.empty() && replies.empty() && notes.empty() && clients.empty(); }
    void append(LogBatch&& later);
};

std::vector<std::uint8_t> encode(const LogBatch& batch);
/// Total: any bytes give a batch or an Error that describes the fault.
Result<LogBatch> decode_batch(std::span<const std::uint8_t> bytes);

/// All robots' states as one sequence of bytes, and back.
std::vector<std::uint8_t> encode_states(const std::vector<RobotState>& states);
Result<std::vector<RobotState>> decode_states(std::span<const std::uint8_t> bytes, const Model& model);

/// What control programs remember, by Client name.
using ClientMemory = std::map<std::string, std::string>;
std::vector<std::uint8_t> encode_memory(const ClientMemory& memory);
Result<ClientMemory> decode_memory(std::span<const std::uint8_t> bytes);

}  // namespace roboss
