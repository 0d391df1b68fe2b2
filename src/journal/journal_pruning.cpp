// Deleting rows.
#include "journal/journal_pruning.h"

#include <algorithm>
#include <charconv>

#include "core/hash.h"
#include "journal/journal_format.h"

namespace roboss {
namespace {

constexpr double kRoom = 0.9;  // of the limit of bytes that pruning aims at

std::optional<std::int64_t> number(const Database& db, const std::string& question, const Row& parameters) {
    const Result<std::vector<Row>> rows = db.select(question, parameters);
    if (!rows || rows.value().size() != 1 || rows.value()[0].size() != 1) return std::nullopt;
    const auto* value = std::get_if<std::int64_t>(&rows.value()[0][0]);
    return value != nullptr ? std::optional<std::int64_t>(*value) : std::nullopt;
}

/// Recorded ticks that stay.
Tick kept_ticks(const JournalKeep& keep, Tick recorded, std::uint64_t used) {
    Tick kept = keep.ticks > 0 ? std::min(keep.ticks, recorded) : recorded;
    if (keep.bytes > 0 && used > keep.bytes) {
        const double share = kRoom * static_cast<double>(keep.bytes) / static_cast<double>(used);
        kept = std::min(kept, static_cast<Tick>(share * static_cast<double>(recorded)));
    }
    return kept;
}

std::uint64_t hash_of(const Row& row, std::size_t at) {
    std::uint64_t value = 0;
    if (const auto* text = std::get_if<std::string>(&row[at]))
        std::from_chars(text->data(), text->data() + text->size(), value, 16);
    return value;
}

/// What of the entries is needed to restore `first` and later ticks.
void keep_needed(LogBatch& entries, Tick first) {
    std::erase_if(entries.orders, [&](const LoggedOrder& o) { return o.order.apply_at < first; });
    std::erase_if(entries.replies, [&](const LoggedReply& reply) { return reply.observed < first; });
    std::erase_if(entries.notes, [&](const LogNote& note) { return note.tick < first; });
}

/// Its base of before, or an empty one.
Result<LogBase> base_of(const Database& db, BranchId branch, LogBatch& entries) {
    LogBase base;
    base.branch = branch;
    const Result<std::vector<Row>> rows =
        db.select("SELECT serial, planned, committed, state_hash, chain, entries FROM bases WHERE branch = ?",
                  {branch});
    if (!rows) return rows.error();
    for (const Row& row : rows.value()) {
        base.serial = std::get<std::int64_t>(row[0]);
        base.planned = std::get<std::int64_t>(row[1]), base.committed = std::get<std::int64_t>(row[2]);
        base.hash = hash_of(row, 3), base.chain = hash_of(row, 4);
        Result<LogBatch> decoded = decode_batch(std::get<Blob>(row[5]));
        if (!decoded) return decoded.error();
        entries = std::move(decoded).value();
    }
    return base;
}

/// Rows up to the last that was committed before `first` become part of the base.
Result<> cut_log(Database& db, const JournalPruning::Cut& cut) {
    const std::optional<std::int64_t> last =
        number(db, "SELECT max(serial) FROM batches WHERE branch = ? AND committed >= 0 AND committed <= ?",
               {cut.branch, cut.first});
    LogBatch entries;
    Result<LogBase> base = base_of(db, cut.branch, entries);
    if (!base) return base.error();
    if (last && *last > base.value().serial) {
        const Result<std::vector<Row>> rows = db.select(
            "SELECT serial, planned, committed, state_hash, chain, entries FROM batches WHERE branch = ? AND "
            "serial <= ? ORDER BY serial",
            {cut.branch, *last});
        if (!rows) return rows.error();
        LogBase& b = base.value();
        for (const Row& row : rows.value()) {
            b.serial = std::get<std::int64_t>(row[0]);
            b.planned = std::max(b.planned, std::get<std::int64_t>(row[1]));
            b.chain = hash_of(row, 4);
            const std::int64_t committed = std::get<std::int64_t>(row[2]);
            if (const std::uint64_t hash = hash_of(row, 3); committed >= b.committed && hash != 0)
                b.committed = committed, b.hash = hash;
            Result<LogBatch> decoded = decode_batch(std::get<Blob>(row[5]));
            if (!decoded) return decoded.error();
            entries.append(std::move(decoded).value());
        }
        if (Result<> r =
                db.insert("DELETE FROM batches WHERE branch = ? AND serial <= ?", {{cut.branch, *last}});
            !r)
            return r;
    }
    if (base.value().serial == 0) return Ok{};
    keep_needed(entries, cut.first);
    base.value().bytes = encode(entries);
    return db.insert(kInsertBase, {to_row(base.value())});
}

Result<> drop(Database& db, const BranchSpan& branch) {
    for (const char* table : {"checkpoints", "batches", "bases", "bookmarks", "ends"})
        if (Result<> r = db.insert(std::string("DELETE FROM ") + table + " WHERE branch = ?", {{branch.id}});
            !r)
            return r;
    if (branch.parent == 0)
        if (Result<> r = db.insert("INSERT OR REPLACE INTO meta VALUES(?,?)",
                                   {{std::string(kMetaWorld), to_hex(branch.model_hash)}});
            !r)
            return r;
    if (branch.parent == 0)
        if (Result<> r = seal_meta(db); !r) return r;
    return db.insert("DELETE FROM branches WHERE id = ?", {{branch.id}});
}

Result<> prune_rows(Database& db, const JournalPruning& pruning) {
    for (const BranchSpan& branch : pruning.dropped)
        if (Result<> r = drop(db, branch); !r) return r;
    for (const JournalPruning::Cut& cut : pruning.cuts) {
        for (const char* table : {"checkpoints", "bookmarks"})
            if (Result<> r = db.insert(std::string("DELETE FROM ") + table + " WHERE branch = ? AND tick < ?",
                                       {{cut.branch, cut.first}});
                !r)
                return r;
        if (Result<> r = cut_log(db, cut); !r) return r;
    }
    for (const std::uint64_t model : pruning.models)
        if (Result<> r = db.insert("DELETE FROM models WHERE hash = ?", {{to_hex(model)}}); !r) return r;
    return db.run("DELETE FROM states WHERE hash NOT IN (SELECT states FROM checkpoints);");
}

}  // namespace

std::uint64_t used_bytes(const Database& db) {
    const std::int64_t size = number(db, "PRAGMA page_size", {}).value_or(0);
    const std::int64_t all = number(db, "PRAGMA page_count", {}).value_or(0);
    const std::int64_t free = number(db, "PRAGMA freelist_count", {}).value_or(0);
    return static_cast<std::uint64_t>(std::max<std::int64_t>(0, (all - free) * size));
}

JournalPruning plan_pruning(const Database& db, const std::vector<BranchSpan>& spans, const JournalKeep& keep,
                            std::uint64_t used) {
    JournalPruning plan;
    Tick recorded = 0;
    for (const BranchSpan& span : spans) recorded += span.end - span.first;
    Tick beyond = recorded - kept_ticks(keep, recorded, used);
    for (std::size_t i = 0; i < spans.size() && beyond > 0; ++i) {
        const BranchSpan& span = spans[i];
        const Tick length = span.end - span.first;
        if (beyond >= length && i + 1 < spans.size()) {
            plan.dropped.push_back(span);
            beyond -= length;
            continue;
        }
        const std::optional<std::int64_t> first =
            number(db, "SELECT max(tick) FROM checkpoints WHERE branch = ? AND tick <= ?",
                   {span.id, span.first + beyond});
        if (first && *first > span.first) plan.cuts.push_back({span.id, *first});
        break;
    }
    for (const BranchSpan& gone : plan.dropped) {
        const bool used_elsewhere =
            std::any_of(spans.begin() + static_cast<std::ptrdiff_t>(plan.dropped.size()), spans.end(),
                        [&](const BranchSpan& span) { return span.model_hash == gone.model_hash; });
        const bool listed =
            std::find(plan.models.begin(), plan.models.end(), gone.model_hash) != plan.models.end();
        if (!used_elsewhere && !listed) plan.models.push_back(gone.model_hash);
    }
    return plan;
}

Result<> prune_journal(Database& db, const JournalPruning& pruning) {
    if (Result<> r = db.run("BEGIN IMMEDIATE;"); !r) return r;
    Result<> r = prune_rows(db, pruning);
    if (r) r = db.run("COMMIT;");
    if (!r) (void)db.run("ROLLBACK;");
    return r;
}

}  // namespace roboss
