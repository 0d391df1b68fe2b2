// ControlDesk: requests to the run itself (pause, rewind ...), each handed out once and answered as often as
// it is asked. What they mean is the business of whoever owns the run.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bus/bus.h"

namespace roboss {

struct ControlCall {
    Address from;
    ControlRequest request;
};

class ControlDesk {
  public:
    /// Takes a request in, or sends the answer again that it had.
    void take(Bus& bus, const Address& from, const ControlRequest& request);
    /// Requests that are new since the last call.
    std::vector<ControlCall> take_calls() { return std::exchange(calls_, {}); }
    void answer(Bus& bus, const ControlCall& call, bool done, const std::string& text);

  private:
    struct Last {
        std::uint64_t number = 0;
        std::optional<ControlReply> reply;
    };
    std::map<Address, Last> last_;  // of each asker
    std::vector<ControlCall> calls_;
};

}  // namespace roboss
