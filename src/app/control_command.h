// `roboss control WORDS...`: asks a running simulation for something, over the network.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/member.h"

namespace roboss {

/// Adds the subcommand; exit_code as in its --help.
void add_control_command(CLI::App& app, int& exit_code);

/// What the Controller answers to these words; an Error: there is none, or it refuses.
Result<std::string> request_of_controller(const MemberOptions& options,
                                          const std::vector<std::string>& words);
/// Asks the Controller, waits for its answer and prints it. The exit code.
int ask_controller(const MemberOptions& options, const std::vector<std::string>& words);

}  // namespace roboss
