// Loads, validates and compiles a world, then prints the census and all diagnostics, as text or JSON.
#include "app/commands/check_command.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/worlds/world_census.h"
#include "model/model.h"
#include "sdf/load_world.h"

namespace roboss {
namespace {

constexpr const char* kHelp =
    "Reads a world without running it. Prints the numbers of robots, links, joints, shapes and sensors, and "
    "all\n"
    "errors, warnings and unsupported elements, each with file, line and remedy.\n"
    "WORLD is an SDFormat file (1.4 to 1.12) or a URDF file.\n\n"
    "Exit codes: 0 no errors (warnings and notes allowed), 1 errors: `roboss run` leaves out the models that "
    "have "
    "them, or\n"
    "refuses the world if no other model is left, 2 the file cannot be read or wrong usage.\n"
    "Example: roboss check worlds/city.sdf --path ~/models";

struct CheckOptions {
    std::string world;
    std::vector<std::string> paths;
    bool json = false;
};

std::string counts(const std::map<std::string, std::size_t>& by_kind) {
    std::string text;
    for (const auto& [kind, count] : by_kind)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, kind);
    return text.empty() ? "none" : text;
}

void print_text(const World& world, const WorldCensus& census) {
    fmt::print("world          {} ({})\n", world.name, world.file);
    fmt::print("robots         {} of {} distinct types, {} links\n", census.robots, census.robot_types,
               census.links);
    fmt::print("static models  {}\n", census.static_models);
    fmt::print("joints         {}\n", counts(census.joints));
    fmt::print("shapes         {}\n", counts(census.shapes));
    fmt::print("sensors        {}\n", counts(census.sensors));
    fmt::print("time step      {} s\n", world.dt_s);
}

void print_text(const Diagnostics& diagnostics) {
    for (const Severity severity : {Severity::kError, Severity::kWarning, Severity::kNote}) {
        for (const Diagnostic& d : diagnostics.items()) {
            if (d.severity == severity) fmt::print("{}\n", to_text(d));
        }
    }
    fmt::print("{} errors, {} warnings, {} notes\n", diagnostics.count(Severity::kError),
               diagnostics.count(Severity::kWarning), diagnostics.count(Severity::kNote));
}

nlohmann::json to_json(const WorldCensus& census, const World& world) {
    return {{"world", world.name},
            {"file", world.file},
            {"robots", census.robots},
            {"robot_types", census.robot_types},
            {"static_models", census.static_models},
            {"links", census.links},
            {"joints", census.joints},
            {"shapes", census.shapes},
            {"sensors", census.sensors},
            {"dt_s", world.dt_s}};
}

nlohmann::json to_json(const Diagnostics& diagnostics) {
    nlohmann::json list = nlohmann::json::array();
    for (const Diagnostic& d : diagnostics.items()) {
        list.push_back({{"severity", to_text(d.severity)},
                        {"file", d.where.file},
                        {"line", d.where.line},
                        {"code", d.code},
                        {"message", d.message},
                        {"remedy", d.remedy},
                        {"left_out", d.left_out}});
    }
    return list;
}

int check(const CheckOptions& options) {
    Diagnostics diagnostics;
    const std::optional<World> world = load_world(options.world, {options.paths}, diagnostics);
    // Compiling finds errors of the joint graph: loops, unconnected parts.
    const bool runs = world && !diagnostics.refuses() && compile(*world, {}, diagnostics) != nullptr;
    if (options.json) {
        nlohmann::json report = world ? to_json(take_census(*world), *world) : nlohmann::json::object();
        report["runs"] = runs;
        report["errors"] = diagnostics.count(Severity::kError);
        report["warnings"] = diagnostics.count(Severity::kWarning);
        report["diagnostics"] = to_json(diagnostics);
        fmt::print("{}\n", report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    } else {
        if (world) print_text(*world, take_census(*world));
        print_text(diagnostics);
        if (diagnostics.has_errors())
            fmt::print("{}\n",
                       runs ? "`roboss run` leaves out the models with errors, or refuses with --strict"
                            : "`roboss run` refuses this world");
    }
    if (!world) return 2;
    return diagnostics.has_errors() ? 1 : 0;
}

}  // namespace

void add_check_command(CLI::App& app, int& exit_code) {
    auto options = std::make_shared<CheckOptions>();
    CLI::App* command = app.add_subcommand("check", kHelp);
    command->add_option("world", options->world, "world file: SDFormat or URDF")
        ->required()
        ->type_name("WORLD");
    command
        ->add_option("--path", options->paths,
                     "folder in which model://, package:// and relative URIs are looked up (may be repeated)")
        ->type_name("DIR")
        ->take_all();
    command->add_flag("--json", options->json, "print one JSON object instead of text");
    command->callback([options, &exit_code] { exit_code = check(*options); });
}

}  // namespace roboss
