// ClientService: the Clients of a run: which ticks each observes, which replies are outstanding, and so how
// far the world may advance. Replies are numbered and accepted in order, whatever the Bus does to them; their
// orders get ticks and go to the order log and the Recorder.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "bus/bus.h"
#include "roles/controller/model_server.h"
#include "roles/controller/order_log.h"
#include "roles/controller/recorder.h"
#include "roles/controller/run_notices.h"
#include "roles/controller/state_directory.h"
#include "wire/rights.h"

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
    std::uint64_t acknowledged = 0;   // the last reply that was acknowledged to it
    std::uint64_t reply_awaited = 0;  // its last reply to an earlier Controller, which it sends again
    struct Refusal {
        std::uint64_t reply = 0;
        RefusedOrder order;
    };
    Tick shown = -1;     // the last observation that was queued
    Tick answered = -1;  // the last observation to which its reply came
    /// Numbers of its orders: the greatest so far, and that before its present process. Those of a successor
    /// continue them.
    std::uint64_t sequence = 0, sequence_before = 0;
    std::deque<Refusal> refused;  // of replies whose acknowledgement it may not have
    std::deque<Tick> unanswered;  // observations sent and not answered, ascending
    std::int64_t sent_ms = 0, heard_ms = 0;
    std::optional<std::uint64_t>
        acknowledge_at;                       // send the acknowledgement once so many log entries are safe
    std::optional<std::int64_t> vanished_ms;  // since when the Bus reports it as vanished
    bool serves() const { return joined && !gone; }
};

struct ClientServiceOptions {
    /// A run waits for these Clients before its first window; their ids follow this list, whoever joins
    /// first.
    std::vector<std::string> expected;
    std::uint64_t seed = 1;  // sent to Clients
    std::int64_t resend_ms = 100;
    std::int64_t loss_ms = 0;  // a Client that does not reply for so long is considered lost; 0: never
    std::int64_t gone_ms = 0;  // so is one that the Bus reports as vanished for so long; 0: never
    bool went_back = false;    // after a rewind: Clients may have seen ticks that were discarded
};

class ClientService {
  public:
    /// All but the options outlive the ClientService.
    ClientService(std::shared_ptr<const Model> model, const ClientServiceOptions& options,
                  const ModelServer& model_server, OrderLog& order_log, Recorder& recorder,
                  StateDirectory& directory, RunNotices& notices);

    // Messages in. `scheduled_until`: the end of the window in progress, or else the committed tick.
    // `rights`: of the sender's key; null: all.
    /// One that may look only takes part as an observer.
    void take_hello(Bus& bus, const Address& from, const ClientHello& hello, Tick scheduled_until,
                    const Rights* rights = nullptr);
    /// Returns how many of its orders were refused.
    std::size_t take_reply(Bus& bus, const Address& from, const ClientReply& reply, Tick scheduled_until,
                           const Rights* rights = nullptr);
    /// A Client that leaves because of a failure ends the run, unless it may look only.
    void take_bye(Bus& bus, const Address& from, const ClientBye& bye, const Rights* rights = nullptr);
    /// The Bus reports that nobody is at this address any more.
    void take_vanished(const Address& address, std::int64_t now_ms);
    /// Gives up Clients that are silent or vanished for too long. A synchronous one ends the run.
    void notice_losses(std::int64_t now_ms);

    // Messages out.
    /// Acknowledges replies that the log has. An acknowledged reply is never lost.
    void acknowledge(Bus& bus);
    /// The committed tick is observed by the Clients whose turn it is.
    void queue_observations();
    /// The world rests at the committed tick: observers see it, too, if their period does not lead there.
    void show_rest();
    /// States have other holders: observations are sent again at once.
    void holders_changed() { due_ = true; }
    void send_observations(Bus& bus, const Roster& roster);
    void send_heartbeats(Bus& bus) const;
    void dismiss(Bus& bus, const RunOver& over) const;

    bool all_joined() const;
    /// Every synchronous Client has replied to all observations before `tick`.
    bool all_replied(Tick tick) const;
    /// The first tick at which a new order can apply.
    Tick stampable(Tick scheduled_until) const;
    /// The last tick to which a window may go from `tick`: the next observation, or the first tick for which
    /// a synchronous Client that has not replied yet may still give orders. `tick` itself means wait.
    /// `all_answered`: what it will be once every observation before `tick` is answered.
    Tick limit(Tick tick, bool all_answered = false) const;
    /// Names of those for whom the world waits at `tick`: they have not joined, or not replied.
    std::vector<std::string> awaited(Tick tick) const;
    /// By ClientId.
    const std::vector<ClientSeat>& seats() const { return seats_; }
    /// Names of all Clients that ever joined or are expected, by ClientId.
    std::vector<std::string> names() const;
    /// Names of those that are here or expected, without observers. A run that is changed twice in a row
    /// still waits for who had no time to join again.
    std::vector<std::string> names_serving() const;

  private:
    ClientSeat* seat_named(const std::string& name);
    /// The reason for which this caller cannot take part; nothing: it can.
    std::optional<Error> objection_to(const Address& from, const ClientHello& hello, const Rights* rights);
    ClientSeat& seat_for(const ClientHello& hello);
    static void sit_down(ClientSeat& seat, const Address& address, const ClientHello& hello, Tick earliest);
    /// The seat of a Client that has joined at this address; others get ClientUnknown.
    ClientSeat* joined_at(Bus& bus, const Address& from, ClientId id);
    std::size_t take_orders(ClientSeat& seat, const ClientReply& reply, Tick scheduled_until,
                            const Rights* rights);
    void queue_observation(ClientId id);
    Observation observation_of(const WantedTick& want, const Roster& roster) const;
    /// `for_good`: a run that continues from the log does not wait for it.
    void drop(ClientId id, bool for_good);
    bool stays_away(const ClientSeat& seat, std::int64_t now_ms) const;
    static bool observes(const ClientSeat& seat, Tick tick) {
        return seat.serves() && tick >= seat.first && tick % seat.period == 0;
    }

    std::shared_ptr<const Model> model_;
    ClientServiceOptions options_;
    const ModelServer& model_server_;
    OrderLog& order_log_;
    Recorder& recorder_;
    StateDirectory& directory_;
    RunNotices& notices_;
    std::vector<ClientSeat> seats_;
    bool due_ = false;  // observations are sent at once
};

}  // namespace roboss
