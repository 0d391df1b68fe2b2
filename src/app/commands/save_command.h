// `roboss save FILE`: saves a state of a running simulation or of a journal to a file.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

/// Adds the subcommand; exit_code as in its --help.
void add_save_command(CLI::App& app, int& exit_code);

}  // namespace roboss
