// `roboss runs`: lists the runs of this computer.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

/// Adds the subcommand; exit_code as in its --help.
void add_runs_command(CLI::App& app, int& exit_code);

}  // namespace roboss
