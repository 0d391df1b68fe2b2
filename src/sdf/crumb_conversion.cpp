// See crumb_conversion.h.
#include "sdf/crumb_conversion.h"

#include <algorithm>
#include <cstring>
#include <set>

#include "sdf/model_conversion.h"
#include "sdf/model_tree.h"
#include "sdf/placements.h"
#include "sdf/plugin_conversion.h"

namespace roboss::sdf_import {
namespace {

constexpr int kCopiesMost = 1000;  // of one supply

/// Where copy number n is stored: below the world, no two at one place.
Pose store_of(std::size_t n) {
    constexpr double kDepth = 1000, kApart = 10;  // m
    return {{0, 0, -kDepth - kApart * static_cast<double>(n)}, {}};
}

Element model_of(const Element& plugin) {
    const Element sdf = plugin.child("breadcrumb").child("sdf");
    if (const Element model = sdf.child("model")) return model;
    return sdf.child("include");
}

bool is_breadcrumbs(const Element& plugin) {
    return is_named(plugin_name(plugin), BreadcrumbsSpec::kKind.classes, BreadcrumbsSpec::kKind.files);
}

/// All such plugins of a model and of those in it.
void find_plugins(const Element& model, std::vector<Element>& found) {
    for (const auto node : model.node.children()) {
        const Element child{model.source, node};
        if (std::strcmp(node.name(), "model") == 0) find_plugins(child, found);
        if (std::strcmp(node.name(), "plugin") == 0 && is_breadcrumbs(child)) found.push_back(child);
    }
}

bool is_at(const SourceLocation& a, const SourceLocation& b) {
    return a.file == b.file && a.line == b.line;
}

class CrumbConverter {
  public:
    CrumbConverter(const Import& import, World& world) : import_(import), world_(world) {
        for (const ModelInstance& instance : world.instances) taken_.insert(instance.name);
    }

    std::vector<CrumbSupply> convert(const std::vector<PrototypeSource>& sources) {
        const std::size_t carriers = world_.instances.size();
        for (const PrototypeSource& source : sources) {
            std::vector<Element> plugins;
            find_plugins(source.model, plugins);
            for (const Element& plugin : plugins) {
                for (std::size_t i = 0; i < carriers; ++i)
                    if (world_.instances[i].prototype == source.prototype) supply(plugin, i);
                crumb_.reset();
            }
        }
        return std::move(supplies_);
    }

  private:
    struct Crumb {
        std::size_t prototype = 0;
        Pose X_MC;
    };

    /// The plugin as it was converted, and which of its kind it is; nullptr: it does not run.
    BreadcrumbsSpec* spec_of(const Element& plugin, ModelSpec& model, int& number) {
        number = 0;
        for (OnboardSpec& onboard : model.onboard) {
            auto* spec = std::get_if<BreadcrumbsSpec>(&onboard.parameters);
            if (spec == nullptr) continue;
            if (is_at(onboard.where, plugin.where())) return spec;
            ++number;
        }
        return nullptr;
    }

    void supply(const Element& plugin, std::size_t carrier) {
        CrumbSupply supply;
        const std::size_t prototype = world_.instances[carrier].prototype;
        BreadcrumbsSpec* found = spec_of(plugin, world_.prototypes[prototype], supply.supply);
        if (found == nullptr) return;
        const BreadcrumbsSpec spec = *found;
        if (!crumb_ && !read(plugin, spec, world_.prototypes[prototype])) return;
        supply.carrier = world_.instances[carrier].name;
        supply.topic = spec.channels().front().topic;
        if (const std::size_t at = supply.topic.find("{model}"); at != std::string::npos)
            supply.topic.replace(at, 7, supply.carrier);
        supply.X_MC = crumb_->X_MC, supply.limit = spec.max_deployments;
        const int copies = spec.max_deployments < 0 ? BreadcrumbsSpec::kUnlimited
                                                    : std::min(spec.max_deployments, kCopiesMost);
        if (copies != spec.max_deployments)
            import_.diagnostics().note(plugin.where(), "breadcrumbs",
                                       "model '" + supply.carrier + "' can drop " + std::to_string(copies) +
                                           " of '" + spec.crumb + "'",
                                       "Write <max_deployments>: that many copies are made at the start.");
        for (int i = 0; i < copies; ++i)
            if (const std::string name = name_for(spec, i); !name.empty()) add(name, plugin, supply);
        if (supply.names.size() < static_cast<std::size_t>(copies))
            import_.diagnostics().warning(
                plugin.where(), "breadcrumbs",
                "model '" + supply.carrier + "' cannot drop some of '" + spec.crumb +
                    "': there are models '" + spec.crumb + "_0' and on already",
                "Write <allow_renaming>true</allow_renaming>, or give the crumb another name.");
        supplies_.push_back(std::move(supply));
    }

    /// NAME_i; if that is taken NAME_i_1 and on, or nothing.
    std::string name_for(const BreadcrumbsSpec& spec, int i) const {
        const std::string wanted = spec.crumb + "_" + std::to_string(i);
        if (!taken_.contains(wanted)) return wanted;
        if (!spec.allow_renaming) return {};
        for (int k = 1;; ++k)
            if (std::string name = wanted + "_" + std::to_string(k); !taken_.contains(name)) return name;
    }

    void add(const std::string& name, const Element& plugin, CrumbSupply& supply) {
        taken_.insert(name);
        world_.instances.push_back({name, crumb_->prototype, store_of(stored_++), plugin.where()});
        supply.names.push_back(name);
    }

    /// Reads the crumb's model as a prototype; what is wrong with it concerns this plugin only.
    bool read(const Element& plugin, const BreadcrumbsSpec& spec, ModelSpec& carrier) {
        Diagnostics found;
        const Import local{import_.paths, ElementReader(found), import_.files,
                           import_.looks, import_.dt_s,         import_.max_contacts};
        std::optional<ModelSpec> model = model_in(plugin, spec, local, found);
        std::string fault;
        for (Diagnostic each : found.items()) {
            if (each.severity == Severity::kError && fault.empty()) fault = each.message;
            if (each.severity == Severity::kError) each.severity = Severity::kWarning;
            import_.diagnostics().add(std::move(each));
        }
        if (fault.empty() && !model) fault = "it has no links";
        if (!fault.empty()) return give_up(plugin, "cannot read the model to drop: " + fault, carrier);
        world_.prototypes.push_back(std::move(*model));
        return true;
    }

    std::optional<ModelSpec> model_in(const Element& plugin, const BreadcrumbsSpec& spec, const Import& local,
                                      Diagnostics& found) {
        IncludeStore includes(local.paths, found);
        const auto placement = placement_of(model_of(plugin), includes, local);
        if (!placement) return std::nullopt;
        ModelSpec model =
            convert_model(*read_model_tree(placement->model, includes, local.reader), false, local);
        if (model.links.empty()) return std::nullopt;
        CrumbSpec crumb;
        if (spec.disable_physics_time > 0) crumb.fixed_after = spec.disable_physics_time;
        if (placement->is_static) crumb.fixed_after = 0;
        model.onboard.insert(model.onboard.begin(), {"breadcrumb", crumb, plugin.where()});
        validate(model, found);
        crumb_ = Crumb{world_.prototypes.size(), placement->X_RP};
        return model;
    }

    bool give_up(const Element& plugin, const std::string& fault, ModelSpec& carrier) {
        std::erase_if(carrier.onboard, [&](const OnboardSpec& onboard) {
            return std::holds_alternative<BreadcrumbsSpec>(onboard.parameters) &&
                   is_at(onboard.where, plugin.where());
        });
        for (ExtensionElement& record : carrier.extensions) {
            if (record.name != "plugin" || !is_at(record.where, plugin.where())) continue;
            record.fate = PluginFate::kNotRun, record.reason = fault;
        }
        import_.diagnostics().warning(plugin.where(), "plugin-not-run",
                                      "plugin '" + plugin.name() + "' " + fault + "; it is not run",
                                      "Correct <breadcrumb><sdf><model>.");
        return false;
    }

    const Import& import_;
    World& world_;
    std::set<std::string> taken_;  // names of models
    std::optional<Crumb> crumb_;   // of the plugin in turn
    std::size_t stored_ = 0;
    std::vector<CrumbSupply> supplies_;
};

}  // namespace

std::string name_of_crumb(const Element& plugin) {
    const Element model = model_of(plugin);
    return model.child("name") ? model.text("name") : model.name();
}

std::vector<CrumbSupply> add_crumbs(const std::vector<PrototypeSource>& sources, const Import& import,
                                    World& world) {
    return CrumbConverter(import, world).convert(sources);
}

}  // namespace roboss::sdf_import
