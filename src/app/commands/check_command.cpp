// Loads, validates and compiles a world, then prints the census and all diagnostics, as text or JSON.
#include "app/commands/check_command.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/worlds/plugin_census.h"
#include "app/worlds/world_census.h"
#include "model/model.h"
#include "sdf/load_world.h"

namespace roboss {
namespace {

constexpr const char* kHelp =
    "Reads a world without running it. Prints the numbers of robots, links, joints, shapes and sensors, the\n"
    "commands that the robots take, what becomes of each <plugin>, and all errors, warnings and unsupported\n"
    "elements, each with file, line and remedy.\n"
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

/// "linear_x (m/s), angular_z (rad/s)"
std::string values_of(const Channel& command) {
    std::string text;
    for (const ChannelValue& value : command.values) {
        text += (text.empty() ? "" : ", ") + value.name;
        if (!value.unit.empty()) text += " (" + value.unit + ")";
    }
    return command.is_list ? "rows of " + text : text;
}

void print_text(const std::vector<TypeCommands>& types) {
    for (const TypeCommands& type : types) {
        fmt::print("commands of    {}{}\n", type.first,
                   type.robots > 1 ? fmt::format(" and {} like it", type.robots - 1) : "");
        for (const Channel& command : type.commands)
            fmt::print("    {}: {} [{}]\n", command.name, values_of(command), command.topic);
    }
}

/// "the world", "model 'car'", "link 'base' of model 'car'"
std::string place_of(const PluginReport& plugin) {
    if (plugin.model.empty()) return "the world";
    const std::string model = fmt::format("model '{}'", plugin.model);
    if (plugin.owner.empty()) return model;
    return fmt::format("{} '{}' of {}", plugin.parent, plugin.owner, model);
}

void print_text(const std::vector<PluginReport>& plugins) {
    for (const PluginReport& p : plugins) {
        fmt::print("plugin         {} in {}{}: {}{} ({}:{})\n", p.name, place_of(p),
                   p.count > 1 ? fmt::format(" and {} like it", p.count - 1) : "", to_text(p.fate),
                   p.reason.empty() ? "" : ", " + p.reason, p.where.file, p.where.line);
    }
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
            {"sensors_without_readings", census.silent},
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

nlohmann::json to_json(const std::vector<TypeCommands>& types) {
    nlohmann::json list = nlohmann::json::array();
    for (const TypeCommands& type : types) {
        nlohmann::json commands = nlohmann::json::array();
        for (const Channel& command : type.commands) {
            nlohmann::json values = nlohmann::json::array();
            for (const ChannelValue& value : command.values)
                values.push_back({{"name", value.name}, {"unit", value.unit}});
            commands.push_back({{"name", command.name},
                                {"topic", command.topic},
                                {"list", command.is_list},
                                {"values", values}});
        }
        list.push_back({{"robot", type.first}, {"robots", type.robots}, {"commands", commands}});
    }
    return list;
}

nlohmann::json to_json(const std::vector<PluginReport>& plugins) {
    nlohmann::json list = nlohmann::json::array();
    for (const PluginReport& p : plugins) {
        list.push_back({{"class", p.name},
                        {"in", p.parent},
                        {"model", p.model},
                        {"owner", p.owner},
                        {"file", p.where.file},
                        {"line", p.where.line},
                        {"count", p.count},
                        {"fate", to_text(p.fate)},
                        {"reason", p.reason}});
    }
    return list;
}

int check(const CheckOptions& options) {
    Diagnostics diagnostics;
    const std::optional<World> world = load_world(options.world, {options.paths}, diagnostics);
    // Compiling finds errors of the joint graph: loops, unconnected parts.
    std::shared_ptr<const Model> model;
    if (world && !diagnostics.refuses()) model = compile(*world, {}, diagnostics);
    const bool runs = model != nullptr;
    const auto commands = runs ? list_commands(*model) : std::vector<TypeCommands>{};
    const auto plugins = world ? list_plugins(*world, model.get(), diagnostics) : std::vector<PluginReport>{};
    if (options.json) {
        nlohmann::json report = world ? to_json(take_census(*world), *world) : nlohmann::json::object();
        report["runs"] = runs;
        report["commands"] = to_json(commands);
        report["plugins"] = to_json(plugins);
        report["errors"] = diagnostics.count(Severity::kError);
        report["warnings"] = diagnostics.count(Severity::kWarning);
        report["diagnostics"] = to_json(diagnostics);
        fmt::print("{}\n", report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    } else {
        if (world) print_text(*world, take_census(*world));
        print_text(commands);
        print_text(plugins);
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
