// See plugin_conversion.h.
#include "sdf/plugin_conversion.h"

#include <cctype>
#include <sstream>

#include "sdf/comms.h"
#include "sdf/crumb_conversion.h"
#include "sdf/environment.h"
#include "sdf/event_conversion.h"
#include "sdf/parameter_reader.h"
#include "sdf/plugin_sensors.h"
#include "sdf/slip_map.h"

namespace roboss::sdf_import {
namespace {

/// Gazebo's plugins that need nothing here: they draw, record, or are what every run does anyway. "gz::sim"
/// says which models are performers and what to load by distance.
constexpr const char* kNotNeeded =
    "Physics|UserCommands|SceneBroadcaster|Sensors|Imu|Contact|Altimeter|AirPressure|AirSpeed|NavSat|"
    "Magnetometer|ForceTorque|LogicalCamera|CpuLidar|LogRecord|LogPlayback|CameraVideoRecorder|LensFlare|"
    "Label|Thermal|ThermalSensor|ParticleEmitter|ParticleEmitter2|ModelPhotoShoot|ColladaWorldExporter|"
    "VisibilityRenderPlugin|ShaderParam|RenderEngineServerHeadless|sim|gazebo";
constexpr const char* kNotNeededFiles =
    "physics-system|user-commands-system|scene-broadcaster-system|sensors-system|imu-system|contact-system|"
    "altimeter-system|air-pressure-system|air-speed-system|navsat-system|magnetometer-system|"
    "forcetorque-system|logical-camera-system|cpu-lidar-system|log-system|camera-video-recorder-system|"
    "lens-flare-system|label-system|thermal-system|thermal-sensor-system|particle-emitter-system|"
    "particle-emitter2-system|model-photo-shoot-system|collada-world-exporter-system|shader-param-system";

/// Removes `prefix` with an optional number behind it ("gz-sim8-"); false: it is not there.
bool remove_prefix(std::string& text, std::string_view prefix) {
    if (!text.starts_with(prefix)) return false;
    std::size_t end = prefix.size();
    while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end])) != 0) ++end;
    if (end >= text.size() || text[end] != '-') return false;
    text.erase(0, end + 1);
    return true;
}

/// Parameters of the kind that the plugin asks for, with their defaults.
std::optional<OnboardParameters> parameters_for(const PluginName& name) {
    std::optional<OnboardParameters> found;
    for_each_onboard_kind([&]<class Kind>(std::in_place_type_t<Kind> type) {
        if (is_named(name, Kind::kKind.classes, Kind::kKind.files)) found = OnboardParameters(type);
    });
    return found;
}

std::vector<std::string> links_of(const Element& model, const std::string& scope) {
    std::vector<std::string> links;
    for (const auto link : model.node.children("link"))
        links.push_back(scope + link.attribute("name").value());
    return links;
}

/// Tells a controller of the joints of the plugin's own model that can move, and of its links, if it asks.
void use_model(const Element& plugin, const std::string& scope, OnboardParameters& parameters) {
    const Element model{plugin.source, plugin.node.parent()};
    std::vector<std::string> joints;
    for (const auto joint : plugin.node.parent().children("joint"))
        if (std::string_view(joint.attribute("type").value()) != "fixed")
            joints.push_back(scope + name_of_joint(joint));
    std::visit(
        [&](auto& spec) {
            if constexpr (requires { spec.use_model(joints); }) spec.use_model(joints);
            if constexpr (requires { spec.use_parts(scope, joints, joints); })
                spec.use_parts(scope, joints, links_of(model, scope));
        },
        parameters);
    if (auto* crumbs = std::get_if<BreadcrumbsSpec>(&parameters)) crumbs->crumb = name_of_crumb(plugin);
}

/// Gazebo logs what is wrong with a plugin and does not run it; the model stays.
void pass_on(const Diagnostics& found, const Import& import) {
    for (const Diagnostic& d : found.items()) {
        Diagnostic each = d;
        if (each.severity == Severity::kError) each.severity = Severity::kWarning;
        import.diagnostics().add(std::move(each));
    }
}

}  // namespace

bool is_named(const PluginName& name, const char* classes, const char* files) {
    if (!name.class_name.empty()) return is_one_of(classes, name.class_name);
    return !name.file.empty() && is_one_of(files, name.file);
}

ExtensionElement kept_element(const Element& element, const std::string& scope) {
    std::ostringstream text;
    element.node.print(text, "", pugi::format_raw);
    ExtensionElement kept;
    kept.name = element.node.name(), kept.text = std::move(text).str(), kept.where = element.where();
    const std::string file = element.node.attribute("filename").value();
    kept.plugin = element.name().find("::") == std::string::npos && !file.empty() ? file : element.name();
    kept.parent = element.node.parent().name();
    for (auto at = element.node.parent(); at && at.attribute("name"); at = at.parent()) {
        if (is_one_of("model|world|include|actor", at.name())) break;
        kept.owner = at.attribute("name").value() + (kept.owner.empty() ? "" : "::" + kept.owner);
    }
    kept.owner = scope + kept.owner;
    if (kept.owner.ends_with("::")) kept.owner.resize(kept.owner.size() - 2);
    return kept;
}

PluginName plugin_name(const Element& plugin) {
    PluginName name;
    const std::string written = plugin.name();
    if (const std::size_t at = written.rfind("::"); at != std::string::npos)
        name.class_name = written.substr(at + 2);
    name.file = plugin.node.attribute("filename").value();
    if (const std::size_t slash = name.file.rfind('/'); slash != std::string::npos)
        name.file.erase(0, slash + 1);
    if (name.file.starts_with("lib")) name.file.erase(0, 3);
    if (const std::size_t at = name.file.find(".so"); at != std::string::npos) name.file.erase(at);
    if (!remove_prefix(name.file, "gz-sim")) remove_prefix(name.file, "ignition-gazebo");
    return name;
}

void convert_plugin(const Element& plugin, const std::string& scope, const Import& import,
                    std::vector<OnboardSpec>& onboard, std::vector<ExtensionElement>& kept) {
    ExtensionElement& record = kept.emplace_back(kept_element(plugin, scope));
    const PluginName name = plugin_name(plugin);
    const std::string called =
        plugin.name().empty() ? plugin.node.attribute("filename").value() : plugin.name();
    if (is_one_of(kNotNeeded, name.class_name) || is_one_of(kNotNeededFiles, name.file)) {
        record.fate = PluginFate::kNotNeeded;
        return;
    }
    if (is_one_of(kEventPlugins, name.class_name) || is_environment_plugin(name) || is_comms_plugin(name))
        return;  // convert_events(), convert_environment(), convert_comms() do, when all models are known
    std::optional<OnboardParameters> parameters = parameters_for(name);
    if (!parameters && is_sensor_plugin(name)) {
        record.fate = PluginFate::kRuns;  // see convert_plugin_sensors()
        return;
    }
    if (!parameters) {
        record.reason = "RoBOSS has no counterpart of it";
        import.diagnostics().note(plugin.where(), "plugin", "plugin '" + called + "' is not run",
                                  "docs/plugins.md lists the plugins that run. Drive the robot from a Client "
                                  "program instead.");
        return;
    }
    Diagnostics found;
    const Import local{import.paths, ElementReader(found), import.files,
                       import.looks, import.dt_s,          import.max_contacts};
    OnboardSpec spec{called, std::move(*parameters), plugin.where()};
    visit_parameters(spec.parameters, ParameterReader{plugin, scope, local});
    report_ignored(plugin, spec.kind().ignored, spec.kind().phrase, local);
    use_model(plugin, scope, spec.parameters);
    if (auto* slip = std::get_if<LookupWheelSlipSpec>(&spec.parameters)) read_slip_map(plugin, local, *slip);
    const bool unreadable = found.has_errors();
    pass_on(found, import);
    const std::vector<OnboardProblem> problems = problems_of(spec);
    for (const OnboardProblem& problem : problems)
        import.diagnostics().warning(plugin.where(), "plugin-not-run",
                                     "plugin '" + called + "' " + problem.text + "; it is not run",
                                     problem.remedy);
    if (unreadable)
        import.diagnostics().warning(
            plugin.where(), "plugin-not-run",
            "plugin '" + called + "' has elements that cannot be read; it is not run",
            "Correct the values named above.");
    if (unreadable || !problems.empty()) {
        record.reason = problems.empty() ? "it has elements that cannot be read" : problems.front().text;
        return;
    }
    record.fate = PluginFate::kRuns;
    for (OnboardParameters& part : parts_of(spec.parameters))
        onboard.push_back({called, std::move(part), plugin.where()});
}

void convert_gripper(const Element& gripper, const Element& link, const std::string& scope,
                     const Import& import, std::vector<OnboardSpec>& onboard) {
    GripperSpec parameters;
    GripperSpec::parameters(ParameterReader{gripper, scope, import}, parameters);
    parameters.link = {scope + link.name()};
    parameters.name = gripper.name();
    OnboardSpec spec{"gripper of " + link.name(), parameters, gripper.where()};
    for (const OnboardProblem& problem : problems_of(spec))
        import.diagnostics().error(gripper.where(), "bad-gripper",
                                   "<roboss:gripper> of link '" + link.name() + "' " + problem.text,
                                   problem.remedy);
    onboard.push_back(std::move(spec));
}

}  // namespace roboss::sdf_import
