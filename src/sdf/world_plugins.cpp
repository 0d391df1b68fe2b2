// See world_plugins.h.
#include "sdf/world_plugins.h"

#include <algorithm>

namespace roboss::sdf_import {
namespace {

/// A prototype, its copy with controllers, and what tells it from other copies.
struct Variant {
    std::size_t prototype = 0, copy = 0;
    std::vector<OnboardParameters> controllers;
};

std::vector<OnboardSpec> specs_for(const std::vector<OnboardSpec>& plugins, const World& world,
                                   const std::string& model) {
    std::vector<OnboardSpec> specs;
    for (const OnboardSpec& plugin : plugins)
        for (OnboardParameters& one : controllers_for(plugin.parameters, world.name, model))
            specs.push_back({plugin.name, std::move(one), plugin.where});
    return specs;
}

/// The prototype with these controllers, made the first time.
std::size_t prototype_with(std::size_t prototype, const std::vector<OnboardSpec>& specs,
                           std::vector<Variant>& variants, World& world) {
    std::vector<OnboardParameters> controllers;
    for (const OnboardSpec& spec : specs) controllers.push_back(spec.parameters);
    bool is_known = false;
    for (const Variant& variant : variants) {
        if (variant.prototype != prototype) continue;
        is_known = true;
        if (variant.controllers == controllers) return variant.copy;
    }
    std::size_t copy = prototype;
    if (is_known) {
        copy = world.prototypes.size();
        ModelSpec model = world.prototypes[prototype];
        const auto own = static_cast<std::ptrdiff_t>(
            model.onboard.size() -
            std::ranges::find(variants, prototype, &Variant::copy)->controllers.size());
        model.onboard.erase(model.onboard.begin() + own, model.onboard.end());
        world.prototypes.push_back(std::move(model));
    }
    std::vector<OnboardSpec>& onboard = world.prototypes[copy].onboard;
    onboard.insert(onboard.end(), specs.begin(), specs.end());
    variants.push_back({prototype, copy, std::move(controllers)});
    return copy;
}

}  // namespace

void attach_world_plugins(const std::vector<OnboardSpec>& plugins, World& world, Diagnostics& diagnostics) {
    std::vector<OnboardSpec> of_world;
    for (const OnboardSpec& plugin : plugins) {
        if (is_of_world(plugin.parameters))
            of_world.push_back(plugin);
        else
            diagnostics.warning(plugin.where, "plugin-not-run",
                                "plugin '" + plugin.name + "' stands in <world>; it is not run",
                                "Move it into the model that it acts on.");
    }
    if (of_world.empty()) return;
    std::vector<Variant> variants;
    for (ModelInstance& instance : world.instances) {
        if (world.prototypes[instance.prototype].is_static) continue;
        const std::vector<OnboardSpec> specs = specs_for(of_world, world, instance.name);
        instance.prototype = prototype_with(instance.prototype, specs, variants, world);
    }
}

}  // namespace roboss::sdf_import
