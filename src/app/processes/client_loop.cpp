// See client_loop.h.
#include "app/processes/client_loop.h"

#include "app/processes/interrupt.h"

namespace roboss {
namespace {

constexpr std::int64_t kLeave_ms = 5'000;  // for the Controller to hear that it leaves

}  // namespace

ClientEnd serve_client(Member& member, BusClient& client, const std::function<bool()>& turn) {
    std::int64_t leaving_ms = 0;
    bool stays = true;
    while (client.over().empty()) {
        const std::int64_t now = member.bus().now_ms();
        if (leaving_ms == 0 && (interrupted() || !stays)) {
            leaving_ms = now;
            if (stays && client.joined()) client.leave(member.bus());
        }
        if (leaving_ms != 0 && (client.heard() || now - leaving_ms > kLeave_ms)) break;
        stays = turn();
        if (client.outdated()) return ClientEnd::kNewModel;
        if (!client.refusal().empty()) return ClientEnd::kRefused;
        if (client.over().empty() && !member.wait()) break;
    }
    member.bus().flush(500);
    return ClientEnd::kOver;
}

int client_exit_code(Member& member, const BusClient& client) {
    return client.over().empty() ? member.exit_code() : member.end({client.over(), client.failed()});
}

}  // namespace roboss
