// See usage.h.
#include "app/commands/usage.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "app/commands/exit_codes.h"
#include "app/commands/help_text.h"
#include "app/output/say.h"
#include "core/result.h"
#include "core/similar.h"

namespace roboss {
namespace {

/// The subcommand of the subcommand ... that was typed.
const CLI::App& innermost(const CLI::App& app) {
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    return chosen.empty() ? app : innermost(*chosen.front());
}

std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

std::vector<std::string> subcommand_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(sub->get_name());
    return names;
}

/// What no option or subcommand takes.
Error unexpected(const CLI::App& app, const std::string& word) {
    const bool is_option = word.size() > 1 && word.front() == '-';
    const std::string name = word.substr(0, word.find('='));
    const std::string what = is_option                       ? "has no option '" + name + "'"
                             : subcommand_names(app).empty() ? "does not expect '" + word + "'"
                                                             : "has no command '" + word + "'";
    return Error{"'" + full_name(app) + "' " + what,
                 did_you_mean(name, is_option ? option_names(app) : subcommand_names(app),
                              "see `" + full_name(app) + " --help`"),
                 "wrong-usage"};
}

Error usage_error(const CLI::App& app, const CLI::ParseError& error) {
    const CLI::App& command = innermost(app);
    for (const CLI::App* from : {&command, &app})
        if (const std::vector<std::string> words = from->remaining(); !words.empty()) {
            const auto option = std::ranges::find_if(words, [](const std::string& w) { return w[0] == '-'; });
            return unexpected(command, option != words.end() ? *option : words.front());
        }
    return Error{error.what(), "see `" + full_name(command) + " --help`", "wrong-usage"};
}

}  // namespace

std::optional<int> read_command_line(CLI::App& app, int argc, const char* const* argv) {
    std::vector<const char*> words(argv, argv + argc);
    if (words.size() == 1) {  // what one types to see what there is
        say(stderr, "{}", app.help());
        return kWrongUsage;
    }
    if (words[1] == std::string_view("help")) {  // `roboss help run` is `roboss run --help`
        words.erase(words.begin() + 1);
        words.push_back("--help");
    }
    try {
        app.parse(static_cast<int>(words.size()), words.data());
    } catch (const CLI::Success& request) {  // --help, --version
        return app.exit(request);
    } catch (const CLI::ParseError& error) {
        say(stderr, "roboss: {}\n", usage_error(app, error).text());
        return kWrongUsage;
    }
    return std::nullopt;
}

}  // namespace roboss
