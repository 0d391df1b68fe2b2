// roboss cluster up|status|down.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

void add_cluster_command(CLI::App& app, int& exit_code);

}  // namespace roboss
