// `roboss run WORLD`: the whole system in one process.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

/// Adds the subcommand; exit_code as in its --help.
void add_run_command(CLI::App& app, int& exit_code);

}  // namespace roboss
