// VirtualNetwork: members on computers of their own, in virtual time. Each has a clock that runs by the CPU
// time of its own work; a message arrives when its sender's clock said, plus what the way takes. Messages are
// really encoded and decoded; only their way is a model, of three numbers.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <queue>
#include <stdexcept>
#include <string>
#include <vector>

#include "bus/bus.h"
#include "wire/codec.h"

namespace roboss::bench {

/// Of one message between two computers, beside encoding and decoding, which are measured as they happen.
struct NetworkCosts {
    double send_us = 0;          // CPU time that sending costs the sender
    double way_us = 0;           // from there until the receiver can have it
    double bytes_per_us = 1250;  // 10 Gbit/s
};

/// Bytes and messages since the beginning.
struct Traffic {
    std::uint64_t messages = 0, bytes = 0;
};

/// Member 0 is the Controller.
class VirtualNetwork : public Bus {
  public:
    static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

    explicit VirtualNetwork(const NetworkCosts& costs) : costs_(costs) {}
    void add(const Address& address);

    void send(const Address& from, const Address& to, Message message) override;
    void drain(const Address& self, std::vector<Envelope>& inbox) override;
    std::int64_t now_ms() override { return now_ns() / 1'000'000; }

    std::size_t size() const { return members_.size(); }
    std::int64_t clock_ns(std::size_t i) const { return members_[i].clock_ns; }
    std::int64_t latest_ns() const;
    /// CPU time that this member has spent, tolls included.
    std::int64_t spent_ns(std::size_t i) const { return members_[i].spent_ns; }
    /// When this member can go on; kNever: nothing has come for it.
    std::int64_t ready_ns(std::size_t i) const;
    /// The one that can go on first; size(): nobody can, for nothing is under way.
    std::size_t next() const;

    /// Gives a member its turn: role(bus) is its work, from `start_ns` by its clock.
    template <class Role>
    void work(std::size_t i, std::int64_t start_ns, Role&& role) {
        begin(i, start_ns);
        role(static_cast<Bus&>(*this));
        end();
    }

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
        std::int64_t clock_ns = 0, spent_ns = 0;
        std::int64_t toll_ns = 0;  // of what was sent in this turn
        std::priority_queue<Letter> inbox;
    };

    void begin(std::size_t i, std::int64_t start_ns);
    void end();
    std::int64_t now_ns() const;

    NetworkCosts costs_;
    std::map<Address, std::size_t> places_;
    std::vector<Member> members_;
    std::size_t at_work_ = 0;
    std::int64_t began_ns_ = 0;
    std::uint64_t serial_ = 0;
};

}  // namespace roboss::bench
