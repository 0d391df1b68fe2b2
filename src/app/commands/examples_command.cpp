// Prints the examples as a table or JSON.
#include "app/commands/examples_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/exit_codes.h"
#include "app/output/say.h"
#include "app/run/run.h"
#include "app/worlds/examples.h"

namespace roboss {
namespace {

const char* const kExamplesFooter =
    R"(`roboss run example:NAME` runs one with its control programs and orders, and prints the address of its page:
  roboss run example:city
  roboss run example:spider --headless --duration 10
With --client or --orders your own programs or orders take the place of those of the example.
The commands check, snapshot, sense, dataset, controller, record and analyse take example:NAME for a world, too.

Exit codes: 0 done, 1 the installation has no examples.)";

int print_examples(bool json) {
    const Result<std::vector<Example>> all = examples();
    if (!all) return print(all.error()), kBadInput;
    if (!json) {
        std::size_t width = 0;
        for (const Example& example : all.value()) width = std::max(width, example.name.size());
        for (const Example& example : all.value()) say("{:{}}  {}\n", example.name, width, example.summary);
        say("\nroboss run example:{} runs the first of them.\n", all.value().front().name);
        return kSuccess;
    }
    nlohmann::ordered_json printed = nlohmann::ordered_json::array();
    for (const Example& example : all.value()) {
        nlohmann::json programs = nlohmann::json::array();
        for (const ExampleProgram& program : example.programs) programs.push_back(program.name);
        printed.push_back({{"name", example.name},
                           {"summary", example.summary},
                           {"world", example.world.string()},
                           {"orders", example.orders.string()},
                           {"programs", programs}});
    }
    say("{}\n", printed.dump(2));
    return kSuccess;
}

}  // namespace

void add_examples_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("examples", "list the worlds that come with RoBOSS, a line each");
    command->footer(kExamplesFooter);
    auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "print a JSON array");
    command->callback([json, &exit_code] { exit_code = print_examples(*json); });
}

}  // namespace roboss
