// Switchboard: the connections of a process, in a thread of their own. The Controller's takes calls and
// passes on what is for others; a member's calls the Controller, again and again until it is there. Who is
// silent counts as lost.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/rate_limit.h"
#include "core/result.h"
#include "net/beats.h"
#include "net/frames.h"
#include "net/net_options.h"
#include "net/routes.h"
#include "net/tls.h"
#include "wire/message.h"

namespace roboss {

class Connection;
class Mailboxes;

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
    Beats& beats() { return beats_; }
    /// To be called after mailboxes were emptied.
    void resume();

    bool reaches(const Address& address) const { return routes_.leads_to(address); }
    std::optional<Error> refusal() const;
    /// The farewell of the Controller. Nothing before it, and once another Controller is there.
    std::optional<RunOver> farewell() const;
    void say_farewell(const RunOver& farewell);
    bool all_sent() const;
    std::vector<std::string> take_notices();
    std::string where() const;

  private:
    struct Thread;
    using Peer = Routes::Peer;

    Switchboard(const NetOptions& options, std::optional<Member> member, Mailboxes& mailboxes);
    Result<> listen();
    Result<> check_keys() const;
    void run();

    // In the network's thread. switchboard.cpp: messages
    Peer connect(int socket, std::shared_ptr<const TlsContext> tls);
    void take_frame(Connection& peer, const Frame& frame);
    void take_message(Connection& peer, std::vector<std::uint8_t> bytes);
    bool owns(Connection& peer, const Address& from);

    // switchboard_calls.cpp: calls, answers and ends
    void accept();
    void take_call(int socket);
    void accept_has_failed(const std::string& why, bool for_want_of_files);
    void call();
    void ready(Connection& peer);
    void take_hello(Connection& peer, const Frame& frame);
    void take_accept(Connection& peer);
    void take_farewell(Connection& peer, const Frame& frame);
    void refuse(Connection& peer, const std::string& code, const std::string& reason);
    void give_up(Connection& peer, Error error);
    bool found_key_is_replaced() const;
    void closed(Connection& peer, const std::string& reason);
    void report_trouble(const std::string& what);

    // switchboard_time.cpp: work by the clock
    void tick();
    void look_after(const Peer& peer, std::int64_t now_ms);
    void lose(const Peer& peer);
    void judge_again(std::int64_t now_ms);

    void notice(std::string line);

    const NetOptions options_;
    const std::optional<Member> member_;
    Mailboxes& mailboxes_;
    std::unique_ptr<Thread> thread_;  // the last to go: connections belong to its io_context
    Routes routes_;
    Beats beats_;

    mutable std::mutex mutex_;  // of what follows
    std::set<Peer> peers_;
    std::vector<std::string> notices_;
    RateLimit notice_rate_{5, 500};  // strangers who call again and again must not fill a log
    std::size_t left_out_ = 0;       // notices
    std::optional<Error> refusal_;
    std::optional<RunOver> farewell_;
    std::string where_, trouble_;
};

}  // namespace roboss
