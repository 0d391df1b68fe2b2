// See usage.h.
#include "app/commands/usage.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "app/commands/exit_codes.h"
#include "core/result.h"

namespace roboss {
namespace {

/// Letters to change, add, leave out, or swap with their neighbour, from one word to the other (Damerau
/// 1964).
std::size_t distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> older, before(b.size() + 1), now(b.size() + 1);
    std::iota(before.begin(), before.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        now[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            now[j] =
                std::min({before[j] + 1, now[j - 1] + 1, before[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                now[j] = std::min(now[j], older[j - 2] + 1);
        }
        older = std::exchange(before, now);
    }
    return before.back();
}

/// The name that is most like the word that was typed; empty: none is much like it.
std::string similar_to(const std::string& word, const std::vector<std::string>& names) {
    std::string best;
    std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
    for (const std::string& name : names) {
        const std::size_t d = word.size() > 2 && name.starts_with(word) ? 1 : distance(word, name);
        if (d < least) least = d, best = name;
    }
    return best;
}

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

/// "roboss control" for its help.
std::string full_name(const CLI::App& app) {
    const CLI::App* parent = app.get_parent();
    return parent == nullptr ? "roboss" : full_name(*parent) + " " + app.get_name();
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

std::string did_you_mean(const std::string& word, const std::vector<std::string>& names,
                         const std::string& otherwise) {
    const std::string name = similar_to(word, names);
    return name.empty() ? otherwise : "did you mean '" + name + "'?";
}

std::optional<int> read_command_line(CLI::App& app, int argc, const char* const* argv) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& request) {  // --help, --version
        return app.exit(request);
    } catch (const CLI::ParseError& error) {
        fmt::print(stderr, "roboss: {}\n", usage_error(app, error).text());
        return kWrongUsage;
    }
    return std::nullopt;
}

}  // namespace roboss
