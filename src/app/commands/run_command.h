// `roboss run WORLD`: the whole system on this computer. `roboss controller WORLD`: the same run, its
// Simulators and Clients anywhere.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

/// Adds the subcommand; exit_code as in its --help.
void add_run_command(CLI::App& app, int& exit_code);
void add_controller_command(CLI::App& app, int& exit_code);

/// `roboss replay JOURNAL`: the same once more, from what was kept.
void add_replay_command(CLI::App& app, int& exit_code);

}  // namespace roboss
