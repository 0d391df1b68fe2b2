// See help_text.h.
#include "app/commands/help_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "core/check.h"

namespace roboss {
namespace {

constexpr const char* kUnnamed = "Options";  // the heading that CLI11 gives
constexpr const char* kFirst = "Options that most people need first";

}  // namespace

std::string full_name(const CLI::App& app) {
    const CLI::App* parent = app.get_parent();
    return parent == nullptr ? "roboss" : full_name(*parent) + " " + app.get_name();
}

void name_new_options(CLI::App& command, const std::string& heading) {
    for (CLI::Option* option : command.get_options([](const CLI::Option* o) { return o->nonpositional(); }))
        if (option->get_group() == kUnnamed && option != command.get_help_ptr() &&
            option != command.get_help_all_ptr())
            option->group(heading);
}

void limit_help_to(CLI::App& command, std::initializer_list<const char*> options) {
    for (const char* name : options) {
        CLI::Option* option = command.get_option_no_throw("--" + std::string(name));
        ROBOSS_CHECK(option != nullptr, name);
        option->group(kFirst);
    }
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
    const std::vector<std::string> groups = app->get_groups();
    if (mode != CLI::AppFormatMode::Normal || std::ranges::find(groups, kFirst) == groups.end())
        return Formatter::make_help(app, std::move(name), mode);
    const auto first = app->get_options([](const CLI::Option* o) { return o->get_group() == kFirst; });
    const auto all = app->get_options([](const CLI::Option* o) { return o->nonpositional(); });
    return make_description(app) + make_usage(app, std::move(name)) + make_positionals(app) +
           make_group(kFirst, false, first) +
           fmt::format("\n{} more options, by topic: {} --help-all\n\n", all.size() - first.size(),
                       full_name(*app)) +
           make_footer(app);
}

}  // namespace roboss
