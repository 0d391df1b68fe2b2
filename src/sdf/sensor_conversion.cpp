// Sensors: the elements that each kind names for its parameters (src/sensor_kinds), read into them.
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "sdf/conversion.h"

namespace roboss::sdf_import {
namespace {

/// <noise type="gaussian"> or, as older files write it, <noise><type>gaussian</type>.
NoiseSpec read_noise(const Element& noise, const Import& import) {
    NoiseSpec spec;
    if (!noise) return spec;
    std::string type = noise.node.attribute("type").value();
    if (type.empty()) type = noise.text("type");
    if (type == "none") return spec;
    if (!type.empty() && type != "gaussian" && type != "gaussian_quantized") {
        import.diagnostics().warning(noise.where(), "noise",
                                     "noise of type '" + type + "' is not known; there is none",
                                     "Use gaussian or gaussian_quantized.");
        return spec;
    }
    const ElementReader& reader = import.reader;
    spec.mean = reader.number(noise, "mean", 0);
    spec.stddev = reader.number(noise, "stddev", 0);
    spec.bias_mean = reader.number(noise, "bias_mean", 0);
    spec.bias_stddev = reader.number(noise, "bias_stddev", 0);
    if (type == "gaussian_quantized") spec.precision = reader.number(noise, "precision", 0);
    if (reader.number(noise, "dynamic_bias_stddev", 0) != 0) {
        import.diagnostics().note(noise.where(), "noise",
                                  "a bias that drifts (<dynamic_bias_stddev>) is still to come");
    }
    return spec;
}

/// Calls found(part) for each part of "a|b|c".
template <class Found>
void for_each_part(std::string_view text, char separator, Found&& found) {
    while (!text.empty()) {
        const std::size_t end = text.find(separator);
        found(std::string(text.substr(0, end)));
        text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    }
}

bool is_one_of(std::string_view names, const std::string& name) {
    bool found = false;
    for_each_part(names, '|', [&](const std::string& one) { found |= one == name; });
    return found;
}

/// The element that holds the parameters of a sensor of this kind; none if it is not written.
Element block_of(const Element& sensor, const SensorKind& kind) {
    if (*kind.block == '\0') return sensor;
    Element block;
    for_each_part(kind.block, '|', [&](const std::string& name) {
        if (!block) block = sensor.child(name.c_str());
    });
    return block;
}

/// Reads the elements of a sensor's parameters. What is not written keeps its value.
struct ParameterReader {
    const Element& block;
    const std::string& scope;
    const Import& import;

    void operator()(const Parameter& p, double& value) const {
        const auto [parent, name] = place_of(p.element);
        const Finite finite = p.infinite ? Finite::kInfinityAllowed : Finite::kRequired;
        value = std::strcmp(p.unit, "rad") == 0 ? import.reader.angle(parent, name.c_str(), value)
                                                : import.reader.number(parent, name.c_str(), value, finite);
    }
    void operator()(const Parameter& p, int& value) const {
        const auto [parent, name] = place_of(p.element);
        value = import.reader.integer(parent, name.c_str(), value);
    }
    void operator()(const Parameter& p, NoiseSpec& noise) const {
        const auto [parent, name] = place_of(p.element);
        noise = read_noise(parent.child(name.c_str()), import);
    }
    void operator()(const Parameter& p, JointNames& joints) const {
        const auto [parent, name] = place_of(p.element);
        for (const auto joint : parent.node.children(name.c_str()))
            joints.push_back(scope + joint.text().get());
    }

    /// The element that holds the last one of a path, and the last one's name.
    std::pair<Element, std::string> place_of(const char* path) const {
        Element parent = block;
        std::string name;
        for_each_part(path, '/', [&](const std::string& part) {
            if (!name.empty()) parent = parent.child(name.c_str());
            name = part;
        });
        return {parent, name};
    }
};

bool is_neutral(const std::string& text, std::string_view neutral) {
    const std::optional<double> number = parse_number(text);
    bool found = false;
    for_each_part(neutral, '|', [&](const std::string& value) {
        found |= value == text || (number && number == parse_number(value));
    });
    return found;
}

void report_ignored(const ParameterReader& reader, const SensorKind& kind) {
    for (const IgnoredElement& ignored : kind.ignored) {
        const auto [parent, name] = reader.place_of(ignored.element);
        const Element element = parent.child(name.c_str());
        if (!element || is_neutral(element.node.text().get(), ignored.neutral)) continue;
        reader.import.diagnostics().note(
            element.where(), "ignored-element",
            "<" + name + "> of " + kind.phrase + " has no effect: " + ignored.why, ignored.remedy);
    }
}

bool is_ours(const Element& sensor) {
    return std::strcmp(sensor.node.name(), "roboss:sensor") == 0;
}

/// "a or b": the types of <roboss:sensor>.
std::string own_types() {
    std::string types;
    (void)parameters_of_kind([&](const SensorKind& kind) {
        if (kind.ours) types += (types.empty() ? "" : " or ") + std::string(kind.sdf_types);
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
    report_ignored(reader, kind);
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
    spec.parameters = read_parameters(sensor, spec, scope, import);
    return spec;
}

}  // namespace roboss::sdf_import
