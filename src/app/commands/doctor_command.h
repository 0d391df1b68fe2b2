// The subcommand `doctor`: what a report of a defect needs, and what is wrong with this computer.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

void add_doctor_command(CLI::App& app, int& exit_code);

}  // namespace roboss
