// See parameter_reader.h.
#include "sdf/parameter_reader.h"

#include <cstring>
#include <optional>

namespace roboss::sdf_import {
namespace {

bool is_neutral(const std::string& text, std::string_view neutral) {
    const std::optional<double> number = parse_number(text);
    bool found = false;
    for_each_part(neutral, '|', [&](const std::string& value) {
        found |= value == text || (number && number == parse_number(value));
    });
    return found;
}

}  // namespace

bool is_one_of(std::string_view names, const std::string& name) {
    bool found = false;
    for_each_part(names, '|', [&](const std::string& one) { found |= one == name; });
    return found;
}

std::pair<Element, std::string> place_of(const Element& block, const char* paths) {
    std::optional<std::pair<Element, std::string>> first, written;
    for_each_part(paths, '|', [&](const std::string& path) {
        Element parent = block;
        std::string name;
        for_each_part(path, '/', [&](const std::string& part) {
            if (!name.empty()) parent = parent.child(name.c_str());
            name = part;
        });
        if (!first) first = {parent, name};
        if (!written && parent && parent.child(name.c_str())) written = {parent, name};
    });
    if (written) return *written;
    return first.value_or(std::pair<Element, std::string>{});  // a parameter without an element
}

void report_ignored(const Element& block, std::span<const IgnoredElement> ignored, const char* phrase,
                    const Import& import) {
    for (const IgnoredElement& one : ignored) {
        const auto [parent, name] = place_of(block, one.element);
        const Element element = parent.child(name.c_str());
        if (!element || is_neutral(element.node.text().get(), one.neutral)) continue;
        import.diagnostics().note(element.where(), "ignored-element",
                                  "<" + name + "> of " + phrase + " has no effect: " + one.why, one.remedy);
    }
}

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
    spec.dynamic_bias_stddev = reader.number(noise, "dynamic_bias_stddev", 0);
    spec.dynamic_bias_correlation_time = reader.number(noise, "dynamic_bias_correlation_time", 0);
    if (spec.dynamic_bias_stddev != 0 && spec.dynamic_bias_correlation_time == 0)
        import.diagnostics().note(noise.child("dynamic_bias_stddev").where(), "noise",
                                  "<dynamic_bias_stddev> has no effect without a correlation time",
                                  "Write <dynamic_bias_correlation_time> in s.");
    return spec;
}

void ParameterReader::read(const Parameter& p, const Element& parent, const std::string& name,
                           double& value) const {
    const Finite finite = p.infinite ? Finite::kInfinityAllowed : Finite::kRequired;
    value = std::strcmp(p.unit, "rad") == 0 ? import.reader.angle(parent, name.c_str(), value)
                                            : import.reader.number(parent, name.c_str(), value, finite);
}
void ParameterReader::read(const Parameter&, const Element& parent, const std::string& name,
                           int& value) const {
    value = import.reader.integer(parent, name.c_str(), value);
}
void ParameterReader::read(const Parameter&, const Element& parent, const std::string& name,
                           bool& value) const {
    value = import.reader.boolean(parent, name.c_str(), value);
}
void ParameterReader::read(const Parameter&, const Element& parent, const std::string& name,
                           std::string& value) const {
    if (name[0] == '@') {  // an attribute
        if (const auto written = parent.node.attribute(name.c_str() + 1)) value = trimmed(written.value());
        return;
    }
    if (const Element element = parent.child(name.c_str())) value = trimmed(element.node.text().get());
}
void ParameterReader::read(const Parameter&, const Element& parent, const std::string& name,
                           Vec3& value) const {
    value = import.reader.vector(parent, name.c_str(), value);
}
void ParameterReader::read(const Parameter&, const Element& parent, const std::string& name,
                           Pose& value) const {
    if (const Element element = parent.child(name.c_str())) value = import.reader.pose(element);
}
void ParameterReader::read(const Parameter&, const Element& parent, const std::string& name,
                           NoiseSpec& value) const {
    value = read_noise(parent.child(name.c_str()), import);
}
void ParameterReader::read(const Parameter&, const Element& parent, const std::string& name,
                           JointNames& value) const {
    read_names(parent, name, value);
}
void ParameterReader::read(const Parameter&, const Element& parent, const std::string& name,
                           LinkNames& value) const {
    read_names(parent, name, value);
}
void ParameterReader::read(const Parameter&, const Element& parent, const std::string& name,
                           std::vector<std::string>& value) const {
    if (!parent) return;
    for (const auto node : parent.node.children(name.c_str()))
        for_each_part(node.text().get(), ',', [&](const std::string& part) {
            if (std::string one = trimmed(part); !one.empty()) value.push_back(std::move(one));
        });
}
void ParameterReader::read(const Parameter&, const Element& parent, const std::string& name,
                           std::vector<double>& value) const {
    if (!parent) return;
    for (const auto node : parent.node.children(name.c_str())) {
        for (const auto word : words_of(node.text().get())) {
            const auto number = parse_number(word);
            if (number) {
                value.push_back(*number);
                continue;
            }
            import.diagnostics().error(parent.source->where(node), "bad-value",
                                       "<" + name + "> is '" + node.text().get() + "', which is not numbers",
                                       "Write numbers with decimal points.");
            break;
        }
    }
}

void ParameterReader::read_attribute(const char* name, std::vector<std::string>& names) const {
    if (std::string one = trimmed(block.node.attribute(name).value()); !one.empty())
        names.push_back(scope + one);
}

void ParameterReader::read_names(const Element& parent, const std::string& name,
                                 std::vector<std::string>& names) const {
    if (!parent) return;
    for (const auto node : parent.node.children(name.c_str()))
        if (std::string one = trimmed(node.text().get()); !one.empty()) names.push_back(scope + one);
}

}  // namespace roboss::sdf_import
