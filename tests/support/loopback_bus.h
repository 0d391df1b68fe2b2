// Buses over Fast DDS that find each other on the loopback interface.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <memory>
#include <string>
#include <utility>

#include "dds/dds_bus.h"

namespace roboss::test {

/// Loopback without multicast, on a name of this process, so that tests at the same time do not meet.
inline DdsOptions loopback(const std::string& name) {
    DdsOptions options;
    options.simulation = "test-" + std::to_string(getpid()) + "-" + name;
    options.domain = 90;
    options.multicast = false;
    options.peers = {"127.0.0.1"};
    options.liveliness_ms = 1000;
    return options;
}

inline std::unique_ptr<DdsBus> bus_of(const DdsOptions& options) {
    auto bus = DdsBus::create(options);
    EXPECT_TRUE(bus.ok()) << (bus.ok() ? "" : bus.error().text());
    return bus.ok() ? std::move(bus).value() : nullptr;
}

}  // namespace roboss::test
