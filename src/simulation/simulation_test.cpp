// The Simulation in one process: targets, saved runs, requests, Simulators that come and go; the same hash
// always.
#include "simulation/simulation.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <support/bodies.h>
#include <atomic>
#include <filesystem>

#include "journal/journal_writer.h"

namespace roboss {
namespace {

constexpr Tick kEnd = 300;

/// A row of boxes that fall and slide, and touch each other.
std::shared_ptr<const Model> boxes_world() {
    World world = test::empty_world(0.002);
    test::place(world, test::ground(test::surface(0.4)), "ground");
    for (int i = 0; i < 4; ++i)
        test::place(world, test::solid_box(1, {0.2, 0.2, 0.2}, test::surface(0.4)), "box" + std::to_string(i),
                    {{0.21 * i, 0, 0.15 + 0.05 * i}, {}});
    Diagnostics diagnostics;
    auto model = compile(world, {}, diagnostics);
    EXPECT_FALSE(diagnostics.has_errors());
    return model;
}

std::unique_ptr<Simulation> make(const std::shared_ptr<const Model>& model, std::size_t simulators = 1,
                                 const SavedRun* from = nullptr) {
    SimulationOptions options;
    options.simulators = simulators;
    Result<std::unique_ptr<Simulation>> made = Simulation::create(model, options, {}, from);
    EXPECT_TRUE(made.ok());
    return std::move(made).value();
}

void run_until(Simulation& simulation, Tick target) {
    const Result<> stepped = simulation.run_until(target);
    ASSERT_TRUE(stepped.ok()) << stepped.error().text();
    ASSERT_EQ(simulation.tick(), target);
}

Order push(Tick apply_at) {
    return {apply_at, {}, 1, RobotId(0u), SetVelocity{{1, 0, 0}, {}}};
}

class SimulationTest : public ::testing::Test {
  protected:
    void SetUp() override {
        const auto simulation = make(model_);
        ASSERT_TRUE(simulation->submit(push(100)).ok());
        run_until(*simulation, kEnd);
        expected_ = simulation->hash();
    }
    std::shared_ptr<const Model> model_ = boxes_world();
    std::uint64_t expected_ = 0;  // of the run with the push, by one Simulator
};

TEST_F(SimulationTest, StopsAtEachTargetAndHasTheStatesThere) {
    const auto simulation = make(model_, 3);
    ASSERT_TRUE(simulation->submit(push(100)).ok());
    for (const Tick target : {1, 2, 50, 120, 121}) {
        run_until(*simulation, target);
        std::vector<std::uint64_t> hashes;
        const std::vector<RobotState>& states = simulation->states();
        for (std::size_t r = 0; r < states.size(); ++r)
            hashes.push_back(state_hash(RobotId(r), target, states[r]));
        EXPECT_EQ(world_hash(model_->hash, hashes), simulation->hash()) << "tick " << target;
    }
    run_until(*simulation, kEnd);
    EXPECT_EQ(simulation->hash(), expected_);
}

/// The window that is in progress when the interrupt comes is not committed.
TEST_F(SimulationTest, AnInterruptEndsARunWithinAWindowAndLeavesTheStatesOfTheLastOne) {
    std::atomic<int> asked = 0;
    std::atomic<bool> interrupts = true;
    SimulationOptions options;
    options.controller.window = 100;
    options.threads = 2;
    // Once a tick, and a few times a window.
    options.interrupted = [&] { return interrupts && ++asked > 150; };
    const auto simulation = std::move(Simulation::create(model_, options)).value();
    ASSERT_TRUE(simulation->submit(push(100)).ok());
    ASSERT_TRUE(simulation->run_until(kEnd).ok());
    const Tick tick = simulation->tick();
    EXPECT_EQ(tick % 100, 0) << "a part of a window was committed";
    EXPECT_LT(tick, kEnd);
    EXPECT_LT(asked, 250) << "it was stepped on after the interrupt";
    std::vector<std::uint64_t> hashes;
    for (std::size_t r = 0; r < simulation->states().size(); ++r)
        hashes.push_back(state_hash(RobotId(r), tick, simulation->states()[r]));
    EXPECT_EQ(world_hash(model_->hash, hashes), simulation->hash());
    const SavedRun saved = simulation->saved_run();
    EXPECT_EQ(saved.tick, tick);
    interrupts = false;
    run_until(*simulation, kEnd);
    EXPECT_EQ(simulation->hash(), expected_) << "the run continues to the undisturbed hash";
    const auto continued = make(model_, 2, &saved);
    run_until(*continued, kEnd);
    EXPECT_EQ(continued->hash(), expected_);
}

TEST_F(SimulationTest, AProfileSumsOverSimulatorsAndChangesNoBit) {
    SolverProfile alone;
    for (const std::size_t simulators : {std::size_t{1}, std::size_t{3}}) {
        const auto simulation = make(model_, simulators);
        ASSERT_TRUE(simulation->submit(push(100)).ok());
        run_until(*simulation, 100);
        EXPECT_EQ(simulation->take_profile(), StepProfile{}) << "no profile was requested";
        simulation->measure(true);
        simulation->set_window(10);
        run_until(*simulation, 200);
        const StepProfile profile = simulation->take_profile();
        EXPECT_GT(profile.stages.of(Stage::kVelocities), 0u);
        EXPECT_GT(profile.stages.of(Stage::kNarrowPhase), 0u);
        EXPECT_GE(profile.solver.islands, 100u);
        EXPECT_GE(profile.solver.largest_island, 1u);
        EXPECT_EQ(simulation->take_profile(), StepProfile{}) << "it was taken";
        simulation->measure(false);
        run_until(*simulation, kEnd);
        EXPECT_EQ(simulation->take_profile(), StepProfile{});
        EXPECT_EQ(simulation->hash(), expected_);
        if (simulators == 1) alone = profile.solver;
        EXPECT_EQ(profile.solver.largest_island, alone.largest_island);
        EXPECT_EQ(profile.solver.residual, alone.residual) << "the worst of the same islands";
    }
}

class Idle : public ControlProgram {
    void control(Client&) override {}
};

TEST_F(SimulationTest, AJournalNamesTheClientsFromItsBeginningEvenIfTheyAreStillToJoin) {
    const std::string file = ::testing::TempDir() + "roboss_clients_" + std::to_string(getpid());
    std::filesystem::remove(file);
    SimulationOptions options;
    options.simulators = 1;
    options.clients_awaited = {"elsewhere"};
    std::vector<NamedProgram> programs;
    programs.push_back({"driver", std::make_unique<Idle>()});
    const auto simulation = std::move(Simulation::create(model_, options, std::move(programs))).value();
    auto writer = std::move(JournalWriter::open(file)).value();
    ASSERT_TRUE(writer->start_branch({}, *model_).ok());
    simulation->start_log(writer.get(), 100);
    ASSERT_TRUE(writer->flush().ok());

    const Journal journal = std::move(Journal::open(file)).value();  // as after kill -9
    const Branch branch = journal.branch().value();
    const Result<SavedRun> run = journal.resume_from(branch, journal.checkpoints(branch).front(), *model_);
    ASSERT_TRUE(run.ok()) << run.error().text();
    EXPECT_EQ(run.value().clients, (std::vector<std::string>{"driver", "elsewhere"}));
    EXPECT_EQ(run.value().tick, 0);
    std::filesystem::remove(file);
}

TEST_F(SimulationTest, RefusesAnOrderForATickThatIsOverAndForARobotThatIsNot) {
    const auto simulation = make(model_);
    run_until(*simulation, 50);
    EXPECT_FALSE(simulation->submit(push(49)).ok());
    Order nobody = push(60);
    nobody.robot = RobotId(99u);
    EXPECT_FALSE(simulation->submit(nobody).ok());
    ASSERT_TRUE(simulation->submit(push(100)).ok());
    run_until(*simulation, kEnd);
    EXPECT_EQ(simulation->hash(), expected_) << "what was refused has changed nothing";
}

TEST_F(SimulationTest, ContinuesASavedRunExactlyWithTheOrdersStillToBeApplied) {
    const auto first = make(model_);
    ASSERT_TRUE(first->submit(push(100)).ok());
    run_until(*first, 60);
    const SavedRun saved = first->saved_run();
    EXPECT_EQ(saved.tick, 60);
    const auto second = make(model_, 2, &saved);
    EXPECT_EQ(second->tick(), 60);
    EXPECT_EQ(second->hash(), first->hash());
    run_until(*second, kEnd);
    EXPECT_EQ(second->hash(), expected_);
}

TEST_F(SimulationTest, SimulatorsThatComeAndGoChangeNoBit) {
    const auto simulation = make(model_, 1);
    ASSERT_TRUE(simulation->submit(push(100)).ok());
    EXPECT_FALSE(simulation->remove_simulator()) << "it is the only one";
    run_until(*simulation, 40);
    simulation->add_simulator();
    simulation->add_simulator();
    run_until(*simulation, 90);
    EXPECT_EQ(simulation->counters().simulators, 3u);
    ASSERT_EQ(simulation->members().size(), 3u);
    std::size_t robots = 0;
    for (const MemberReport& member : simulation->members()) robots += member.robots;
    EXPECT_EQ(robots, model_->robots.size());
    EXPECT_TRUE(simulation->remove_simulator());
    run_until(*simulation, 200);
    EXPECT_EQ(simulation->counters().simulators, 2u);
    simulation->set_window(1);
    run_until(*simulation, kEnd);
    EXPECT_EQ(simulation->hash(), expected_);
}

TEST_F(SimulationTest, HandsOutARequestOnceAndSendsItsAnswer) {
    const auto simulation = make(model_);
    const Address requester{Role::kClient, 77};
    simulation->bus().send(requester, kControllerAddress, ControlRequest{1, PauseRun{}});
    simulation->bus().send(requester, kControllerAddress, ControlRequest{1, PauseRun{}});
    for (int i = 0; i < 3; ++i) simulation->serve();
    const std::vector<ControlCall> calls = simulation->take_control_calls();
    ASSERT_EQ(calls.size(), 1u);
    EXPECT_EQ(calls[0].request.action, ControlAction(PauseRun{}));
    simulation->answer(calls[0], ControlDone{0, "paused"});
    EXPECT_TRUE(simulation->take_control_calls().empty());
    std::vector<Envelope> inbox;
    simulation->bus().drain(requester, inbox);
    ASSERT_EQ(inbox.size(), 1u);
    EXPECT_EQ(std::get<ControlReply>(inbox[0].message), (ControlReply{1, ControlDone{0, "paused"}}));
}

TEST_F(SimulationTest, EndsEarlyAtAWindowsEndWhenItsCallerSaysSo) {
    const auto simulation = make(model_);
    ASSERT_TRUE(simulation->submit(push(100)).ok());
    int asked = 0;
    ASSERT_TRUE(simulation->run_until(kEnd, [&] { return ++asked < 5; }).ok());
    EXPECT_LT(simulation->tick(), kEnd);
    run_until(*simulation, kEnd);
    EXPECT_EQ(simulation->hash(), expected_);
}

TEST_F(SimulationTest, ANextSimulationOnTheSameBusContinuesTheRun) {
    auto first = make(model_, 2);
    ASSERT_TRUE(first->submit(push(100)).ok());
    run_until(*first, 80);
    const SavedRun saved = first->saved_run();
    SimulationOptions options;
    options.simulators = 2;
    options.controller.before = first->hand_over();
    Result<std::unique_ptr<Simulation>> next =
        Simulation::create(model_, options, {}, &saved, first->release_bus());
    ASSERT_TRUE(next.ok());
    run_until(*next.value(), kEnd);
    EXPECT_EQ(next.value()->hash(), expected_);
}

}  // namespace
}  // namespace roboss
