// A Controller's Bus and members' on the loopback interface.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "net/meeting_place.h"
#include "net/stream_bus.h"

namespace roboss::test {

/// A name of this process, so that tests at the same time do not meet.
inline NetOptions loopback(const std::string& name) {
    NetOptions options;
    options.simulation = "test-" + std::to_string(getpid()) + "-" + name;
    return options;
}

inline std::unique_ptr<StreamBus> checked(Result<std::unique_ptr<StreamBus>> bus) {
    EXPECT_TRUE(bus.ok()) << (bus.ok() ? "" : bus.error().text());
    return bus.ok() ? std::move(bus).value() : nullptr;
}

inline std::unique_ptr<StreamBus> controller_of(const NetOptions& options) {
    auto bus = checked(StreamBus::listen(options));
    std::vector<Envelope> inbox;
    bus->drain(kControllerAddress, inbox);
    return bus;
}

/// A member, with the inbox of this address open.
inline std::unique_ptr<StreamBus> member_of(const NetOptions& options, const Address& self) {
    auto bus = checked(StreamBus::join(options, "simulator", "member-" + std::to_string(self.instance)));
    std::vector<Envelope> inbox;
    bus->drain(self, inbox);
    return bus;
}

/// Folder of the keys that a Controller has made for members of this computer.
inline std::string run_keys(const std::string& simulation) {
    return (run_folder().value() / (simulation + ".net") / "keys").string();
}

/// Waits until `done`, at most ten seconds.
template <class Done>
bool becomes(const Done& done) {
    for (int turn = 0; turn < 2'000; ++turn) {
        if (done()) return true;
        usleep(5'000);
    }
    return false;
}

/// Drains `self` until `count` messages have come, for at most ten seconds.
inline std::vector<Envelope> receive(StreamBus& bus, const Address& self, std::size_t count) {
    std::vector<Envelope> all, inbox;
    const std::int64_t end = bus.now_ms() + 10'000;
    while (all.size() < count && bus.now_ms() < end) {
        bus.drain(self, inbox);
        for (Envelope& e : inbox) all.push_back(std::move(e));
        if (all.size() < count) bus.wait(5);
    }
    return all;
}

}  // namespace roboss::test
