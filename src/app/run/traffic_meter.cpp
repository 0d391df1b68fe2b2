// A Bus that was replaced (a rewind in one process) counts from zero again: so does the meter.
#include "app/run/traffic_meter.h"

namespace roboss {

void TrafficMeter::take(std::span<const Flow> flows, std::int64_t now_ms) {
    std::map<Address, Sums> now;
    for (const Flow& flow : flows) {
        if (flow.to == kControllerAddress) {
            now[flow.from].messages_in += flow.messages;
            now[flow.from].bytes_in += flow.bytes;
        } else if (flow.from == kControllerAddress) {
            now[flow.to].messages_out += flow.messages;
            now[flow.to].bytes_out += flow.bytes;
        }
    }
    const double s = 1e-3 * static_cast<double>(now_ms - taken_ms_);
    const auto rate = [s](std::uint64_t count, std::uint64_t before) {
        return static_cast<double>(count >= before ? count - before : count) / s;
    };
    rates_.clear();
    for (const auto& [member, sums] : now) {
        const Sums& then = before_[member];
        MessageRate& rates = rates_[member];
        rates.messages_in = rate(sums.messages_in, then.messages_in);
        rates.messages_out = rate(sums.messages_out, then.messages_out);
        rates.bytes_in = rate(sums.bytes_in, then.bytes_in);
        rates.bytes_out = rate(sums.bytes_out, then.bytes_out);
    }
    before_ = std::move(now);
    taken_ms_ = now_ms;
}

MessageRate TrafficMeter::total() const {
    MessageRate total;
    for (const auto& [member, rate] : rates_) {
        total.messages_in += rate.messages_in, total.bytes_in += rate.bytes_in;
        total.messages_out += rate.messages_out, total.bytes_out += rate.bytes_out;
    }
    return total;
}

MessageRate TrafficMeter::of(const Address& member) const {
    const auto found = rates_.find(member);
    return found == rates_.end() ? MessageRate() : found->second;
}

}  // namespace roboss
