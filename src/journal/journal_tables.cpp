// Reads the tables of a journal and checks every row of them; blobs are read, and checked, when they are
// needed.
#include <algorithm>
#include <bit>

#include "core/hash.h"
#include "journal/columns.h"
#include "journal/journal.h"
#include "journal/journal_format.h"
#include "wire/model_codec.h"

namespace roboss {
Result<> Journal::read_meta() {
    Result<std::vector<Row>> rows = db_->select("SELECT key, value FROM meta");
    if (!rows)
        return Error{
            path_ + " is not a checkpoint or journal of RoBOSS, or is truncated: " + rows.error().message,
            kAnotherCopy, "not-a-journal"};
    std::int64_t format = 0;
    world_.reset();
    for (const Row& row : rows.value()) {
        const auto* key = std::get_if<std::string>(&row[0]);
        if (key != nullptr && *key == "format" && std::holds_alternative<std::int64_t>(row[1]))
            format = std::get<std::int64_t>(row[1]);
        if (key != nullptr && *key == "version" && std::holds_alternative<std::string>(row[1]))
            version_ = std::get<std::string>(row[1]);
        if (key != nullptr && *key == kMetaWorld) {
            Columns c(row);
            (void)c.get<std::string>();
            world_ = c.hash();
            if (!c.good()) return damaged("the hash of its world was changed");
        }
    }
    if (format == 0) return damaged("the row 'format' of its table meta is missing or was changed");
    format_ = format;
    if (format < kOldestJournalFormat || format > kJournalFormat)
        return Error{path_ + " has journal format " + std::to_string(format) + " (written by RoBOSS " +
                         (version_.empty() ? "of long ago" : version_) + "), this program reads " +
                         std::to_string(kJournalFormat),
                     "use the version of RoBOSS that wrote it", "journal-format"};
    if (!is_sealed()) return Ok{};
    const Result<std::uint64_t> check = check_of_meta(*db_);
    const bool sealed = std::ranges::any_of(rows.value(), [&](const Row& row) {
        return row[0] == Value(std::string(kMetaCheck)) && check && row[1] == Value(to_hex(check.value()));
    });
    return sealed ? Result<>(Ok{}) : damaged("a row of its table meta was changed");
}

Result<> Journal::read_branches() {
    Result<std::vector<Row>> rows = db_->select(
        "SELECT id, parent, tick, model, seed, world_file, reason, row_hash FROM branches ORDER BY id");
    if (!rows) return damaged(rows.error().message);
    branches_.clear();
    for (const Row& row : rows.value()) {
        Columns c(row);
        Branch b;
        b.id = c.number(), b.parent = c.number(), b.tick = c.number();
        b.model_hash = c.hash();
        b.seed = std::bit_cast<std::uint64_t>(c.number());
        b.world_file = c.get<std::string>(), b.reason = c.get<std::string>();
        const std::uint64_t check = c.hash();
        if (!c.good() || check != check_of(b))
            return damaged("the row of branch " + std::to_string(b.id) + " was changed");
        const bool pruned = has_bases() && (!is_sealed() || world_);  // the oldest are removed first
        const bool in_order = branches_.empty() ? b.id == 1 || pruned : b.id == branches_.back().id + 1;
        if (!in_order) return damaged("the row of branch " + std::to_string(b.id - 1) + " is missing");
        if (b.id < 1 || b.parent < 0 || b.parent >= b.id || b.tick < 0)
            return damaged("its branches do not make a tree");
        b.committed = b.end = b.tick;
        branches_.push_back(std::move(b));
    }
    if (branches_.empty())
        return Error{path_ + " is empty: its run never began", kAnotherCopy, "journal-empty"};
    return Ok{};
}

Result<> Journal::read_checkpoint_entries() {
    Result<std::vector<Row>> rows = db_->select(
        std::string("SELECT c.branch, c.tick, c.state_hash, coalesce(length(c.memory) + length(s.bytes), "
                    "'none'), c.states, ") +
        (is_sealed() ? "c.memory_hash, coalesce(c.serial, 0), c.row_hash " : "NULL, 0, c.row_hash ") +
        "FROM checkpoints c LEFT JOIN states s ON s.hash = c.states ORDER BY c.branch, c.tick");
    if (!rows) return damaged(rows.error().message);
    checkpoints_.clear();
    last_serials_.clear();
    has_older_checkpoints_ = false;
    for (const Row& values : rows.value()) {
        Columns c(values);
        CheckpointRow row;
        CheckpointEntry& entry = row.entry;
        entry.branch = c.number(), entry.tick = c.number();
        entry.hash = c.hash();
        const std::int64_t bytes = c.number();
        row.states_hash = c.hash();
        const std::optional<std::uint64_t> memory_hash = c.hash_or_null();
        row.memory_hash = memory_hash.value_or(0), row.serial = c.number();
        const std::uint64_t check = c.hash();
        if (!c.good() || (memory_hash && check != check_of(row)))
            return changed("the checkpoint " + at_tick(entry.tick), entry.branch);
        has_older_checkpoints_ |= !memory_hash;
        std::int64_t& last = last_serials_[entry.branch];
        last = std::max(last, row.serial);
        Branch* holder = find_own(entry.branch);
        if (holder == nullptr || entry.tick < holder->tick)
            return damaged("the checkpoint " + at_tick(entry.tick) + " belongs to no branch");
        Branch& b = *holder;
        if (b.checkpoints++ == 0) b.first = entry.tick;
        b.bytes += static_cast<std::uint64_t>(bytes);
        if (entry.tick >= b.committed) b.committed = entry.tick, b.hash = entry.hash;
        b.end = std::max(b.end, entry.tick);
        checkpoints_.push_back(entry);
    }
    for (const Branch& b : branches_)
        if (b.checkpoints == 0) return damaged("branch " + std::to_string(b.id) + " has no checkpoint");
    return Ok{};
}

/// The digest that stands for the rows that were pruned.
Result<> Journal::read_log_bases() {
    std::erase_if(heads_, [this](const auto& head) { return find(head.first) == nullptr; });
    if (!has_bases()) return Ok{};
    Result<std::vector<Row>> rows = db_->select(kSelectBases);
    if (!rows) return damaged(rows.error().message);
    for (const Row& values : rows.value()) {
        Columns c(values);
        LogBase base;
        base.branch = c.number(), base.serial = c.number();
        base.planned = c.number(), base.committed = c.number(), base.hash = c.hash(), base.chain = c.hash();
        base.bytes = c.get<Blob>();
        const std::uint64_t check = c.hash();
        if (!c.good() || find(base.branch) == nullptr || check != check_of(base))
            return damaged("the beginning of the log of branch " + std::to_string(base.branch) +
                           " was changed");
        LogHead& head = heads_[base.branch];
        if (head.tail.serial >= base.serial) continue;
        head.tail = {base.serial, base.chain};
        if (base.committed >= head.committed && base.hash != 0)
            head.committed = base.committed, head.hash = base.hash;
        head.end = std::max({head.end, base.planned, base.committed});
    }
    return Ok{};
}

/// Checks the chain of all rows, also of those that nothing refers to. Only the youngest branch grows.
Result<> Journal::read_log_heads() {
    Result<std::vector<Row>> rows = db_->select(
        std::string("SELECT branch, serial, planned, committed, state_hash, low, high, orders, ") +
            // Bytes that log() reads are checked there; of a row without entries it reads none.
            (is_sealed() ? "entries_hash, CASE WHEN entries_hash IS NULL OR low > high THEN entries ELSE x'' "
                           "END, "
                         : "NULL, entries, ") +
            "length(entries), chain FROM batches WHERE branch > ? OR (branch = ? AND serial > ?) "
            "ORDER BY branch, serial",
        {read_branch_, read_branch_, read_serial_});
    if (!rows) return damaged(rows.error().message);
    for (const Row& values : rows.value()) {
        Columns c(values);
        BatchRow row;
        row.branch = c.number(), row.serial = c.number();
        row.planned = c.number(), row.committed = c.number(), row.hash = c.hash();
        row.low = c.number(), row.high = c.number(), row.orders = c.number();
        row.bytes_hash = c.hash_or_null(), row.bytes = c.get<Blob>();
        const std::int64_t bytes = c.number();
        const std::uint64_t chain = c.hash();
        const std::string name = "row " + std::to_string(row.serial) + " of the log";
        if (find(row.branch) == nullptr) return damaged(name + " belongs to no branch");
        LogHead& head = heads_[row.branch];
        read_branch_ = row.branch, read_serial_ = row.serial;
        if (row.serial != head.tail.serial + 1)
            return damaged("row " + std::to_string(head.tail.serial + 1) + " of the log of branch " +
                           std::to_string(row.branch) + " is missing");
        const bool whole =
            !row.bytes_hash || row.low <= row.high || hash_of_bytes(row.bytes) == *row.bytes_hash;
        if (!c.good() || chain != chain_of(head.tail.chain, row) || !whole) return changed(name, row.branch);
        head.tail = {row.serial, chain};
        head.orders += static_cast<std::size_t>(row.orders);
        head.bytes += static_cast<std::uint64_t>(bytes);
        if (row.committed >= head.committed && row.hash != 0)
            head.committed = row.committed, head.hash = row.hash;
        head.end = std::max({head.end, row.planned, row.committed});
    }
    for (const auto& [id, head] : heads_) {
        Branch& b = *find_own(id);
        b.orders = head.orders;
        b.bytes += head.bytes;
        if (head.committed >= b.committed && head.hash != 0) b.committed = head.committed, b.hash = head.hash;
        b.end = std::max(b.end, head.end);
    }
    return Ok{};
}

/// A log is at least as long as its writer left it. All branches that began before the last one with an end
/// have one, too.
Result<> Journal::read_log_ends() {
    for (auto& entry : heads_) entry.second.ended = -1;
    const Result<std::vector<Row>> there = db_->select("SELECT 1 FROM sqlite_master WHERE name = 'ends'");
    if (!there) return damaged(there.error().message);
    if (there.value().empty()) return Ok{};
    Result<std::vector<Row>> rows = db_->select(kSelectEnds);
    if (!rows) return damaged(rows.error().message);
    auto next = branches_.begin();
    for (const Row& values : rows.value()) {
        Columns c(values);
        LogEnd end;
        end.branch = c.number(), end.tail.serial = c.number(), end.tail.chain = c.hash();
        const std::uint64_t check = c.hash();
        if (!c.good() || check != check_of(end)) return changed("the end of the log", end.branch);
        if (find(end.branch) == nullptr) continue;  // an older program has pruned it
        if (next->id != end.branch)
            return damaged("the end of the log of branch " + std::to_string(next->id) + " is missing");
        ++next;
        const Tail has = tail(end.branch);
        if (has.serial < end.tail.serial)
            return damaged("row " + std::to_string(has.serial + 1) + " of the log of branch " +
                           std::to_string(end.branch) + " is missing");
        if (has.serial == end.tail.serial && has.chain != end.tail.chain)
            return changed("the end of the log", end.branch);
        heads_[end.branch].ended = end.tail.serial;
    }
    return Ok{};
}

/// A checkpoint and a row of the log are written together: later rows may be lost, that one not.
Result<> Journal::check_serials() const {
    for (const auto& [branch, serial] : last_serials_)
        if (const std::int64_t has = tail(branch).serial; has < serial)
            return damaged("row " + std::to_string(has + 1) + " of the log of branch " +
                           std::to_string(branch) + " is missing");
    return Ok{};
}

/// A branch leaves its parent at a tick that the parent has.
Result<> Journal::check_tree() const {
    for (const Branch& b : branches_)
        if (const Branch* parent = find(b.parent); parent != nullptr && b.tick > parent->end)
            return damaged("branch " + std::to_string(b.id) + " begins behind the end of branch " +
                           std::to_string(parent->id));
    return Ok{};
}

/// For a format before 8.
Result<> Journal::check_older_checkpoints() const {
    if (!has_older_checkpoints_) return Ok{};
    for (const CheckpointEntry& entry : checkpoints_)
        if (Result<CheckpointBlobs> blobs = checkpoint_blobs(entry); !blobs) return blobs.error();
    return Ok{};
}

Result<> Journal::read_bookmarks() {
    bookmarks_.clear();
    if (!has_bases()) return Ok{};
    Result<std::vector<Row>> rows = db_->select(kSelectBookmarks);
    if (!rows) return damaged(rows.error().message);
    for (const Row& values : rows.value()) {
        Columns c(values);
        Bookmark mark;
        mark.id = c.number(), mark.branch = c.number(), mark.tick = c.number();
        mark.name = c.get<std::string>();
        if (c.hash() != check_of(mark) || !c.good())
            return damaged("bookmark " + std::to_string(mark.id) + " was changed");
        if (find(mark.branch) != nullptr) bookmarks_.push_back(std::move(mark));
    }
    return Ok{};
}

}  // namespace roboss
