// `roboss save FILE`: a state as a file of its own, out of a running simulation or out of a journal.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

/// Adds the subcommand; exit_code as in its --help.
void add_save_command(CLI::App& app, int& exit_code);

}  // namespace roboss
