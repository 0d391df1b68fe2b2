// Requests by requester and number.
#include "roles/controller/control_service.h"

namespace roboss {

void ControlService::take(Bus& bus, const Address& from, const ControlRequest& request) {
    Last& last = last_[from];
    if (request.number == last.number && last.reply) return bus.send(kControllerAddress, from, *last.reply);
    if (request.number <= last.number) return;  // in progress, or older than the last
    last = {request.number, std::nullopt};
    calls_.push_back({from, request});
}

void ControlService::answer(Bus& bus, const ControlCall& call, ControlOutcome outcome) {
    ControlReply reply{call.request.number, std::move(outcome)};
    Last& last = last_[call.from];
    if (last.number == call.request.number) last.reply = reply;
    bus.send(kControllerAddress, call.from, std::move(reply));
}

}  // namespace roboss
