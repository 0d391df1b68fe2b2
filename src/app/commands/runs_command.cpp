// Prints the list of runs as a table or JSON.
#include "app/commands/runs_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/exit_codes.h"
#include "app/local/run_list.h"
#include "app/output/say.h"
#include "app/run/run.h"

namespace roboss {
namespace {

const char* const kRunsFooter =
    R"(`roboss control --simulation NAME REQUEST` reaches each of them; the process id does as well.

Exit codes: 0 done (also if there is none), 1 the list cannot be read.)";

void print_table(const std::vector<ListedRun>& runs) {
    if (runs.empty()) return say(stderr, "no runs on this computer; start one with `roboss run WORLD`\n");
    std::size_t width = 4;
    for (const ListedRun& run : runs) width = std::max(width, run.name.size());
    say("{:{}}  {:10}  {:>7}  {:20}  {}\n", "NAME", width, "COMMAND", "PROCESS", "STARTED", "WORLD, VIEWER");
    for (const ListedRun& run : runs)
        say("{:{}}  {:10}  {:>7}  {:20}  {}{}{}\n", run.name, width, run.command, run.pid, run.started,
            run.world, run.viewer.empty() ? "" : "  ", run.viewer);
}

int list(bool json) {
    const Result<std::vector<ListedRun>> runs = listed_runs();
    if (!runs) return print(runs.error()), kBadInput;
    if (!json) return print_table(runs.value()), kSuccess;
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const ListedRun& run : runs.value())
        all.push_back({{"name", run.name},
                       {"command", run.command},
                       {"pid", run.pid},
                       {"world", run.world},
                       {"viewer", run.viewer},
                       {"started", run.started}});
    say("{}\n", all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    return kSuccess;
}

}  // namespace

void add_runs_command(CLI::App& app, int& exit_code) {
    CLI::App* command =
        app.add_subcommand("runs", "list the runs of this computer, which `roboss control` reaches");
    command->footer(kRunsFooter);
    auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "print a JSON array");
    command->callback([json, &exit_code] { exit_code = list(*json); });
}

}  // namespace roboss
