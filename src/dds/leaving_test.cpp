// Members that leave while others check their leases: Fast DDS 2.9 aborts the process when it takes word of a
// leave while a lease check of the same member waits (decision 0021).
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "dds/dds_bus.h"

namespace roboss {
namespace {

TEST(Leaving, MembersThatLeaveDuringLeaseChecksAbortNobody) {
    DdsOptions options;
    options.simulation = "test-" + std::to_string(getpid()) + "-leaving";
    options.domain = 92;
    options.multicast = false;
    options.peers = {"127.0.0.1"};
    options.liveliness_ms = 20;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    std::atomic<int> members = 0;
    std::atomic<std::uint64_t> serial = 100;
    const auto come_and_go = [&] {
        while (std::chrono::steady_clock::now() < end) {
            auto bus = DdsBus::create(options);
            ASSERT_TRUE(bus.ok()) << bus.error().text();
            std::vector<Envelope> inbox;
            const Address self{Role::kSimulator, ++serial};
            bus.value()->drain(self, inbox);
            bus.value()->send(self, {Role::kSimulator, self.instance - 5}, Expelled{});
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            ++members;
        }
    };
    std::vector<std::thread> threads;
    for (int i = 0; i < 24; ++i) threads.emplace_back(come_and_go);
    for (std::thread& thread : threads) thread.join();
    EXPECT_GT(members, 8);
    printf("members %d\n", members.load());
}

}  // namespace
}  // namespace roboss
