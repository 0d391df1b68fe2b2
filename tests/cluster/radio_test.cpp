// Radio in runs: what is heard, and the bits of the world, are the same for all groupings, with kills, over a
// saved run, and in a replay.
#include <gtest/gtest.h>

#include <filesystem>

#include <support/bodies.h>
#include <support/robots.h>

#include "faulty_cluster.h"
#include "journal/journal_writer.h"
#include "simulation/replay.h"
#include "simulation/simulation.h"

namespace roboss::test {
namespace {

constexpr Tick kEnd = 300;
constexpr int kCrates = 9;

/// Crates with radios that are thrown at each other over a floor; a wall stands in the middle.
std::shared_ptr<const Model> crates() {
    World world = empty_world(2e-3);
    world.sleep = true;
    ModelSpec floor = solid_box(1, {40, 40, 1}, surface(0.5)), wall = solid_box(1, {0.2, 6, 2}, surface(0.5));
    floor.is_static = wall.is_static = true;
    place(world, floor, "floor", {{0, 0, -0.5}, {}});
    place(world, wall, "wall", {{0.75, 0, 1}, {}});
    ModelSpec crate = solid_box(2, {0.4, 0.3, 0.2}, surface(0.4));
    RadioSpec radio;
    radio.bit_rate = 5e4, radio.sigma = 6, radio.noise_floor = -60, radio.obstacle_loss = 15,
    radio.tx_power = 10;
    radio.latency = 0.004;
    SensorSpec sensor;
    sensor.name = "radio", sensor.parameters = radio;
    crate.links[0].sensors = {sensor};
    for (int i = 0; i < kCrates; ++i)
        place(world, crate, "crate_" + std::to_string(i),
              {{1.5 * (i % 3) - 1.5, 1.5 * (i / 3) - 1.5, 0.4}, {}});
    Diagnostics diagnostics;
    return compile(world, {}, diagnostics);
}

RobotId crate(int i) {
    return RobotId(static_cast<std::size_t>(i));
}

/// A message, who heard it, and at which observation.
struct Heard {
    Tick observed = 0;
    int by = 0;
    RadioMessage message;
    friend bool operator==(const Heard&, const Heard&) = default;
};

/// Each crate sends now and then, and answers what it hears; so a difference would grow.
class Chatter : public ControlProgram {
  public:
    Chatter(std::vector<Heard>& heard, double period_s) : heard_(heard), period_s_(period_s) {}
    ControlOptions options() const override { return {period_s_, -1, true}; }
    void control(Client& client) override {
        const Tick tick = client.tick();
        for (int i = 0; i < kCrates; ++i) {
            const double to = 2.0 - static_cast<double>((tick / 50 + i) % 5);
            if (tick % 50 == 0) (void)client.set_velocity(crate(i), {to, 0.5 * i - 2, 1}, {0, 1, to});
            if ((tick + 7 * i) % 60 == 0)
                (void)client.transmit(crate(i), "radio", "hello" + std::to_string(i));
            for (RadioMessage& m : client.received(crate(i), "radio")) {
                const bool answers = (m.number + static_cast<std::uint64_t>(i)) % 4 == 0;  // not all at once
                if (answers && m.payload.size() < 9) (void)client.transmit(crate(i), 0, "answered!", m.from);
                heard_.push_back({tick, i, std::move(m)});
            }
        }
    }

  private:
    std::vector<Heard>& heard_;
    double period_s_;
};

std::vector<NamedProgram> chatter(std::vector<Heard>& heard) {
    std::vector<NamedProgram> programs;
    programs.push_back({"chatter", std::make_unique<Chatter>(heard, 0.01)});
    return programs;
}

struct Outcome {
    std::uint64_t hash = 0;
    std::vector<Heard> heard;
};

Outcome run(const std::shared_ptr<const Model>& model, std::size_t simulators, unsigned threads,
            Tick window) {
    Outcome outcome;
    SimulationOptions options;
    options.simulators = simulators, options.threads = threads, options.controller.window = window;
    auto made = Simulation::create(model, options, chatter(outcome.heard));
    EXPECT_TRUE(made.value()->run_until(kEnd).ok());
    outcome.hash = made.value()->hash();
    return outcome;
}

TEST(RadioRuns, HearTheSameForAllGroupings) {
    const auto model = crates();
    const Outcome one = run(model, 1, 1, 1);
    std::size_t answers = 0;
    for (const Heard& h : one.heard) {
        EXPECT_GT(h.message.arrived, h.message.sent);
        EXPECT_LE(h.message.arrived, h.observed);
        EXPECT_GT(h.message.arrived, h.observed - 5) << "heard at the first observation that has it";
        answers += h.message.payload.size() == 9 ? 1 : 0;
    }
    EXPECT_GT(answers, 3u);
    EXPECT_GT(one.heard.size(), 50u);
    for (const std::size_t simulators : {1u, 4u})
        for (const unsigned threads : {1u, 2u})
            for (const Tick window : {Tick{0}, Tick{7}}) {
                const Outcome other = run(model, simulators, threads, window);
                EXPECT_EQ(other.hash, one.hash) << simulators << " Simulators, " << threads << " threads";
                EXPECT_EQ(other.heard, one.heard) << simulators << " Simulators, " << threads << " threads";
            }
}

TEST(RadioRuns, HearTheSameWhileSimulatorsAreKilled) {
    const auto model = crates();
    const Outcome undisturbed = run(model, 1, 1, 0);
    int kills = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        ControllerOptions options;
        options.checkpoint_ticks = 20 + static_cast<Tick>(seed % 4) * 30;
        FaultyCluster cluster(model, options, bad_network(seed), {60, 30, 20, 250, 2000}, 1 + seed % 3);
        std::vector<Heard> heard;
        cluster.add_program("chatter", std::make_unique<Chatter>(heard, 0.01));
        ASSERT_TRUE(cluster.run_until(kEnd));
        EXPECT_EQ(cluster.controller().hash(), undisturbed.hash);
        EXPECT_EQ(heard, undisturbed.heard);
        kills += cluster.kills();
    }
    EXPECT_GT(kills, 3) << "else this test did not test";
}

TEST(RadioRuns, ASavedRunHearsWhatIsOnItsWay) {
    const auto model = crates();
    const Outcome whole = run(model, 2, 1, 0);
    for (const Tick half : {1, 60, 63, 125, 200}) {
        std::vector<Heard> heard;
        auto first = std::move(Simulation::create(model, {}, chatter(heard))).value();
        ASSERT_TRUE(first->run_until(half).ok());
        const SavedRun saved = first->saved_run();
        first.reset();
        std::erase_if(heard, [&](const Heard& h) { return h.observed >= saved.tick; });  // is observed again
        SimulationOptions options;
        options.simulators = 3;
        auto second = std::move(Simulation::create(model, options, chatter(heard), &saved)).value();
        ASSERT_TRUE(second->run_until(kEnd).ok());
        EXPECT_EQ(second->hash(), whole.hash) << "saved at tick " << half;
        EXPECT_EQ(heard, whole.heard) << "saved at tick " << half;
    }
}

TEST(RadioRuns, AReplayHasTheSameTransmissions) {
    const auto model = crates();
    const std::string file = (std::filesystem::path(::testing::TempDir()) / "roboss_radio.journal").string();
    std::filesystem::remove(file);
    std::vector<Heard> heard;
    auto simulation = std::move(Simulation::create(model, {}, chatter(heard))).value();
    {
        auto writer = std::move(JournalWriter::open(file)).value();
        ASSERT_TRUE(writer->start_branch({}, *model).ok());
        simulation->start_log(writer.get(), 100);
        ASSERT_TRUE(writer->flush().ok());
        ASSERT_TRUE(simulation->run_until(kEnd).ok());
        ASSERT_TRUE(writer->close().ok());
    }
    const Journal journal = std::move(Journal::open(file)).value();
    const Branch branch = journal.branch().value();
    auto replayed = replay_at(journal, branch, model, kEnd, kEnd, {2, 5});
    ASSERT_TRUE(replayed.ok()) << replayed.error().text();
    EXPECT_EQ(replayed.value()->hash(), simulation->hash());
    std::uint64_t count = 0;
    for (const RobotState& state : replayed.value()->states())
        if (!state.radios.empty()) count += state.radios[0].count;
    EXPECT_GT(count, 15u);
    std::filesystem::remove(file);
}

TEST(RadioRuns, TransmissionsMoveNothing) {
    const auto model = crates();
    std::vector<Heard> heard;
    auto silent = std::move(Simulation::create(model, {})).value();
    auto talking = std::move(Simulation::create(model, {})).value();
    for (Tick t = 0; t < 1500; t += 13)
        ASSERT_TRUE(talking
                        ->submit({t, ClientId(), static_cast<std::uint64_t>(t),
                                  crate(static_cast<int>(t) % 9), Transmit{0, {}, {1, 2, 3}}})
                        .ok());
    ASSERT_TRUE(silent->run_until(1500).ok());
    ASSERT_TRUE(talking->run_until(1500).ok());
    EXPECT_NE(silent->hash(), talking->hash()) << "what was sent is part of the state";
    bool any_sleeps = false;
    for (std::size_t i = 0; i < kCrates; ++i) {
        RobotState state = talking->states()[i];
        EXPECT_GT(state.radios.at(0).count, 10u);
        state.radios = silent->states()[i].radios;
        EXPECT_EQ(state, silent->states()[i]) << "crate " << i;
        any_sleeps |= state.rest.asleep;
    }
    EXPECT_TRUE(any_sleeps) << "else nobody could have been woken";
}

}  // namespace
}  // namespace roboss::test
