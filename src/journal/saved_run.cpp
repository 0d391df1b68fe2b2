// A run saved in a file of its own: a journal of one branch and one checkpoint.
#include "journal/saved_run.h"

#include <algorithm>
#include <filesystem>

#include "core/hash.h"
#include "journal/journal.h"
#include "journal/journal_format.h"
#include "journal/new_file.h"

namespace roboss {

namespace {

constexpr const char* kSaved = "saved";  // reason of its branch

/// A journal of one branch, as write() makes it.
bool is_saved_run(const std::string& path) {
    const Result<Journal> journal = Journal::open_own(path);
    if (!journal || journal.value().branches().size() != 1) return false;
    const Branch& only = journal.value().branches().front();
    return only.reason == kSaved && only.checkpoints == 1;
}

Result<> write(const std::string& path, const Model& model, const SavedRun& run) {
    Result<Database> opened = Database::open_write(path);
    if (!opened) return opened.error();
    Database& db = opened.value();
    Branch branch;
    branch.id = 1;
    branch.tick = run.tick;
    branch.model_hash = model.hash;
    branch.seed = run.seed;
    branch.world_file = run.world_file;
    branch.reason = kSaved;
    const CheckpointEntry entry{1, run.tick, state_hash_of(model, run)};
    LogBatch entries;
    entries.orders = run.orders;
    for (std::size_t i = 0; i < run.clients.size(); ++i) {
        entries.clients.emplace(static_cast<std::uint32_t>(i), run.clients[i]);
        const auto answered = run.answered.find(run.clients[i]);
        if (answered != run.answered.end() && answered->second >= run.tick)
            entries.replies.push_back({ClientId(i), answered->second});
    }
    BatchRow batch = to_batch_row(entries);
    batch.branch = batch.serial = 1;
    batch.planned = std::max(run.tick, run.logged_until);
    batch.committed = run.tick;
    batch.hash = entry.hash;
    std::vector<Row> meta{{std::string("format"), kJournalFormat},
                          {std::string("version"), program_version()}};
    if (run.world_hash != 0) meta.push_back({std::string(kMetaWorld), to_hex(run.world_hash)});
    if (Result<> r = db.run(std::string("BEGIN;") + kJournalTables + kJournalTables5 + kJournalEnds); !r)
        return r;
    if (Result<> r = db.insert("INSERT INTO meta VALUES(?,?)", meta); !r) return r;
    if (Result<> r = seal_meta(db); !r) return r;
    if (Result<> r = db.insert(kInsertModel, {model_row(model)}); !r) return r;
    if (Result<> r = db.insert(kInsertBranch, {to_row(branch)}); !r) return r;
    Blob states = encode_states(run.states);
    const Row checkpoint = to_row(entry, encode_memory(run.memory), states, batch.serial);
    if (Result<> r = db.insert(kInsertStates, {states_row(std::move(states))}); !r) return r;
    if (Result<> r = db.insert(kInsertCheckpoint, {checkpoint}); !r) return r;
    const LogEnd end{branch.id, {batch.serial, chain_of(0, batch)}};
    if (Result<> r = db.insert(kInsertBatch, {to_row(batch, end.tail.chain)}); !r) return r;
    if (Result<> r = db.insert(kInsertEnd, {to_row(end)}); !r) return r;
    return db.run("COMMIT;");
}

}  // namespace

std::uint64_t state_hash_of(const Model& model, Tick tick, const std::vector<RobotState>& states) {
    std::vector<std::uint64_t> hashes;
    hashes.reserve(states.size());
    for (std::size_t i = 0; i < states.size(); ++i) hashes.push_back(state_hash(RobotId(i), tick, states[i]));
    return world_hash(model.hash, hashes);
}

std::uint64_t state_hash_of(const Model& model, const SavedRun& run) {
    return state_hash_of(model, run.tick, run.states);
}

Result<> may_save_to(const std::string& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return Ok{};
    if (std::filesystem::is_regular_file(path, error))
        if (std::filesystem::file_size(path, error) == 0 || is_saved_run(path)) return Ok{};
    return Error{path + " exists and is not a saved run; nothing else is overwritten",
                 "give another name, or remove the file yourself", "not-a-saved-run"};
}

Result<> save_run(const std::string& path, const Model& model, const SavedRun& run) {
    if (Result<> may = may_save_to(path); !may) return may;
    Result<NewFile> file = NewFile::beside(path);
    if (!file) return file.error();
    if (Result<> written = write(file.value().own_path(), model, run); !written) return written;
    return file.value().publish();
}

Result<SavedRun> load_run(const std::string& path, const Model& model) {
    Result<Journal> journal = Journal::open(path);
    if (!journal) return journal.error();
    Result<Branch> branch = journal.value().branch();
    if (!branch) return branch.error();
    if (Result<> fits = check_world(journal.value(), branch.value(), model); !fits) return fits.error();
    if (branch.value().model_hash != model.hash)
        return Error{path + " was saved when the robots or the accuracy of its world had been changed",
                     "give the Model that it has: Journal::model()", "another-world"};
    if (auto same = journal.value().model(branch.value()); !same) return same.error();
    return journal.value().run_at(branch.value(), model, branch.value().end);
}

}  // namespace roboss
