// A preview shows what the run was, to the bit of its rounding, whatever was asked before.
#include "app/run/journal_preview.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include <support/compiling.h>
#include <support/robots.h>

#include "journal/journal_writer.h"
#include "model/edit.h"

namespace roboss::test {
namespace {

namespace fs = std::filesystem;
constexpr Tick kEnd = 400, kEvery = 100;

class JournalPreviews : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::path(::testing::TempDir()) /
                  ("roboss_preview_" +
                   std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        World world = empty_world(1e-3);
        place(world, ball_chain(), "one", {{0, 0, 5}, {}});
        place(world, ball_chain(), "two", {{0, 9, 5}, {}});
        Diagnostics found;
        model_ = compile(world, {}, found);
        record();
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string file() const { return (folder_ / "run.journal").string(); }

    /// The world falls for kEnd ticks; views_[tick] is what a viewer was shown.
    void record() {
        auto writer = JournalWriter::open(file());
        ASSERT_TRUE(writer.ok()) << writer.error().text();
        auto run = Simulation::create(model_, {});
        ASSERT_TRUE(run.ok()) << run.error().text();
        ASSERT_TRUE(writer.value()->start_branch({}, *model_).ok());
        run.value()->start_log(writer.value().get(), kEvery);
        ASSERT_TRUE(writer.value()->flush().ok());
        for (Tick tick = 0; tick <= kEnd; ++tick) {
            ASSERT_TRUE(run.value()->run_until(tick).ok());
            std::vector<std::uint8_t>& view = views_.emplace_back();
            for (std::size_t r = 0; r < model_->robots.size(); ++r)
                ViewLayout(*model_).append(*model_, RobotId(r), run.value()->states()[r], view);
            if (tick % kEvery != 0) continue;
            ASSERT_TRUE(writer.value()->flush().ok());  // no checkpoint is left out
        }
        ASSERT_TRUE(run.value()->run_until(kEnd + 50).ok());
        ASSERT_TRUE(writer.value()->close().ok());
    }

    /// Asks, and waits for the reply.
    ControlOutcome ask(JournalPreview& preview, double time_s, std::uint32_t patience_ms = 10'000,
                       std::shared_ptr<const Model> shown = nullptr) const {
        std::optional<ControlOutcome> outcome;
        preview.ask({{Role::kClient, 1},
                     {0, time_s, patience_ms},
                     [&](ControlOutcome reply) { outcome = std::move(reply); }},
                    shown ? shown : model_, 1);
        for (int left = 10'000; left > 0 && !outcome; --left) {
            for (JournalPreview::Reply& reply : preview.take_replies())
                reply.answer(std::move(reply.outcome));
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        return outcome.value_or(ControlRefused(Error{"no reply", "", "no-reply"}));
    }

    fs::path folder_;
    std::shared_ptr<const Model> model_;
    std::vector<std::vector<std::uint8_t>> views_;
};

TEST_F(JournalPreviews, ShowEveryMomentAsItWasForwardsAndBackwards) {
    JournalPreview preview(file());
    for (const Tick tick : {0, 37, 38, 250, 251, 260, 99, 100, 101, 399, 1, 400}) {
        const ControlOutcome outcome = ask(preview, 1e-3 * static_cast<double>(tick));
        const auto* shown = std::get_if<RunPreview>(&outcome);
        ASSERT_NE(shown, nullptr) << std::get<ControlRefused>(outcome).message;
        EXPECT_EQ(shown->tick, tick);
        EXPECT_TRUE(shown->exact);
        EXPECT_EQ(shown->branch, 1);
        EXPECT_EQ(shown->model_hash, model_->hash);
        EXPECT_EQ(shown->entries, views_[static_cast<std::size_t>(tick)]) << tick;
    }
}

TEST_F(JournalPreviews, ComeNearerStepByStepWhereTheirPatienceIsShort) {
    JournalPreview preview(file());
    Tick before = 0;
    for (int asked = 1; asked < 1'000; ++asked) {
        const ControlOutcome outcome = ask(preview, 0.299, 0);
        const auto* shown = std::get_if<RunPreview>(&outcome);
        ASSERT_NE(shown, nullptr);
        ASSERT_GE(shown->tick, std::max<Tick>(before, 200)) << "from the checkpoint on, never back";
        EXPECT_EQ(shown->entries, views_[static_cast<std::size_t>(shown->tick)]);
        before = shown->tick;
        if (shown->exact) break;
    }
    EXPECT_EQ(before, 299);
}

TEST_F(JournalPreviews, MatchRobotsOfAnotherModelByName) {
    const Result<ModelEdit> edit = without_robots(*model_, {"one"});
    ASSERT_TRUE(edit.ok());
    JournalPreview preview(file());
    const ControlOutcome outcome = ask(preview, 0.15, 10'000, edit.value().model);
    const auto* shown = std::get_if<RunPreview>(&outcome);
    ASSERT_NE(shown, nullptr);
    EXPECT_EQ(shown->gone, 1u);
    EXPECT_EQ(shown->absent, 0u);
    const ViewLayout layout(*edit.value().model);
    EXPECT_EQ(layout.entry_at(shown->entries, 0), RobotId(0u));
    EXPECT_EQ(shown->entries.size(), layout.bytes_of(RobotId(0u)));
    const std::vector<std::uint8_t>& all = views_[150];
    EXPECT_TRUE(std::equal(shown->entries.begin() + 4, shown->entries.end(),
                           all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2) + 4))
        << "as 'two' was, under its present number";
}

TEST_F(JournalPreviews, AreRefusedWhereTheJournalHasNothing) {
    JournalPreview preview(file());
    EXPECT_EQ(std::get<ControlRefused>(ask(preview, 77)).code, "no-such-time");
    JournalPreview nothing((folder_ / "none.journal").string());
    EXPECT_EQ(std::get<ControlRefused>(ask(nothing, 0.1)).code, "no-file");
}

TEST_F(JournalPreviews, AnswerTheNewestRequestOfAnAskerAndRefuseThoseItReplaced) {
    JournalPreview preview(file());
    std::vector<std::string> codes;
    std::size_t shown = 0;
    const auto take = [&](ControlOutcome outcome) {
        if (const auto* refused = std::get_if<ControlRefused>(&outcome))
            codes.push_back(refused->code);
        else
            ++shown;
    };
    for (int k = 0; k < 20; ++k)
        preview.ask({{Role::kClient, 1}, {0, 0.39 - 0.01 * k, 1'000}, take}, model_, 1);
    for (int left = 5'000; left > 0 && codes.size() + shown < 20; --left) {
        for (JournalPreview::Reply& reply : preview.take_replies()) reply.answer(std::move(reply.outcome));
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    EXPECT_EQ(codes.size() + shown, 20u);
    EXPECT_GE(shown, 1u);
    for (const std::string& code : codes) EXPECT_EQ(code, "superseded");
}

}  // namespace
}  // namespace roboss::test
