// A journal gives back what a run told it, survives what happens to files, and notices every damage.
#include "journal/journal.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include <support/compiling.h>

#include "journal/journal_writer.h"

namespace roboss::test {
namespace {

namespace fs = std::filesystem;

class Journals : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::path(::testing::TempDir()) /
                  ("roboss_journal_" +
                   std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        for (std::size_t i = 0; i < model_->robots.size(); ++i)
            states_->push_back(initial_state(*model_, RobotId(i)));
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string file(const std::string& name = "run.journal") const { return (folder_ / name).string(); }

    std::unique_ptr<JournalWriter> open(const std::string& name = "run.journal",
                                        const JournalWriterOptions& options = {}) const {
        auto writer = JournalWriter::open(file(name), options);
        EXPECT_TRUE(writer.ok()) << writer.error().text();
        return writer.ok() ? std::move(writer).value() : nullptr;
    }
    /// A branch at `tick` with its first checkpoint.
    void begin(JournalWriter& writer, Tick tick = 0, BranchId parent = 0) const {
        Branch branch;
        branch.parent = parent;
        branch.tick = tick;
        branch.seed = 0xF000000000000001ull;
        branch.world_file = "balls.sdf";
        branch.reason = "test";
        ASSERT_TRUE(writer.start_branch(branch, *model_).ok());
        writer.checkpoint({tick, states_, {{"driver", "memory"}}});
        ASSERT_TRUE(writer.flush().ok());
    }
    Order order(Tick at, std::uint64_t sequence) const {
        return {at, ClientId(0u), sequence, RobotId(0u), SetVelocity{{1, 0, 0}, {}}};
    }

    fs::path folder_;
    std::shared_ptr<const Model> model_ = compile_one(row_of_three()).model;
    std::shared_ptr<std::vector<RobotState>> states_ = std::make_shared<std::vector<RobotState>>();
};

TEST_F(Journals, GiveBackWhatWasSaid) {
    {
        auto writer = open();
        begin(*writer);
        writer->joined(ClientId(0u), "driver");
        writer->order(order(30, 1), 10);
        writer->reply(ClientId(0u), 10);
        writer->order(order(40, 2), 20);
        writer->reply(ClientId(0u), 20);
        writer->planned(40);
        writer->note(21, "paused");
        writer->committed(30, 77);
        ASSERT_TRUE(writer->close().ok());
    }
    const Result<Journal> journal = Journal::open(file(), true);
    ASSERT_TRUE(journal.ok()) << journal.error().text();
    EXPECT_TRUE(journal.value().inspect().ok());
    const Branch branch = journal.value().branch().value();
    EXPECT_EQ(branch.end, 40);
    EXPECT_EQ(branch.committed, 30);
    EXPECT_EQ(branch.hash, 77u);
    EXPECT_EQ(branch.orders, 2u);
    EXPECT_EQ(branch.seed, 0xF000000000000001ull);
    EXPECT_EQ(journal.value().model(branch).value()->hash, model_->hash);
    const Result<SavedRun> run = journal.value().run_at(branch, *model_, 15);
    ASSERT_TRUE(run.ok()) << run.error().text();
    EXPECT_EQ(run.value().states, *states_);
    EXPECT_EQ(run.value().memory.at("driver"), "memory");
    ASSERT_EQ(run.value().orders.size(), 1u) << "what was said on seeing tick 20 is not known at 15";
    EXPECT_EQ(run.value().orders[0].order.apply_at, 30);
    EXPECT_EQ(run.value().answered.at("driver"), 10);
    EXPECT_EQ(run.value().logged_until, 15);
    const Result<SavedRun> late = journal.value().run_at(branch, *model_, 41);
    ASSERT_FALSE(late.ok());
    EXPECT_NE(late.error().message.find("0 to 40"), std::string::npos) << late.error().message;
}

/// A Controller commits, tells its Clients, takes a word, and is killed before the log has the commit.
TEST_F(Journals, KeepWhatWasSaidAfterTheirEndForWhoGoesOn) {
    {
        auto writer = open();
        begin(*writer);
        writer->joined(ClientId(0u), "driver");
        writer->committed(20, 77);
        writer->order(order(35, 1), 25);
        writer->reply(ClientId(0u), 25);
        ASSERT_TRUE(writer->close().ok());
    }
    const Result<Journal> journal = Journal::open(file(), true);
    ASSERT_TRUE(journal.ok()) << journal.error().text();
    const Branch branch = journal.value().branch().value();
    ASSERT_EQ(branch.end, 20);
    const CheckpointEntry first = journal.value().checkpoints(branch).front();
    const Result<SavedRun> goes_on = journal.value().resume_from(branch, first, *model_);
    ASSERT_TRUE(goes_on.ok()) << goes_on.error().text();
    EXPECT_EQ(goes_on.value().logged_until, 20);
    EXPECT_EQ(goes_on.value().orders.size(), 1u);
    EXPECT_EQ(goes_on.value().answered.at("driver"), 25);
    const Result<SavedRun> leaves = journal.value().run_at(branch, *model_, 20);
    ASSERT_TRUE(leaves.ok()) << leaves.error().text();
    EXPECT_TRUE(leaves.value().orders.empty()) << "a branch of its own has Clients of its own";
}

TEST_F(Journals, AreContinuedAndBranch) {
    {
        auto writer = open();
        begin(*writer);
        writer->order(order(5, 1), 2);
        writer->planned(10);
    }
    {
        auto writer = open();
        EXPECT_FALSE(writer->is_new());
        const Journal journal = Journal::open(file()).value();
        writer->continue_branch(journal, journal.branch().value());
        writer->order(order(15, 2), 12);
        writer->planned(20);
        ASSERT_TRUE(writer->flush().ok());
        begin(*writer, 7, 1);
        writer->planned(9);
    }
    const Journal journal = Journal::open(file()).value();
    ASSERT_EQ(journal.branches().size(), 2u);
    EXPECT_TRUE(journal.inspect().ok()) << journal.inspect().error().text();
    EXPECT_EQ(journal.branch(1).value().end, 20);
    EXPECT_EQ(journal.branch(1).value().orders, 2u);
    EXPECT_EQ(journal.branch().value().parent, 1);
    const Lineage lineage = journal.lineage(journal.branch().value());
    EXPECT_EQ(lineage.parts(), (std::vector<Lineage::Part>{{1, 0, 7}, {2, 7, 9}}))
        << "before it left, its history is its parent's";
    EXPECT_EQ(journal.holder(lineage, 6, 0.5).value().id, 1);
    EXPECT_EQ(journal.holder(lineage, 7, 0.5).value().id, 2);
    const Result<Branch> late = journal.holder(lineage, 15, 0.5);
    ASSERT_FALSE(late.ok()) << "the future that was left is not its own";
    EXPECT_EQ(late.error().code, "no-such-time");
    EXPECT_NE(late.error().remedy.find("#1@7.5"), std::string::npos) << late.error().remedy;
    EXPECT_FALSE(journal.branch(3).ok());
}

TEST_F(Journals, AreWholeAfterTheirWriterIsKilled) {
    auto writer = open();
    begin(*writer);
    for (std::uint64_t i = 1; i <= 100; ++i) writer->order(order(static_cast<Tick>(i), i), 0);
    writer->planned(100);
    writer->wait_safe(writer->given(), 10'000);
    ASSERT_TRUE(writer->safe(writer->given()));
    for (const char* part : {"", "-wal"})  // what a killed process leaves behind
        fs::copy_file(file() + part, file("killed.journal") + part);
    const Result<Journal> journal = Journal::open(file("killed.journal"), true);
    ASSERT_TRUE(journal.ok()) << journal.error().text();
    EXPECT_EQ(journal.value().branch().value().orders, 100u);
    EXPECT_EQ(journal.value().branch().value().end, 100);
}

TEST_F(Journals, ThatWereKilledBeforeTheyBeganAreBegunAgain) {
    { auto writer = open(); }  // tables and nothing in them
    ASSERT_TRUE(Database::open_write(file("empty")).value().run("PRAGMA journal_mode=WAL;").ok());
    for (const char* name : {"run.journal", "empty"}) {
        auto writer = open(name);
        ASSERT_NE(writer, nullptr);
        EXPECT_TRUE(writer->is_new());
        begin(*writer);
        EXPECT_TRUE(Journal::open(file(name)).ok());
    }
}

TEST_F(Journals, AreWrittenByOneAtATime) {
    auto writer = open();
    begin(*writer);
    const auto second = JournalWriter::open(file());
    ASSERT_FALSE(second.ok());
    EXPECT_NE(second.error().message.find("another run"), std::string::npos) << second.error().message;
    EXPECT_TRUE(Journal::open(file()).ok()) << "reading is for everybody";
}

TEST_F(Journals, OfAnotherKindAreRefusedByName) {
    EXPECT_NE(Journal::open(file("none")).error().message.find("no such file"), std::string::npos);
    std::ofstream(file("text")) << std::string(5000, 'x');
    EXPECT_NE(Journal::open(file("text")).error().message.find("not a checkpoint or journal"),
              std::string::npos);
    EXPECT_FALSE(JournalWriter::open(file("text")).ok()) << "nor is it overwritten";
    EXPECT_EQ(fs::file_size(file("text")), 5000u);
    { begin(*open()); }
    auto db = Database::open_write(file());
    ASSERT_TRUE(db.value().run("UPDATE meta SET value = 99 WHERE key = 'format'").ok());
    const Result<Journal> later = Journal::open(file());
    ASSERT_FALSE(later.ok());
    EXPECT_NE(later.error().message.find("journal format 99"), std::string::npos) << later.error().message;
}

TEST_F(Journals, NoticeEveryChangedByteAndRow) {
    {
        auto writer = open();
        begin(*writer);
        writer->order(order(5, 1), 2);
        ASSERT_TRUE(writer->flush().ok());
        writer->order(order(6, 2), 3);
        ASSERT_TRUE(writer->flush().ok());
    }
    for (const char* change :
         {"UPDATE batches SET planned = 1000 WHERE serial = 2", "DELETE FROM batches WHERE serial = 2",
          "UPDATE checkpoints SET tick = 1", "UPDATE checkpoints SET states = zeroblob(8)",
          "UPDATE states SET bytes = zeroblob(8)", "DELETE FROM states", "UPDATE branches SET seed = 1",
          "DELETE FROM checkpoints", "DELETE FROM models",
          "UPDATE models SET bytes = zeroblob(length(bytes))", "UPDATE batches SET entries = 'text'",
          "UPDATE branches SET tick = 'x'", "DROP TABLE batches"}) {
        fs::copy_file(file(), file("changed"), fs::copy_options::overwrite_existing);
        ASSERT_TRUE(Database::open_write(file("changed")).value().run(change).ok()) << change;
        const Result<Journal> journal = Journal::open(file("changed"));
        const Result<> whole = journal.ok() ? journal.value().inspect() : Result<>(journal.error());
        ASSERT_FALSE(whole.ok()) << change;
        EXPECT_NE(whole.error().message.find("damaged"), std::string::npos) << whole.error().message;
    }
    std::ifstream in(file(), std::ios::binary);
    const std::string good((std::istreambuf_iterator<char>(in)), {});
    for (std::size_t size = 1; size < good.size(); size += good.size() / 23) {
        std::ofstream(file("cut"), std::ios::binary).write(good.data(), static_cast<std::streamsize>(size));
        const Result<Journal> journal = Journal::open(file("cut"));
        EXPECT_FALSE(journal.ok() && journal.value().inspect().ok())
            << "cut to " << size << " of " << good.size();
    }
}

TEST_F(Journals, OfManyBranchesFromTheSameStateStoreItOnce) {
    const auto bytes_of = [&](int branches) {
        fs::remove(file());
        auto writer = open();
        for (int i = 0; i < branches; ++i) {
            begin(*writer);
            EXPECT_TRUE(writer->flush().ok());
        }
        EXPECT_TRUE(writer->close().ok());
        writer.reset();
        EXPECT_TRUE(Journal::open(file(), true).value().inspect().ok());
        return fs::file_size(file());
    };
    const auto few = bytes_of(100), many = bytes_of(1'100);
    EXPECT_LT((many - few) / 1'000, 700u) << "a row each of branches, checkpoints and log";
}

/// Lets no file of this process grow beyond `bytes`, as a full disk would.
class FileLimit {
  public:
    explicit FileLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

  private:
    rlimit before_{};
    void (*handler_)(int);
};

void say_much(JournalWriter& writer, Tick from, const std::function<Order(Tick)>& order) {
    for (Tick tick = from; tick < from + 20'000; ++tick) writer.order(order(tick), tick - 1);
    writer.planned(from + 20'000);
}

TEST_F(Journals, OnAFullDiskWaitForRoomAndLoseNothing) {
    const auto make = [&](Tick tick) { return order(tick, static_cast<std::uint64_t>(tick)); };
    auto writer = open("run.journal", {5, 5, 64u << 20});
    begin(*writer);
    {
        const FileLimit limit(200'000);
        say_much(*writer, 1, make);
        EXPECT_FALSE(writer->flush().ok());
        EXPECT_TRUE(writer->safe(writer->given())) << "a journal that cannot be written holds nobody up";
        const std::vector<std::string> notices = writer->take_notices();
        ASSERT_EQ(notices.size(), 1u);
        EXPECT_NE(notices[0].find("run continues"), std::string::npos) << notices[0];
    }
    EXPECT_TRUE(writer->close().ok()) << "there is room again";
    EXPECT_EQ(Journal::open(file(), true).value().branch().value().orders, 20'000u);
}

TEST_F(Journals, OnADiskThatStaysFullEndWhole) {
    const auto make = [&](Tick tick) { return order(tick, static_cast<std::uint64_t>(tick)); };
    const FileLimit limit(200'000);
    auto writer = open("run.journal", {5, 5, 1u << 20});
    begin(*writer);
    writer->order(order(1, 1), 0);
    ASSERT_TRUE(writer->flush().ok());
    say_much(*writer, 10, make);
    EXPECT_FALSE(writer->close().ok());
    writer.reset();
    const Result<Journal> journal = Journal::open(file(), true);
    ASSERT_TRUE(journal.ok()) << journal.error().text();
    EXPECT_TRUE(journal.value().inspect().ok());
    EXPECT_EQ(journal.value().branch().value().orders, 1u);
}

}  // namespace
}  // namespace roboss::test
