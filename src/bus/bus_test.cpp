// The two Buses: one that loses nothing, one that does its worst by seed.
#include <gtest/gtest.h>

#include <algorithm>

#include "bus/faulty_bus.h"
#include "bus/in_process_bus.h"

namespace roboss {
namespace {

const Address kA{Role::kSimulator, 1}, kB{Role::kSimulator, 2};

TEST(InProcessBus, DeliversEverythingOnceAndInOrder) {
    InProcessBus bus;
    for (std::uint32_t i = 0; i < 5; ++i) bus.send(kA, kB, Heartbeat{SimulatorId(i)});
    EXPECT_FALSE(bus.quiet());
    std::vector<Envelope> inbox;
    bus.drain(kA, inbox);
    EXPECT_TRUE(inbox.empty());
    bus.drain(kB, inbox);
    ASSERT_EQ(inbox.size(), 5u);
    for (std::uint32_t i = 0; i < 5; ++i)
        EXPECT_EQ(std::get<Heartbeat>(inbox[i].message).simulator, SimulatorId(i));
    bus.drain(kB, inbox);
    EXPECT_TRUE(inbox.empty());
    EXPECT_TRUE(bus.quiet());
}

std::vector<std::uint32_t> what_arrives(std::uint64_t seed) {
    FaultyBus bus({seed, 0.2, 0.2, 6});
    std::vector<std::uint32_t> arrived;
    std::vector<Envelope> inbox;
    for (std::uint32_t i = 0; i < 500; ++i) {
        if (i < 480) bus.send(kA, kB, Heartbeat{SimulatorId(i)});
        bus.advance_clock(1);
        bus.drain(kB, inbox);
        for (const Envelope& e : inbox) arrived.push_back(std::get<Heartbeat>(e.message).simulator.value);
    }
    EXPECT_GT(bus.dropped(), 50u);
    EXPECT_GT(bus.doubled(), 50u);
    EXPECT_EQ(arrived.size(), 480 - bus.dropped() + bus.doubled());
    return arrived;
}

TEST(FaultyBus, DropsDoublesAndReordersTheSameWayForTheSameSeed) {
    const auto arrived = what_arrives(5);
    EXPECT_FALSE(std::is_sorted(arrived.begin(), arrived.end()));
    EXPECT_EQ(arrived, what_arrives(5));
    EXPECT_NE(arrived, what_arrives(6));
}

TEST(FaultyBus, CutsOffWhoIsDead) {
    FaultyBus bus({1, 0, 0, 0});
    std::vector<Envelope> inbox;
    bus.send(kA, kB, Heartbeat{});
    bus.cut_off(kB);
    bus.send(kA, kB, Heartbeat{});
    bus.send(kB, kA, Heartbeat{});
    bus.drain(kB, inbox);
    EXPECT_TRUE(inbox.empty());
    bus.drain(kA, inbox);
    EXPECT_TRUE(inbox.empty());
}

}  // namespace
}  // namespace roboss
