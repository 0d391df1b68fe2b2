// The tables of a journal, and the check in every row, which detects damage that SQLite does not.
#pragma once

#include "journal/journal.h"

namespace roboss {

inline constexpr std::int64_t kJournalFormat =
    7;  // 5: bookmarks, pruning; 6: orders of joint states; 7: radio
inline constexpr std::int64_t kOldestJournalFormat = 4;  // that is read, and brought up to date when written
inline constexpr std::int64_t kFirstPrunableFormat = 5;
/// Key in `meta`: hash of the Model of a root branch that was pruned.
inline constexpr const char* kMetaWorld = "world";

extern const char* const kJournalTables;
/// The tables that format 5 has added.
extern const char* const kJournalTables5;

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
BatchRow to_batch_row(const LogBatch& entries);  // low, high, orders, bytes
/// Chains a row to those before it: a missing or changed row breaks the chain.
std::uint64_t chain_of(std::uint64_t before, const BatchRow& row);
std::uint64_t check_of(const Branch& branch);
std::uint64_t check_of(const CheckpointEntry& entry, const Blob& memory, const Blob& states);
std::uint64_t check_of(const LogBase& base);
std::uint64_t check_of(const Bookmark& mark);

Row to_row(const LogBase& base);
Row to_row(const Bookmark& mark);
Row to_row(const BatchRow& row, std::uint64_t chain);
Row to_row(const Branch& branch);
/// `states` are stored by their hash, so that a run that is reset often does not store the start each time.
Row to_row(const CheckpointEntry& entry, Blob memory, const Blob& states);
Row states_row(Blob states);

inline constexpr const char* kInsertModel = "INSERT OR IGNORE INTO models VALUES(?,?,?)";
inline constexpr const char* kInsertBranch = "INSERT INTO branches VALUES(?,?,?,?,?,?,?,?)";
inline constexpr const char* kInsertCheckpoint = "INSERT OR IGNORE INTO checkpoints VALUES(?,?,?,?,?,?)";
inline constexpr const char* kInsertStates = "INSERT OR IGNORE INTO states VALUES(?,?)";
inline constexpr const char* kInsertBatch = "INSERT INTO batches VALUES(?,?,?,?,?,?,?,?,?,?)";
inline constexpr const char* kInsertBase = "INSERT OR REPLACE INTO bases VALUES(?,?,?,?,?,?,?,?)";
inline constexpr const char* kInsertBookmark = "INSERT INTO bookmarks VALUES(?,?,?,?,?)";
inline constexpr const char* kSelectBases =
    "SELECT branch, serial, planned, committed, state_hash, chain, entries, row_hash FROM bases ORDER BY "
    "branch";
inline constexpr const char* kSelectBookmarks =
    "SELECT id, branch, tick, name, row_hash FROM bookmarks ORDER BY id";

Row model_row(const Model& model);

}  // namespace roboss
