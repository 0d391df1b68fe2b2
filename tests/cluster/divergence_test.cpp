// Where two runs part is found to the tick, the robot and the field, from journals with few checkpoints.
#include "simulation/divergence.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "journal/journal_writer.h"
#include "test_worlds.h"

namespace roboss::test {
namespace {

namespace fs = std::filesystem;

class Divergences : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ =
            fs::path(::testing::TempDir()) /
            ("roboss_diff_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    /// A journal of 300 ticks with checkpoints at multiples of `every` and one order at `tick`, if any.
    Journal keep(const std::string& name, Tick every, Tick tick = -1, double force = 1e-9) const {
        const std::string file = (folder_ / name).string();
        auto writer = std::move(JournalWriter::open(file)).value();
        auto simulation = std::move(Simulation::create(model_, {})).value();
        if (tick >= 0) {
            const Order order{tick, ClientId(), 1, RobotId(1u),
                              ApplyWrench{LinkId(0u), {force, 0, 0}, {}, 1}};
            EXPECT_TRUE(simulation->submit(order).ok());
        }
        EXPECT_TRUE(writer->start_branch({}, *model_).ok());
        simulation->start_log(writer.get(), every);
        EXPECT_TRUE(writer->flush().ok());
        for (Tick to = every; to < 300; to += every) {
            EXPECT_TRUE(simulation->run_until(to).ok());
            (void)simulation->states();
            EXPECT_TRUE(writer->flush().ok());
        }
        EXPECT_TRUE(simulation->run_until(300).ok());
        EXPECT_TRUE(writer->close().ok());
        writer.reset();
        return std::move(Journal::open(file)).value();
    }
    Comparison compared(const Journal& a, const Journal& b) const {
        const Result<Comparison> result = compare(a, a.branch().value(), b, b.branch().value(), {});
        EXPECT_TRUE(result.ok()) << result.error().text();
        return result.ok() ? result.value() : Comparison{};
    }

    fs::path folder_;
    std::shared_ptr<const Model> model_ = piles_world(2);
};

TEST_F(Divergences, AreFoundToTheTickRobotAndField) {
    const Journal plain = keep("plain", 50);
    for (const Tick every :
         {Tick{50}, Tick{70}, Tick{1000}}) {  // common checkpoints, others, none but the first
        const Journal other = keep("other" + std::to_string(every), every, 123);
        const Comparison found = compared(plain, other);
        ASSERT_TRUE(found.divergence.has_value());
        EXPECT_EQ(found.divergence->tick, 124) << "the step from 123 is the first with the order";
        EXPECT_EQ(found.divergence->robot, model_->robots[1].name);
        EXPECT_NE(found.divergence->field.a, found.divergence->field.b);
        EXPECT_FALSE(found.divergence->field.field.empty());
        EXPECT_TRUE(found.divergence->orders_a_only.empty());
        EXPECT_EQ(found.divergence->orders_b_only.size(), 1u);
    }
}

TEST_F(Divergences, AreNoneBetweenEqualRuns) {
    const Comparison found = compared(keep("a", 50, 200, 5), keep("b", 70, 200, 5));
    EXPECT_FALSE(found.divergence.has_value());
    EXPECT_EQ(found.from, 0);
    EXPECT_EQ(found.until, 300);
}

TEST_F(Divergences, ComputedWithOtherBitsAreToldFromOrderedOnes) {
    const Journal plain = keep("plain", 50);
    { keep("forged", 50); }
    {  // a machine that computed another bit: its checkpoint does not follow from its log
        auto writer = std::move(JournalWriter::open((folder_ / "bits").string())).value();
        EXPECT_TRUE(writer->start_branch({}, *model_).ok());
        const Branch branch = plain.branch().value();
        for (const CheckpointEntry& entry : plain.checkpoints(branch)) {
            auto states =
                std::make_shared<std::vector<RobotState>>(plain.checkpoint(entry, *model_).value().states);
            if (entry.tick == 150) (*states)[2].v[4] += 1e-12;
            writer->checkpoint({entry.tick, states, {}});
            EXPECT_TRUE(writer->flush().ok());
        }
        EXPECT_TRUE(writer->close().ok());
    }
    const Journal other = std::move(Journal::open((folder_ / "bits").string())).value();
    const Comparison found = compared(plain, other);
    ASSERT_TRUE(found.divergence.has_value());
    EXPECT_EQ(found.divergence->tick, 150);
    EXPECT_EQ(found.divergence->robot, model_->robots[2].name);
    EXPECT_EQ(found.divergence->field.field, "base linear velocity y");
    EXPECT_FALSE(found.divergence->remark.empty()) << "advises `roboss journal verify`";
    const auto verified = verify(other, other.branch().value(), {});
    ASSERT_TRUE(verified.ok());
    std::vector<Tick> bad;
    for (const Stretch& stretch : verified.value())
        if (!stretch.good()) bad.push_back(stretch.until);
    EXPECT_EQ(bad, (std::vector<Tick>{150, 200})) << "into the forged checkpoint and out of it";
}

TEST_F(Divergences, OfOtherWorldsAreNotLookedFor) {
    const Journal plain = keep("plain", 100);
    model_ = carts_world(2);
    const Journal other = keep("other", 100);
    const auto result = compare(plain, plain.branch().value(), other, other.branch().value(), {});
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, "other-robots");
}

}  // namespace
}  // namespace roboss::test
