// Reads the command line; what is wrong with it is said in the words that were typed, with what was probably
// meant.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>

namespace roboss {

/// Reads the command line and runs the subcommand. The exit code if that is all: 0 after --help, 2 after
/// wrong usage, which is printed.
std::optional<int> read_command_line(CLI::App& app, int argc, const char* const* argv);

}  // namespace roboss
