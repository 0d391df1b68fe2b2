// `roboss record`, `plot`, `analyse` and `calibrate`: commands of the Python package
// (python/roboss/analysis). This process becomes Python.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

/// Adds the subcommands; each passes all its arguments on. exit_code: kBadInput if there is no such package.
void add_python_commands(CLI::App& app, int& exit_code);

}  // namespace roboss
