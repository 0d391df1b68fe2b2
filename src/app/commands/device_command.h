// `roboss device`: a control program drives real robots.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

/// Adds the subcommand; exit_code as in its --help.
void add_device_command(CLI::App& app, int& exit_code);

}  // namespace roboss
