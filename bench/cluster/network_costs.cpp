// Ping and pong.
#include "cluster/network_costs.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "core/thread_cpu.h"
#include "median.h"
#include "net/stream_bus.h"

namespace roboss::bench {
namespace {

constexpr Address kEcho{Role::kSimulator, 1};
constexpr std::int64_t kPatience_ms = 10'000;

std::unique_ptr<StreamBus> checked(Result<std::unique_ptr<StreamBus>> bus) {
    if (!bus) throw std::runtime_error(bus.error().text());
    return std::move(bus).value();
}

/// An assignment of fifty robots.
Assignment letter() {
    Assignment assignment;
    assignment.simulator = SimulatorId(std::size_t{0});
    assignment.until = 8;
    assignment.island_offsets = {0};
    for (std::uint32_t i = 0; i < 50; ++i) {
        assignment.robots.emplace_back(i);
        assignment.island_offsets.push_back(i + 1);
    }
    return assignment;
}

double wall_us() {
    timespec t{};
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
}

}  // namespace

NetworkCosts measure_network(int rounds) {
    NetOptions options;
    options.simulation = "costs-" + std::to_string(getpid());
    const auto bus = checked(StreamBus::listen(options));
    const auto other = checked(StreamBus::join(options, "simulator", "echo"));
    std::atomic<bool> done = false;
    std::thread echo([&] {
        std::vector<Envelope> inbox;
        while (!done) {
            other->drain(kEcho, inbox);
            for (const Envelope& e : inbox) other->send(kEcho, e.from, e.message);
            if (inbox.empty()) other->wait(10);
        }
    });
    std::vector<double> send_us, way_us;
    std::vector<Envelope> inbox;
    bus->drain(kControllerAddress, inbox);
    const std::int64_t end_ms = bus->now_ms() + kPatience_ms;
    for (; inbox.empty() && bus->now_ms() < end_ms;
         bus->drain(kControllerAddress, inbox)) {  // until both know each other
        if (bus->present(kEcho)) bus->send(kControllerAddress, kEcho, letter());
        bus->wait(10);
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    bus->drain(kControllerAddress, inbox);
    for (int i = 0; i < rounds && bus->now_ms() < end_ms; ++i) {
        const double begin_us = wall_us();
        const std::uint64_t begin_ns = thread_cpu_ns();
        bus->send(kControllerAddress, kEcho, letter());
        const double spent_us = 1e-3 * static_cast<double>(thread_cpu_ns() - begin_ns);
        for (bus->drain(kControllerAddress, inbox); inbox.empty() && bus->now_ms() < end_ms;
             bus->drain(kControllerAddress, inbox))
            bus->wait(10);
        send_us.push_back(spent_us);
        way_us.push_back((wall_us() - begin_us) / 2 - spent_us);
    }
    done = true;
    echo.join();
    if (send_us.empty()) throw std::runtime_error("no message arrives over the loopback interface");
    // Encoding an assignment is in send_us and is measured again as it happens; that is on the safe side.
    return {median(send_us), std::max(0.0, median(way_us))};
}

}  // namespace roboss::bench
