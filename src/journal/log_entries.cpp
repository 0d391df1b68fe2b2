// Entries of the log as bytes and back, by the archive of the wire.
#include "journal/log_entries.h"

#include <iterator>

#include "core/archive.h"
#include "wire/codec.h"

namespace roboss {

namespace {

using wire::field;
using wire::Reader;
using wire::Writer;

template <class T>
void move_behind(std::vector<T>& all, std::vector<T>& more) {
    all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

Error damaged(const char* what, const Reader& a) {
    return {std::string("damaged ") + what + ": " + a.failure(), ""};
}

std::vector<std::uint8_t> take_block(Reader& a) {
    std::vector<std::uint8_t> block(a.count(1));
    a.raw(block.data(), block.size());
    return block;
}

}  // namespace

void LogBatch::append(LogBatch&& later) {
    move_behind(orders, later.orders);
    move_behind(replies, later.replies);
    move_behind(notes, later.notes);
    clients.merge(later.clients);
}

std::vector<std::uint8_t> encode(const LogBatch& batch) {
    std::vector<Order> orders;
    orders.reserve(batch.orders.size());
    for (const LoggedOrder& o : batch.orders) orders.push_back(o.order);
    const std::vector<std::uint8_t> block = encode_orders(orders);
    Writer a;
    a.count(block.size());
    a.raw(block.data(), block.size());
    for (const LoggedOrder& o : batch.orders) a.scalar(o.given_at);
    a.count(batch.replies.size());
    for (const LoggedReply& reply : batch.replies) a.scalar(reply.client.value), a.scalar(reply.observed);
    a.count(batch.notes.size());
    for (const LogNote& note : batch.notes) a.scalar(note.tick), field(a, note.text);
    a.count(batch.clients.size());
    for (const auto& [client, name] : batch.clients) a.scalar(client), field(a, name);
    return a.take();
}

Result<LogBatch> decode_batch(std::span<const std::uint8_t> bytes) {
    Reader a(bytes);
    LogBatch batch;
    Result<std::vector<Order>> orders = decode_orders(take_block(a));
    if (a.failed()) return damaged("log entries", a);
    if (!orders) return orders.error();
    for (Order& order : orders.value()) a.scalar(batch.orders.emplace_back(LoggedOrder{order, 0}).given_at);
    for (std::size_t n = a.count(12); n > 0 && !a.failed(); --n) {
        LoggedReply& reply = batch.replies.emplace_back();
        a.scalar(reply.client.value), a.scalar(reply.observed);
    }
    for (std::size_t n = a.count(12); n > 0 && !a.failed(); --n) {
        LogNote& note = batch.notes.emplace_back();
        a.scalar(note.tick), field(a, note.text);
    }
    for (std::size_t n = a.count(8); n > 0 && !a.failed(); --n) {
        std::uint32_t client = 0;
        a.scalar(client);
        std::string name;
        field(a, name);
        if (!batch.clients.emplace(client, std::move(name)).second) a.fail("a Client joins twice at once");
    }
    if (a.left() > 0) a.fail("bytes are left over behind them");
    if (a.failed()) return damaged("log entries", a);
    return batch;
}

std::vector<std::uint8_t> encode_states(const std::vector<RobotState>& states) {
    Writer a;
    a.count(states.size());
    std::vector<std::uint8_t> bytes;
    for (const RobotState& state : states) {
        bytes.clear();
        encode(state, bytes);
        a.count(bytes.size());
        a.raw(bytes.data(), bytes.size());
    }
    return a.take();
}

Result<std::vector<RobotState>> decode_states(std::span<const std::uint8_t> bytes, const Model& model) {
    Reader a(bytes);
    const std::size_t n = a.count(4);
    if (!a.failed() && n != model.robots.size())
        return Error{"it has " + std::to_string(n) + " robots' states instead of " +
                         std::to_string(model.robots.size()),
                     ""};
    std::vector<RobotState> states;
    for (std::size_t i = 0; i < n && !a.failed(); ++i) {
        const std::vector<std::uint8_t> block = take_block(a);
        if (a.failed()) break;
        Result<RobotState> state = decode_state(block, model.type_of(RobotId(i)), model.robots.size());
        if (!state) return Error{"robot '" + model.robots[i].name + "': " + state.error().message, ""};
        states.push_back(std::move(state).value());
    }
    if (a.left() > 0) a.fail("bytes are left over behind them");
    if (a.failed()) return damaged("states", a);
    return states;
}

std::vector<std::uint8_t> encode_memory(const ClientMemory& memory) {
    Writer a;
    a.count(memory.size());
    for (const auto& [name, bytes] : memory) field(a, name), field(a, bytes);
    return a.take();
}

Result<ClientMemory> decode_memory(std::span<const std::uint8_t> bytes) {
    Reader a(bytes);
    ClientMemory memory;
    for (std::size_t n = a.count(8); n > 0 && !a.failed(); --n) {
        std::string name, text;
        field(a, name), field(a, text);
        if (!memory.emplace(std::move(name), std::move(text)).second) a.fail("a Client is named twice");
    }
    if (a.left() > 0) a.fail("bytes are left over behind it");
    if (a.failed()) return damaged("memory of control programs", a);
    return memory;
}

}  // namespace roboss
