// See plugin_sensors.h.
#include "sdf/plugin_sensors.h"

#include <algorithm>

#include "sdf/parameter_reader.h"

namespace roboss::sdf_import {
namespace {

bool stands_for(const SensorKind& kind, const PluginName& name) {
    return is_named(name, kind.plugin.classes, kind.plugin.files);
}

/// Whether the kind reads the memory of a controller.
template <class Kind>
constexpr bool kReadsController = requires(Kind spec) {
    spec.controller = 0;
};

/// Whether there is such a sensor only if its topic is written.
template <class Kind>
constexpr bool kAsksForIt = std::is_same_v<Kind, TrackOdometrySpec>;

/// Calls visit(std::in_place_type<Kind>) for each kind of sensor that measures.
template <class Visit>
void for_each_kind(Visit&& visit) {
    [&]<class... Kinds>(std::in_place_type_t<std::variant<UnsupportedSensor, Kinds...>>) {
        (visit(std::in_place_type<Kinds>), ...);
    }(std::in_place_type<SensorParameters>);
}

/// Text of the first of "a|b" that is written.
std::string text_of(const Element& plugin, const char* path) {
    if (*path == '\0') return {};
    const auto [parent, name] = place_of(plugin, path);
    return trimmed(parent.child(name.c_str()).node.text().get());
}

/// The topic without "/" and "model/NAME/".
std::string sensor_name(const Element& plugin, const PublishingPlugin& source) {
    return channel_of(text_of(plugin, source.topic), source.usual_topic, {}).name;
}

double rate_of(const Element& plugin, const PublishingPlugin& source, const Import& import) {
    if (*source.rate == '\0') return source.usual_rate_hz;
    const auto [parent, name] = place_of(plugin, source.rate);
    const double usual = name == "update_rate" || name == "updateRate" ? 0 : source.usual_rate_hz;
    return std::max(0.0, import.reader.number(parent, name.c_str(), usual));
}

/// What a kind derives from its parameters: its name, and its place in the model's frame.
void use_parameters(PluginSensor& sensor) {
    std::visit(
        [&](const auto& spec) {
            if constexpr (requires { spec.sensor_name(); }) sensor.spec.name = spec.sensor_name();
            if constexpr (requires { spec.X_RM; }) sensor.spec.X_LS = spec.X_RM;
        },
        sensor.spec.parameters);
}

/// Reads a sensor of this kind from `block`, the plugin or one of its elements; problems become warnings, as
/// with Gazebo, and then there is no sensor.
std::optional<PluginSensor> read_sensor(const Element& plugin, const Element& block, const std::string& scope,
                                        SensorParameters parameters, const Import& import) {
    Diagnostics found;
    const Import local{import.paths, ElementReader(found), import.files,
                       import.looks, import.dt_s,          import.max_contacts};
    PluginSensor sensor;
    sensor.spec.parameters = std::move(parameters);
    sensor.spec.sdf_type = "plugin", sensor.spec.where = plugin.where();
    const SensorKind& kind = sensor.spec.kind();
    PluginFacts facts{plugin_name(plugin).file, scope, text_of(plugin, "body_name|bodyName")};
    if (!facts.body.empty()) facts.body = scope + facts.body;
    sensor.link = facts.body;
    std::visit(
        [&](auto& spec) {
            if constexpr (requires { spec.use_plugin(facts); }) spec.use_plugin(facts);
        },
        sensor.spec.parameters);
    visit_parameters(sensor.spec.parameters, ParameterReader{block, scope, local});
    report_ignored(block, kind.ignored, kind.phrase, local);
    sensor.spec.name = sensor_name(plugin, kind.plugin);
    sensor.spec.topic = channel_of(text_of(plugin, kind.plugin.topic), kind.plugin.usual_topic, {}).topic;
    sensor.spec.ros_topic = text_of(plugin, kind.plugin.topic);
    sensor.spec.ros_frame = text_of(plugin, "frame_id|odometry_frame|odometryFrame|odom_frame");
    sensor.spec.update_rate_hz = rate_of(plugin, kind.plugin, local);
    use_parameters(sensor);
    for (const SensorProblem& problem : problems_of(sensor.spec))
        found.error(plugin.where(), "bad-sensor", "plugin '" + plugin.name() + "' " + problem.text,
                    problem.remedy);
    const bool broken = found.has_errors();
    for (Diagnostic d : found.items()) {
        if (d.severity == Severity::kError) d.severity = Severity::kWarning;
        import.diagnostics().add(std::move(d));
    }
    if (broken) return std::nullopt;
    return sensor;
}

/// How many controllers of the last one's kind stand before it.
int place_among_its_kind(std::span<const OnboardSpec> onboard) {
    const std::uint32_t number = onboard.back().kind().number;
    return static_cast<int>(std::ranges::count_if(
               onboard, [&](const OnboardSpec& spec) { return spec.kind().number == number; })) -
           1;
}

}  // namespace

bool is_sensor_plugin(const PluginName& name) {
    bool found = false;
    for_each_kind([&]<class Kind>(std::in_place_type_t<Kind>) {
        if constexpr (!kReadsController<Kind>) found |= stands_for(Kind::kKind, name);
    });
    return found;
}

std::vector<PluginSensor> convert_plugin_sensors(const Element& plugin, const std::string& scope,
                                                 std::span<const OnboardSpec> onboard, bool controls,
                                                 const Import& import) {
    std::vector<PluginSensor> sensors;
    const PluginName name = plugin_name(plugin);
    const auto add_from = [&](const Element& block, SensorParameters parameters) {
        if (auto sensor = read_sensor(plugin, block, scope, std::move(parameters), import))
            sensors.push_back(std::move(*sensor));
    };
    const auto add = [&](const SensorParameters& parameters) {
        const char* const element =
            std::visit([](const auto& p) { return p.kKind.plugin.element; }, parameters);
        if (*element == '\0') return add_from(plugin, parameters);
        for (const auto node : plugin.node.children(element)) add_from({plugin.source, node}, parameters);
    };
    for_each_kind([&]<class Kind>(std::in_place_type_t<Kind>) {
        if constexpr (!kReadsController<Kind>) {
            if (stands_for(Kind::kKind, name)) add(Kind{});
        } else if (controls) {
            Kind spec;
            spec.controller = place_among_its_kind(onboard);
            const OnboardKind& controller = onboard.back().kind();
            if constexpr (requires { spec.controller_kind = 0; }) {
                spec.controller_kind = static_cast<int>(controller.number);
                if (controller.odometry >= 0) add(spec);
            } else if (stands_for(Kind::kKind, name)) {
                if (!kAsksForIt<Kind> || !text_of(plugin, Kind::kKind.plugin.topic).empty()) add(spec);
            }
        }
    });
    return sensors;
}

void attach_plugin_sensor(PluginSensor sensor, const std::string& canonical_link, const Pose& X_MS,
                          const Import& import, ModelSpec& model) {
    const std::string& wanted = sensor.link.empty() ? canonical_link : sensor.link;
    const auto link = std::ranges::find(model.links, wanted, &LinkSpec::name);
    if (link == model.links.end()) {
        import.diagnostics().warning(sensor.spec.where, "plugin-not-run",
                                     "a plugin of model '" + model.name + "' observes the link '" + wanted +
                                         "', which the model does not have",
                                     "Correct the name.");
        return;
    }
    if (sensor.link.empty()) sensor.spec.X_LS = inverse(link->X_ML) * X_MS * sensor.spec.X_LS;
    const std::string name = sensor.spec.name;
    const auto is_taken = [&] {
        return std::ranges::any_of(model.links, [&](const LinkSpec& other) {
            return std::ranges::find(other.sensors, sensor.spec.name, &SensorSpec::name) !=
                   other.sensors.end();
        });
    };
    for (int k = 2; is_taken(); ++k) sensor.spec.name = name + "_" + std::to_string(k);
    link->sensors.push_back(std::move(sensor.spec));
}

}  // namespace roboss::sdf_import
