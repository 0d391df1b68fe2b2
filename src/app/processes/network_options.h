// The network options of the processes of a run: where the Controller listens, and how members reach it.
#pragma once

#include <CLI/CLI.hpp>
#include <array>

#include "net/net_options.h"

namespace roboss {

// Each option can also come from the environment: ROBOSS_SIMULATION, ROBOSS_CONTROLLER ...
void add_listen_options(CLI::App& command, NetOptions& options);
void add_join_options(CLI::App& command, NetOptions& options);

/// Those of add_join_options() that lead to another computer.
inline constexpr std::array kJoinOptions{"--controller", "--keys", "--insecure"};

}  // namespace roboss
