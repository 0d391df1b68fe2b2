// ControlService: requests to the run itself (pause, rewind ...). Each is handed out once, and its answer is
// sent again whenever the request is. The owner of the run executes them.
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

class ControlService {
  public:
    /// Accepts a request, or sends its answer again.
    void take(Bus& bus, const Address& from, const ControlRequest& request);
    /// Requests that are new since the last call.
    std::vector<ControlCall> take_calls() { return std::exchange(calls_, {}); }
    void answer(Bus& bus, const ControlCall& call, ControlOutcome outcome);

  private:
    struct Last {
        std::uint64_t number = 0;
        std::optional<ControlReply> reply;
        std::uint64_t turn = 0;  // of its last request, counted over all requesters
    };
    void forget_oldest();

    /// Requesters that are remembered: each `roboss control` is a new one, and repeats itself for seconds.
    static constexpr std::size_t kRequestersMost = 256;
    std::map<Address, Last> last_;  // by requester
    std::uint64_t turns_ = 0;
    std::vector<ControlCall> calls_;
};

}  // namespace roboss
