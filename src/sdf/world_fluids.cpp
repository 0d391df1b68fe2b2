// See world_fluids.h.
#include "sdf/world_fluids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "sdf/parameter_reader.h"
#include "sdf/plugin_conversion.h"

namespace roboss::sdf_import {
namespace {

template <class Spec>
bool asks_for(const PluginName& name) {
    if (!name.class_name.empty()) return is_one_of(Spec::kKind.classes, name.class_name);
    return !name.file.empty() && is_one_of(Spec::kKind.files, name.file);
}

/// Whether read_rest() has read the element of a parameter.
bool is_read(const BuoyancySpec&, const Parameter&) {
    return false;
}
bool is_read(const WindEffectsSpec& spec, const Parameter& parameter) {
    return !spec.regions.empty() && std::string_view(parameter.name) == "scale";
}

/// What only some of the kinds need.
void read_rest(const Element& plugin, std::vector<OnboardProblem>&, BuoyancySpec& spec) {
    spec.graded = static_cast<bool>(plugin.child("graded_buoyancy"));
    for (const auto node : plugin.node.children("enable"))
        for (const std::string_view word : words_of(node.text().get())) spec.enabled.emplace_back(word);
}

/// Numbers of an element; false: it has another count of them, or words.
bool read_numbers(const Element& parent, const char* name, std::span<double> values) {
    const Element element = parent.child(name);
    if (!element) return true;
    const auto words = words_of(element.node.text().get());
    if (words.size() != values.size()) return false;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto number = parse_number(words[i]);
        if (!number || !std::isfinite(*number)) return false;
        values[i] = *number;
    }
    return true;
}

/// A bound on each coordinate from an attribute "x" + `closed` or "x" + `open`; an open one ends at the next
/// number. Both at once cancel out, as in Gazebo.
bool read_bounds(const Element& when, const char* closed, const char* open, double beyond, Vec3& bound) {
    for (std::size_t k = 0; k < 3; ++k) {
        const std::string axis(1, "xyz"[k]);
        const auto at = [&](const char* name) { return when.node.attribute((axis + name).c_str()); };
        if (static_cast<bool>(at(closed)) == static_cast<bool>(at(open))) continue;
        const auto number = parse_number((at(closed) ? at(closed) : at(open)).value());
        if (!number || !std::isfinite(*number)) return false;
        bound[k] = at(closed) ? *number : std::nextafter(*number, beyond);
    }
    return true;
}

/// k (p(x) + q(y) + r(z)), each with the coefficients of x^3, x^2, x and 1; or a number.
bool read_factor(const Element& element, WindRegion& region) {
    const bool is_number =
        !element.node.find_child([](auto node) { return node.type() == pugi::node_element; });
    if (is_number) {
        const auto number = parse_number(element.node.text().get());
        region.constant = number.value_or(0);
        return number && std::isfinite(*number);
    }
    double k = 1;
    if (!read_numbers(element, "k", {&k, 1})) return false;
    constexpr const char* kNames[] = {"px", "qy", "rz"};
    for (std::size_t i = 0; i < 3; ++i) {
        std::array<double, 4> c{};
        if (!read_numbers(element, kNames[i], c)) return false;
        region.cubic[i] = k * c[0], region.square[i] = k * c[1], region.linear[i] = k * c[2];
        region.constant += k * c[3];
    }
    return true;
}

void read_rest(const Element& plugin, std::vector<OnboardProblem>& problems, WindEffectsSpec& spec) {
    const Element scale = plugin.child("force_approximation_scaling_factor");
    if (!scale || !scale.node.find_child([](auto node) { return node.type() == pugi::node_element; })) return;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    bool good = true;
    const auto add = [&](const Element& element) {
        WindRegion& region = spec.regions.emplace_back();
        good = good && read_bounds(element, "ge", "gt", kInfinity, region.lower) &&
               read_bounds(element, "le", "lt", -kInfinity, region.upper) && read_factor(element, region);
    };
    for (const auto node : scale.node.children("when")) add(Element{scale.source, node});
    if (spec.regions.empty()) add(scale);
    if (!good)
        problems.push_back(
            {"has a <force_approximation_scaling_factor> that cannot be read",
             "Write a number, or <when xge=\"0\" zlt=\"5\"> with a number or with <k>, <px>, <qy> "
             "and <rz>; polynomials have four coefficients."});
}

template <class Spec>
void read(const Element& plugin, const Import& import, std::optional<Spec>& target,
          ExtensionElement& record) {
    Diagnostics found;
    const Import local{import.paths, ElementReader(found), import.files,
                       import.looks, import.dt_s,          import.max_contacts};
    Spec spec;
    std::vector<OnboardProblem> problems;
    read_rest(plugin, problems, spec);
    if (problems.empty()) {
        const std::string no_scope;
        const ParameterReader reader{plugin, no_scope, local};
        Spec::parameters(
            [&](const Parameter& parameter, auto& value) {
                if (!is_read(spec, parameter)) reader(parameter, value);
            },
            spec);
        report_ignored(plugin, Spec::kKind.ignored, Spec::kKind.phrase, local);
        spec.check(problems);
    }
    for (Diagnostic d : found.items()) {
        if (d.severity == Severity::kError) {
            d.severity = Severity::kWarning;
            problems.push_back({"has elements that cannot be read", "Correct the values named above."});
        }
        import.diagnostics().add(std::move(d));
    }
    for (const OnboardProblem& problem : problems)
        import.diagnostics().warning(plugin.where(), "plugin-not-run",
                                     "plugin '" + plugin.name() + "' " + problem.text + "; it is not run",
                                     problem.remedy);
    if (!problems.empty()) {
        record.reason = problems.front().text;
        return;
    }
    record.fate = PluginFate::kRuns;
    target = std::move(spec);
}

/// Whether the world's fluids carry what is called `name`.
bool is_enabled(const std::vector<std::string>& enabled, const std::string& name) {
    return enabled.empty() || std::ranges::any_of(enabled, [&](const std::string& e) {
               return name == e || name.starts_with(e + "::");
           });
}

std::vector<bool> floating_links(const World& world, const ModelInstance& instance) {
    std::vector<bool> floats;
    for (const LinkSpec& link : world.prototypes[instance.prototype].links)
        floats.push_back(is_enabled(world.buoyancy->enabled, instance.name + "::" + link.name));
    return floats;
}

}  // namespace

bool convert_fluid_plugin(const Element& plugin, const Import& import, World& out) {
    const PluginName name = plugin_name(plugin);
    if (asks_for<BuoyancySpec>(name)) {
        read(plugin, import, out.buoyancy, out.extensions.emplace_back(kept_element(plugin)));
        return true;
    }
    if (asks_for<WindEffectsSpec>(name)) {
        read(plugin, import, out.wind_effects, out.extensions.emplace_back(kept_element(plugin)));
        return true;
    }
    return false;
}

void mark_buoyant(World& world) {
    if (!world.buoyancy) return;
    std::map<std::size_t, std::map<std::vector<bool>, std::size_t>> known;  // prototypes by links that float
    for (ModelInstance& instance : world.instances) {
        if (world.prototypes[instance.prototype].is_static) continue;
        const std::vector<bool> floats = floating_links(world, instance);
        auto& variants = known[instance.prototype];
        const auto [found, is_new] = variants.try_emplace(floats, instance.prototype);
        if (is_new && variants.size() > 1) {
            found->second = world.prototypes.size();
            ModelSpec copy = world.prototypes[instance.prototype];
            world.prototypes.push_back(std::move(copy));
        }
        instance.prototype = found->second;
        if (!is_new) continue;
        std::vector<LinkSpec>& links = world.prototypes[instance.prototype].links;
        for (std::size_t l = 0; l < links.size(); ++l) links[l].buoyant = floats[l];
    }
}

}  // namespace roboss::sdf_import
