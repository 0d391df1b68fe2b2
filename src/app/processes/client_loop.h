// The loop of a process that is a Client of a run.
#pragma once

#include <functional>

#include "app/processes/member.h"
#include "client/bus_client.h"

namespace roboss {

/// How serve_client() ended.
enum class ClientEnd {
    kNewModel,  ///< the run has another Model: the caller makes another Client
    kRefused,   ///< BusClient::refusal() says why
    kOver       ///< the run or the Client has ended, or there is no Controller; client_exit_code() tells
};

/// Serves a Client until it ends, or Ctrl-C. `turn` is called in each turn, between waits for messages; it
/// returns false once the Client leaves for a reason of its own.
ClientEnd serve_client(Member& member, BusClient& client, const std::function<bool()>& turn);

/// Reports the end of the run, if that is why the Client has ended. The answer is the exit code.
int client_exit_code(Member& member, const BusClient& client);

}  // namespace roboss
