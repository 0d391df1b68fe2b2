// The journal's thread, and what it writes.
#include "journal/journal_writer.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "journal/journal_format.h"

namespace roboss {

namespace {

// WAL: readers look at a journal that is being written, and a killed process leaves a whole one. NORMAL: the
// disk is waited for when the WAL is folded in, so only a power failure can lose the last entries.
constexpr const char* kPragmas =
    "PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL; PRAGMA wal_autocheckpoint=2000;";

std::chrono::milliseconds ms(std::int64_t n) {
    return std::chrono::milliseconds(n);
}

std::size_t bytes_about(const LogBatch& entries) {
    return 160 * entries.orders.size() + 16 * entries.replies.size() + 80 * entries.notes.size();
}

Result<int> lock(const std::string& path) {
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file < 0)
        return Error{path + ": cannot write it", "check the path, the permissions and the free space"};
    if (flock(file, LOCK_EX | LOCK_NB) == 0) return file;
    ::close(file);
    return Error{path + " is being written by another run", "end that run, or give another file",
                 "journal-busy"};
}

/// The one number that the question is answered with; -1 if it is not.
std::int64_t count(const Database& db, const char* question) {
    const Result<std::vector<Row>> rows = db.select(question);
    if (!rows || rows.value().size() != 1) return -1;
    const auto* number = std::get_if<std::int64_t>(&rows.value()[0][0]);
    return number != nullptr ? *number : -1;
}

Result<> make_tables(Database& db) {
    const std::vector<Row> meta{{std::string("format"), kJournalFormat},
                                {std::string("version"), program_version()}};
    if (Result<> r = db.run(std::string("BEGIN;") + kJournalTables + kJournalTables5); !r) return r;
    if (Result<> r = db.insert("INSERT INTO meta VALUES(?,?)", meta); !r) return r;
    if (Result<> r = seal_meta(db); !r) return r;
    return db.run("COMMIT;");
}

/// Of a file in an older format.
Result<> bring_up_to_date(Database& db) {
    const std::int64_t format = count(db, "SELECT value FROM meta WHERE key = 'format'");
    if (format == kJournalFormat) return Ok{};
    const std::string tables =
        std::string(format < kFirstPrunableFormat ? kJournalTables5 : "") + kJournalColumns8;
    if (Result<> r = db.run("BEGIN;" + tables); !r) return r;
    if (Result<> r = db.insert("UPDATE meta SET value = ? WHERE key = 'format'", {{kJournalFormat}}); !r)
        return r;
    if (Result<> r = seal_meta(db); !r) return r;
    return db.run("COMMIT;");
}

/// The ends of all logs of a file that a writer opens: no row of them may go, also of a run that was killed.
std::vector<Row> ends_of(const Journal& journal) {
    std::vector<Row> ends;
    for (const Branch& b : journal.branches()) ends.push_back(to_row(LogEnd{b.id, journal.tail(b.id)}));
    return ends;
}

Result<> mark_ends(Database& db, const std::vector<Row>& ends) {
    if (Result<> r = db.run(std::string("BEGIN;") + kJournalEnds); !r) return r;
    Result<> r = db.insert(kInsertEnd, ends);
    if (r) r = db.run("COMMIT;");
    if (!r) (void)db.run("ROLLBACK;");
    return r;
}

}  // namespace

Result<std::unique_ptr<JournalWriter>> JournalWriter::open(const std::string& path,
                                                           const JournalWriterOptions& options) {
    std::unique_ptr<JournalWriter> writer(new JournalWriter);
    writer->path_ = path;
    writer->options_ = options;
    Result<int> locked = lock(path);
    if (!locked) return locked.error();
    writer->lock_file_ = locked.value();
    Result<Database> opened = Database::open_write(path);
    if (!opened) return opened.error();
    writer->db_ = std::move(opened).value();
    const std::int64_t tables = count(*writer->db_, "SELECT count(*) FROM sqlite_master");
    const bool began = tables > 0 && count(*writer->db_, "SELECT count(*) FROM branches") != 0;
    std::vector<Row> ends;
    if (tables < 0 || began) {  // it is not empty: check the contents
        Result<Journal> journal = Journal::open(path);
        if (!journal) return journal.error();
        writer->branches_ = journal.value().branches().back().id;
        writer->spans_ = journal.value().spans();
        writer->bookmarks_ = journal.value().bookmarks();
        for (const Bookmark& mark : writer->bookmarks_) writer->last_bookmark_ = mark.id;
        if (Result<> r = bring_up_to_date(*writer->db_); !r) return r.error();
        ends = ends_of(journal.value());
    }
    if (Result<> r = writer->db_->run(kPragmas); !r) return r.error();
    if (tables == 0)
        if (Result<> r = make_tables(*writer->db_); !r) return r.error();
    writer->marks_ends_ = mark_ends(*writer->db_, ends).ok();  // not on a full disk: the ends stay open
    writer->thread_ = std::thread([w = writer.get()] { w->serve(); });
    return writer;
}

JournalWriter::~JournalWriter() {
    if (thread_.joinable()) (void)close();
    db_.reset();
    if (lock_file_ >= 0) ::close(lock_file_);
}

Result<BranchId> JournalWriter::start_branch(Branch branch, const Model& model) {
    if (Result<> flushed = flush(); !flushed) return flushed.error();
    const std::lock_guard guard(mutex_);
    branch.id = branches_ + 1;
    branch.model_hash = model.hash;
    if (std::find(models_.begin(), models_.end(), model.hash) == models_.end()) {
        waiting_.models.push_back(model_row(model));
        models_.push_back(model.hash);
    }
    if (branch_ != 0 && marks_ends_) waiting_.ends.push_back(to_row(LogEnd{branch_, tail_}));
    waiting_.branches.push_back(to_row(branch));
    spans_.push_back(
        {branch.id, branch.parent, branch.tick, branch.tick, branch.tick, model.hash, branch.reason});
    ++timeline_serial_;
    beginning_ = true;
    branches_ = branch_ = branch.id;
    model_hash_ = model.hash;
    tail_ = {};
    return branch_;
}

void JournalWriter::continue_branch(const Journal& journal, const Branch& branch) {
    (void)flush();
    const std::lock_guard guard(mutex_);
    branch_ = branch.id;
    model_hash_ = branch.model_hash;
    tail_ = journal.tail(branch.id);
}

void JournalWriter::serve() {
    std::unique_lock guard(mutex_);
    auto last = std::chrono::steady_clock::now() - ms(options_.gather_ms);
    for (;;) {
        wake_.wait(guard, [&] { return ending_ || (!beginning_ && !waiting_.empty()); });
        if (waiting_.empty()) return;
        const auto due = last + ms(failing_ ? options_.retry_ms : options_.gather_ms);
        wake_.wait_until(guard, due, [&] { return ending_ || (hurry_ && !failing_); });
        hurry_ = false;
        Pending pending = std::move(waiting_);
        waiting_ = {};
        writing_ = true;
        guard.unlock();
        const Result<> written = write(pending);
        guard.lock();
        writing_ = false;
        const bool prunes = written.ok() && pending.checkpoint && options_.keep.limited();
        settle(written, pending);
        if (prunes) {
            done_.notify_all();
            writing_ = true;
            guard.unlock();
            prune();
            guard.lock();
            writing_ = false;
        }
        last = std::chrono::steady_clock::now();
        done_.notify_all();
        if (ending_ && failing_) return;
    }
}

/// Removes what lies beyond the limit. Where that fails, the next checkpoint tries again.
void JournalWriter::prune() {
    const std::vector<BranchSpan> all = spans();
    JournalPruning plan = plan_pruning(*db_, all, options_.keep, used_bytes(*db_));
    if (plan.empty()) return;
    {  // a branch that begins from now on brings its Model along
        const std::lock_guard guard(mutex_);
        std::erase_if(plan.models, [&](std::uint64_t model) {
            return std::any_of(spans_.begin() + static_cast<std::ptrdiff_t>(plan.dropped.size()),
                               spans_.end(),
                               [&](const BranchSpan& span) { return span.model_hash == model; });
        });
        for (const std::uint64_t model : plan.models) std::erase(models_, model);
    }
    if (prune_journal(*db_, plan)) forget(plan);
}

void JournalWriter::forget(const JournalPruning& done) {
    const std::lock_guard guard(mutex_);
    for (const BranchSpan& gone : done.dropped) {
        std::erase_if(spans_, [&](const BranchSpan& span) { return span.id == gone.id; });
        std::erase_if(bookmarks_, [&](const Bookmark& mark) { return mark.branch == gone.id; });
    }
    for (const JournalPruning::Cut& cut : done.cuts) {
        if (BranchSpan* span = span_of(cut.branch)) span->first = cut.first;
        const auto early = [&](const Bookmark& mark) {
            return mark.branch == cut.branch && mark.tick < cut.first;
        };
        if (std::erase_if(bookmarks_, early) > 0) ++timeline_serial_;
    }
    if (!done.dropped.empty()) ++timeline_serial_;
}

BranchSpan* JournalWriter::span_of(BranchId id) {
    const auto found =
        std::find_if(spans_.begin(), spans_.end(), [id](const BranchSpan& span) { return span.id == id; });
    return found == spans_.end() ? nullptr : &*found;
}

std::vector<BranchSpan> JournalWriter::spans() const {
    const std::lock_guard guard(mutex_);
    return spans_;
}

std::vector<Bookmark> JournalWriter::bookmarks() const {
    const std::lock_guard guard(mutex_);
    return bookmarks_;
}

Tick JournalWriter::first_tick() const {
    const std::lock_guard guard(mutex_);
    return branch_ == 0 ? 0 : Lineage::of(spans_, branch_).first();
}

Result<std::int64_t> JournalWriter::add_bookmark(Bookmark bookmark) {
    const std::lock_guard guard(mutex_);
    if (bookmarks_.size() >= kBookmarksMost)
        return Error{path_ + " has " + std::to_string(kBookmarksMost) + " bookmarks already", "remove some",
                     "too-many-bookmarks"};
    bookmark.id = ++last_bookmark_;
    waiting_.bookmarks.push_back(to_row(bookmark));
    bookmarks_.push_back(std::move(bookmark));
    ++timeline_serial_;
    wake_.notify_one();
    return last_bookmark_;
}

Result<> JournalWriter::remove_bookmark(std::int64_t id) {
    const std::lock_guard guard(mutex_);
    if (std::erase_if(bookmarks_, [id](const Bookmark& mark) { return mark.id == id; }) == 0)
        return Error{"there is no bookmark " + std::to_string(id), "`roboss control timeline` lists them",
                     "no-bookmark"};
    waiting_.bookmarks_removed.push_back({id});
    ++timeline_serial_;
    wake_.notify_one();
    return Ok{};
}

/// After a transaction: advances the safe count, or puts the entries back if it failed.
void JournalWriter::settle(const Result<>& written, Pending& pending) {
    if (written) {
        tail_ = next_tail_;
        waiting_bytes_ = bytes_about(waiting_.entries);
        if (pending.checkpoint) checkpoint_waits_ = false;
        if (failing_.exchange(false) && !lost_)
            notices_.push_back("journal " + path_ + " can be written again and is complete");
        trouble_.reset();
        safe_ = pending.given;
        return;
    }
    trouble_ = written.error();
    if (!failing_.exchange(true))
        notices_.push_back(written.error().message +
                           "; the run continues, the journal stays consistent [journal-waiting]");
    take_in(pending);
}

/// Puts entries that could not be written in front of the newer ones; drops all if they are too many.
void JournalWriter::take_in(Pending& pending) {
    pending.entries.append(std::move(waiting_.entries));
    pending.planned = std::max(pending.planned, waiting_.planned);
    if (waiting_.committed >= 0) pending.committed = waiting_.committed, pending.hash = waiting_.hash;
    for (auto rows : {&Pending::bookmarks, &Pending::bookmarks_removed, &Pending::ends})
        (pending.*rows).insert((pending.*rows).end(), (waiting_.*rows).begin(), (waiting_.*rows).end());
    if (waiting_.checkpoint && pending.branches.empty()) pending.checkpoint = std::move(waiting_.checkpoint);
    pending.given = given_;
    waiting_ = std::move(pending);
    waiting_bytes_ = bytes_about(waiting_.entries);
    if (waiting_bytes_ <= options_.waiting_bytes_max || lost_) return;
    lost_ = Error{path_ + ": it could not be written for too long, the journal ends here",
                  "free some space, and start again with it", "journal-lost"};
    notices_.push_back(lost_->message);
    waiting_ = {};
    checkpoint_waits_ = true;
}

Result<> JournalWriter::write(const Pending& pending) {
    if (lost_) return *lost_;
    if (Result<> r = db_->run("BEGIN IMMEDIATE;"); !r) return r;
    Result<> r = write_rows(pending);
    if (r) r = db_->run("COMMIT;");
    if (!r) (void)db_->run("ROLLBACK;");
    return r;
}

Result<> JournalWriter::write_rows(const Pending& pending) {
    if (Result<> r = db_->insert(kInsertModel, pending.models); !r) return r;
    if (Result<> r = db_->insert(kInsertEnd, pending.ends); !r) return r;
    if (Result<> r = db_->insert(kInsertBranch, pending.branches); !r) return r;
    if (pending.checkpoint) {
        const RunCheckpoint& c = *pending.checkpoint;
        std::vector<std::uint64_t> hashes;
        for (std::size_t i = 0; i < c.states->size(); ++i)
            hashes.push_back(state_hash(RobotId(i), c.tick, (*c.states)[i]));
        const CheckpointEntry entry{branch_, c.tick, world_hash(model_hash_, hashes)};
        Blob states = encode_states(*c.states);
        const Row row = to_row(entry, encode_memory(c.memory), states, tail_.serial + 1);
        if (Result<> r = db_->insert(kInsertStates, {states_row(std::move(states))}); !r) return r;
        if (Result<> r = db_->insert(kInsertCheckpoint, {row}); !r) return r;
    }
    if (Result<> r = db_->insert(kInsertBookmark, pending.bookmarks); !r) return r;
    if (Result<> r = db_->insert("DELETE FROM bookmarks WHERE id = ?", pending.bookmarks_removed); !r)
        return r;
    next_tail_ = tail_;
    if (!pending.logs()) return Ok{};
    BatchRow row = to_batch_row(pending.entries);
    row.branch = branch_;
    row.serial = ++next_tail_.serial;
    row.planned = pending.planned;
    row.committed = pending.committed;
    row.hash = pending.hash;
    next_tail_.chain = chain_of(tail_.chain, row);
    return db_->insert(kInsertBatch, {to_row(row, next_tail_.chain)});
}

Result<> JournalWriter::flush() {
    std::unique_lock guard(mutex_);
    hurry_ = true;
    beginning_ = false;
    wake_.notify_all();
    done_.wait(guard, [&] { return (waiting_.empty() && !writing_) || failing_ || !thread_.joinable(); });
    if (lost_) return *lost_;
    if (trouble_) return *trouble_;
    return Ok{};
}

Result<> JournalWriter::close() {
    {
        const std::lock_guard guard(mutex_);
        ending_ = true;
        wake_.notify_all();
    }
    if (thread_.joinable()) thread_.join();
    const std::lock_guard guard(mutex_);
    mark_end();
    db_.reset();  // SQLite merges the WAL into the file
    if (lost_) return *lost_;
    if (!waiting_.empty() && trouble_) return *trouble_;
    return Ok{};
}

/// Marks the end of the branch that was written last, unless entries of it are missing: then its end is open.
void JournalWriter::mark_end() {
    if (marks_ends_ && branch_ != 0 && waiting_.empty() && !lost_ && !trouble_)
        (void)db_->insert(kInsertEnd, {to_row(LogEnd{branch_, tail_})});
}

std::vector<std::string> JournalWriter::take_notices() {
    const std::lock_guard guard(mutex_);
    return std::exchange(notices_, {});
}

void JournalWriter::joined(ClientId client, const std::string& name) {
    const std::lock_guard guard(mutex_);
    waiting_.entries.clients[client.value] = name;
    waiting_.given = ++given_;
    wake_.notify_one();
}

void JournalWriter::order(const Order& order, Tick given_at) {
    const std::lock_guard guard(mutex_);
    ++given_;
    if (lost_) return;
    waiting_.entries.orders.push_back({order, given_at});
    waiting_.given = given_;
    wake_.notify_one();
}

void JournalWriter::reply(ClientId client, Tick observed) {
    const std::lock_guard guard(mutex_);
    ++given_;
    if (lost_) return;
    waiting_.entries.replies.push_back({client, observed});
    waiting_.given = given_;
    wake_.notify_one();
}

void JournalWriter::note(Tick tick, const std::string& text) {
    const std::lock_guard guard(mutex_);
    if (!lost_) waiting_.entries.notes.push_back({tick, text});
    waiting_.given = given_;
    wake_.notify_one();
}

void JournalWriter::planned(Tick until) {
    const std::lock_guard guard(mutex_);
    waiting_.planned = std::max(waiting_.planned, until);
    waiting_.given = given_;
}

void JournalWriter::committed(Tick tick, std::uint64_t world_hash) {
    const std::lock_guard guard(mutex_);
    waiting_.committed = tick;
    waiting_.hash = world_hash;
    if (!spans_.empty()) spans_.back().end = std::max(spans_.back().end, tick);
    waiting_.given = given_;
    wake_.notify_one();
}

bool JournalWriter::takes_checkpoint() const {
    return !checkpoint_waits_;
}

void JournalWriter::checkpoint(RunCheckpoint checkpoint) {
    const std::lock_guard guard(mutex_);
    waiting_.checkpoint = std::move(checkpoint);
    checkpoint_waits_ = true;
    waiting_.given = given_;
    wake_.notify_one();
}

void JournalWriter::hurry() {
    const std::lock_guard guard(mutex_);
    hurry_ = true;
    wake_.notify_one();
}

void JournalWriter::wait_safe(std::uint64_t count, std::int64_t ms_max) {
    std::unique_lock guard(mutex_);
    hurry_ = true;
    wake_.notify_one();
    done_.wait_for(guard, ms(ms_max), [&] { return safe(count); });
}

}  // namespace roboss
