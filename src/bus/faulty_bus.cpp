// Faults by seed (splitmix64 by Vigna, public domain).
#include "bus/faulty_bus.h"

#include <utility>

#include "core/check.h"
#include "wire/codec.h"

namespace roboss {

FaultyBus::FaultyBus(const FaultOptions& options) : options_(options), random_state_(options.seed) {}

std::uint64_t FaultyBus::random(std::uint64_t limit) {
    std::uint64_t z = (random_state_ += 0x9E3779B97F4A7C15ull);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return (z ^ (z >> 31)) % limit;
}

bool FaultyBus::chance(double probability) {
    return static_cast<double>(random(1'000'000)) < probability * 1e6;
}

void FaultyBus::post(const Address& to, std::vector<std::uint8_t> bytes) {
    const auto delay =
        static_cast<std::int64_t>(random(static_cast<std::uint64_t>(options_.delay_ms_max) + 1));
    // a random serial number breaks ties, so that messages of the same time are reordered too
    under_way_[to].emplace(std::pair{now_ms_ + delay, random(1u << 20) << 40 | ++serial_}, std::move(bytes));
}

void FaultyBus::garble(const Address& to, std::vector<std::uint8_t> bytes) {
    for (std::uint64_t k = 0; k < 1 + random(3); ++k)
        bytes[random(bytes.size())] = static_cast<std::uint8_t>(random(4) == 0 ? 0xFF : random(256));
    const Result<Envelope> envelope = decode_envelope(bytes);
    if (!envelope) return void(++refused_);
    constexpr Tick kLongest = 500;  // longer garbled assignments would take too long to step
    if (const auto* assignment = std::get_if<Assignment>(&envelope.value().message);
        assignment && assignment->until - assignment->from > kLongest)
        return;
    ++garbled_[message_name(envelope.value().message)];
    post(to, std::move(bytes));
}

void FaultyBus::send(const Address& from, const Address& to, Message message) {
    if (cut_.contains(from) || cut_.contains(to)) return;
    if (chance(options_.drop)) {
        ++dropped_;
        return;
    }
    std::vector<std::uint8_t> bytes = encode(Envelope{from, to, std::move(message)});
    if (options_.garble > 0 && chance(options_.garble)) garble(to, bytes);
    if (chance(options_.duplicate)) {
        ++doubled_;
        post(to, bytes);
    }
    post(to, std::move(bytes));
}

void FaultyBus::drain(const Address& self, std::vector<Envelope>& inbox) {
    inbox.clear();
    if (on_drain) on_drain();
    auto& queue = under_way_[self];
    while (!queue.empty() && queue.begin()->first.first <= now_ms_) {
        Result<Envelope> envelope = decode_envelope(queue.begin()->second);
        ROBOSS_CHECK(envelope.ok(), envelope.error().text());
        if (!cut_.contains(self)) inbox.push_back(std::move(envelope).value());
        queue.erase(queue.begin());
    }
}

std::vector<Address> FaultyBus::take_vanished(const Address& self) {
    return self == kControllerAddress ? std::exchange(rumours_, {}) : std::vector<Address>{};
}

}  // namespace roboss
