// `roboss simulator`: a Simulator that joins a run from anywhere and at any time.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

/// Adds the subcommand; exit_code as in its --help.
void add_simulator_command(CLI::App& app, int& exit_code);

}  // namespace roboss
