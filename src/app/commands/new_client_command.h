// `roboss new-client NAME`: writes a small project for a control program.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

/// Adds the subcommand; exit_code as in its --help.
void add_new_client_command(CLI::App& app, int& exit_code);

}  // namespace roboss
