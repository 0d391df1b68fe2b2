// Switchboard: the connections of a process, in a thread of their own. The Controller's takes calls and
// passes on what is for others; a member's calls the Controller, again and again until it is there. Who is
// silent is hung up on.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/result.h"
#include "net/net_options.h"
#include "net/tls.h"
#include "wire/message.h"

namespace roboss {

class Connection;
class Mailboxes;
struct Frame;

class Switchboard {
  public:
    /// Who this process is, as it says when it calls.
    struct Member {
        std::string role, name;
    };
    /// Of the Controller's process, or (with `member`) of another one. See StreamBus for the Errors.
    static Result<std::unique_ptr<Switchboard>> open(const NetOptions& options, std::optional<Member> member,
                                                     Mailboxes& mailboxes);
    ~Switchboard();

    /// An encoded Envelope. Lost if no connection leads to `to`.
    void send(const Address& to, std::vector<std::uint8_t> bytes, bool urgent);
    /// From now on sends these bytes while note_own() is not called; see Bus::keep_alive().
    void begin_beat(const Address& from, const Address& to, std::vector<std::uint8_t> bytes);
    void end_beat(const Address& from);
    void note_own(const Address& from, const Address& to);
    /// To be called after mailboxes were emptied.
    void resume();

    bool reaches(const Address& address) const;
    std::optional<Error> refusal() const;
    bool all_sent() const;
    std::vector<std::string> take_notices();
    std::string where() const;

  private:
    struct Thread;
    using Peer = std::shared_ptr<Connection>;

    /// A heartbeat for a role whose step is long.
    struct Beat {
        Address to;
        std::vector<std::uint8_t> bytes;
        std::int64_t own_ms = 0;
    };

    Switchboard(const NetOptions& options, std::optional<Member> member, Mailboxes& mailboxes);
    Result<> listen();
    Result<> check_keys() const;
    void run();

    // In the network's thread:
    void accept();
    void call();
    Peer connect(int socket, std::shared_ptr<const TlsContext> tls);
    void ready(Connection& peer);
    void take_frame(Connection& peer, const Frame& frame);
    void take_hello(Connection& peer, const Frame& frame);
    void take_message(Connection& peer, std::vector<std::uint8_t> bytes);
    bool owns(Connection& peer, const Address& from);
    void closed(Connection& peer, const std::string& reason);
    void refuse(Connection& peer, const std::string& code, const std::string& reason);
    void give_up(Connection& peer, Error error);
    void tick();
    void look_after(const Peer& peer, std::int64_t now_ms);
    void send_beats(std::int64_t now_ms);
    void judge_again(std::int64_t now_ms);

    void notice(std::string line);
    void report_trouble(const std::string& what);
    Peer way_to(const Address& address) const;  // with mutex_ held

    const NetOptions options_;
    const std::optional<Member> member_;
    Mailboxes& mailboxes_;
    std::unique_ptr<Thread> thread_;

    mutable std::mutex mutex_;  // of what follows
    std::set<Peer> peers_;
    std::map<Address, Peer> routes_;
    Peer controller_;  // of a member: accepted
    std::map<Address, Beat> beats_;
    std::vector<std::string> notices_;
    std::optional<Error> refusal_;
    std::string where_, trouble_;
};

}  // namespace roboss
