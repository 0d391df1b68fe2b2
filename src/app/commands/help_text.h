// Help in two lengths: --help prints the options that most people need first, --help-all prints every option.
#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>

namespace roboss {

/// "roboss control" for its subcommand.
std::string full_name(const CLI::App& app);

/// Puts the options that have no heading yet under this one. Called after each set of options is added.
void name_new_options(CLI::App& command, const std::string& heading);

/// Limits --help of the command to these options (by their long names, without dashes), and says how to see
/// the rest.
void limit_help_to(CLI::App& command, std::initializer_list<const char*> options);

/// Prints help as above. Set it on the main command before subcommands are added: they inherit it.
class HelpFormatter : public CLI::Formatter {
  public:
    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
};

}  // namespace roboss
