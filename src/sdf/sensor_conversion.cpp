// Sensors: the elements that each kind names for its parameters (src/sensor_kinds), read into them.
#include <cstring>

#include "sdf/parameter_reader.h"
#include "sdf/plugin_conversion.h"
#include "sdf/sensor_names.h"

namespace roboss::sdf_import {
namespace {

/// The element that holds the parameters of a sensor of this kind; none if it is not written.
Element block_of(const Element& sensor, const SensorKind& kind) {
    if (*kind.block == '\0') return sensor;
    Element block;
    for_each_part(kind.block, '|', [&](const std::string& name) {
        if (!block) block = sensor.child(name.c_str());
    });
    return block;
}

bool is_ours(const Element& sensor) {
    return std::strncmp(sensor.node.name(), "roboss:", 7) == 0;
}

/// Gazebo's type of a sensor of type "custom": "environmental_sensor/humidity". A <roboss:radio> has none.
std::string sensor_type_of(const Element& sensor) {
    if (std::strcmp(sensor.node.name(), "roboss:radio") == 0) return "radio";
    std::string type = sensor.node.attribute("type").value();
    if (type != "custom") return type;
    for (const char* name : {"gz:type", "ignition:type"})
        if (const auto custom = sensor.node.attribute(name)) return custom.value();
    return type;
}

/// What the name of a custom type says: the column of the table; and what its elements may not say.
void complete(EnvironmentalSpec& spec, const Element& sensor, const std::string& type, const Import& import) {
    const auto check = [&](std::string& value, const char* name, const char* allowed, const char* usual) {
        if (is_one_of(allowed, value)) return;
        import.diagnostics().warning(
            sensor.where(), "sensor",
            "<" + std::string(name) + "> is '" + value + "'; it is taken as " + usual,
            "Use one of " + std::string(allowed) + ".");
        value = usual;
    };
    check(spec.output_format, "output_format", "scalar|vector3", "scalar");
    check(spec.transform_type, "transform_type", "GLOBAL|LOCAL|ADD_VELOCITY_GLOBAL|ADD_VELOCITY_LOCAL",
          "GLOBAL");
    if (const std::size_t slash = type.find('/'); spec.variable.empty() && slash != std::string::npos)
        spec.variable = type.substr(slash + 1);
}

constexpr const char* kLenses = "gnomonical|stereographic|equidistant|equisolid_angle|orthographic|custom";

/// A lens that is not known draws nothing in Gazebo, but costs it no model.
void complete_lens(SensorParameters& parameters, const Element& camera, const Import& import) {
    const auto mend = [&](auto& spec) {
        if constexpr (requires { spec.optics.lens; }) {
            std::string& lens = spec.optics.lens;
            if (is_one_of(kLenses, lens)) return;
            import.diagnostics().warning(
                camera.child("lens").where(), "sensor",
                "a lens of <type> '" + lens + "' is not known; it is taken as gnomonical",
                "Use one of " + std::string(kLenses) + ".");
            lens = "gnomonical";
        }
    };
    std::visit(mend, parameters);
}

/// Formats of pixels that are not kept, and what stands beside the block: the ThermalSensor plugin.
void complete_camera(SensorParameters& parameters, const Element& sensor, const Element& camera,
                     const Import& import) {
    std::string* format = nullptr;
    if (auto* color = std::get_if<ColorCameraSpec>(&parameters)) format = &color->format;
    if (auto* rgbd = std::get_if<RgbdCameraSpec>(&parameters)) format = &rgbd->format;
    if (format != nullptr && !is_one_of("R8G8B8|RGB_INT8|B8G8R8|BGR_INT8|L8|L_INT8|RGB_INT32|", *format) &&
        !format->empty()) {
        import.diagnostics().warning(
            camera.child("image").where(), "sensor",
            "images of <format> '" + *format + "' are not made; it is taken as R8G8B8",
            "Use R8G8B8, B8G8R8 or L8.");
        *format = "R8G8B8";
    }
    complete_lens(parameters, camera, import);
    auto* thermal = std::get_if<ThermalCameraSpec>(&parameters);
    if (thermal == nullptr) return;
    for (const auto node : sensor.node.children("plugin")) {
        const Element plugin{sensor.source, node};
        if (!is_named(plugin_name(plugin), "ThermalSensor", "thermal-sensor-system")) continue;
        thermal->min = import.reader.number(plugin, "min_temp", thermal->min);
        thermal->max = import.reader.number(plugin, "max_temp", thermal->max);
        thermal->resolution = import.reader.number(plugin, "resolution", thermal->resolution);
    }
}

/// "a or b": the types of <roboss:sensor>.
std::string own_types() {
    std::string types;
    (void)parameters_of_kind([&](const SensorKind& kind) {
        if (kind.ours && *kind.sdf_types != '\0')
            types += (types.empty() ? "" : " or ") + std::string(kind.sdf_types);
        return false;
    });
    return types;
}

void report_unsupported(const Element& sensor, const SensorSpec& spec, const Import& import) {
    if (is_ours(sensor))
        import.diagnostics().error(
            sensor.where(), "sensor",
            "<roboss:sensor> '" + spec.name + "' has the type '" + spec.sdf_type + "', which is not known",
            "Use " + own_types() + ", or a <sensor> of SDFormat.");
    else if (spec.sdf_type == "multicamera")
        import.diagnostics().warning(
            sensor.where(), "sensor",
            "sensor '" + spec.name + "' has no <camera> element and measures nothing",
            "Add a <camera> with its parameters.");
    else
        import.diagnostics().warning(
            sensor.where(), "sensor-to-come",
            "sensors of type '" + spec.sdf_type + "' are still to come; they measure nothing");
}

/// All parameters of a kind, from the element that holds them.
void read_block(SensorParameters& parameters, const Element& sensor, const Element& block,
                const std::string& scope, const Import& import) {
    visit_parameters(parameters, ParameterReader{block, scope, import});
    const SensorKind& kind =
        std::visit([](const auto& p) -> const SensorKind& { return p.kKind; }, parameters);
    report_ignored(block, kind.ignored, kind.phrase, import);
    complete_camera(parameters, sensor, block, import);
}

/// All but the parameters and the topic.
SensorSpec head_of(const Element& sensor, const Pose& X_LS, const Import& import) {
    SensorSpec spec;
    spec.name = sensor.name();
    spec.sdf_type = sensor_type_of(sensor);
    spec.where = sensor.where();
    spec.X_LS = X_LS;
    spec.update_rate_hz = import.reader.number(sensor, "update_rate", 0);
    return spec;
}

SensorParameters read_parameters(const Element& sensor, const SensorSpec& spec, const std::string& scope,
                                 const Import& import) {
    const bool ours = is_ours(sensor);
    const std::string type = spec.sdf_type.substr(0, spec.sdf_type.find('/'));
    SensorParameters parameters = parameters_of_kind(
        [&](const SensorKind& kind) { return kind.ours == ours && is_one_of(kind.sdf_types, type); });
    if (std::holds_alternative<UnsupportedSensor>(parameters)) {
        report_unsupported(sensor, spec, import);
        return parameters;
    }
    const SensorKind& kind =
        std::visit([](const auto& p) -> const SensorKind& { return p.kKind; }, parameters);
    const Element block = block_of(sensor, kind);
    if (!block && kind.block_required) {
        import.diagnostics().warning(sensor.where(), "sensor",
                                     "sensor '" + spec.name + "' of type '" + spec.sdf_type + "' has no <" +
                                         std::string(kind.block) + "> element and measures nothing",
                                     "Add the element with its parameters.");
        return UnsupportedSensor{};
    }
    read_block(parameters, sensor, block, scope, import);
    if (auto* environmental = std::get_if<EnvironmentalSpec>(&parameters))
        complete(*environmental, sensor, spec.sdf_type, import);
    return parameters;
}

}  // namespace

std::vector<SensorSpec> convert_multicamera(const Element& sensor, const Pose& X_LS, const std::string& scope,
                                            const Import& import) {
    std::vector<SensorSpec> cameras;
    if (sensor_type_of(sensor) != "multicamera") return cameras;
    for (const auto node : sensor.node.children("camera")) {
        const Element camera{sensor.source, node};
        SensorSpec& spec = cameras.emplace_back(head_of(sensor, X_LS, import));
        const std::string own = camera.name().empty() ? std::to_string(cameras.size()) : camera.name();
        spec.name += "/" + own;
        spec.where = camera.where();
        spec.parameters = ColorCameraSpec{};
        read_block(spec.parameters, sensor, camera, scope, import);
    }
    return cameras;
}

SensorSpec convert_sensor(const Element& sensor, const Pose& X_LS, const std::string& scope,
                          const Import& import) {
    SensorSpec spec = head_of(sensor, X_LS, import);
    if (sensor.child("topic")) spec.topic = sensor.text("topic");
    if (sensor.child("contact").child("topic")) spec.topic = sensor.child("contact").text("topic");
    read_ros_names(sensor, spec);
    spec.parameters = read_parameters(sensor, spec, scope, import);
    return spec;
}

}  // namespace roboss::sdf_import
