// Control programs in the loop: what they see, what their orders do, and what happens when they break.
#include <gtest/gtest.h>

#include <stdexcept>

#include "simulation/simulation.h"
#include "test_worlds.h"

namespace roboss::test {
namespace {

using Call = std::function<void(Client&)>;

class Calling : public ControlProgram {
  public:
    Calling(const ControlOptions& options, Call call) : options_(options), call_(std::move(call)) {}
    ControlOptions options() const override { return options_; }
    void control(Client& client) override { call_(client); }

  private:
    ControlOptions options_;
    Call call_;
};

std::unique_ptr<Simulation> make(const std::shared_ptr<const Model>& model, const ControlOptions& options,
                                 Call call, std::size_t simulators = 2) {
    std::vector<NamedProgram> programs;
    programs.push_back({"caller", std::make_unique<Calling>(options, std::move(call))});
    SimulationOptions simulation;
    simulation.simulators = simulators;
    return std::move(Simulation::create(model, simulation, std::move(programs)).value());
}

TEST(Clients, SeeEveryPeriodTheExactCommittedState) {
    const auto model = pair_world();
    ControlOptions options;
    options.period_s = 0.02;  // 10 ticks
    std::vector<Tick> ticks;
    std::vector<std::uint64_t> hashes;
    auto simulation = make(model, options, [&](Client& client) {
        ticks.push_back(client.tick());
        std::vector<std::uint64_t> robots;
        for (std::size_t i = 0; i < 4; ++i)
            robots.push_back(state_hash(RobotId(i), client.tick(), client.state(RobotId(i))));
        hashes.push_back(world_hash(client.model().hash, robots));
    });
    std::vector<std::uint64_t> expected;
    auto reference = Simulation::create(model, {});
    for (Tick t = 0; t < 100; t += 10) {
        ASSERT_TRUE(reference.value()->run_until(t).ok());
        expected.push_back(reference.value()->hash());
    }
    ASSERT_TRUE(simulation->run_until(95).ok());
    EXPECT_EQ(ticks, (std::vector<Tick>{0, 10, 20, 30, 40, 50, 60, 70, 80, 90}));
    EXPECT_EQ(hashes, expected);
}

TEST(Clients, OrdersTakeEffectAfterTheDeclaredLatency) {
    const auto model = pair_world();
    for (const double latency_s : {-1.0, 0.0, 0.006, 0.05}) {
        ControlOptions options;
        options.period_s = 0.02;
        options.latency_s = latency_s;
        const Tick latency = latency_s < 0 ? 10 : static_cast<Tick>(latency_s / 0.002 + 0.5);
        auto simulation = make(model, options, [&](Client& client) {
            if (client.tick() != 20) return;
            EXPECT_TRUE(client.set_velocity(RobotId(3u), {3, 0, 0}, {}).ok());
        });
        auto reference = Simulation::create(model, {});
        ASSERT_TRUE(reference.value()
                        ->submit({20 + latency, ClientId(), 1, RobotId(3u), SetVelocity{{3, 0, 0}, {}}})
                        .ok());
        ASSERT_TRUE(reference.value()->run_until(70).ok());
        ASSERT_TRUE(simulation->run_until(70).ok());
        EXPECT_EQ(simulation->hash(), reference.value()->hash()) << "latency " << latency;
    }
}

TEST(Clients, AFreeRunningClientsOrdersArrive) {
    const auto model = pair_world();
    ControlOptions options;
    options.synchronous = false;
    int calls = 0;
    auto simulation = make(model, options, [&](Client& client) {
        if (++calls != 2) return;
        EXPECT_TRUE(client.set_velocity(RobotId(3u), {3, 0, 0}, {}).ok());
    });
    auto reference = Simulation::create(model, {});
    ASSERT_TRUE(simulation->run_until(200).ok());
    ASSERT_TRUE(reference.value()->run_until(200).ok());
    EXPECT_GE(calls, 5);
    EXPECT_GT(simulation->states()[3].q[0], reference.value()->states()[3].q[0] + 0.3);
}

TEST(Clients, ABadOrderIsRefusedAtOnceAndNothingElseIsDisturbed) {
    const auto model = pair_world();
    int refused = 0;
    auto simulation = make(model, {}, [&](Client& client) {
        refused += !client.set_pose(RobotId(77u), {}).ok();
        refused += !client.set_joint(RobotId(0u), JointId(3u), MotorMode::kVelocity, 1).ok();
        refused += !client.set_velocity(RobotId(0u), {0.0 / 0.0, 0, 0}, {}).ok();
        refused += !client.apply_wrench(RobotId(0u), LinkId(0u), {}, {}, -1).ok();
    });
    auto reference = Simulation::create(model, {});
    ASSERT_TRUE(simulation->run_until(50).ok());
    ASSERT_TRUE(reference.value()->run_until(50).ok());
    EXPECT_GE(refused, 4);
    EXPECT_EQ(refused % 4, 0);
    EXPECT_EQ(simulation->hash(), reference.value()->hash());
}

TEST(Clients, OneThatThrowsEndsTheRunWithItsWordsAndNothingIsLost) {
    const auto model = pair_world();
    auto simulation = make(model, {}, [&](Client& client) {
        if (client.tick() >= 40) throw std::runtime_error("my battery is empty");
    });
    const Result<> ran = simulation->run_until(1000);
    ASSERT_FALSE(ran.ok());
    EXPECT_EQ(ran.error().code, "client-failed") << ran.error().text();
    EXPECT_NE(ran.error().message.find("my battery is empty"), std::string::npos)
        << "the text of the exception";
    EXPECT_NE(ran.error().message.find("'caller'"), std::string::npos);
    EXPECT_GE(simulation->tick(), 40);
    EXPECT_LE(simulation->tick(), 50);
    auto reference = Simulation::create(model, {});
    ASSERT_TRUE(reference.value()->run_until(simulation->tick()).ok());
    EXPECT_EQ(simulation->hash(), reference.value()->hash());
    EXPECT_EQ(simulation->saved_run().states, reference.value()->states());
}

TEST(Clients, TwoProgramsOfOneNameAreRefused) {
    std::vector<NamedProgram> programs;
    for (int i = 0; i < 2; ++i)
        programs.push_back({"twin", std::make_unique<Calling>(ControlOptions{}, [](Client&) {})});
    const auto made = Simulation::create(pair_world(), {}, std::move(programs));
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().code, "duplicate-name");
    EXPECT_NE(made.error().message.find("twin"), std::string::npos);
}

TEST(Clients, APeriodThatMakesNoSenseIsRefused) {
    ControlOptions options;
    options.period_s = 0;
    std::vector<NamedProgram> programs;
    programs.push_back({"p", std::make_unique<Calling>(options, [](Client&) {})});
    EXPECT_FALSE(Simulation::create(pair_world(), {}, std::move(programs)).ok());
}

}  // namespace
}  // namespace roboss::test
