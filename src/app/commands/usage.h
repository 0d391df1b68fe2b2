// Reads the command line; what is wrong with it is said in the words that were typed, with what was probably
// meant.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace roboss {

/// Reads the command line and runs the subcommand. The exit code if that is all: 0 after --help, 2 after
/// wrong usage, which is printed.
std::optional<int> read_command_line(CLI::App& app, int argc, const char* const* argv);

/// The remedy for a word that is none of these names: the name that is most like it, if one is, else
/// `otherwise`.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& names,
                         const std::string& otherwise);

}  // namespace roboss
