// DdsBus: the Bus over DDS (eProsima Fast DDS 2.9), between the processes and machines of one run. Each
// address has an inbox, a pair of topics named after the simulation and the address; a sender makes a writer
// for it on first use. Messages are reliable and in order, except heartbeats, which are best effort (decision
// 0009).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/bus.h"
#include "core/result.h"
#include "dds/dds_options.h"

namespace roboss {

class DdsBus : public Bus {
  public:
    /// An Error says which option does not fit this computer.
    static Result<std::unique_ptr<DdsBus>> create(const DdsOptions& options);
    ~DdsBus() override;

    /// Messages between addresses of this process do not touch the network.
    void send(const Address& from, const Address& to, Message message) override;
    /// The first call opens the inbox of `self`; nothing is kept for it before.
    void drain(const Address& self, std::vector<Envelope>& inbox) override;
    std::int64_t now_ms() override { return monotonic_ms(); }
    std::vector<Address> take_vanished(const Address& self) override;
    void wait(std::int64_t ms_max) override;
    void keep_alive(const Address& from, const Address& to, const Heartbeat& heartbeat) override;
    void end_keep_alive(const Address& from) override;
    std::vector<Flow> flows() const override;

    /// Whether a process that owns this address is connected now. Asking makes the connection.
    bool present(const Address& address);
    /// When the last message from this address arrived (now_ms()); empty: never.
    std::optional<std::int64_t> heard_ms(const Address& address) const;
    /// Leaves the network and joins it again, for a process that receives nothing although others are there:
    /// after a process was stopped for longer than its lease, DDS may rediscover only one direction. An
    /// Error: the interface is down or a peer's name is unknown at the moment (its container is being
    /// recreated, say); then nothing changes.
    Result<> reconnect();
    /// Another process has opened the inbox of this address: an address must have one process only.
    bool taken_elsewhere(const Address& address) const;
    /// Waits until all that was sent has arrived, at most so long. To be called before a process ends.
    bool flush(std::int64_t ms_max);
    /// Damaged messages, errors of the DDS layer: one line each, for the log.
    std::vector<std::string> take_notices();

  private:
    struct Network;
    explicit DdsBus(std::unique_ptr<Network> network);
    std::unique_ptr<Network> network_;
};

}  // namespace roboss
