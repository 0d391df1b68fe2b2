// Beats: heartbeats that the network's thread sends for roles whose step is long (Bus::keep_alive()).
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "wire/message.h"

namespace roboss {

class Beats {
  public:
    /// From now on, as long as note_own() is not called: these bytes, an encoded Envelope.
    void begin(const Address& from, const Address& to, std::vector<std::uint8_t> bytes);
    void end(const Address& from);
    /// The role has sent something to this address itself.
    void note_own(const Address& from, const Address& to);
    /// Those that are to be sent now.
    std::vector<std::pair<Address, std::vector<std::uint8_t>>> due(std::int64_t now_ms) const;

  private:
    struct Beat {
        Address to;
        std::vector<std::uint8_t> bytes;
        std::int64_t own_ms = 0;
    };
    mutable std::mutex mutex_;
    std::map<Address, Beat> beats_;  // by sender
};

}  // namespace roboss
