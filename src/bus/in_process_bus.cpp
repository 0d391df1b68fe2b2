// Queues between the roles of one process.
#include "bus/in_process_bus.h"

#include <chrono>

namespace roboss {

std::int64_t monotonic_ms() {
    using namespace std::chrono;
    return duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
}

void InProcessBus::send(const Address& from, const Address& to, Message message) {
    count_.add(from, to, 0);
    queues_[to].push_back({from, to, std::move(message)});
}

void InProcessBus::drain(const Address& self, std::vector<Envelope>& inbox) {
    inbox.clear();
    inbox.swap(queues_[self]);
}

bool InProcessBus::quiet() const {
    for (const auto& [address, queue] : queues_)
        if (!queue.empty()) return false;
    return true;
}

}  // namespace roboss
