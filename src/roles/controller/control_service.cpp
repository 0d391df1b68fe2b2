// Requests by requester and number.
#include "roles/controller/control_service.h"

namespace roboss {

void ControlService::take(Bus& bus, const Address& from, const ControlRequest& request) {
    Last& last = last_[from];
    if (request.number == last.number && last.reply) return bus.send(kControllerAddress, from, *last.reply);
    if (request.number <= last.number) return;  // in progress, or older than the last
    last = {request.number, std::nullopt, ++turns_};
    calls_.push_back({from, request});
    if (last_.size() > kRequestersMost) forget_oldest();
}

/// Of those that have their reply.
void ControlService::forget_oldest() {
    auto oldest = last_.end();
    for (auto i = last_.begin(); i != last_.end(); ++i)
        if (i->second.reply && (oldest == last_.end() || i->second.turn < oldest->second.turn)) oldest = i;
    if (oldest != last_.end()) last_.erase(oldest);
}

void ControlService::answer(Bus& bus, const ControlCall& call, ControlOutcome outcome) {
    ControlReply reply{call.request.number, std::move(outcome)};
    const auto last = last_.find(call.from);
    if (last != last_.end() && last->second.number == call.request.number) last->second.reply = reply;
    bus.send(kControllerAddress, call.from, std::move(reply));
}

}  // namespace roboss
