// ClientService: the Clients of a run: which ticks each observes, which replies are outstanding, and so how
// far the world may advance. Replies are numbered and accepted in order, whatever the Bus does to them.
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
    bool observer = false;  // nobody waits for it
    Tick first = 0;         // tick of its first observation
    std::uint64_t last_reply = 0;
    std::uint64_t acknowledged = 0;     // the last reply that was acknowledged to it
    std::uint64_t reply_awaited = 0;    // its last reply to an earlier Controller, which it sends again
    std::vector<RefusedOrder> refused;  // of the last reply
    std::deque<Tick> unanswered;        // observations sent and not answered, ascending
    std::int64_t sent_ms = 0, heard_ms = 0;
    std::optional<std::uint64_t>
        acknowledge_at;                       // send the acknowledgement once so many log entries are safe
    std::optional<std::int64_t> vanished_ms;  // since when the Bus reports it as vanished
    bool serves() const { return joined && !gone; }
};

class ClientService {
  public:
    /// A run waits for these Clients before its first window; their ids follow this list, whoever joins
    /// first.
    explicit ClientService(const std::vector<std::string>& expected);

    /// Seats a Client. `earliest`: the first tick that is not scheduled yet. `is_new`: false if the hello
    /// came twice.
    ClientId welcome(const Address& address, const ClientHello& hello, Tick earliest, bool& is_new);
    bool all_joined() const;

    ClientSeat* find(ClientId id) { return id.index() < seats_.size() ? &seats_[id.index()] : nullptr; }
    std::vector<ClientSeat>& seats() { return seats_; }
    const std::vector<ClientSeat>& seats() const { return seats_; }

    static bool observes(const ClientSeat& seat, Tick tick) {
        return seat.serves() && tick >= seat.first && tick % seat.period == 0;
    }
    /// The last tick to which a window may go from `tick`: the next observation, or the first tick for which
    /// a synchronous Client that has not replied yet may still give orders. `tick` itself means wait.
    /// `all_answered`: what it will be once every observation before `tick` is answered.
    Tick limit(Tick tick, bool all_answered = false) const;

  private:
    std::vector<ClientSeat> seats_;
};

}  // namespace roboss
