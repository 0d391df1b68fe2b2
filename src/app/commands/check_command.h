// `roboss check WORLD`: prints the contents of a world and all diagnostics, without running it.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

/// Adds the subcommand; it sets exit_code to 0 (fine, warnings allowed), 1 (errors in the world) or 2 (cannot
/// be read).
void add_check_command(CLI::App& app, int& exit_code);

}  // namespace roboss
