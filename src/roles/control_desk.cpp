// Requests by asker and number.
#include "roles/control_desk.h"

namespace roboss {

void ControlDesk::take(Bus& bus, const Address& from, const ControlRequest& request) {
    Last& last = last_[from];
    if (request.number == last.number && last.reply) return bus.send(kControllerAddress, from, *last.reply);
    if (request.number <= last.number) return;  // under way, or older than the last
    last = {request.number, std::nullopt};
    calls_.push_back({from, request});
}

void ControlDesk::answer(Bus& bus, const ControlCall& call, bool done, const std::string& text) {
    ControlReply reply{call.request.number, done, text};
    Last& last = last_[call.from];
    if (last.number == call.request.number) last.reply = reply;
    bus.send(kControllerAddress, call.from, std::move(reply));
}

}  // namespace roboss
