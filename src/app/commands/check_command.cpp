// Loads, validates and compiles a world, then prints the census and all diagnostics, as text or JSON.
#include "app/commands/check_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "app/commands/exit_codes.h"
#include "app/output/findings.h"
#include "app/output/say.h"
#include "app/ros2/ros2_options.h"
#include "app/run/run.h"
#include "app/worlds/examples.h"
#include "app/worlds/plugin_census.h"
#include "app/worlds/world_census.h"
#include "app/worlds/world_names.h"
#include "model/model.h"
#include "model/on_ground.h"
#include "physics/start_overlaps.h"
#include "ros2/robot_controllers.h"
#include "ros2/robot_names.h"
#include "ros2/world_drives.h"
#include "sdf/load_world.h"
#include "world/bare_model.h"

namespace roboss {
namespace {

constexpr const char* kHelp =
    "Reads a world without running it. Prints the numbers of robots, links, joints, shapes and sensors, the\n"
    "commands that the robots take, what becomes of each <plugin>, and all errors, warnings and unsupported\n"
    "elements, each with file, line and remedy.\n"
    "WORLD is an SDFormat file (1.4 to 1.12), a URDF file, or an MJCF file (MuJoCo).\n\n"
    "Exit codes: 0 no errors (warnings and notes allowed), 1 errors: `roboss run` leaves out the models that "
    "have\n"
    "them, or refuses the world if no other model is left; also a file that cannot be read; 2 wrong usage.\n"
    "Of several files the worst counts.\n"
    "Examples: roboss check worlds/city.sdf --path ~/models\n"
    "          roboss check robot.urdf --names\n"
    "          roboss check worlds/*.sdf --json";

struct CheckOptions {
    std::vector<std::string> worlds, paths;
    BareModelOptions bare;
    bool on_ground = false;
    std::string keyframe;
    std::shared_ptr<const ros2::Controllers> controllers;
    bool json = false, all = false, names = false;
};

std::string counts(const std::map<std::string, std::size_t>& by_kind) {
    std::string text;
    for (const auto& [kind, count] : by_kind)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, kind);
    return text.empty() ? "none" : text;
}

void print_text(const World& world, const WorldCensus& census) {
    say("world          {} ({})\n", world.name, world.file);
    say("robots         {} of {} type{}, {} links\n", census.robots, census.robot_types,
        census.robot_types == 1 ? "" : "s", census.links);
    say("static models  {}\n", census.static_models);
    say("joints         {}\n", counts(census.joints));
    say("shapes         {}\n", counts(census.shapes));
    say("sensors        {}{}\n", counts(census.sensors),
        census.silent.empty() ? "" : "; without readings: " + counts(census.silent));
    say("time step      {} s\n", world.dt_s);
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
        if (type.is_repeated) continue;
        const std::size_t others = type.robots - 1 + type.alike;
        say("{:15}{}{}{}\n", type.is_board ? "messages of" : "commands of",
            type.is_board ? "the world" : type.first,
            others > 0 ? fmt::format(" and {} like it", others) : "",
            type.alike > 0 ? ", with names of their own (--names)" : "");
        for (const Channel& command : type.commands)
            say("    {}: {} [{}]\n", command.name, values_of(command), command.topic);
    }
}

/// "the world", "model 'car'", "link 'base' of model 'car'"
std::string place_of(const PluginReport& plugin) {
    if (plugin.model.empty()) return "the world";
    const std::string model = fmt::format("model '{}'", plugin.model);
    if (plugin.owner.empty()) return model;
    return fmt::format("{} '{}' of {}", plugin.parent, plugin.owner, model);
}

/// "line 12" in the world file, else "FILE:12".
std::string where(const SourceLocation& place, const std::string& world_file) {
    if (place.file == world_file) return fmt::format("line {}", place.line);
    return fmt::format("{}:{}", place.file, place.line);
}

/// One line for each kind of plugin and what becomes of it.
void print_text(const std::vector<PluginReport>& plugins, const std::string& world_file) {
    using Key = std::tuple<std::string, PluginFate, std::string>;
    std::vector<std::pair<Key, std::vector<const PluginReport*>>> kinds;  // in the order of the file
    std::size_t width = 0;
    for (const PluginReport& p : plugins) {
        const Key key{p.name, p.fate, p.reason};
        auto found = std::ranges::find(kinds, key, [](const auto& kind) { return kind.first; });
        if (found == kinds.end()) found = kinds.insert(kinds.end(), {key, {}});
        found->second.push_back(&p);
        width = std::max(width, p.name.size());
    }
    for (const auto& [key, reports] : kinds) {
        const PluginReport& first = *reports.front();
        std::size_t elements = 0;
        for (const PluginReport* p : reports) elements += p->count;
        say("plugin         {:{}}  {:10}  {} ({}){}{}\n", first.name, width, to_text(first.fate),
            place_of(first), where(first.where, world_file),
            elements > 1 ? fmt::format(" and {} more", elements - 1) : "",
            first.reason.empty() ? "" : ": " + first.reason);
    }
    if (std::ranges::any_of(plugins, [](const PluginReport& p) { return p.fate == PluginFate::kNotRun; }))
        say("    For plugins that do not run: docs/plugins.md lists those that do; a control program can "
            "do their work.\n");
}

/// "1 error", "2 warnings"
std::string counted(const Diagnostics& diagnostics, Severity severity) {
    const std::size_t count = diagnostics.count(severity);
    return fmt::format("{} {}{}", count, to_text(severity), count == 1 ? "" : "s");
}

/// Errors first, one line for findings that are alike, and none for what the list of plugins says; `all`:
/// every finding.
void print_text(const Diagnostics& diagnostics, bool all) {
    for (const Severity severity : {Severity::kError, Severity::kWarning, Severity::kNote}) {
        if (all) {
            for (const Diagnostic& d : diagnostics.items())
                if (d.severity == severity) say("{}\n", to_text(d));
            continue;
        }
        for (const FindingGroup& group : group_findings(diagnostics, severity))
            if (group.first->code != "plugin" || severity != Severity::kNote) say("{}\n", to_text(group));
    }
    say("{}, {}, {}\n", counted(diagnostics, Severity::kError), counted(diagnostics, Severity::kWarning),
        counted(diagnostics, Severity::kNote));
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

/// Prints the parts of a file of ros2_control that have no effect in the world.
void print_notices(const ros2::Controllers& controllers, const Model& model) {
    for (const std::string& line : ros2::controller_notices(controllers, model, ros2::robot_names(model, "")))
        say("{}\n", line);
}

/// Prints the report on one file, or adds it to `reports`. Returns its exit code.
int check(const std::string& file, const CheckOptions& options, nlohmann::json& reports) {
    Diagnostics diagnostics;
    std::optional<World> world = load_world(file, {options.paths, {}, true, options.keyframe}, diagnostics);
    if (world)
        if (const Result<> completed = complete(*world, options.bare); !completed)
            diagnostics.error({file, 0}, completed.error().code, completed.error().message,
                              completed.error().remedy);
    if (world && options.controllers) ros2::add_drives(*options.controllers, "", "", *world);
    // Compiling finds errors of the joint graph: loops, unconnected parts.
    std::shared_ptr<const Model> model;
    if (world && !diagnostics.refuses()) model = compile(*world, {}, diagnostics);
    if (model && options.on_ground) model = stood_on_ground(*model, {file, 0}, diagnostics);
    if (model) report_overlaps(*model, &*world, diagnostics);
    const bool runs = model != nullptr;
    const auto commands = runs ? list_commands(*model) : std::vector<TypeCommands>{};
    const auto plugins = world ? list_plugins(*world, model.get(), diagnostics) : std::vector<PluginReport>{};
    if (options.json) {
        nlohmann::json report =
            world ? to_json(take_census(*world, model.get()), *world) : nlohmann::json{{"file", file}};
        report["runs"] = runs;
        report["commands"] = to_json(commands);
        report["plugins"] = to_json(plugins);
        if (options.names && runs) report["names"] = to_json(list_names(*model, *world));
        report["errors"] = diagnostics.count(Severity::kError);
        report["warnings"] = diagnostics.count(Severity::kWarning);
        report["diagnostics"] = to_json(diagnostics);
        reports.push_back(std::move(report));
    } else {
        if (world) print_text(*world, take_census(*world, model.get()));
        if (options.names && runs) say("{}", to_text(list_names(*model, *world)));
        print_text(commands);
        if (world) print_text(plugins, world->file);
        print_text(diagnostics, options.all);
        if (runs && options.controllers) print_notices(*options.controllers, *model);
        if (diagnostics.has_errors())
            say("{}\n", runs ? "`roboss run` leaves out the models with errors, or refuses with --strict"
                             : "`roboss run` refuses this world");
    }
    return !world || diagnostics.has_errors() ? kBadInput : kSuccess;
}

/// Checks all files. One prints its report, several print one after the other, as JSON a list.
int check_all(const CheckOptions& options) {
    int worst = kSuccess;
    nlohmann::json reports = nlohmann::json::array();
    for (const std::string& world : options.worlds) {
        if (options.worlds.size() > 1 && !options.json)
            say("{}== {}\n", world == options.worlds.front() ? "" : "\n", world);
        const Result<std::string> file = world_file(world);
        if (!file) return print(file.error()), kBadInput;
        worst = std::max(worst, check(file.value(), options, reports));
    }
    const nlohmann::json& printed = reports.size() == 1 ? reports.front() : reports;
    if (options.json) say("{}\n", printed.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    return worst;
}

}  // namespace

void add_check_command(CLI::App& app, int& exit_code) {
    auto options = std::make_shared<CheckOptions>();
    CLI::App* command =
        app.add_subcommand("check", "report what a world file holds and what is wrong with it");
    command->footer(kHelp);
    command->add_option("world", options->worlds, "world files: SDFormat, URDF or MJCF")
        ->required()
        ->type_name("WORLD");
    command
        ->add_option("--path", options->paths,
                     "folder in which model://, package:// and relative URIs are looked up (may be repeated)")
        ->type_name("DIR")
        ->take_all();
    command->add_flag("--ground", options->bare.ground, "as of `roboss run`: add a ground plane at z = 0");
    command
        ->add_option("--fixed-base", options->bare.fixed_base,
                     "as of `roboss run`: fix the base of this model to the world (may be repeated)")
        ->take_all();
    command->add_flag("--on-ground", options->on_ground,
                      "as of `roboss run`: stand the robots on the ground below them");
    command
        ->add_option("--keyframe", options->keyframe, "as of `roboss run`: start an MJCF file at this <key>")
        ->type_name("NAME");
    add_controllers_option(*command, "--ros2-controllers", options->controllers);
    command->add_flag("--all", options->all, "print every finding (default: one of those that are alike)");
    command->add_flag(
        "--names", options->names,
        "also print the names of all robots, links, joints, sensors and commands, as orders and "
        "programs spell them, and the links that frames are fixed to");
    command->add_flag("--json", options->json,
                      "print JSON instead of text: an object, or a list for several files");
    command->callback([options, &exit_code] { exit_code = check_all(*options); });
}

}  // namespace roboss
