// Clocks and the way of messages.
#include "cluster/virtual_network.h"

#include <algorithm>

#include "core/thread_cpu.h"

namespace roboss::bench {

std::int64_t VirtualNetwork::cpu_ns() const {
    return static_cast<std::int64_t>(counted_ ? static_cast<std::uint64_t>(counted_ns_) : thread_cpu_ns());
}

void VirtualNetwork::add(const Address& address) {
    places_[address] = members_.size();
    members_.emplace_back();
    members_.back().clock_ns = members_.front().clock_ns;
}

void VirtualNetwork::send(const Address& from, const Address& to, Message message) {
    const auto place = places_.find(to);
    if (place == places_.end()) return;
    Letter letter{0, serial_++, encode({from, to, std::move(message)})};
    members_[at_work_].toll_ns += static_cast<std::int64_t>(1e3 * costs_.send_us);
    const double way_us = costs_.way_us + static_cast<double>(letter.bytes.size()) / costs_.bytes_per_us;
    letter.arrival_ns = now_ns() + static_cast<std::int64_t>(1e3 * way_us);
    members_[place->second].inbox.push(std::move(letter));
}

void VirtualNetwork::drain(const Address&, std::vector<Envelope>& inbox) {
    const std::size_t self = at_work_;
    Member& member = members_[self];
    end();  // what is done for the model of a network is nobody's work
    if (costs_.mid_turn && looked_ && others_may_write()) member.turn->pause();
    looked_ = true;
    std::vector<std::vector<std::uint8_t>> letters;
    for (; !member.inbox.empty() && member.inbox.top().arrival_ns <= member.clock_ns; member.inbox.pop())
        letters.push_back(member.inbox.top().bytes);
    begin(self, member.clock_ns);
    inbox.clear();
    for (const std::vector<std::uint8_t>& bytes : letters) inbox.push_back(read(bytes));
}

Envelope VirtualNetwork::read(const std::vector<std::uint8_t>& bytes) {
    Result<Envelope> envelope = decode_envelope(bytes);
    if (!envelope) throw std::runtime_error(envelope.error().text());
    if (at_work_ == 0) {
        Traffic& traffic = received[message_name(envelope.value().message)];
        ++traffic.messages;
        traffic.bytes += bytes.size();
    }
    return std::move(envelope).value();
}

std::int64_t VirtualNetwork::latest_ns() const {
    std::int64_t latest = 0;
    for (const Member& member : members_) latest = std::max(latest, member.clock_ns);
    return latest;
}

bool VirtualNetwork::others_may_write() const {
    const std::int64_t sent_ns = members_[at_work_].clock_ns - static_cast<std::int64_t>(1e3 * costs_.way_us);
    for (std::size_t i = 0; i < members_.size(); ++i)
        if (i != at_work_ && ready_ns(i) < sent_ns) return true;
    return false;
}

std::int64_t VirtualNetwork::ready_ns(std::size_t i) const {
    const Member& m = members_[i];
    if (m.turn->under_way()) return m.clock_ns;
    return m.inbox.empty() ? kNever : std::max(m.clock_ns, m.inbox.top().arrival_ns);
}

std::size_t VirtualNetwork::next() const {
    std::size_t first = 0;
    for (std::size_t i = 1; i < members_.size(); ++i)
        if (ready_ns(i) < ready_ns(first)) first = i;
    return ready_ns(first) == kNever ? members_.size() : first;
}

void VirtualNetwork::work(std::size_t i, std::int64_t start_ns, const std::function<void(Bus&)>& role) {
    Fiber& turn = *members_[i].turn;
    if (turn.under_way()) return turn.go_on();
    turn.begin([this, i, start_ns, role] {
        begin(i, start_ns);
        looked_ = false;
        role(*this);
        end();
    });
}

void VirtualNetwork::begin(std::size_t i, std::int64_t start_ns) {
    at_work_ = i;
    members_[i].clock_ns = start_ns;
    members_[i].toll_ns = 0;
    began_ns_ = cpu_ns();
}

void VirtualNetwork::end() {
    Member& member = members_[at_work_];
    const std::int64_t work = cpu_ns() - began_ns_, spent = work + member.toll_ns;
    member.work_ns += work;
    member.clock_ns += spent;
    member.spent_ns += spent;
}

std::uint64_t VirtualNetwork::work_ns() const {
    return static_cast<std::uint64_t>(members_[at_work_].work_ns + cpu_ns() - began_ns_);
}

std::int64_t VirtualNetwork::now_ns() const {
    const Member& m = members_[at_work_];
    return m.clock_ns + m.toll_ns + cpu_ns() - began_ns_;
}

}  // namespace roboss::bench
