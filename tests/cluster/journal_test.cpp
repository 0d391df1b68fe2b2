// A Controller that is killed resumes from its log, whatever the Bus does and however far the log had come;
// what was committed is what it was.
#include <gtest/gtest.h>

#include "faulty_cluster.h"
#include "simulation/simulation.h"
#include "test_worlds.h"

namespace roboss::test {
namespace {

constexpr Tick kTicks = 200;
constexpr Tick kLogTicks = 30;

/// A log whose entries become safe together, now and then, and of which only the safe ones outlive a crash.
class SlowLog : public RunLog {
  public:
    void joined(ClientId, const std::string&) override {}
    void order(const Order& order, Tick given_at) override {
        waiting_.orders.push_back({order, given_at}), ++given_;
    }
    void reply(ClientId client, Tick observed) override {
        waiting_.replies.push_back({client, observed}), ++given_;
    }
    void note(Tick, const std::string&) override {}
    void planned(Tick until) override { waiting_planned_ = until; }
    void committed(Tick tick, std::uint64_t hash) override { committed_[tick] = hash; }
    bool takes_checkpoint() const override { return !waiting_checkpoint_; }
    void checkpoint(RunCheckpoint checkpoint) override { waiting_checkpoint_ = std::move(checkpoint); }
    std::uint64_t given() const override { return given_; }
    bool safe(std::uint64_t count) const override { return safe_ >= count; }
    void hurry() override {}
    void wait_safe(std::uint64_t, std::int64_t) override {}

    void settle() {
        kept_.append(std::exchange(waiting_, {}));
        planned_ = std::max(planned_, waiting_planned_);
        if (waiting_checkpoint_) checkpoints_.push_back(*std::exchange(waiting_checkpoint_, std::nullopt));
        safe_ = given_;
    }
    void crash() {
        waiting_ = {};
        waiting_planned_ = -1;
        waiting_checkpoint_.reset();
        given_ = safe_;
    }
    Tick planned() const { return planned_; }
    const std::map<Tick, std::uint64_t>& committed() const { return committed_; }

    /// As RunJournal::last_run(): a checkpoint before which every Client had answered.
    StartingPoint last(const Model& model, std::size_t clients) const {
        StartingPoint start = beginning_of(model);
        start.answered.assign(clients, -1);
        for (const LoggedReply& reply : kept_.replies)
            start.answered[reply.client.index()] =
                std::max(start.answered[reply.client.index()], reply.observed);
        const Tick all = *std::min_element(start.answered.begin(), start.answered.end());
        for (const RunCheckpoint& c : checkpoints_)
            if (c.tick <= all) start.tick = c.tick, start.states = *c.states;
        for (const LoggedOrder& o : kept_.orders)
            if (o.order.apply_at >= start.tick) start.orders.push_back(o);
        start.logged_until = std::max(planned_, start.tick);
        return start;
    }

  private:
    LogBatch waiting_, kept_;
    Tick waiting_planned_ = -1, planned_ = -1;
    std::optional<RunCheckpoint> waiting_checkpoint_;
    std::vector<RunCheckpoint> checkpoints_;
    std::map<Tick, std::uint64_t> committed_;
    std::uint64_t given_ = 0, safe_ = 0;
};

ControlOptions often() {
    ControlOptions options;
    options.period_s = 0.016;
    return options;
}
ControlOptions seldom() {
    ControlOptions options;
    options.period_s = 0.024;
    options.latency_s = 0.05;
    return options;
}

std::uint64_t undisturbed_hash(const std::shared_ptr<const Model>& model) {
    std::vector<NamedProgram> programs;
    programs.push_back({"often", std::make_unique<DrivingProgram>(often())});
    programs.push_back({"seldom", std::make_unique<DrivingProgram>(seldom())});
    auto simulation = Simulation::create(model, {}, std::move(programs));
    EXPECT_TRUE(simulation.value()->run_until(kTicks).ok());
    return simulation.value()->hash();
}

/// One run with crashes of the Controller by chance; how many there were.
int run_with_crashes(const std::shared_ptr<const Model>& model, std::uint64_t seed, std::uint64_t expected) {
    SlowLog log;
    ControllerOptions options;
    options.log = &log;
    options.log_ticks = kLogTicks;
    options.window = seed % 3 == 0 ? 0 : static_cast<Tick>(seed % 9 + 1);
    FaultOptions faults;
    faults.seed = seed;
    faults.drop = 0.02 * static_cast<double>(seed % 5);
    faults.duplicate = seed % 7 == 0 ? 0.3 : 0.05;
    faults.delay_ms_max = seed % 4 == 0 ? 60 : 5;
    FaultyCluster cluster(model, options, faults, {seed % 2 == 0 ? 50u : 0u, 0, 0, 100, 2000}, 2);
    cluster.add_program("often", often());
    cluster.add_program("seldom", seldom());
    int crashes = 0;
    Tick committed = 0;
    for (int turns = 0; turns < 100'000; ++turns) {
        cluster.turn();
        Controller& controller = cluster.controller();
        controller.run_until(kTicks);
        if (auto checkpoint = controller.take_log_checkpoint()) log.checkpoint(std::move(*checkpoint));
        if (cluster.bus().random(4) == 0) log.settle();
        committed = std::max(committed, controller.tick());
        if (controller.resting()) {
            EXPECT_EQ(controller.hash(), expected);
            return crashes;
        }
        EXPECT_FALSE(controller.failure()) << controller.failure()->text();
        if (controller.failure()) return crashes;
        if (cluster.bus().random(120) != 0 || crashes >= 6) continue;
        log.crash();
        cluster.restart_controller(log.last(*model, 2));
        ++crashes;
    }
    ADD_FAILURE() << "stuck at tick " << cluster.controller().tick() << " of " << committed;
    return crashes;
}

TEST(JournaledCluster, AControllerKilledAtAnyMomentGoesOnToTheUndisturbedHash) {
    const auto model = carts_world(3);
    const std::uint64_t expected = undisturbed_hash(model);
    int crashes = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        crashes += run_with_crashes(model, seed, expected);
    }
    EXPECT_GT(crashes, 500);
}

}  // namespace
}  // namespace roboss::test
