// StreamBus: the Bus between the processes and machines of one run, over TCP connections that are encrypted
// with TLS 1.3 and certificates on both sides. The Controller's process listens; every member has one
// connection to it, over which it also reaches the other members (decision 0042).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/bus.h"
#include "core/result.h"
#include "net/net_options.h"

namespace roboss {

class StreamBus : public Bus {
  public:
    /// The Controller's process. An Error says which option does not fit this computer, that the port is
    /// taken, or that a Controller of this name is running here.
    static Result<std::unique_ptr<StreamBus>> listen(const NetOptions& options);
    /// A member: it connects in the background, and again whenever the connection is lost. `role`:
    /// "simulator" or "client"; `name`: where it runs, for reports. An Error: keys or options are wrong.
    static Result<std::unique_ptr<StreamBus>> join(const NetOptions& options, const std::string& role,
                                                   const std::string& name);
    ~StreamBus() override;

    /// Messages between addresses of this process do not touch the network. What cannot be sent now is lost.
    void send(const Address& from, const Address& to, Message message) override;
    /// The first call opens the inbox of `self`; nothing is kept for it before.
    void drain(const Address& self, std::vector<Envelope>& inbox) override;
    std::int64_t now_ms() override { return monotonic_ms(); }
    std::vector<Address> take_vanished(const Address& self) override;
    void wait(std::int64_t ms_max) override;
    /// Ends wait(), or the next one, since something else has happened. Any thread may call it.
    void ring();
    void keep_alive(const Address& from, const Address& to, const Heartbeat& heartbeat) override;
    void end_keep_alive(const Address& from) override;
    std::vector<Flow> flows() const override;

    /// Whether a process that owns this address is connected now.
    bool present(const Address& address) const;
    /// When the last message from this address arrived (now_ms()); empty: never.
    std::optional<std::int64_t> heard_ms(const Address& address) const;
    /// Of a member: why the Controller does not take it. It tries no more.
    std::optional<Error> refusal() const;
    /// For a member: the end of the run, as the Controller announced it. Nothing while the run lasts, and
    /// once another run has begun.
    std::optional<RunOver> run_end() const;
    /// The same, from the second call on: between two calls a role takes the messages that came before the
    /// end.
    std::optional<RunOver> run_end_after_turn();
    /// Says to all who are connected, and to those who were silent for so long that they count as lost, why
    /// this process ends; of the Controller's process: why the run does.
    void say_farewell(const RunOver& end);
    /// Waits until the other computers have received all that was sent, at most so long. To be called before
    /// a process ends.
    bool flush(std::int64_t ms_max);
    /// Connections lost and made again, refused and misbehaving peers: one line each, for the log.
    std::vector<std::string> take_notices();
    /// "192.0.2.7:7117": where the Controller listens, or is looked for; empty: nowhere yet.
    std::string where() const;

  private:
    class Network;
    explicit StreamBus(std::unique_ptr<Network> network);
    std::unique_ptr<Network> network_;
    bool end_seen_ = false;  // of run_end_after_turn()
};

/// How messages and errors name a run's network: "simulation 'default' (at 192.0.2.7:7117)".
std::string describe(const NetOptions& options);

}  // namespace roboss
