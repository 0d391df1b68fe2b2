// roboss foxglove: shows a running simulation to Foxglove and Lichtblick.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

void add_foxglove_command(CLI::App& app, int& exit_code);

}  // namespace roboss
