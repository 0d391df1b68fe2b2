// One lock for all: messages are few beside the ticks between them.
#include "net/mailboxes.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace roboss {

void Mailboxes::drain(const Address& self, std::vector<Envelope>& inbox) {
    inbox.clear();
    const std::lock_guard lock(mutex_);
    Mailbox& box = boxes_[self];
    inbox.swap(box.inbox);
    box.bytes = 0;
}

bool Mailboxes::has(const Address& self) const {
    const std::lock_guard lock(mutex_);
    return boxes_.contains(self);
}

std::vector<Address> Mailboxes::addresses() const {
    const std::lock_guard lock(mutex_);
    std::vector<Address> all;
    for (const auto& [address, box] : boxes_) all.push_back(address);
    return all;
}

bool Mailboxes::put_local(Envelope& envelope) {
    const std::lock_guard lock(mutex_);
    const auto box = boxes_.find(envelope.to);
    if (box == boxes_.end()) return false;
    flows_.add(envelope.from, envelope.to, 0);
    box->second.inbox.push_back(std::move(envelope));
    rung_ = true;
    return true;
}

void Mailboxes::put(Envelope envelope, std::size_t bytes) {
    {
        const std::lock_guard lock(mutex_);
        heard_ms_[envelope.from] = monotonic_ms();
        const auto box = boxes_.find(envelope.to);
        if (box == boxes_.end()) return;
        flows_.add(envelope.from, envelope.to, bytes);
        box->second.known.insert(envelope.from);
        box->second.bytes += bytes;
        box->second.inbox.push_back(std::move(envelope));
        rung_ = true;
    }
    bell_.notify_one();
}

bool Mailboxes::full() const {
    const std::lock_guard lock(mutex_);
    return std::any_of(boxes_.begin(), boxes_.end(),
                       [](const auto& box) { return box.second.bytes > kFull; });
}

void Mailboxes::vanish(const std::set<Address>& gone) {
    {
        const std::lock_guard lock(mutex_);
        for (const Address& address : gone) {
            heard_ms_.erase(address);
            for (auto& [self, box] : boxes_)
                if (box.known.erase(address) > 0) box.vanished.push_back(address);
        }
        rung_ = true;
    }
    bell_.notify_one();
}

std::vector<Address> Mailboxes::take_vanished(const Address& self) {
    const std::lock_guard lock(mutex_);
    return std::exchange(boxes_[self].vanished, {});
}

std::optional<std::int64_t> Mailboxes::heard_ms(const Address& from) const {
    const std::lock_guard lock(mutex_);
    const auto found = heard_ms_.find(from);
    return found == heard_ms_.end() ? std::nullopt : std::optional(found->second);
}

void Mailboxes::count(const Address& from, const Address& to, std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    flows_.add(from, to, bytes);
}

std::vector<Flow> Mailboxes::flows() const {
    const std::lock_guard lock(mutex_);
    return flows_.all();
}

void Mailboxes::wait(std::int64_t ms_max) {
    std::unique_lock lock(mutex_);
    bell_.wait_for(lock, std::chrono::milliseconds(ms_max), [&] { return rung_; });
    rung_ = false;
}

void Mailboxes::ring() {
    {
        const std::lock_guard lock(mutex_);
        rung_ = true;
    }
    bell_.notify_one();
}

}  // namespace roboss
