// `roboss diff A B`: the first tick, robot and field in which two journals differ.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

/// Adds the subcommand; exit_code as in its --help.
void add_diff_command(CLI::App& app, int& exit_code);

}  // namespace roboss
