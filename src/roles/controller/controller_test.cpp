// The phases of a run, by messages of a Simulator that the test plays.
#include "roles/controller/controller.h"

#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/scripted_bus.h>
#include <support/simulation.h>

#include "wire/rights.h"
#include "wire/state_block.h"

namespace roboss::test {
namespace {

World one_ball() {
    World world = empty_world(1e-3);
    place(world, solid_sphere(1.0, 0.1, surface(0.5)), "ball", {{0, 0, 1}, {}});
    return world;
}

class Phases : public testing::Test {
  protected:
    void send(const Address& from, Message message) {
        bus.send(from, kControllerAddress, std::move(message));
        controller.advance(bus);
    }
    void join(const Address& simulator) { send(simulator, Hello{sim.model->hash, 1, ""}); }
    /// Answers the assignment that this Simulator got.
    void step(const Address& simulator, std::uint64_t hash) {
        const auto assignments = bus.take<Assignment>(simulator);
        ASSERT_EQ(assignments.size(), 1u);
        WindowResult result;
        result.epoch = assignments[0].epoch;
        result.window = assignments[0].window;
        result.attempt = assignments[0].attempt;
        result.islands.resize(1);
        result.robots.push_back({RobotId(0u), {}, {}, {}, hash});
        send(simulator, result);
    }
    void lose(const Address& simulator) {
        bus.vanished.push_back(simulator);
        controller.advance(bus);
    }

    const Address first{Role::kSimulator, 1}, second{Role::kSimulator, 2};
    const Simulation sim{one_ball()};
    ScriptedBus bus;
    Controller controller{sim.model, {}, beginning_of(*sim.model)};
};

TEST_F(Phases, AWindowIsSteppedOnceTheSimulatorIsHereAndThereIsATarget) {
    controller.advance(bus);
    EXPECT_EQ(controller.phase(), Phase::kWaiting);
    join(first);
    EXPECT_EQ(controller.phase(), Phase::kIdle);
    EXPECT_TRUE(controller.resting());
    controller.run_until(4);
    controller.advance(bus);
    EXPECT_EQ(controller.phase(), Phase::kStepping);
    step(first, 77);
    EXPECT_EQ(controller.phase(), Phase::kIdle);
    EXPECT_EQ(controller.tick(), 4);
    EXPECT_EQ(controller.robot_hash(RobotId(0u)), 77u);
}

TEST_F(Phases, ALossIsRecoveredBeforeTheNextWindow) {
    join(first);
    controller.run_until(4);
    controller.advance(bus);
    step(first, 77);
    lose(first);
    EXPECT_EQ(controller.phase(), Phase::kIdle) << "nobody can step again what is lost";
    join(second);
    EXPECT_EQ(controller.phase(), Phase::kRecovering);
    step(second, 77);
    EXPECT_EQ(controller.phase(), Phase::kIdle);
    EXPECT_FALSE(controller.failure());
    EXPECT_EQ(controller.seat_of(RobotId(0u)), 1u);
}

TEST_F(Phases, ARecoveryThatComesToAnotherStateEndsTheRun) {
    join(first);
    controller.run_until(4);
    controller.advance(bus);
    step(first, 77);
    lose(first);
    join(second);
    step(second, 78);
    EXPECT_EQ(controller.phase(), Phase::kFailed);
    ASSERT_TRUE(controller.failure());
    EXPECT_EQ(controller.failure()->code, "bits-differ");
    EXPECT_TRUE(controller.stopped());
    EXPECT_EQ(controller.tick(), 4);
}

TEST_F(Phases, ALossWhileAWindowIsSteppedDiscardsIt) {
    join(first);
    join(second);
    controller.run_until(4);
    controller.advance(bus);
    ASSERT_EQ(controller.phase(), Phase::kStepping);
    const bool is_first = bus.take<Assignment>(first).size() == 1;
    lose(is_first ? first : second);
    EXPECT_EQ(controller.phase(), Phase::kStepping) << "again, since its states are at the Controller";
    step(is_first ? second : first, 77);
    EXPECT_EQ(controller.tick(), 4);
}

TEST_F(Phases, ALeavingSimulatorIsReleasedOnceItsStatesAreHere) {
    join(first);
    controller.run_until(4);
    controller.advance(bus);
    step(first, 77);
    send(first, LeaveRequest{SimulatorId(0u)});
    EXPECT_EQ(controller.phase(), Phase::kReleasing);
    const auto requests = bus.take<StateRequest>(first);
    ASSERT_EQ(requests.size(), 1u);
    StateReply reply;
    reply.states.tick = requests[0].tick;
    append(reply.states, RobotId(0u), sim.states[0]);
    send(first, reply);
    EXPECT_EQ(controller.phase(), Phase::kIdle);
    EXPECT_EQ(bus.take<Goodbye>(first).size(), 1u);
    EXPECT_EQ(controller.seat_of(RobotId(0u)), kAtController);
}

TEST_F(Phases, AStateThatIsNotFiniteEndsTheRunBeforeIt) {
    join(first);
    controller.run_until(4);
    controller.advance(bus);
    const auto fail_at = [&](Tick tick) {
        const auto assignments = bus.take<Assignment>(first);
        ASSERT_EQ(assignments.size(), 1u);
        WindowResult result;
        result.window = assignments[0].window;
        result.islands.resize(1);
        result.islands[0].failed = RobotId(0u);
        result.islands[0].failed_at = tick;
        result.robots.push_back({RobotId(0u), {}, {}, {}, 1});
        send(first, result);
    };
    fail_at(3);
    EXPECT_EQ(controller.phase(), Phase::kStepping) << "first the ticks before it";
    step(first, 77);
    EXPECT_EQ(controller.tick(), 3);
    fail_at(3);
    EXPECT_EQ(controller.phase(), Phase::kFailed);
    EXPECT_EQ(controller.failure()->code, "not-finite");
    EXPECT_EQ(controller.tick(), 3);
}

TEST_F(Phases, ARequestThatTheKeyDoesNotPermitIsAnsweredWithTheReasonAndReportedOnce) {
    auto rights = std::make_shared<Rights>(make_rights({"*"}, {"force"}, false).value());
    rights->key = "pilot";
    const Address asking{Role::kClient, 9};
    const auto ask = [&](std::uint64_t number, const ControlAction& action) {
        bus.rights = rights;
        send(asking, ControlRequest{number, action});
        bus.rights = nullptr;
        return bus.take<ControlReply>(asking);
    };
    for (std::uint64_t number = 1; number <= 5; ++number) {
        const auto replies = ask(number, QuitRun{});
        ASSERT_EQ(replies.size(), 1u);
        EXPECT_EQ(replies[0].number, number);
        EXPECT_EQ(std::get<ControlRefused>(replies[0].outcome).code, "not-permitted");
    }
    EXPECT_TRUE(controller.control().take_calls().empty());
    const std::vector<std::string> lines = controller.take_notices();
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find("'pilot'"), std::string::npos) << lines[0];
    EXPECT_TRUE(ask(6, GetStatus{}).empty()) << "the owner of the run answers";
    EXPECT_EQ(controller.control().take_calls().size(), 1u);
    rights->steers = true;
    EXPECT_TRUE(ask(7, QuitRun{}).empty());
    EXPECT_EQ(controller.control().take_calls().size(), 1u);
}

}  // namespace
}  // namespace roboss::test
