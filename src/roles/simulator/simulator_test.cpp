// A Simulator drops assignments that it cannot step, reports it, and goes on with those that it can.
#include "roles/simulator/simulator.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>

#include <support/robots.h>
#include <support/simulation.h>

#include "bus/in_process_bus.h"
#include "wire/state_block.h"

namespace roboss::test {
namespace {

constexpr Address kSelf{Role::kSimulator, 1};
constexpr SimulatorId kId(5u);

World three_balls() {
    World world = empty_world(2e-3);
    for (int i = 0; i < 3; ++i)
        place(world, solid_sphere(1.0, 0.1, surface(0.5)), "ball_" + std::to_string(i),
              {{10.0 * i, 0, 1}, {}});
    return world;
}

class AssignmentsFromTheWire : public testing::Test {
  protected:
    AssignmentsFromTheWire() {
        simulator.advance(bus);
        send(Welcome{kId});
    }

    /// All robots, each an island of its own, from the Controller.
    Assignment assignment(std::uint64_t window, Tick from, Tick until) const {
        Assignment assignment;
        assignment.window = window;
        assignment.simulator = kId;
        assignment.window_from = assignment.from = from;
        assignment.until = until;
        assignment.island_offsets = {0};
        for (const RobotId robot : sim.ids) {
            assignment.robots.push_back(robot);
            assignment.island_offsets.push_back(static_cast<std::uint32_t>(assignment.robots.size()));
        }
        if (from == 0) assignment.hand_offs = {{kControllerAddress, assignment.robots}};
        return assignment;
    }
    void send(Message message) {
        bus.send(kControllerAddress, kSelf, std::move(message));
        simulator.advance(bus);
    }
    /// The hash of the result of this window, once states are given where they are asked for; 0: there is
    /// none.
    std::uint64_t answer(std::uint64_t window) {
        for (int i = 0; i < 4; ++i) {
            bus.drain(kControllerAddress, inbox);
            for (const Envelope& envelope : inbox) {
                if (const auto* result = std::get_if<WindowResult>(&envelope.message);
                    result && result->window == window)
                    return result->robots[0].hash;
                if (const auto* request = std::get_if<StateRequest>(&envelope.message)) {
                    StateReply reply;
                    reply.states.tick = request->tick;
                    for (const RobotId robot : request->robots)
                        append(reply.states, robot, sim.states[robot.index()]);
                    send(reply);
                }
            }
            simulator.advance(bus);
        }
        return 0;
    }
    void expect_dropped(const Assignment& wrong, const std::string& why) {
        send(wrong);
        EXPECT_EQ(answer(wrong.window), 0u) << why;
        const std::vector<std::string> notices = simulator.take_notices();
        ASSERT_EQ(notices.size(), 1u) << why;
        EXPECT_NE(notices[0].find("dropped=Assignment simulator=5"), std::string::npos) << notices[0];
        EXPECT_NE(notices[0].find(why), std::string::npos) << notices[0];
    }

    Simulation sim{three_balls()};
    InProcessBus bus;
    ThreadPool pool{1};
    Simulator simulator{sim.model, kSelf, {}, pool};
    std::vector<Envelope> inbox;
};

TEST_F(AssignmentsFromTheWire, OneOfRobotsThatAreNotHereIsDroppedAndTheNextOneIsStepped) {
    expect_dropped(assignment(1, 7, 9), "robot 0 is not here at tick 7");
    send(assignment(2, 0, 4));
    const std::uint64_t hash = answer(2);
    EXPECT_NE(hash, 0u);
    expect_dropped(assignment(3, 5, 9), "robot 0 is not here at tick 5");
    send(assignment(4, 4, 8));
    const std::uint64_t next = answer(4);
    for (int i = 0; i < 8; ++i) sim.step();
    EXPECT_EQ(next, state_hash(RobotId(0u), 8, sim.states[0]));
    EXPECT_TRUE(simulator.take_notices().empty());
}

TEST_F(AssignmentsFromTheWire, OneThatMakesNoSenseIsDroppedByReason) {
    const std::function<void(Assignment&)> robots[] = {
        [](Assignment& p) { p.robots[1] = RobotId(3u); },
        [](Assignment& p) { p.robots[1] = RobotId(); },
        [](Assignment& p) { p.robots[1] = p.robots[0]; },
        [](Assignment& p) { std::swap(p.robots[0], p.robots[1]); },
        [](Assignment& p) {
            p.island_offsets = {0, 3}, std::swap(p.robots[1], p.robots[2]);
        },
        [](Assignment& p) { p.keep = {RobotId(3u)}; },
        [](Assignment& p) { p.hand_offs[0].robots.push_back(RobotId(77u)); },
    };
    for (const auto& spoil : robots) {
        Assignment wrong = assignment(1, 0, 4);
        spoil(wrong);
        expect_dropped(wrong, "its robots are invalid");
    }
    const auto order = [](Tick tick, RobotId robot) {
        return Order{tick, ClientId(0u), 1, robot, SetVelocity{}};
    };
    for (const auto& orders : {std::vector<Order>{order(1, RobotId(3u))},
                               std::vector<Order>{order(2, RobotId(0u)), order(1, RobotId(0u))}}) {
        Assignment wrong = assignment(1, 0, 4);
        wrong.orders = orders;
        expect_dropped(wrong, "its orders are invalid");
    }
    send(assignment(1, 0, 4));
    EXPECT_NE(answer(1), 0u) << "the same attempt, without a flaw";
}

/// Notes which addresses have a pulse.
class PulseBus : public InProcessBus {
  public:
    void keep_alive(const Address& from, const Address& to, const Heartbeat& heartbeat) override {
        EXPECT_EQ(to, kControllerAddress);
        pulses[from] = heartbeat.simulator;
    }
    void end_keep_alive(const Address& from) override { pulses.erase(from); }
    std::map<Address, SimulatorId> pulses;
};

TEST(Simulator, HasAPulseAsLongAsItHasASeat) {
    const Simulation sim(three_balls());
    ThreadPool pool(1);
    PulseBus bus;
    Simulator simulator(sim.model, kSelf, {}, pool);
    const auto send = [&](Message message) {
        bus.send(kControllerAddress, kSelf, std::move(message));
        simulator.advance(bus);
    };
    simulator.advance(bus);
    EXPECT_TRUE(bus.pulses.empty());
    send(Welcome{kId});
    EXPECT_EQ(bus.pulses, (std::map<Address, SimulatorId>{{kSelf, kId}}));
    send(Expelled{kId});
    EXPECT_TRUE(bus.pulses.empty());
    const SimulatorId next(6u);
    send(Welcome{next});
    EXPECT_EQ(bus.pulses, (std::map<Address, SimulatorId>{{kSelf, next}}));
    send(RunOver{"the run is over"});
    EXPECT_TRUE(bus.pulses.empty());
}

}  // namespace
}  // namespace roboss::test
