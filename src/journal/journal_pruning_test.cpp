// A journal with a limit keeps what is young, without a gap, and its file stops growing.
#include "journal/journal_pruning.h"

#include <gtest/gtest.h>

#include <filesystem>

#include <support/compiling.h>

#include "journal/journal_writer.h"
#include "journal/test_older_journal.h"

namespace roboss::test {
namespace {

namespace fs = std::filesystem;

class PrunedJournals : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::path(::testing::TempDir()) /
                  ("roboss_pruning_" +
                   std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        for (std::size_t i = 0; i < model_->robots.size(); ++i)
            states_->push_back(initial_state(*model_, RobotId(i)));
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string file() const { return (folder_ / "run.journal").string(); }

    std::unique_ptr<JournalWriter> open(const JournalKeep& keep) const {
        JournalWriterOptions options;
        options.keep = keep;
        auto writer = JournalWriter::open(file(), options);
        EXPECT_TRUE(writer.ok()) << writer.error().text();
        return writer.ok() ? std::move(writer).value() : nullptr;
    }
    void begin(JournalWriter& writer, Tick tick, BranchId parent, const Model& model) const {
        Branch branch;
        branch.parent = parent, branch.tick = tick;
        branch.world_file = "balls.sdf", branch.reason = "test";
        ASSERT_TRUE(writer.start_branch(branch, model).ok());
        writer.checkpoint({tick, states_, {}});
        ASSERT_TRUE(writer.flush().ok());
    }
    /// One tick a row, an order each, a checkpoint every ten; as a Controller does.
    void record(JournalWriter& writer, Tick from, Tick until) {
        for (Tick tick = from + 1; tick <= until; ++tick) {
            writer.order({tick + 5, ClientId(0u), ++sequence_, RobotId(0u), SetVelocity{{1, 0, 0}, {}}},
                         tick);
            writer.reply(ClientId(0u), tick);
            writer.committed(tick, 100 + static_cast<std::uint64_t>(tick));
            if (tick % 10 == 0) writer.checkpoint({tick, states_, {}});
            ASSERT_TRUE(writer.flush().ok());
        }
    }

    fs::path folder_;
    std::shared_ptr<const Model> model_ = compile_one(row_of_three()).model;
    std::shared_ptr<std::vector<RobotState>> states_ = std::make_shared<std::vector<RobotState>>();
    std::uint64_t sequence_ = 0;
};

TEST_F(PrunedJournals, KeepWhatIsYoungWithNamesAndOrdersThatAreStillNeeded) {
    auto writer = open({50, 0});
    begin(*writer, 0, 0, *model_);
    writer->joined(ClientId(0u), "driver");
    record(*writer, 0, 200);
    EXPECT_EQ(writer->first_tick(), 150);
    ASSERT_TRUE(writer->close().ok());
    const Result<Journal> journal = Journal::open(file(), true);
    ASSERT_TRUE(journal.ok()) << journal.error().text();
    const Result<> whole = journal.value().inspect();
    EXPECT_TRUE(whole.ok()) << whole.error().text();
    const Branch branch = journal.value().branch().value();
    EXPECT_EQ(branch.first, 150);
    EXPECT_EQ(branch.end, 200);
    EXPECT_EQ(branch.hash, 300u);
    EXPECT_EQ(journal.value().lineage(branch).first(), 150);
    const Result<SavedRun> run = journal.value().run_at(branch, *model_, 160);
    ASSERT_TRUE(run.ok()) << run.error().text();
    ASSERT_FALSE(run.value().orders.empty());
    const Result<SavedRun> first = journal.value().run_at(branch, *model_, 150);
    ASSERT_TRUE(first.ok()) << first.error().text();
    EXPECT_EQ(first.value().clients, std::vector<std::string>{"driver"});
    EXPECT_EQ(first.value().orders.size(), 5u) << "given from 145 to 149, they apply from 150 to 154";
    const Result<SavedRun> early = journal.value().run_at(branch, *model_, 149);
    ASSERT_FALSE(early.ok());
    EXPECT_EQ(early.error().code, "no-such-time");
    EXPECT_NE(early.error().remedy.find("--journal-keep"), std::string::npos);
}

TEST_F(PrunedJournals, AreContinuedAfterTheyWerePruned) {
    {
        auto writer = open({50, 0});
        begin(*writer, 0, 0, *model_);
        writer->joined(ClientId(0u), "driver");
        record(*writer, 0, 100);
        ASSERT_TRUE(writer->close().ok());
    }
    auto writer = open({50, 0});
    {
        const Result<Journal> journal = Journal::open(file());
        ASSERT_TRUE(journal.ok()) << journal.error().text();
        writer->continue_branch(journal.value(), journal.value().branch().value());
    }
    record(*writer, 100, 140);
    ASSERT_TRUE(writer->close().ok());
    const Result<Journal> journal = Journal::open(file(), true);
    ASSERT_TRUE(journal.ok()) << journal.error().text();
    const Result<> whole = journal.value().inspect();
    EXPECT_TRUE(whole.ok()) << whole.error().text();
    EXPECT_EQ(journal.value().branch().value().first, 90);
    EXPECT_EQ(journal.value().branch().value().hash, 240u);
}

TEST_F(PrunedJournals, DropOldBranchesWithTheirModelsAndBookmarks) {
    const std::shared_ptr<const Model> other = compile_one(row_of_three(), {{0, 0, 1}, {}}).model;
    auto writer = open({60, 0});
    begin(*writer, 0, 0, *model_);
    record(*writer, 0, 40);
    ASSERT_TRUE(writer->add_bookmark({0, 1, 20, "early"}).ok());
    begin(*writer, 30, 1, *other);
    record(*writer, 30, 60);
    ASSERT_TRUE(writer->add_bookmark({0, 2, 50, "late"}).ok());
    ASSERT_EQ(writer->spans().size(), 2u);
    record(*writer, 60, 120);
    EXPECT_EQ(writer->spans().size(), 1u);
    EXPECT_EQ(writer->first_tick(), 60);
    begin(*writer, 100, 2, *model_);  // the Model that was removed comes back with it
    record(*writer, 100, 110);
    ASSERT_TRUE(writer->close().ok());
    const Result<Journal> journal = Journal::open(file(), true);
    ASSERT_TRUE(journal.ok()) << journal.error().text();
    const Result<> whole = journal.value().inspect();
    EXPECT_TRUE(whole.ok()) << whole.error().text();
    ASSERT_EQ(journal.value().branches().size(), 2u);
    EXPECT_EQ(journal.value().branches().front().id, 2);
    EXPECT_EQ(journal.value().branch(1).error().code, "no-branch");
    EXPECT_TRUE(journal.value().bookmarks().empty()) << "50 lies before the first tick, 60";
    EXPECT_EQ(journal.value().world_hash(journal.value().branch().value()), model_->hash)
        << "the world of the branch that is gone";
    EXPECT_EQ(journal.value().lineage(journal.value().branch().value()).first(),
              journal.value().branches().front().first);
}

TEST_F(PrunedJournals, StopGrowing) {
    std::uintmax_t before = 0;
    for (const Tick until : {400, 1'600}) {
        auto writer = open({100, 0});
        if (before == 0) begin(*writer, 0, 0, *model_);
        if (before > 0) {
            const Result<Journal> journal = Journal::open(file());
            ASSERT_TRUE(journal.ok()) << journal.error().text();
            writer->continue_branch(journal.value(), journal.value().branch().value());
        }
        record(*writer, before == 0 ? 0 : 400, until);
        ASSERT_TRUE(writer->close().ok());
        writer.reset();
        if (before > 0) {
            EXPECT_LE(fs::file_size(file()), before + before / 4);
        }
        before = fs::file_size(file());
    }
}

TEST_F(PrunedJournals, KeepToASize) {
    constexpr std::uint64_t kLimit = 300'000;
    auto writer = open({0, kLimit});
    begin(*writer, 0, 0, *model_);
    record(*writer, 0, 3'000);
    EXPECT_GT(writer->first_tick(), 0);
    ASSERT_TRUE(writer->close().ok());
    EXPECT_LE(fs::file_size(file()), 2 * kLimit);
    const Result<Journal> journal = Journal::open(file(), true);
    ASSERT_TRUE(journal.ok()) << journal.error().text();
    EXPECT_TRUE(journal.value().inspect().ok());
}

/// Pruning is one transaction: a writer that is killed leaves the file as it was before or as it is after.
TEST_F(PrunedJournals, AreWholeWhereAPruningWasBrokenOff) {
    {
        auto writer = open({0, 0});
        begin(*writer, 0, 0, *model_);
        writer->joined(ClientId(0u), "driver");
        record(*writer, 0, 100);
        ASSERT_TRUE(writer->close().ok());
    }
    {
        Result<Database> db = Database::open_write(file());
        ASSERT_TRUE(db.ok());
        ASSERT_TRUE(db.value().run("BEGIN IMMEDIATE").ok());
        ASSERT_TRUE(db.value().run("DELETE FROM batches WHERE serial < 50").ok());
    }  // never committed
    const Result<Journal> journal = Journal::open(file(), true);
    ASSERT_TRUE(journal.ok()) << journal.error().text();
    EXPECT_TRUE(journal.value().inspect().ok());
    EXPECT_EQ(journal.value().branch().value().first, 0);
}

TEST_F(PrunedJournals, NoticeAMissingRowBehindTheirBeginning) {
    {
        auto writer = open({50, 0});
        begin(*writer, 0, 0, *model_);
        record(*writer, 0, 100);
        ASSERT_TRUE(writer->close().ok());
    }
    {
        Result<Database> db = Database::open_write(file());
        ASSERT_TRUE(db.ok());
        ASSERT_TRUE(
            db.value().run("DELETE FROM batches WHERE serial = (SELECT min(serial) FROM batches)").ok());
    }
    EXPECT_EQ(Journal::open(file(), true).error().code, "journal-damaged");
}

TEST_F(PrunedJournals, AndThoseOfTheFormatBeforeAreReadAndBroughtUpToDate) {
    {
        auto writer = open({0, 0});
        begin(*writer, 0, 0, *model_);
        record(*writer, 0, 30);
        ASSERT_TRUE(writer->close().ok());
        make_older(file(), 4);
    }
    EXPECT_TRUE(Journal::open(file(), true).ok());
    auto writer = open({0, 0});
    ASSERT_TRUE(writer->add_bookmark({0, 1, 10, "here"}).ok());
    ASSERT_TRUE(writer->add_bookmark({0, 1, 20, "there"}).ok());
    ASSERT_TRUE(writer->remove_bookmark(1).ok());
    EXPECT_EQ(writer->remove_bookmark(1).error().code, "no-bookmark");
    ASSERT_TRUE(writer->close().ok());
    const Result<Journal> journal = Journal::open(file(), true);
    ASSERT_TRUE(journal.ok()) << journal.error().text();
    EXPECT_EQ(journal.value().bookmarks(), (std::vector<Bookmark>{{2, 1, 20, "there"}}));
}

}  // namespace
}  // namespace roboss::test
