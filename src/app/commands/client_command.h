// `roboss client PROGRAM`: a control program as a process of its own.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

/// Adds the subcommand; exit_code as in its --help.
void add_client_command(CLI::App& app, int& exit_code);

}  // namespace roboss
