// For tests: a journal as formats before 8 have it, made of one of today.
#pragma once

#include <charconv>
#include <map>

#include "core/check.h"
#include "core/hash.h"
#include "journal/journal_format.h"

namespace roboss::test {

inline std::uint64_t hash_in(const Value& text) {
    std::uint64_t value = 0;
    const std::string& digits = std::get<std::string>(text);
    std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    return value;
}

/// Rows get the checks of before, and lose the columns that format 8 has added. The journal was not pruned.
inline void make_older(const std::string& path, std::int64_t format) {
    Database db = std::move(Database::open_write(path)).value();
    const auto number = [](const Value& value) { return std::get<std::int64_t>(value); };
    std::map<BranchId, std::uint64_t> chains;
    const auto batches = db.select(
        "SELECT branch, serial, planned, committed, state_hash, low, high, orders, entries FROM batches "
        "ORDER BY branch, serial");
    for (const Row& r : batches.value()) {
        BatchRow row{number(r[0]), number(r[1]), number(r[2]), number(r[3]),         hash_in(r[4]),
                     number(r[5]), number(r[6]), number(r[7]), std::get<Blob>(r[8]), {}};
        std::uint64_t& chain = chains[row.branch];
        chain = chain_of(chain, row);
        const Result<> chained = db.insert("UPDATE batches SET chain = ? WHERE branch = ? AND serial = ?",
                                           {{to_hex(chain), row.branch, row.serial}});
        ROBOSS_CHECK(chained.ok(), path);
    }
    const auto checkpoints = db.select(
        "SELECT c.branch, c.tick, c.state_hash, c.memory, s.bytes FROM checkpoints c JOIN states s ON s.hash "
        "= c.states");
    for (const Row& r : checkpoints.value()) {
        const CheckpointEntry entry{number(r[0]), number(r[1]), hash_in(r[2])};
        const std::uint64_t check = check_of(entry, std::get<Blob>(r[3]), std::get<Blob>(r[4]));
        const Result<> checked =
            db.insert("UPDATE checkpoints SET row_hash = ? WHERE branch = ? AND tick = ?",
                      {{to_hex(check), entry.branch, entry.tick}});
        ROBOSS_CHECK(checked.ok(), path);
    }
    std::string change =
        "ALTER TABLE batches DROP COLUMN entries_hash; ALTER TABLE checkpoints DROP COLUMN memory_hash; "
        "ALTER TABLE checkpoints DROP COLUMN serial; DROP TABLE ends; DELETE FROM meta WHERE key = 'check'; "
        "UPDATE meta SET "
        "value = " +
        std::to_string(format) + " WHERE key = 'format';";
    if (format < kFirstPrunableFormat) change += "DROP TABLE bases; DROP TABLE bookmarks;";
    ROBOSS_CHECK(db.run(change).ok(), path);
}

}  // namespace roboss::test
