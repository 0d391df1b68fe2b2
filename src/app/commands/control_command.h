// `roboss control REQUEST...`: sends a request to a running simulation.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/processes/member.h"
#include "wire/control.h"

namespace roboss {

/// Adds the subcommand; exit_code as in its --help.
void add_control_command(CLI::App& app, int& exit_code);

/// The status of the run, with the names of its robots; an Error if no Controller was found.
Result<RunStatus> status_of_controller(const MemberOptions& options);
/// Words of a request to save.
std::vector<std::string> save_words(const std::string& file, bool overwrite);
/// The reply to a request that was carried out, as JSON.
std::string done_json(Tick tick, const std::string& text);
struct AskOptions {
    bool yes = false;   // a terminal is not asked for confirmation
    bool json = false;  // the reply is printed as JSON
};
/// Sends a request, as its words on the command line, to the run, waits for its reply and prints it. Returns
/// the exit code.
int ask_controller(const MemberOptions& options, const std::vector<std::string>& words,
                   const AskOptions& ask = {});

}  // namespace roboss
