// `roboss dataset`: a run whose sensors are recorded for the training of perception.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

/// Adds the subcommand; exit_code as in its --help.
void add_dataset_command(CLI::App& app, int& exit_code);

}  // namespace roboss
