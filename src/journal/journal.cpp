// Reads a journal and verifies everything.
#include "journal/journal.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <utility>

#include "core/hash.h"
#include "journal/columns.h"
#include "journal/journal_format.h"
#include "wire/model_codec.h"

namespace roboss {

namespace {

constexpr std::uintmax_t kLookedThrough_bytes = 64u
                                                << 20;  // a file up to this size is always checked completely

}  // namespace

Error Journal::damaged(const std::string& what) const {
    return {path_ + " is damaged: " + what, kAnotherCopy, "journal-damaged"};
}

bool Journal::is_small(const std::string& path) {
    std::error_code error;
    return std::filesystem::file_size(path, error) <= kLookedThrough_bytes;
}

Result<Journal> Journal::open(const std::string& path, bool thorough) {
    return open_as(path, thorough || is_small(path));
}

Result<Journal> Journal::open_own(const std::string& path) {
    return open_as(path, false);
}

Result<Journal> Journal::open_as(const std::string& path, bool look_through) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
        return Error{path + ": there is no such file", "give a file that --journal or --save wrote",
                     "no-file"};
    Result<Database> opened = Database::open_read(path);
    if (!opened) return opened.error();
    Journal journal;
    journal.path_ = path;
    journal.db_ = std::move(opened).value();
    if (Result<> read = journal.read_meta(); !read) return read.error();
    if (!journal.has_whole_pages()) return journal.damaged("it is truncated");
    if (look_through) {
        Result<std::vector<Row>> sound = journal.db_->select("PRAGMA integrity_check(1)");
        if (!sound || sound.value().size() != 1 || sound.value()[0][0] != Value(std::string("ok")))
            return journal.damaged("it is truncated or was changed");
    }
    if (Result<> read = journal.refresh(); !read) return read.error();
    if (look_through)
        if (Result<> good = journal.check_older_checkpoints(); !good) return good.error();
    return journal;
}

/// A file that no run is writing consists of whole pages.
bool Journal::has_whole_pages() const {
    std::error_code error;
    const auto waiting = std::filesystem::file_size(path_ + "-wal", error);
    if (!error && waiting > 0) return true;
    const Result<std::vector<Row>> rows = db_->select("PRAGMA page_size");
    const auto* page =
        rows && rows.value().size() == 1 ? std::get_if<std::int64_t>(&rows.value()[0][0]) : nullptr;
    if (page == nullptr || *page <= 0) return false;
    const auto size = std::filesystem::file_size(path_, error);
    return !error && size % static_cast<std::uintmax_t>(*page) == 0;
}

/// All tables as they are at one moment, although the file may be written meanwhile.
Result<> Journal::refresh() {
    (void)db_->run("BEGIN");
    Result<> read = read_tables();
    (void)db_->run("COMMIT");
    return read;
}

Error Journal::changed(const std::string& row, BranchId branch) const {
    return damaged(row + " of branch " + std::to_string(branch) + " was changed");
}

Result<> Journal::read_tables() {
    for (Result<> (Journal::*read)() :
         {&Journal::read_meta, &Journal::read_branches, &Journal::read_checkpoint_entries,
          &Journal::read_log_bases, &Journal::read_log_heads, &Journal::read_log_ends,
          &Journal::read_bookmarks})
        if (Result<> done = (this->*read)(); !done) return done;
    return check_serials();
}

bool Journal::has_bases() const {
    return format_ >= kFirstPrunableFormat;
}

/// Its rows can be checked without their blobs.
bool Journal::is_sealed() const {
    return format_ >= kFirstSealedFormat;
}

const Branch* Journal::find(BranchId id) const {
    const auto found = std::lower_bound(branches_.begin(), branches_.end(), id,
                                        [](const Branch& b, BranchId wanted) { return b.id < wanted; });
    return found != branches_.end() && found->id == id ? &*found : nullptr;
}

Branch* Journal::find_own(BranchId id) {
    return const_cast<Branch*>(std::as_const(*this).find(id));
}

Result<Branch> Journal::branch(std::optional<BranchId> id) const {
    const BranchId wanted = id.value_or(branches_.back().id);
    if (const Branch* found = find(wanted)) return *found;
    if (wanted >= 1 && wanted < branches_.back().id)
        return Error{path_ + " no longer has branch " + std::to_string(wanted) + ": it was pruned",
                     "`roboss journal info " + path_ + "` shows those that it has; see --journal-keep",
                     "no-branch"};
    return Error{path_ + " has no branch " + std::to_string(wanted) + ", its newest is " +
                     std::to_string(branches_.back().id),
                 "`roboss journal info " + path_ + "` shows them", "no-branch"};
}

std::vector<BranchSpan> Journal::spans() const {
    std::vector<BranchSpan> spans;
    spans.reserve(branches_.size());
    for (const Branch& b : branches_) spans.push_back(b.span());
    return spans;
}

Result<Branch> Journal::holder(const Lineage& lineage, Tick tick, double dt_s) const {
    if (const Lineage::Part* part = lineage.at(tick)) return *find(part->branch);
    const auto at = [dt_s](Tick t) { return time_text(t, dt_s); };
    const Branch& named = *find(lineage.branch());
    std::string remedy = "give a time that it has";
    for (const Branch& other : branches_)
        if (this->lineage(other).at(tick) != nullptr)
            remedy = "branch " + std::to_string(other.id) + " has it: " + path_ + "#" +
                     std::to_string(other.id) + "@" + at(tick).substr(0, at(tick).size() - 2);
    const Branch* first = find(lineage.parts().front().branch);
    if (tick < lineage.first() && (first->first > first->tick || first->parent != 0))
        remedy += "; earlier ones were pruned (--journal-keep)";
    return Error{path_ + " has nothing at " + at(tick) + " (tick " + std::to_string(tick) + ") of branch " +
                     std::to_string(named.id) + ", it has " + at(lineage.first()) + " to " +
                     at(lineage.last()) + " (ticks " + std::to_string(lineage.first()) + " to " +
                     std::to_string(lineage.last()) + ")",
                 remedy, "no-such-time"};
}

std::uint64_t Journal::world_hash(const Branch& branch) const {
    const Branch* root = find(branch.id);
    while (const Branch* parent = find(root->parent)) root = parent;
    return world_.value_or(root->model_hash);
}

Result<std::shared_ptr<const Model>> Journal::model(const Branch& branch) const {
    Result<std::vector<Row>> rows =
        db_->select("SELECT bytes, bytes_hash FROM models WHERE hash = ?", {to_hex(branch.model_hash)});
    if (!rows) return damaged(rows.error().message);
    if (rows.value().size() != 1)
        return damaged("the Model of branch " + std::to_string(branch.id) + " is missing");
    Columns c(rows.value()[0]);
    const Blob bytes = c.get<Blob>();
    const std::uint64_t hash = c.hash();
    if (!c.good() || hash_of_bytes(bytes) != hash) return changed("the Model", branch.id);
    Result<std::shared_ptr<const Model>> model = decode_model(bytes);
    if (!model) return damaged(model.error().message);
    if (model.value()->hash != branch.model_hash) return damaged("a Model does not have its recorded hash");
    return model;
}

std::vector<CheckpointEntry> Journal::checkpoints(const Branch& branch) const {
    std::vector<CheckpointEntry> entries;
    for (const CheckpointEntry& entry : checkpoints_)
        if (entry.branch == branch.id) entries.push_back(entry);
    return entries;
}

const CheckpointEntry* Journal::checkpoint_before(const Branch& branch, Tick tick) const {
    const auto above = std::ranges::upper_bound(
        checkpoints_, std::pair(branch.id, tick), {},
        [](const CheckpointEntry& entry) { return std::pair(entry.branch, entry.tick); });
    if (above == checkpoints_.begin() || std::prev(above)->branch != branch.id) return nullptr;
    return &*std::prev(above);
}

/// Checked against the hashes in the row.
Result<Journal::CheckpointBlobs> Journal::checkpoint_blobs(const CheckpointEntry& entry) const {
    Result<std::vector<Row>> rows = db_->select(
        std::string("SELECT c.memory, s.bytes, c.states, ") + (is_sealed() ? "c.memory_hash" : "NULL") +
            ", c.row_hash FROM checkpoints c JOIN states s ON s.hash = c.states WHERE c.branch = ? AND "
            "c.tick = ?",
        {entry.branch, entry.tick});
    const std::string name = "the checkpoint " + at_tick(entry.tick);
    if (!rows) return damaged(rows.error().message);
    if (rows.value().size() != 1)
        return damaged(name + " of branch " + std::to_string(entry.branch) + " is missing");
    Columns c(rows.value()[0]);
    CheckpointBlobs blobs;
    blobs.memory = c.get<Blob>(), blobs.states = c.get<Blob>();
    const std::uint64_t states_hash = c.hash();
    const std::optional<std::uint64_t> memory_hash = c.hash_or_null();
    const std::uint64_t check = c.hash();
    const bool right = memory_hash ? hash_of_bytes(blobs.memory) == *memory_hash &&
                                         hash_of_bytes(blobs.states) == states_hash
                                   : check == check_of(entry, blobs.memory, blobs.states);
    if (!c.good() || !right) return changed(name, entry.branch);
    return blobs;
}

Result<StoredCheckpoint> Journal::checkpoint(const CheckpointEntry& entry, const Model& model) const {
    Result<CheckpointBlobs> blobs = checkpoint_blobs(entry);
    if (!blobs) return blobs.error();
    const std::string name = "the checkpoint " + at_tick(entry.tick);
    Result<std::vector<RobotState>> decoded = decode_states(blobs.value().states, model);
    if (!decoded) return damaged(name + ": " + decoded.error().message);
    Result<ClientMemory> remembered = decode_memory(blobs.value().memory);
    if (!remembered) return damaged(name + ": " + remembered.error().message);
    if (state_hash_of(model, entry.tick, decoded.value()) != entry.hash)
        return damaged(name + " does not have the hash that was saved");
    return StoredCheckpoint{std::move(decoded).value(), std::move(remembered).value()};
}

Result<LogBatch> Journal::log(const Branch& branch, Tick from, Tick until) const {
    Result<std::vector<Row>> rows = db_->select(
        "SELECT b.serial, b.planned, b.committed, b.state_hash, b.low, b.high, b.orders, b.entries, "
        "b.chain, " +
            std::string(is_sealed() ? "b.entries_hash, " : "NULL, ") +
            std::string(has_bases() ? "coalesce(a.chain, p.chain, '0000000000000000') "
                                    : "coalesce(a.chain, '0000000000000000') ") +
            "FROM batches b LEFT JOIN batches a ON a.branch = b.branch AND a.serial = b.serial - 1 " +
            (has_bases() ? "LEFT JOIN bases p ON p.branch = b.branch AND p.serial = b.serial - 1 " : "") +
            "WHERE b.branch = ? AND b.high >= ? AND b.low < ? ORDER BY b.serial",
        {branch.id, from, until});
    if (!rows) return damaged(rows.error().message);
    LogBatch log;
    if (Result<> based = add_base(branch, log); !based) return based.error();
    for (const Row& values : rows.value()) {
        Columns c(values);
        BatchRow row;
        row.branch = branch.id;
        row.serial = c.number(), row.planned = c.number(), row.committed = c.number();
        row.hash = c.hash();
        row.low = c.number(), row.high = c.number(), row.orders = c.number();
        row.bytes = c.get<Blob>();
        const std::uint64_t chain = c.hash();
        row.bytes_hash = c.hash_or_null();
        const std::uint64_t before = c.hash();
        const std::string name = "row " + std::to_string(row.serial) + " of the log";
        if (!c.good() || chain_of(before, row) != chain ||
            (row.bytes_hash && *row.bytes_hash != hash_of_bytes(row.bytes)))
            return changed(name, branch.id);
        Result<LogBatch> entries = decode_batch(row.bytes);
        if (!entries) return damaged(name + ": " + entries.error().message);
        log.append(std::move(entries).value());
    }
    std::erase_if(log.orders,
                  [&](const LoggedOrder& o) { return o.order.apply_at < from || o.given_at >= until; });
    std::erase_if(log.replies, [&](const LoggedReply& w) {
        return w.observed < from || (w.observed >= until && w.observed != kGoneForGood);
    });
    std::erase_if(log.notes, [&](const LogNote& n) { return n.tick < from || n.tick > until; });
    std::stable_sort(log.orders.begin(), log.orders.end(), [](const LoggedOrder& x, const LoggedOrder& y) {
        return comes_before(x.order, y.order);
    });
    return log;
}

/// Entries of pruned rows that are still needed.
Result<> Journal::add_base(const Branch& branch, LogBatch& log) const {
    if (!has_bases()) return Ok{};
    Result<std::vector<Row>> rows = db_->select("SELECT entries FROM bases WHERE branch = ?", {branch.id});
    if (!rows) return damaged(rows.error().message);
    for (const Row& row : rows.value()) {
        Result<LogBatch> entries = decode_batch(Columns(row).get<Blob>());
        if (!entries) return damaged("the beginning of its log: " + entries.error().message);
        log.append(std::move(entries).value());
    }
    return Ok{};
}

Result<SavedRun> Journal::run_at(const Branch& branch, const Model& model, Tick tick) const {
    const CheckpointEntry* before = checkpoint_before(branch, tick);
    if (before == nullptr || tick > branch.end) {
        const std::vector<BranchSpan> alone{branch.span()};
        Result<Branch> none = holder(Lineage::of(alone, branch.id), tick, model.dt_s);
        if (!none) return none.error();
        return damaged("branch " + std::to_string(branch.id) + " has no checkpoint");
    }
    return run_from(branch, *before, model, tick);
}

Result<SavedRun> Journal::run_from(const Branch& branch, const CheckpointEntry& entry, const Model& model,
                                   Tick until) const {
    return run_with(branch, entry, model, until, until);
}

Result<SavedRun> Journal::resume_from(const Branch& branch, const CheckpointEntry& entry,
                                      const Model& model) const {
    return run_with(branch, entry, model, branch.end, std::numeric_limits<Tick>::max());
}

Result<SavedRun> Journal::run_with(const Branch& branch, const CheckpointEntry& entry, const Model& model,
                                   Tick until, Tick said_until) const {
    Result<StoredCheckpoint> stored = checkpoint(entry, model);
    if (!stored) return stored.error();
    Result<LogBatch> entries = log(branch, entry.tick, said_until);
    if (!entries) return entries.error();
    SavedRun run;
    run.world_file = branch.world_file;
    if (const std::uint64_t world = world_hash(branch); world != branch.model_hash) run.world_hash = world;
    run.seed = branch.seed;
    run.tick = entry.tick;
    run.states = std::move(stored.value().states);
    run.memory = std::move(stored.value().memory);
    run.orders = std::move(entries.value().orders);
    run.logged_until = until;
    for (const LoggedOrder& o : run.orders)
        if (Result<> checked = check_order(model, o.order); !checked) return damaged(checked.error().message);
    for (const auto& [client, name] : entries.value().clients) {
        if (client > 1'000'000) return damaged("a Client has an impossible number");
        if (run.clients.size() <= client) run.clients.resize(client + 1);
        run.clients[client] = name;
        run.answered.try_emplace(name, -1);
    }
    for (const LoggedReply& reply : entries.value().replies) {
        if (reply.client.index() >= run.clients.size())
            return damaged("a Client that never joined has a reply in it");
        if (reply.observed == kGoneForGood) {
            run.left.push_back(run.clients[reply.client.index()]);
            continue;
        }
        Tick& answered = run.answered[run.clients[reply.client.index()]];
        answered = std::max(answered, reply.observed);
    }
    return run;
}

Journal::Tail Journal::tail(BranchId branch) const {
    const auto found = heads_.find(branch);
    return found == heads_.end() ? Tail{} : found->second.tail;
}

bool Journal::has_end(BranchId branch) const {
    const auto found = heads_.find(branch);
    return found != heads_.end() && found->second.ended == found->second.tail.serial;
}

Result<> Journal::inspect() const {
    for (const Branch& b : branches_) {
        Result<std::shared_ptr<const Model>> model = this->model(b);
        if (!model) return model.error();
        for (const CheckpointEntry& entry : checkpoints_)
            if (entry.branch == b.id)
                if (Result<StoredCheckpoint> stored = checkpoint(entry, *model.value()); !stored)
                    return stored.error();
        constexpr Tick kAll = std::numeric_limits<Tick>::max();
        if (Result<LogBatch> entries = log(b, -kAll, kAll); !entries) return entries.error();
    }
    return check_tree();
}

Result<> check_world(const Journal& journal, const Branch& branch, const Model& model) {
    const std::uint64_t hash = journal.world_hash(branch);
    if (hash == model.hash) return Ok{};
    return Error{journal.path() + " was written for another world: " + branch.world_file + ", model hash " +
                     to_hex(hash) + "; this one has model hash " + to_hex(model.hash),
                 "give the world file, the step, the accuracy and the version of RoBOSS (" +
                     journal.version() + ") that it was written with",
                 "another-world"};
}

}  // namespace roboss
