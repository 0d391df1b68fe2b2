// FaultyBus: a Bus with the faults of a network, by seed: it drops, duplicates, delays and reorders, on a
// logical clock. It carries encoded bytes, so that every message also passes the codec. For tests.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>

#include "bus/bus.h"

namespace roboss {

struct FaultOptions {
    std::uint64_t seed = 1;
    double drop = 0.05, duplicate = 0.05;  // probabilities
    std::int64_t delay_ms_max = 8;         // each message is delayed by 0 .. this, so later ones overtake
    /// Probability that a copy with some changed bytes is sent in addition, if it can still be decoded.
    double garble = 0;
};

class FaultyBus : public Bus {
  public:
    explicit FaultyBus(const FaultOptions& options);
    void send(const Address& from, const Address& to, Message message) override;
    void drain(const Address& self, std::vector<Envelope>& inbox) override;
    std::int64_t now_ms() override { return now_ms_; }

    void advance_clock(std::int64_t ms) { now_ms_ += ms; }
    /// Drops all messages to and from this address from now on, those in flight included.
    void cut_off(const Address& address) { cut_.insert(address); }
    /// Until it is connected again.
    void reconnect(const Address& address) { cut_.erase(address); }
    /// Reports to the Controller that this address has vanished, true or not.
    void spread_rumour(const Address& address) { rumours_.push_back(address); }
    std::vector<Address> take_vanished(const Address& self) override;
    /// A uniform number below `limit`, from the same seeded stream; to choose when to kill which member.
    std::uint64_t random(std::uint64_t limit);
    /// Called when a member polls for messages, before it gets them, so that a test can let others advance
    /// meanwhile.
    std::function<void()> on_drain;

    std::uint64_t dropped() const { return dropped_; }
    std::uint64_t doubled() const { return doubled_; }
    /// By kind of message: garbled copies delivered; garbled copies that the decoder refused.
    const std::map<std::string, std::uint64_t>& garbled() const { return garbled_; }
    std::uint64_t refused() const { return refused_; }

  private:
    bool chance(double probability);
    void garble(const Address& to, std::vector<std::uint8_t> bytes);
    void post(const Address& to, std::vector<std::uint8_t> bytes);

    FaultOptions options_;
    std::uint64_t random_state_;
    std::int64_t now_ms_ = 0;
    std::uint64_t dropped_ = 0, doubled_ = 0, serial_ = 0;
    // by receiver: (due time, serial) -> bytes
    std::map<Address, std::map<std::pair<std::int64_t, std::uint64_t>, std::vector<std::uint8_t>>> under_way_;
    std::set<Address> cut_;
    std::map<std::string, std::uint64_t> garbled_;
    std::uint64_t refused_ = 0;
    std::vector<Address> rumours_;
};

}  // namespace roboss
