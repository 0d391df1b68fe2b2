// `roboss journal info|verify|export FILE`: what a journal holds, whether it is true, and its log as text.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

/// Adds the subcommands; exit_code as in their --help.
void add_journal_command(CLI::App& app, int& exit_code);

}  // namespace roboss
