// A run saved in a file of its own: a journal of one branch and one checkpoint.
#include "journal/saved_run.h"

#include <algorithm>

#include "journal/journal.h"
#include "journal/journal_format.h"
#include "journal/new_file.h"

namespace roboss {

namespace {

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
    branch.reason = "saved";
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
    const std::vector<Row> meta{{std::string("format"), kJournalFormat},
                                {std::string("version"), program_version()}};
    if (Result<> r = db.run(std::string("BEGIN;") + kJournalTables + kJournalTables5); !r) return r;
    if (Result<> r = db.insert("INSERT INTO meta VALUES(?,?)", meta); !r) return r;
    if (Result<> r = db.insert(kInsertModel, {model_row(model)}); !r) return r;
    if (Result<> r = db.insert(kInsertBranch, {to_row(branch)}); !r) return r;
    Blob states = encode_states(run.states);
    const Row checkpoint = to_row(entry, encode_memory(run.memory), states);
    if (Result<> r = db.insert(kInsertStates, {states_row(std::move(states))}); !r) return r;
    if (Result<> r = db.insert(kInsertCheckpoint, {checkpoint}); !r) return r;
    if (Result<> r = db.insert(kInsertBatch, {to_row(batch, chain_of(0, batch))}); !r) return r;
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

Result<> save_run(const std::string& path, const Model& model, const SavedRun& run) {
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
    if (auto same = journal.value().model(branch.value()); !same) return same.error();
    return journal.value().run_at(branch.value(), model, branch.value().end);
}

}  // namespace roboss
