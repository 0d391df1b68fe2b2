// VirtualNetwork: members on computers of their own, in virtual time. Each has a clock that runs by the CPU
// time of its own work; a message arrives when its sender's clock said, plus what the way takes. Messages are
// really encoded and decoded; only their way is a model, of three numbers.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <queue>
#include <stdexcept>
#include <string>
#include <vector>

#include "bus/bus.h"
#include "cluster/fiber.h"
#include "wire/codec.h"

namespace roboss::bench {

/// Of one message between two computers, beside encoding and decoding, which are measured as they happen.
struct NetworkCosts {
    double send_us = 0;          // CPU time that sending costs the sender
    double way_us = 0;           // from there until the receiver can have it
    double bytes_per_us = 1250;  // 10 Gbit/s
    bool mid_turn = true;        // messages reach a member also during its turn
};

/// Bytes and messages since the beginning.
struct Traffic {
    std::uint64_t messages = 0, bytes = 0;
};

/// Member 0 is the Controller.
class VirtualNetwork : public Bus {
  public:
    static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

    /// `counted`: clocks run by the work that is told of (count()), not by CPU time.
    VirtualNetwork(const NetworkCosts& costs, bool counted) : costs_(costs), counted_(counted) {}
    void add(const Address& address);

    void send(const Address& from, const Address& to, Message message) override;
    void drain(const Address& self, std::vector<Envelope>& inbox) override;
    /// When the member last looked for messages, or its turn began: asking a clock of CPU time takes longer
    /// than asking what time it is.
    std::int64_t now_ms() override { return members_[at_work_].clock_ns / 1'000'000; }

    std::size_t size() const { return members_.size(); }
    std::int64_t clock_ns(std::size_t i) const { return members_[i].clock_ns; }
    std::int64_t latest_ns() const;
    /// CPU time that this member has spent, tolls included.
    std::int64_t spent_ns(std::size_t i) const { return members_[i].spent_ns; }
    void count(double work_ns) { counted_ns_ += work_ns; }
    /// CPU time of the member whose turn it is, without tolls: its own clock for what it measures.
    std::uint64_t work_ns() const;
    /// When this member can go on; kNever: nothing has come for it.
    std::int64_t ready_ns(std::size_t i) const;
    /// The one that can go on first; size(): nobody can, for nothing is under way.
    std::size_t next() const;

    /// Gives a member its turn: role(bus) is its work, from `start_ns` by its clock. During it, where it
    /// looks for messages, it pauses while others' clocks are behind by more than a message's way, unless
    /// nothing is to reach it there.
    void work(std::size_t i, std::int64_t start_ns, const std::function<void(Bus&)>& role);

    /// By the Controller, by message name.
    std::map<std::string, Traffic> received;

  private:
    struct Letter {
        std::int64_t arrival_ns = 0;
        std::uint64_t serial = 0;
        std::vector<std::uint8_t> bytes;
        bool operator<(const Letter& other) const {  // for a queue whose top is the earliest
            return std::pair(arrival_ns, serial) > std::pair(other.arrival_ns, other.serial);
        }
    };
    struct Member {
        std::unique_ptr<Fiber> turn = std::make_unique<Fiber>();
        std::int64_t clock_ns = 0, spent_ns = 0, work_ns = 0;
        std::int64_t toll_ns = 0;  // of what was sent in this turn
        std::priority_queue<Letter> inbox;
    };

    void begin(std::size_t i, std::int64_t start_ns);
    void end();
    std::int64_t now_ns() const;
    /// Something that would be here by now, for their clocks are behind by more than its way.
    bool others_may_write() const;
    Envelope read(const std::vector<std::uint8_t>& bytes);

    std::int64_t cpu_ns() const;

    NetworkCosts costs_;
    bool counted_ = false;
    double counted_ns_ = 0;
    std::map<Address, std::size_t> places_;
    std::vector<Member> members_;
    std::size_t at_work_ = 0;
    bool looked_ = false;  // for messages, since its turn began
    std::int64_t began_ns_ = 0;
    std::uint64_t serial_ = 0;
};

}  // namespace roboss::bench
