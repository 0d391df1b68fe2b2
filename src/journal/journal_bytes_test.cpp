// Every byte of a journal is covered: one that is changed, and a row that is forged, is noticed, or what is
// read is what was written.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include <support/compiling.h>
#include <support/random.h>

#include "journal/journal_writer.h"
#include "journal/test_older_journal.h"
#include "wire/model_codec.h"

namespace roboss::test {
namespace {

namespace fs = std::filesystem;

class JournalBytes : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ =
            fs::path(::testing::TempDir()) /
            ("roboss_bytes_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        for (std::size_t i = 0; i < model_->robots.size(); ++i)
            states_->push_back(initial_state(*model_, RobotId(i)));
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string file(const std::string& name = "run.journal") const { return (folder_ / name).string(); }

    /// Two branches with orders, rows without entries, a bookmark; the first is pruned if `keep` says so.
    void write(const JournalKeep& keep = {}) const {
        JournalWriterOptions options;
        options.keep = keep;
        auto writer = std::move(JournalWriter::open(file(), options)).value();
        for (const BranchId parent : {0, 1}) {
            Branch branch;
            branch.parent = parent, branch.tick = 40 * parent;
            branch.world_file = "balls.sdf", branch.reason = "test";
            ASSERT_TRUE(writer->start_branch(branch, *model_).ok());
            writer->checkpoint({branch.tick, states_, {{"driver", "memory"}}});
            ASSERT_TRUE(writer->flush().ok());
            writer->joined(ClientId(0u), "driver");
            for (Tick tick = branch.tick + 10; tick <= branch.tick + 60; tick += 10) {
                writer->order({tick + 5, ClientId(0u), static_cast<std::uint64_t>(tick), RobotId(0u),
                               SetVelocity{{1, 0, 0}, {}}},
                              tick);
                ASSERT_TRUE(writer->flush().ok());
                writer->planned(tick + 2), writer->committed(tick, 7);
                ASSERT_TRUE(writer->flush().ok()) << "a row without entries";
                if (tick % 20 == 0) writer->checkpoint({tick, states_, {{"driver", "later"}}});
                ASSERT_TRUE(writer->flush().ok());
            }
        }
        ASSERT_TRUE(writer->add_bookmark({0, 2, 80, "here"}).ok());
        ASSERT_TRUE(writer->close().ok());
    }
    std::string bytes() const {
        std::ifstream in(file(), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    void put(const std::string& bytes) const { std::ofstream(file("changed"), std::ios::binary) << bytes; }

    fs::path folder_;
    std::shared_ptr<const Model> model_ = compile_one(row_of_three()).model;
    std::shared_ptr<std::vector<RobotState>> states_ = std::make_shared<std::vector<RobotState>>();
};

std::string text(std::span<const std::uint8_t> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// All that commands get from the file; of a refused one the message.
struct Read {
    bool refused = true;
    std::string contents;
};
Read read(const std::string& path) {
    const auto refused = [](const Error& error) { return Read{true, error.message}; };
    const Result<Journal> opened = Journal::open(path, true);
    if (!opened) return refused(opened.error());
    const Journal& journal = opened.value();
    if (const Result<> whole = journal.inspect(); !whole) return refused(whole.error());
    std::ostringstream out;
    for (const Branch& b : journal.branches()) {
        out << b.id << ' ' << b.parent << ' ' << b.tick << ' ' << b.model_hash << ' ' << b.seed << ' '
            << b.world_file << ' ' << b.reason << ' ' << b.committed << ' ' << b.hash << ' ' << b.end << ' '
            << b.orders << ' ' << b.first << ' ' << journal.world_hash(b) << '\n';
        const auto model = journal.model(b).value();
        out << text(encode_model(*model));
        for (const CheckpointEntry& entry : journal.checkpoints(b)) {
            const StoredCheckpoint kept = journal.checkpoint(entry, *model).value();
            out << entry.tick << ' ' << entry.hash << text(encode_states(kept.states))
                << text(encode_memory(kept.memory));
        }
        constexpr Tick kAll = std::numeric_limits<Tick>::max();
        for (const Tick from : {-kAll, Tick{55}}) out << text(encode(journal.log(b, from, kAll).value()));
        out << text(encode(journal.log(b, 0, 70).value()));
    }
    for (const Bookmark& mark : journal.bookmarks())
        out << mark.id << ' ' << mark.branch << ' ' << mark.tick << ' ' << mark.name << '\n';
    return {false, out.str()};
}

/// Changes bytes at random; how many were noticed.
void flip(const std::string& good, const std::string& path, std::uint64_t seeds) {
    const Read before = read(path);
    ASSERT_FALSE(before.refused) << before.contents;
    std::uint64_t noticed = 0;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        Random random(seed);
        std::string bytes = good;
        for (int n = random.integer(1, 3); n > 0; --n) {
            auto& byte =
                bytes[static_cast<std::size_t>(random.integer(0, static_cast<int>(bytes.size()) - 1))];
            byte = static_cast<char>(byte ^ (1 << random.integer(0, 7)));
        }
        std::ofstream(path, std::ios::binary) << bytes;
        const Read after = read(path);
        noticed += after.refused;
        if (!after.refused) {
            EXPECT_TRUE(after.contents == before.contents) << "seed " << seed;
        }
    }
    std::printf("%d of %d changed files refused\n", static_cast<int>(noticed), static_cast<int>(seeds));
    EXPECT_GT(noticed, seeds / 10);
}

TEST_F(JournalBytes, ThatAreChangedAreNoticedOrChangeNothing) {
    write();
    put(bytes());
    flip(bytes(), file("changed"), 1'000);
}

TEST_F(JournalBytes, ThatAreChangedInAPrunedJournalAreNoticed) {
    write({70, 0});
    ASSERT_GT(Journal::open(file()).value().branches().front().first, 0);
    put(bytes());
    flip(bytes(), file("changed"), 300);
}

TEST_F(JournalBytes, ThatAreChangedInOneOfAnOlderFormatAreNoticed) {
    write();
    make_older(file(), 7);
    put(bytes());
    flip(bytes(), file("changed"), 300);
}

/// A value that differs, as somebody might forge it.
std::string forged(const std::string& column, int how) {
    switch (how) {
        case 0:
            return column + " + 1";
        case 1:
            return "'x'";
        case 2:
            return "'00000000000000ff'";
        case 3:
            return "NULL";
        case 4:
            return "zeroblob(8)";
        default:
            return column + " || '0'";
    }
}

/// Changes each column of each row of each table, deletes each row.
void forge(const std::string& good, const std::string& path) {
    std::ofstream(path, std::ios::binary) << good;
    const Read before = read(path);
    ASSERT_FALSE(before.refused) << before.contents;
    const auto changed = [&](const std::string& change) {
        std::ofstream(path, std::ios::binary) << good;
        (void)Database::open_write(path).value().run(change);  // some break a rule of the table
        return read(path);
    };
    Database db = std::move(Database::open_read(path)).value();
    std::vector<std::string> tables;
    const std::vector<Row> names = db.select("SELECT name FROM sqlite_master WHERE type = 'table'").value();
    for (const Row& row : names) tables.push_back(std::get<std::string>(row[0]));
    for (const std::string& table : tables) {
        const std::vector<Row> rows = db.select("SELECT rowid FROM " + table).value();
        const std::vector<Row> columns =
            db.select("SELECT name FROM pragma_table_info('" + table + "')").value();
        for (const Row& row : rows) {
            const std::string at = " WHERE rowid = " + std::to_string(std::get<std::int64_t>(row[0]));
            for (const Row& info : columns)
                for (int how = 0; how < 6; ++how) {
                    const std::string& column = std::get<std::string>(info[0]);
                    const std::string change =
                        "UPDATE " + table + " SET " + column + " = " + forged(column, how) + at;
                    const Read after = changed(change);
                    EXPECT_TRUE(after.refused || after.contents == before.contents) << change;
                }
            // Later checkpoints and bookmarks are no condition for anything; the end of the youngest log may
            // be open.
            const Read after = changed("DELETE FROM " + table + at);
            const bool may =
                table == "checkpoints" || table == "bookmarks" || (table == "ends" && at.ends_with(" 2"));
            if (!may) {
                EXPECT_TRUE(after.refused) << table << at;
            }
        }
    }
}

TEST_F(JournalBytes, OfForgedRowsAreNoticed) {
    write();
    const std::string good = bytes();
    forge(good, file("changed"));
}

TEST_F(JournalBytes, OfForgedRowsOfAPrunedJournalAreNoticed) {
    write({70, 0});
    const std::string good = bytes();
    forge(good, file("changed"));
}

TEST_F(JournalBytes, OfARowWithoutEntriesAreCoveredAndTheRowIsNamed) {
    write();
    for (const bool older : {false, true}) {
        if (older) make_older(file(), 7);
        put(bytes());
        ASSERT_TRUE(Database::open_write(file("changed"))
                        .value()
                        .run("UPDATE batches SET planned = 100000 WHERE branch = 2 AND high < 0 AND serial = "
                             "(SELECT max(serial) FROM batches WHERE branch = 2 AND high < 0)")
                        .ok());
        const Result<Journal> journal = Journal::open(file("changed"));
        ASSERT_FALSE(journal.ok()) << older;
        EXPECT_EQ(journal.error().code, "journal-damaged");
        EXPECT_NE(journal.error().message.find("of the log of branch 2 was changed"), std::string::npos)
            << journal.error().message;
        EXPECT_FALSE(JournalWriter::open(file("changed")).ok()) << "nor is it continued";
    }
}

TEST_F(JournalBytes, OfALogWhoseEndIsMissingAreMissed) {
    write();
    put(bytes());
    ASSERT_TRUE(Database::open_write(file("changed"))
                    .value()
                    .run("DELETE FROM batches WHERE branch = 2 AND serial > 3")
                    .ok());
    const Result<Journal> journal = Journal::open(file("changed"));
    ASSERT_FALSE(journal.ok()) << "checkpoints were written with later rows";
    EXPECT_NE(journal.error().message.find("row 4 of the log of branch 2 is missing"), std::string::npos)
        << journal.error().message;
}

/// Opens a journal that was changed so.
Result<Journal> changed_so(const std::string& path, const std::string& change) {
    const Result<> changed = Database::open_write(path).value().run(change);
    EXPECT_TRUE(changed.ok()) << change;
    return Journal::open(path);
}

TEST_F(JournalBytes, OfTheLastRowAreMissedThoughNoCheckpointFollows) {
    for (const BranchId branch : {1, 2}) {
        write();
        ASSERT_TRUE(Journal::open(file()).value().has_end(branch));
        put(bytes());
        const std::string of_branch = " FROM batches WHERE branch = " + std::to_string(branch);
        // The checkpoints that were written with the last rows are gone, too.
        const Result<Journal> journal =
            changed_so(file("changed"), "DELETE FROM checkpoints WHERE branch = " + std::to_string(branch) +
                                            " AND serial > 1; DELETE" + of_branch +
                                            " AND serial = (SELECT max(serial)" + of_branch + ")");
        ASSERT_FALSE(journal.ok()) << "branch " << branch;
        EXPECT_EQ(journal.error().code, "journal-damaged");
        EXPECT_NE(
            journal.error().message.find("of the log of branch " + std::to_string(branch) + " is missing"),
            std::string::npos)
            << journal.error().message;
        fs::remove(file());
    }
}

TEST_F(JournalBytes, OfARunThatWasKilledHaveAnOpenEndUntilItIsContinued) {
    std::string killed;
    {
        auto writer = std::move(JournalWriter::open(file())).value();
        for (const BranchId parent : {0, 1}) {
            Branch branch;
            branch.parent = parent;
            ASSERT_TRUE(writer->start_branch(branch, *model_).ok());
            writer->checkpoint({0, states_, {}});
            writer->committed(10, 7);
            ASSERT_TRUE(writer->flush().ok());
        }
        ASSERT_TRUE(Database::open_write(file()).value().run("PRAGMA wal_checkpoint(TRUNCATE)").ok());
        killed = bytes();
    }
    put(killed);
    {
        const Result<Journal> journal = Journal::open(file("changed"));
        ASSERT_TRUE(journal.ok()) << journal.error().text();
        EXPECT_TRUE(journal.value().has_end(1)) << "the run went on in branch 2";
        EXPECT_FALSE(journal.value().has_end(2));
        auto writer = std::move(JournalWriter::open(file("changed"))).value();
        writer->continue_branch(journal.value(), journal.value().branch().value());
        writer->committed(20, 8);
        ASSERT_TRUE(writer->flush().ok());
        EXPECT_FALSE(Journal::open_own(file("changed")).value().has_end(2)) << "it writes";
        ASSERT_TRUE(writer->close().ok());
    }
    const Result<Journal> journal = Journal::open(file("changed"));
    ASSERT_TRUE(journal.ok()) << journal.error().text();
    EXPECT_TRUE(journal.value().has_end(1) && journal.value().has_end(2));
}

TEST_F(JournalBytes, OfAFileWithoutEndsAreReadAndContinued) {
    write();
    put(bytes());
    const Result<Journal> journal = changed_so(file("changed"), "DROP TABLE ends");
    ASSERT_TRUE(journal.ok()) << journal.error().text();
    EXPECT_FALSE(journal.value().has_end(1) || journal.value().has_end(2));
    {
        auto writer = std::move(JournalWriter::open(file("changed"))).value();
        writer->continue_branch(journal.value(), journal.value().branch().value());
        writer->committed(110, 9);
        ASSERT_TRUE(writer->close().ok());
    }
    const Result<Journal> later = Journal::open(file("changed"), true);
    ASSERT_TRUE(later.ok()) << later.error().text();
    EXPECT_TRUE(later.value().inspect().ok() && later.value().has_end(1) && later.value().has_end(2));
}

TEST_F(JournalBytes, OfEntriesInARowWithoutOrdersAreCovered) {
    write();
    const std::string good = bytes();
    Database db = std::move(Database::open_read(file())).value();
    const std::vector<Row> rows =
        db.select("SELECT rowid FROM batches WHERE orders = 0 AND length(entries) > 0").value();
    ASSERT_FALSE(rows.empty());
    for (const Row& row : rows) {
        put(good);
        const std::string at = std::to_string(std::get<std::int64_t>(row[0]));
        const Result<Journal> journal =
            changed_so(file("changed"),
                       "UPDATE batches SET entries = substr(entries, 1, length(entries) - 1) || x'01' "
                       "WHERE rowid = " +
                           at);
        const bool refused = !journal.ok() || !journal.value().inspect().ok();
        EXPECT_TRUE(refused) << "row " << at;
    }
}

TEST_F(JournalBytes, OfAnOlderFormatAreReadAndContinued) {
    write();
    const Read before = read(file());
    make_older(file(), 7);
    EXPECT_EQ(read(file()).contents, before.contents);
    {
        auto writer = std::move(JournalWriter::open(file())).value();
        const Journal journal = std::move(Journal::open(file())).value();
        writer->continue_branch(journal, journal.branch().value());
        writer->committed(110, 9);
        writer->checkpoint({110, states_, {}});
        ASSERT_TRUE(writer->close().ok());
    }
    const Result<Journal> journal = Journal::open(file(), true);
    ASSERT_TRUE(journal.ok()) << journal.error().text();
    EXPECT_TRUE(journal.value().inspect().ok()) << journal.value().inspect().error().text();
    EXPECT_EQ(journal.value().branch().value().committed, 110);
    put(bytes());
    flip(bytes(), file("changed"), 200);
}

}  // namespace
}  // namespace roboss::test
