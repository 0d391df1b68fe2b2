// Tables and checks.
#include "journal/journal_format.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "core/hash.h"
#include "wire/codec.h"
#include "wire/model_codec.h"

namespace roboss {

const char* const kJournalTables =
    "CREATE TABLE meta(key TEXT PRIMARY KEY, value);"
    "CREATE TABLE models(hash TEXT PRIMARY KEY, bytes BLOB, bytes_hash TEXT);"
    "CREATE TABLE branches(id INTEGER PRIMARY KEY, parent INTEGER, tick INTEGER, model TEXT, seed INTEGER, "
    "world_file TEXT, reason TEXT, row_hash TEXT);"
    "CREATE TABLE states(hash TEXT PRIMARY KEY, bytes BLOB);"
    "CREATE TABLE checkpoints(branch INTEGER, tick INTEGER, state_hash TEXT, states TEXT, memory_hash TEXT, "
    "serial INTEGER, row_hash TEXT, memory BLOB, PRIMARY KEY(branch, tick));"
    "CREATE TABLE batches(branch INTEGER, serial INTEGER, planned INTEGER, committed INTEGER, state_hash "
    "TEXT, low INTEGER, high INTEGER, orders INTEGER, entries_hash TEXT, chain TEXT, entries BLOB, PRIMARY "
    "KEY(branch, serial));";

const char* const kJournalTables5 =
    "CREATE TABLE bases(branch INTEGER PRIMARY KEY, serial INTEGER, planned INTEGER, committed INTEGER, "
    "state_hash TEXT, chain TEXT, entries BLOB, row_hash TEXT);"
    "CREATE TABLE bookmarks(id INTEGER PRIMARY KEY, branch INTEGER, tick INTEGER, name TEXT, row_hash TEXT);";

const char* const kJournalEnds =
    "CREATE TABLE IF NOT EXISTS ends(branch INTEGER PRIMARY KEY, serial INTEGER, chain TEXT, row_hash TEXT);";

const char* const kJournalColumns8 =
    "ALTER TABLE checkpoints ADD COLUMN memory_hash TEXT; ALTER TABLE checkpoints ADD COLUMN serial INTEGER;"
    "ALTER TABLE batches ADD COLUMN entries_hash TEXT;";

std::string program_version() {
    return ROBOSS_VERSION " (wire " + std::to_string(kWireVersion) + ")";
}

namespace {

std::string_view text(const Blob& b) {
    return {reinterpret_cast<const char*>(b.data()), b.size()};
}

}  // namespace

BatchRow to_batch_row(const LogBatch& entries) {
    constexpr Tick kAlways = std::numeric_limits<Tick>::max();
    BatchRow row;
    row.low = kAlways;
    row.high = -1;
    const auto include = [&row](Tick low, Tick high) {
        row.low = std::min(row.low, low);
        row.high = std::max(row.high, high);
    };
    for (const LoggedOrder& o : entries.orders) include(o.given_at, o.order.apply_at);
    for (const LoggedReply& reply : entries.replies) include(reply.observed, reply.observed);
    for (const LogNote& note : entries.notes) include(note.tick, note.tick);
    if (!entries.clients.empty()) include(std::numeric_limits<Tick>::min(), kAlways);
    row.orders = static_cast<std::int64_t>(entries.orders.size());
    row.bytes = encode(entries);
    row.bytes_hash = hash_of_bytes(row.bytes);
    return row;
}

std::uint64_t chain_of(std::uint64_t before, const BatchRow& row) {
    Hash hash;
    hash.add(before);
    for (const std::int64_t n :
         {row.branch, row.serial, row.planned, row.committed, row.low, row.high, row.orders})
        hash.add(static_cast<std::uint64_t>(n));
    hash.add(row.hash);
    if (row.bytes_hash)
        hash.add(*row.bytes_hash);
    else
        hash.add(text(row.bytes));
    return hash.value();
}

std::uint64_t check_of(const Branch& b) {
    Hash hash;
    for (const std::int64_t n : {b.id, b.parent, b.tick}) hash.add(static_cast<std::uint64_t>(n));
    hash.add(b.model_hash);
    hash.add(b.seed);
    hash.add(std::string_view(b.world_file));
    hash.add(std::string_view(b.reason));
    return hash.value();
}

std::uint64_t check_of(const CheckpointRow& row) {
    Hash hash;
    for (const std::int64_t n : {row.entry.branch, row.entry.tick, row.serial})
        hash.add(static_cast<std::uint64_t>(n));
    for (const std::uint64_t h : {row.entry.hash, row.states_hash, row.memory_hash}) hash.add(h);
    return hash.value();
}

std::uint64_t check_of(const CheckpointEntry& entry, const Blob& memory, const Blob& states) {
    Hash hash;
    for (const std::int64_t n : {entry.branch, entry.tick}) hash.add(static_cast<std::uint64_t>(n));
    hash.add(entry.hash);
    hash.add(text(memory));
    hash.add(text(states));
    return hash.value();
}

std::uint64_t check_of(const LogBase& base) {
    Hash hash;
    for (const std::int64_t n : {base.branch, base.serial, base.planned, base.committed})
        hash.add(static_cast<std::uint64_t>(n));
    hash.add(base.hash);
    hash.add(base.chain);
    hash.add(text(base.bytes));
    return hash.value();
}

std::uint64_t check_of(const Bookmark& mark) {
    Hash hash;
    for (const std::int64_t n : {mark.id, mark.branch, mark.tick}) hash.add(static_cast<std::uint64_t>(n));
    hash.add(std::string_view(mark.name));
    return hash.value();
}

std::uint64_t check_of(const LogEnd& end) {
    Hash hash;
    for (const std::int64_t n : {end.branch, end.tail.serial}) hash.add(static_cast<std::uint64_t>(n));
    hash.add(end.tail.chain);
    return hash.value();
}

Row to_row(const LogBase& base) {
    return {base.branch,       base.serial,        base.planned, base.committed,
            to_hex(base.hash), to_hex(base.chain), base.bytes,   to_hex(check_of(base))};
}

Row to_row(const Bookmark& mark) {
    return {mark.id, mark.branch, mark.tick, mark.name, to_hex(check_of(mark))};
}

Row to_row(const LogEnd& end) {
    return {end.branch, end.tail.serial, to_hex(end.tail.chain), to_hex(check_of(end))};
}

Row to_row(const BatchRow& row, std::uint64_t chain) {
    return {row.branch,    row.serial,       row.planned,
            row.committed, to_hex(row.hash), row.low,
            row.high,      row.orders,       to_hex(row.bytes_hash.value()),
            to_hex(chain), row.bytes};
}

Row to_row(const Branch& b) {
    return {b.id,
            b.parent,
            b.tick,
            to_hex(b.model_hash),
            std::bit_cast<std::int64_t>(b.seed),
            b.world_file,
            b.reason,
            to_hex(check_of(b))};
}

Row to_row(const CheckpointEntry& entry, Blob memory, const Blob& states, std::int64_t serial) {
    const CheckpointRow row{entry, hash_of_bytes(states), hash_of_bytes(memory), serial};
    return {entry.branch,
            entry.tick,
            to_hex(entry.hash),
            to_hex(row.states_hash),
            to_hex(row.memory_hash),
            serial,
            to_hex(check_of(row)),
            std::move(memory)};
}

Row states_row(Blob states) {
    const std::string hash = to_hex(hash_of_bytes(states));
    return {hash, std::move(states)};
}

Row model_row(const Model& model) {
    Blob bytes = encode_model(model);
    const std::string hash = to_hex(hash_of_bytes(bytes));
    return {to_hex(model.hash), std::move(bytes), hash};
}

Result<std::uint64_t> check_of_meta(const Database& db) {
    Result<std::vector<Row>> rows =
        db.select("SELECT key, value FROM meta WHERE key != ? ORDER BY key", {std::string(kMetaCheck)});
    if (!rows) return rows.error();
    Hash hash;
    for (const Row& row : rows.value())
        for (const Value& value : row) {
            hash.add(value.index());
            if (const auto* number = std::get_if<std::int64_t>(&value))
                hash.add(static_cast<std::uint64_t>(*number));
            if (const auto* word = std::get_if<std::string>(&value)) hash.add(std::string_view(*word));
            if (const auto* bytes = std::get_if<Blob>(&value)) hash.add(text(*bytes));
        }
    return hash.value();
}

Result<> seal_meta(Database& db) {
    Result<std::uint64_t> check = check_of_meta(db);
    if (!check) return check.error();
    return db.insert("INSERT OR REPLACE INTO meta VALUES(?,?)",
                     {{std::string(kMetaCheck), to_hex(check.value())}});
}

}  // namespace roboss
