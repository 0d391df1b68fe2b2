// `roboss control REQUEST...`: sends a request to a running simulation.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/processes/member.h"

namespace roboss {

/// Adds the subcommand; exit_code as in its --help.
void add_control_command(CLI::App& app, int& exit_code);

/// The reply of the Controller to a request; an Error if no Controller was found or it refused.
Result<std::string> request_of_controller(const MemberOptions& options,
                                          const std::vector<std::string>& words);
/// Sends a request to the Controller, waits for its reply and prints it. Returns the exit code.
int ask_controller(const MemberOptions& options, const std::vector<std::string>& words);

}  // namespace roboss
