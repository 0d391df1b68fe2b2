// Sensors: the elements that each kind names for its parameters (src/sensor_kinds), read into them.
#include <cstring>

#include "sdf/parameter_reader.h"

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
    return std::strcmp(sensor.node.name(), "roboss:sensor") == 0;
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
    else
        import.diagnostics().warning(
            sensor.where(), "sensor-to-come",
            "sensors of type '" + spec.sdf_type + "' are still to come; they measure nothing");
}

SensorParameters read_parameters(const Element& sensor, const SensorSpec& spec, const std::string& scope,
                                 const Import& import) {
    const bool ours = is_ours(sensor);
    SensorParameters parameters = parameters_of_kind([&](const SensorKind& kind) {
        return kind.ours == ours && is_one_of(kind.sdf_types, spec.sdf_type);
    });
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
    const ParameterReader reader{block, scope, import};
    visit_parameters(parameters, reader);
    report_ignored(block, kind.ignored, kind.phrase, import);
    return parameters;
}

}  // namespace

SensorSpec convert_sensor(const Element& sensor, const Pose& X_LS, const std::string& scope,
                          const Import& import) {
    SensorSpec spec;
    spec.name = sensor.name();
    spec.sdf_type = sensor.node.attribute("type").value();
    spec.where = sensor.where();
    spec.X_LS = X_LS;
    spec.update_rate_hz = import.reader.number(sensor, "update_rate", 0);
    if (sensor.child("topic")) spec.topic = sensor.text("topic");
    if (sensor.child("contact").child("topic")) spec.topic = sensor.child("contact").text("topic");
    spec.parameters = read_parameters(sensor, spec, scope, import);
    return spec;
}

}  // namespace roboss::sdf_import
