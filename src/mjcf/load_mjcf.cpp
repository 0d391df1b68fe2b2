// The straight path: settings, classes, assets, bodies, robots, what acts between and on them, validation.
#include "mjcf/load_mjcf.h"

#include <algorithm>
#include <filesystem>

#include "mjcf/actuators.h"
#include "mjcf/equalities.h"
#include "mjcf/keyframe.h"
#include "mjcf/robots.h"
#include "mjcf/sensors.h"
#include "mjcf/sub_models.h"
#include "mjcf/unread.h"

namespace roboss {
namespace {

using namespace mjcf;

/// Whether it has elements that are left out and would make bodies.
bool makes_bodies(const Document& document, const Element& parent) {
    return std::ranges::any_of(document.children(parent), [&](const Element& element) {
        const std::string name = element.node.name();
        return name == "composite" || name == "flexcomp" || makes_bodies(document, element);
    });
}

World empty_world(const Document& document, const Settings& settings) {
    World world;
    world.file = document.path();
    world.name = document.root().node.attribute("model").as_string(
        std::filesystem::path(document.path()).stem().string().c_str());
    world.gravity = settings.gravity;
    world.magnetic_field_T = settings.magnetic;
    world.dt_s = settings.timestep;
    world.sleep = settings.sleep;
    return world;
}

}  // namespace

std::optional<World> load_mjcf(std::unique_ptr<xml::SourceFile> file, const MjcfOptions& options,
                               Diagnostics& diagnostics) {
    const Document document(std::move(file), diagnostics);
    report_unread(document, diagnostics);
    const Settings settings = read_settings(document, diagnostics);
    const Defaults defaults(document, diagnostics);
    Assets assets(document, defaults, settings, options.search_paths, diagnostics);
    const Severity unknown = makes_bodies(document, document.root()) ? Severity::kWarning : Severity::kError;
    SubModels sub_models(settings, options.search_paths, diagnostics);
    const Reading reading{document,    defaults, settings, assets, sub_models, options.looks,
                          diagnostics, unknown,  {},       false,  false,      {}};
    std::vector<Reading> parts;
    Tree tree = read_tree(reading, parts);
    read_contact_pairs(tree, parts);
    Robots robots(tree, tied_bodies(tree, parts), reading);
    read_contact_excludes(robots, parts);
    read_equalities(robots, parts);
    read_actuators(robots, parts);
    read_sensors(robots, parts);
    start_at_keyframe(options.keyframe, document, robots, diagnostics);
    World world = empty_world(document, settings);
    robots.move_to(world);
    if (diagnostics.refuses()) return std::nullopt;
    if (world.instances.empty())
        diagnostics.note(document.root().where(), "no-model",
                         "the file has no bodies and no geoms: nothing is there",
                         "Load the file that includes it.");
    validate(world, diagnostics);
    return world;
}

}  // namespace roboss
