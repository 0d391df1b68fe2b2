// A Bus within one process and one thread: one queue per address; messages are moved, not encoded, and never
// lost.
#pragma once

#include <map>

#include "bus/flow_count.h"

namespace roboss {

class InProcessBus : public Bus {
  public:
    void send(const Address& from, const Address& to, Message message) override;
    void drain(const Address& self, std::vector<Envelope>& inbox) override;
    std::int64_t now_ms() override { return monotonic_ms(); }
    std::vector<Flow> flows() const override { return count_.all(); }
    /// No message is in flight.
    bool quiet() const;

  private:
    std::map<Address, std::vector<Envelope>> queues_;
    FlowCount count_;
};

}  // namespace roboss
