// The subcommand `examples`: lists the worlds that come with RoBOSS.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

void add_examples_command(CLI::App& app, int& exit_code);

}  // namespace roboss
