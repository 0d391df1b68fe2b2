// `roboss keys`: the keys with which members of a run recognise each other.
#pragma once

#include <CLI/CLI.hpp>

namespace roboss {

void add_keys_command(CLI::App& app, int& exit_code);

}  // namespace roboss
