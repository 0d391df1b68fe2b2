// The tables of a journal, and the check in every row, which detects damage that SQLite does not.
#pragma once

#include <optional>

#include "journal/journal.h"

namespace roboss {

// 5: bookmarks, pruning; 6: orders of joint states; 7: radio; 8: checks that need no blobs
inline constexpr std::int64_t kJournalFormat = 8;
inline constexpr std::int64_t kOldestJournalFormat = 4;  // that is read, and brought up to date when written
inline constexpr std::int64_t kFirstPrunableFormat = 5;
inline constexpr std::int64_t kFirstSealedFormat = 8;
/// Key in `meta`: hash of the Model of the world file, where no branch has it: the root branch was pruned, or
/// robots had been added to the run before it was saved.
inline constexpr const char* kMetaWorld = "world";
/// Key in `meta`: hash of its other rows.
inline constexpr const char* kMetaCheck = "check";
/// Remedy for a damaged file.
inline constexpr const char* kAnotherCopy = "take another copy of the file, or start without it";

extern const char* const kJournalTables;
/// The tables that format 5 has added.
extern const char* const kJournalTables5;
/// Where the logs of branches end, as their writer left them. Added within format 8: a file may be without.
extern const char* const kJournalEnds;
/// The columns that format 8 has added, for tables of an older one. Rows from before have NULL there.
extern const char* const kJournalColumns8;

std::string program_version();

struct BatchRow {
    BranchId branch = 0;
    std::int64_t serial = 0;
    Tick planned = 0, committed = 0;
    std::uint64_t hash = 0;  // of the world at `committed`
    // A reader of ticks [from, until) needs the row if high >= from and low < until.
    Tick low = 0, high = 0;
    std::int64_t orders = 0;
    Blob bytes;
    std::optional<std::uint64_t> bytes_hash;  // none: of a row that a format before 8 has
};
/// A checkpoint without its blobs.
struct CheckpointRow {
    CheckpointEntry entry;
    std::uint64_t states_hash = 0, memory_hash = 0;
    std::int64_t serial = 0;  // of the log's row that was written with it
};
/// Stands for the rows of a branch's log up to `serial`, which were pruned; has those of their entries that
/// are still needed.
struct LogBase {
    BranchId branch = 0;
    std::int64_t serial = 0;
    Tick planned = -1, committed = -1;
    std::uint64_t hash = 0;  // of the world at `committed`
    std::uint64_t chain = 0;
    Blob bytes;
};
/// The last row of a branch's log when its writer closed it or went on with another branch.
struct LogEnd {
    BranchId branch = 0;
    Journal::Tail tail;
};
BatchRow to_batch_row(const LogBatch& entries);  // low, high, orders, bytes and their hash
/// Chains a row to those before it: a missing or changed row breaks the chain. It covers the columns and
/// `bytes_hash`, so that a reader can check all rows without their bytes; of a row without it, the bytes.
std::uint64_t chain_of(std::uint64_t before, const BatchRow& row);
std::uint64_t check_of(const Branch& branch);
std::uint64_t check_of(const CheckpointRow& row);
/// The digest of a row that a format before 8 has.
std::uint64_t check_of(const CheckpointEntry& entry, const Blob& memory, const Blob& states);
std::uint64_t check_of(const LogBase& base);
std::uint64_t check_of(const Bookmark& mark);
std::uint64_t check_of(const LogEnd& end);

Row to_row(const LogBase& base);
Row to_row(const Bookmark& mark);
Row to_row(const LogEnd& end);
Row to_row(const BatchRow& row, std::uint64_t chain);
Row to_row(const Branch& branch);
/// `states` are stored by their hash, so that a run that is reset often does not store the start each time.
Row to_row(const CheckpointEntry& entry, Blob memory, const Blob& states, std::int64_t serial);
Row states_row(Blob states);

inline constexpr const char* kInsertModel = "INSERT OR IGNORE INTO models VALUES(?,?,?)";
inline constexpr const char* kInsertBranch = "INSERT INTO branches VALUES(?,?,?,?,?,?,?,?)";
inline constexpr const char* kInsertCheckpoint =
    "INSERT OR IGNORE INTO checkpoints(branch, tick, state_hash, states, memory_hash, serial, row_hash, "
    "memory) "
    "VALUES(?,?,?,?,?,?,?,?)";
inline constexpr const char* kInsertStates = "INSERT OR IGNORE INTO states VALUES(?,?)";
inline constexpr const char* kInsertBatch =
    "INSERT INTO batches(branch, serial, planned, committed, state_hash, low, high, orders, entries_hash, "
    "chain, entries) VALUES(?,?,?,?,?,?,?,?,?,?,?)";
inline constexpr const char* kInsertBase = "INSERT OR REPLACE INTO bases VALUES(?,?,?,?,?,?,?,?)";
inline constexpr const char* kInsertBookmark = "INSERT INTO bookmarks VALUES(?,?,?,?,?)";
inline constexpr const char* kInsertEnd = "INSERT OR REPLACE INTO ends VALUES(?,?,?,?)";
inline constexpr const char* kSelectEnds = "SELECT branch, serial, chain, row_hash FROM ends ORDER BY branch";
inline constexpr const char* kSelectBases =
    "SELECT branch, serial, planned, committed, state_hash, chain, entries, row_hash FROM bases ORDER BY "
    "branch";
inline constexpr const char* kSelectBookmarks =
    "SELECT id, branch, tick, name, row_hash FROM bookmarks ORDER BY id";

Row model_row(const Model& model);

/// Hash of the rows of `meta` but its check.
Result<std::uint64_t> check_of_meta(const Database& db);
/// Within a transaction that has changed `meta`.
Result<> seal_meta(Database& db);

}  // namespace roboss
