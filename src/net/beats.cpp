// See beats.h.
#include "net/beats.h"

#include "bus/bus.h"

namespace roboss {
namespace {

constexpr std::int64_t kBeat_ms = 200;         // from the role's last message
constexpr std::int64_t kBusyMost_ms = 60'000;  // a role that is silent for longer hangs

}  // namespace

void Beats::begin(const Address& from, const Address& to, std::vector<std::uint8_t> bytes) {
    const std::lock_guard lock(mutex_);
    beats_[from] = {to, std::move(bytes), monotonic_ms()};
}

void Beats::end(const Address& from) {
    const std::lock_guard lock(mutex_);
    beats_.erase(from);
}

void Beats::note_own(const Address& from, const Address& to) {
    const std::lock_guard lock(mutex_);
    if (const auto beat = beats_.find(from); beat != beats_.end() && beat->second.to == to)
        beat->second.own_ms = monotonic_ms();
}

std::vector<std::pair<Address, std::vector<std::uint8_t>>> Beats::due(std::int64_t now_ms) const {
    std::vector<std::pair<Address, std::vector<std::uint8_t>>> due;
    const std::lock_guard lock(mutex_);
    for (const auto& [from, beat] : beats_)
        if (now_ms - beat.own_ms >= kBeat_ms && now_ms - beat.own_ms < kBusyMost_ms)
            due.emplace_back(beat.to, beat.bytes);
    return due;
}

}  // namespace roboss
