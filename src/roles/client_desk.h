// The Clients that the Controller serves: who observes which ticks, whose words are still to come, and so how
// far the world may go. Words are numbered and accepted in order, so it does not matter how the Bus treats
// them.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "wire/message.h"

namespace roboss {

struct ClientSeat {
    std::string name;
    Address address;
    Tick period = 1, latency = 1;
    bool synchronous = true;
    bool joined = false, gone = false;
    bool guest = false;  // nobody waits for it
    Tick first = 0;      // tick of its first observation
    std::uint64_t last_word = 0;
    std::uint64_t acknowledged = 0;     // the last word that it has been told is taken
    std::uint64_t word_awaited = 0;     // said to an earlier Controller, and on its way again
    std::vector<RefusedOrder> refused;  // of the last word
    std::deque<Tick> unanswered;        // observations told and not answered, ascending
    std::int64_t told_ms = 0, heard_ms = 0;
    std::optional<std::uint64_t> acknowledge_at;  // once so many log entries are safe; none: nothing to say
    std::optional<std::int64_t> vanished_ms;      // since when the Bus has not seen it
    bool serves() const { return joined && !gone; }
};

class ClientDesk {
  public:
    /// A run waits for these Clients before its first window; their ids are their places here, whoever comes
    /// first.
    explicit ClientDesk(const std::vector<std::string>& expected);

    /// Takes a Client in; `earliest`: the first tick that is not planned yet. The seat is joined() already if
    /// the hello came twice.
    ClientId welcome(const Address& address, const ClientHello& hello, Tick earliest, bool& is_new);
    bool all_joined() const;

    ClientSeat* find(ClientId id) { return id.index() < seats_.size() ? &seats_[id.index()] : nullptr; }
    std::vector<ClientSeat>& seats() { return seats_; }
    const std::vector<ClientSeat>& seats() const { return seats_; }

    static bool observes(const ClientSeat& seat, Tick tick) {
        return seat.serves() && tick >= seat.first && tick % seat.period == 0;
    }
    /// The furthest tick to which the world may be planned from `tick`: not beyond the next observation, nor
    /// beyond what a synchronous Client that has not answered yet may still order. May be `tick` itself:
    /// wait. `all_answered`: what it will be once every observation before `tick` is answered.
    Tick limit(Tick tick, bool all_answered = false) const;

  private:
    std::vector<ClientSeat> seats_;
};

}  // namespace roboss
