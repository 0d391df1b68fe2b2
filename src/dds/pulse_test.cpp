// A member whose thread is busy is heard; one that hangs, or has ended its pulse, falls silent.
#include "dds/pulse.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

#include <support/loopback_bus.h>

namespace roboss {
namespace {

const Address kMember{Role::kSimulator, 1};

/// Until a heartbeat comes, for at most ten seconds.
bool hears(DdsBus& controller) {
    std::vector<Envelope> inbox;
    const std::int64_t end = controller.now_ms() + 10'000;
    while (controller.now_ms() < end) {
        controller.wait(20);
        controller.drain(kControllerAddress, inbox);
        if (!inbox.empty()) return std::get<Heartbeat>(inbox[0].message).simulator == SimulatorId(7u);
    }
    return false;
}

/// Until none has come for 0.7 s, for at most ten seconds.
bool falls_silent(DdsBus& controller) {
    std::vector<Envelope> inbox;
    const std::int64_t end = controller.now_ms() + 10'000;
    std::int64_t heard_ms = controller.now_ms();
    while (controller.now_ms() < end && controller.now_ms() - heard_ms < 700) {
        controller.wait(20);
        controller.drain(kControllerAddress, inbox);
        if (!inbox.empty()) heard_ms = controller.now_ms();
    }
    return controller.now_ms() - heard_ms >= 700;
}

TEST(Pulse, AMemberIsHeardWhileItsThreadIsBusyUntilItLeavesAndAfterItJoinsTheNetworkAgain) {
    const auto controller = test::bus_of(test::loopback("busy")),
               member = test::bus_of(test::loopback("busy"));
    std::vector<Envelope> inbox;
    controller->drain(kControllerAddress, inbox);
    // The thread that owns the member's Bus calls it no more until reconnect().
    member->keep_alive(kMember, kControllerAddress, Heartbeat{SimulatorId(7u)});
    EXPECT_TRUE(hears(*controller));
    EXPECT_TRUE(hears(*controller));
    ASSERT_TRUE(member->reconnect().ok());
    controller->drain(kControllerAddress, inbox);
    EXPECT_TRUE(hears(*controller));
    member->end_keep_alive(kMember);
    EXPECT_TRUE(falls_silent(*controller));
}

TEST(Pulse, OfAMemberThatHangsEnds) {
    const Pulse::Limits limits{20, 1000};
    std::vector<std::int64_t> sent_ms;
    std::int64_t begun_ms = 0;
    {
        Pulse pulse([&](std::int64_t now) { sent_ms.push_back(now); }, limits);
        begun_ms = monotonic_ms();
        std::this_thread::sleep_for(std::chrono::milliseconds(1300));
    }
    ASSERT_FALSE(sent_ms.empty());
    EXPECT_LT(sent_ms.back(), begun_ms + limits.busy_most_ms);
}

}  // namespace
}  // namespace roboss
