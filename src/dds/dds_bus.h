// DdsBus: the Bus over DDS (eProsima Fast DDS 2.9), between the processes and machines of one run. Each
// address has an inbox, a pair of topics named after the simulation and the address; whoever sends to it
// makes a writer for it on first use. Words go reliably and in order, signs of life as best they can
// (decision 0009).
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
    std::vector<Flow> flows() const override;

    /// Whether a process that owns this address is connected now. Asking makes the connection.
    bool present(const Address& address);
    /// When a message from this address came last (now_ms()); nothing: never.
    std::optional<std::int64_t> heard_ms(const Address& address) const;
    /// Leaves the network and joins it afresh, for one who hears nothing though others are there: when a
    /// process was stopped for longer than its lease, DDS may find only one direction again. An Error: the
    /// interface is down or a peer's name unknown at the moment (its container is being made again, say);
    /// then all stays as it is.
    Result<> reconnect();
    /// Another process has opened the inbox of this address: two must not be the same.
    bool taken_elsewhere(const Address& address) const;
    /// Waits until all that was sent has arrived, at most so long. For the end of a process.
    bool flush(std::int64_t ms_max);
    /// Damaged messages, complaints of the DDS layer: one line each, for the log.
    std::vector<std::string> take_notices();

  private:
    struct Network;
    explicit DdsBus(std::unique_ptr<Network> network);
    std::unique_ptr<Network> network_;
};

}  // namespace roboss
