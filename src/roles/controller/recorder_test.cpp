// What reaches the log, when a window may be committed, and how a checkpoint for the log proceeds.
#include "roles/controller/recorder.h"

#include <gtest/gtest.h>

#include <limits>

#include "bus/in_process_bus.h"
#include "roles/controller/controller.h"

namespace roboss {
namespace {

/// Writes down what it gets; nothing is safe before `safe_count` says so.
class ScriptedLog : public RunLog {
  public:
    void joined(ClientId, const std::string& name) override { lines.push_back("joined " + name); }
    void order(const Order& order, Tick) override {
        ++entries;
        lines.push_back("order " + std::to_string(order.apply_at));
    }
    void reply(ClientId, Tick observed) override {
        ++entries;
        lines.push_back(observed == kGoneForGood ? "gone" : "reply " + std::to_string(observed));
    }
    void note(Tick, const std::string&) override {}
    void planned(Tick until) override { lines.push_back("planned " + std::to_string(until)); }
    void committed(Tick tick, std::uint64_t) override {
        lines.push_back("committed " + std::to_string(tick));
    }
    bool takes_checkpoint() const override { return takes; }
    void checkpoint(RunCheckpoint) override {}
    std::uint64_t given() const override { return entries; }
    bool safe(std::uint64_t count) const override { return count <= safe_count; }
    void hurry() override { lines.emplace_back("hurry"); }
    void wait_safe(std::uint64_t, std::int64_t) override {}

    std::vector<std::string> lines;
    std::uint64_t entries = 0, safe_count = 0;
    bool takes = true;
};

const ClientId kFirst(0u), kSecond(1u);
const std::vector<std::uint64_t> kHashes{1, 2};

std::shared_ptr<const std::vector<RobotState>> no_robots() {
    return std::make_shared<const std::vector<RobotState>>();
}

TEST(Recorder, WithoutALogEverythingIsSafeAndNoCheckpointIsDue) {
    Recorder recorder(nullptr, 10, 0, {});
    recorder.joined(kFirst, "a");
    recorder.order({}, 0);
    recorder.gone(kFirst);
    recorder.planned(5);
    recorder.hurry();
    EXPECT_TRUE(recorder.may_commit());
    recorder.committed(5, 0, kHashes);
    EXPECT_EQ(recorder.given(), 0u);
    EXPECT_TRUE(recorder.safe(1000));
    EXPECT_EQ(recorder.next_checkpoint(5), std::numeric_limits<Tick>::max());
    EXPECT_FALSE(recorder.take_checkpoint_due(10));
}

TEST(Recorder, AWindowIsCommittedOnceTheOrdersGivenBeforeItAreSafe) {
    ScriptedLog log;
    Recorder recorder(&log, 0, 0, {});
    recorder.order({}, 0);
    recorder.reply(kFirst, 0);
    recorder.planned(5);
    recorder.order({}, 1);  // for a later window
    EXPECT_FALSE(recorder.may_commit());
    log.safe_count = 1;
    EXPECT_FALSE(recorder.may_commit());
    log.safe_count = 2;
    EXPECT_TRUE(recorder.may_commit());
    EXPECT_FALSE(recorder.safe(recorder.given()));
}

TEST(Recorder, ItFollowsAnEarlierLogWithoutWritingItAgain) {
    ScriptedLog log;
    Recorder recorder(&log, 10, 20, {15});
    recorder.committed(10, 0, kHashes);
    recorder.committed(20, 0, kHashes);
    EXPECT_FALSE(recorder.take_checkpoint_due(10));
    EXPECT_TRUE(log.lines.empty());
    recorder.committed(30, 0, kHashes);
    EXPECT_EQ(log.lines, std::vector<std::string>{"committed 30"});
    EXPECT_TRUE(recorder.has_reply(kFirst, true, 15));
    EXPECT_FALSE(recorder.has_reply(kFirst, true, 16));
    EXPECT_TRUE(recorder.has_reply(kFirst, false, 16)) << "the run did not wait for a free-running Client";
    EXPECT_FALSE(recorder.has_reply(kFirst, false, 20));
    EXPECT_TRUE(recorder.has_reply(kSecond, true, 19)) << "joined after the log";
    EXPECT_FALSE(recorder.has_reply(kSecond, true, 20));
}

TEST(Recorder, ACheckpointIsHandedOutOnceAndOneIsUnderWayAtATime) {
    ScriptedLog log;
    Recorder recorder(&log, 10, 0, {});
    EXPECT_EQ(recorder.next_checkpoint(0), 10);
    EXPECT_EQ(recorder.next_checkpoint(10), 20);
    EXPECT_FALSE(recorder.take_checkpoint_due(9));
    ASSERT_TRUE(recorder.take_checkpoint_due(10));
    EXPECT_FALSE(recorder.take_checkpoint_due(10)) << "once per tick";
    recorder.checkpoint_begun(10);
    EXPECT_FALSE(recorder.take_checkpoint_due(20)) << "one is under way";
    recorder.checkpoint_complete(15, no_robots());
    EXPECT_FALSE(recorder.take_checkpoint()) << "another tick's states";
    recorder.checkpoint_complete(10, no_robots());
    EXPECT_EQ(recorder.checkpoint_tick(), 10);
    const auto checkpoint = recorder.take_checkpoint();
    ASSERT_TRUE(checkpoint);
    EXPECT_EQ(checkpoint->tick, 10);
    EXPECT_FALSE(recorder.take_checkpoint());
    EXPECT_FALSE(recorder.checkpoint_tick());
    log.takes = false;
    EXPECT_FALSE(recorder.take_checkpoint_due(30)) << "the log still writes";
    log.takes = true;
    ASSERT_TRUE(recorder.take_checkpoint_due(40));
    recorder.checkpoint_begun(40);
    recorder.checkpoint_lost(30);
    EXPECT_TRUE(recorder.checkpoint_tick());
    recorder.checkpoint_lost(40);
    EXPECT_FALSE(recorder.checkpoint_tick());
}

TEST(Recorder, AnotherLogBeginsWithoutTheCheckpointUnderWay) {
    ScriptedLog first, second;
    Recorder recorder(&first, 10, 0, {});
    ASSERT_TRUE(recorder.take_checkpoint_due(10));
    recorder.checkpoint_begun(10);
    recorder.checkpoint_complete(10, no_robots());
    recorder.start(&second, 5);
    EXPECT_FALSE(recorder.take_checkpoint());
    EXPECT_EQ(recorder.next_checkpoint(10), 15);
    recorder.gone(kFirst);
    EXPECT_TRUE(first.lines.empty());
    EXPECT_EQ(second.lines, std::vector<std::string>{"gone"});
}

TEST(RecorderDeathTest, TheCommittedTickNeverGoesBack) {
    Recorder recorder(nullptr, 0, 0, {});
    recorder.committed(10, 0, kHashes);
    EXPECT_DEATH(recorder.committed(10, 0, kHashes), "committed after tick 10");
}

/// A Client's messages to a Controller with a log: a reply is acknowledged only once it is safe.
TEST(Recorder, AReplyIsAcknowledgedOnceTheLogHasIt) {
    InProcessBus bus;
    ScriptedLog log;
    ControllerOptions options;
    options.log = &log;
    auto model = std::make_shared<Model>();
    Controller controller(model, options, {});
    const Address client{Role::kClient, 1};
    const auto acknowledged = [&] {
        controller.advance(bus);
        std::vector<Envelope> inbox;
        bus.drain(client, inbox);
        for (const Envelope& envelope : inbox)
            if (std::holds_alternative<ReplyAck>(envelope.message)) return true;
        return false;
    };
    ClientHello hello{"a", model->hash, 10, 10, true};
    bus.send(client, kControllerAddress, hello);
    EXPECT_FALSE(acknowledged());
    ClientReply reply;
    reply.client = kFirst;
    reply.number = 1;
    bus.send(client, kControllerAddress, reply);
    EXPECT_FALSE(acknowledged());
    EXPECT_EQ(log.lines, (std::vector<std::string>{"joined a", "reply 0"}));
    log.safe_count = 1;
    EXPECT_TRUE(acknowledged());
    EXPECT_FALSE(acknowledged()) << "once";
}

}  // namespace
}  // namespace roboss
