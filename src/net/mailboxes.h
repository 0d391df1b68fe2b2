// Mailboxes: what has arrived for the addresses of this process. The network's thread fills them, the roles'
// thread empties them.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bus/flow_count.h"
#include "wire/message.h"

namespace roboss {

class Mailboxes {
  public:
    /// Bytes that wait in a mailbox, at most; then the network is not read until some are taken.
    static constexpr std::size_t kFull = std::size_t{64} << 20;

    /// Opens it on first use: nothing is kept for an address before.
    void drain(const Address& self, std::vector<Envelope>& inbox);
    bool has(const Address& self) const;
    /// All that are open.
    std::vector<Address> addresses() const;

    /// From an address of this process. False: `envelope.to` is none.
    bool put_local(Envelope& envelope);
    /// From the network; `bytes` is its length there. Dropped if this process does not have the address.
    void put(Envelope envelope, std::size_t bytes);
    bool full() const;

    /// These addresses are gone or disconnected; take_vanished() reports it to the mailboxes that they have
    /// sent to.
    void vanish(const std::set<Address>& gone);
    std::vector<Address> take_vanished(const Address& self);

    std::optional<std::int64_t> heard_ms(const Address& from) const;
    void count(const Address& from, const Address& to, std::size_t bytes);
    std::vector<Flow> flows() const;

    /// Until something has arrived since the last call, at most so long.
    void wait(std::int64_t ms_max);
    /// Ends the wait: something else has happened.
    void ring();

  private:
    struct Mailbox {
        std::vector<Envelope> inbox;
        std::size_t bytes = 0;
        std::set<Address> known;  // have sent to it
        std::vector<Address> vanished;
    };

    mutable std::mutex mutex_;
    std::condition_variable bell_;
    bool rung_ = false;
    std::map<Address, Mailbox> boxes_;
    std::map<Address, std::int64_t> heard_ms_;
    FlowCount flows_;
};

}  // namespace roboss
