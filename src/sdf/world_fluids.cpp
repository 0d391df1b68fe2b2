// See world_fluids.h.
#include "sdf/world_fluids.h"

#include <algorithm>
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

/// What only some of the kinds need.
void read_rest(const Element& plugin, std::vector<OnboardProblem>&, BuoyancySpec& spec) {
    spec.graded = static_cast<bool>(plugin.child("graded_buoyancy"));
    for (const auto node : plugin.node.children("enable"))
        for (const std::string_view word : words_of(node.text().get())) spec.enabled.emplace_back(word);
}
void read_rest(const Element& plugin, std::vector<OnboardProblem>& problems, WindEffectsSpec&) {
    const Element scale = plugin.child("force_approximation_scaling_factor");
    if (!scale) return;
    for (const auto node : scale.node.children())
        if (node.type() == pugi::node_element)
            return problems.push_back(
                {"has a <force_approximation_scaling_factor> that depends on the place",
                 "Write one number: the rate in 1/s at which the wind carries a link along."});
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
        Spec::parameters(ParameterReader{plugin, "", local}, spec);
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

std::vector<char> floating_links(const World& world, const ModelInstance& instance) {
    std::vector<char> floats;
    for (const LinkSpec& link : world.prototypes[instance.prototype].links)
        floats.push_back(is_enabled(world.buoyancy->enabled, instance.name + "::" + link.name) ? 1 : 0);
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
    std::map<std::size_t, std::map<std::vector<char>, std::size_t>> known;  // prototypes by links that float
    for (ModelInstance& instance : world.instances) {
        if (world.prototypes[instance.prototype].is_static) continue;
        const std::vector<char> floats = floating_links(world, instance);
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
        for (std::size_t l = 0; l < links.size(); ++l) links[l].buoyant = floats[l] != 0;
    }
}

}  // namespace roboss::sdf_import
