// A Bus that behaves as badly as a network may, by seed: drops, doubles, delays and reorders, on a logical
// clock that advances when told. It carries encoded bytes, so that every message also passes the codec. For
// tests.
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
    /// Probability that a copy goes along in which some bytes are others, if it can still be decoded.
    double garble = 0;
};

class FaultyBus : public Bus {
  public:
    explicit FaultyBus(const FaultOptions& options);
    void send(const Address& from, const Address& to, Message message) override;
    void drain(const Address& self, std::vector<Envelope>& inbox) override;
    std::int64_t now_ms() override { return now_ms_; }

    void advance_clock(std::int64_t ms) { now_ms_ += ms; }
    /// Everything to and from this address vanishes from now on, and what is under way to it too.
    void cut_off(const Address& address) { cut_.insert(address); }
    /// Says to the Controller that this address has vanished, true or not.
    void spread_rumour(const Address& address) { rumours_.push_back(address); }
    std::vector<Address> take_vanished(const Address& self) override;
    /// A uniform number below `limit`, from the same seeded stream; for choosing when to kill whom.
    std::uint64_t random(std::uint64_t limit);
    /// Called when somebody looks for messages, before it gets them: a test's chance to let others go on
    /// meanwhile.
    std::function<void()> on_drain;

    std::uint64_t dropped() const { return dropped_; }
    std::uint64_t doubled() const { return doubled_; }
    /// By kind of message: copies that went along garbled; garbled ones that the decoder refused.
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
