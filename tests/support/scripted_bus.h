// A Bus for tests of one role: the test sets the time, sends the messages of the others and reads the
// answers.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bus/in_process_bus.h"

namespace roboss::test {

class ScriptedBus : public InProcessBus {
  public:
    std::int64_t now_ms() override { return time_ms; }
    void drain(const Address& self, std::vector<Envelope>& inbox) override {
        InProcessBus::drain(self, inbox);
        for (Envelope& envelope : inbox) envelope.rights = rights;
    }
    std::vector<Address> take_vanished(const Address&) override { return std::exchange(vanished, {}); }

    /// All messages of this kind that have arrived there; the others are dropped.
    template <class Kind>
    std::vector<Kind> take(const Address& address) {
        std::vector<Envelope> inbox;
        drain(address, inbox);
        std::vector<Kind> taken;
        for (Envelope& envelope : inbox)
            if (Kind* message = std::get_if<Kind>(&envelope.message)) taken.push_back(std::move(*message));
        return taken;
    }

    std::int64_t time_ms = 0;
    std::vector<Address> vanished;         // reported once
    std::shared_ptr<const Rights> rights;  // of all that is drained
};

}  // namespace roboss::test
