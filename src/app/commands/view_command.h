// `roboss view`: the viewer of a run that goes on elsewhere.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

/// Adds the subcommand; exit_code as in its --help.
void add_view_command(CLI::App& app, int& exit_code);

}  // namespace roboss
