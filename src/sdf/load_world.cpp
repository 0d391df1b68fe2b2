// The straight path of loading: file, placements, distinct models, poses, validation.
#include "sdf/load_world.h"

#include <map>
#include <tuple>
#include <unordered_map>

#include "mjcf/load_mjcf.h"
#include "sdf/actor_conversion.h"
#include "sdf/comms.h"
#include "sdf/crumb_conversion.h"
#include "sdf/environment.h"
#include "sdf/event_conversion.h"
#include "sdf/include_store.h"
#include "sdf/look_conversion.h"
#include "sdf/model_conversion.h"
#include "sdf/model_tree.h"
#include "sdf/placements.h"
#include "sdf/same_model.h"
#include "sdf/saved_state.h"
#include "sdf/urdf.h"
#include "sdf/world_fluids.h"
#include "sdf/world_frames.h"
#include "sdf/world_plugins.h"
#include "sdf/world_settings.h"
#include "world/left_out.h"

namespace roboss {
namespace {

using namespace sdf_import;

/// Models that are equal but for name and pose, and what became of them.
struct Distinct {
    Element model;
    bool is_static = false;
    std::unique_ptr<ModelTree> tree;
    std::optional<std::size_t> prototype;  // in World::prototypes
    bool left_out = false;                 // it has errors
};

class WorldLoader {
  public:
    WorldLoader(const LoadOptions& options, Diagnostics& diagnostics)
        : paths_(options.search_paths),
          visuals_(paths_, options.looks),
          import_{paths_, ElementReader(diagnostics), files_, visuals_, 0.001, -1},
          includes_(paths_, diagnostics),
          diagnostics_(diagnostics),
          profile_(options.profile) {}

    std::optional<World> load(std::unique_ptr<SourceFile> file) {
        file_ = std::move(file);
        if (std::string(file_->root().name()) == "robot") file_ = urdf_to_sdf(*file_, diagnostics_);
        if (!file_) return std::nullopt;
        const auto world = find_world();
        if (!world) return std::nullopt;
        World result;
        result.file = file_->path();
        std::vector<OnboardSpec> plugins;
        read_world_settings(*world, profile_, import_, result, plugins);
        if (result.name.empty()) result.name = name_of_file();
        SavedState state(*world, import_);
        std::vector<Placement> placements = collect_placements(*world, includes_, import_);
        state.change(placements, includes_, import_);
        for (const Placement& placement : placements) distinct_of_.push_back(find_distinct(placement));
        for (Distinct& distinct : distinct_) read_distinct(distinct, result);
        place(*world, placements, state, result);
        state.report_unused(diagnostics_);
        const std::vector<CrumbSupply> crumbs = add_crumbs(prototype_sources(), import_, result);
        attach_world_plugins(plugins, result, diagnostics_);
        mark_buoyant(result);
        convert_environment(result, import_);
        convert_comms(result, import_);
        show_scenery(result);
        convert_events(result, crumbs, diagnostics_);
        validate_settings(result, diagnostics_);
        return result;
    }

  private:
    std::string name_of_file() const {
        if (const Element model = first_model(*file_)) return model.name();
        return file_->root().child("light").attribute("name").as_string("world");
    }

    /// The <world>, or the <sdf> of a file that holds a model only, or lights only.
    std::optional<Element> find_world() {
        const Element root{file_.get(), file_->root()};
        if (std::string(root.node.name()) != "sdf") {
            diagnostics_.error(root.where(), "not-sdf",
                               "the file begins with <" + std::string(root.node.name()) +
                                   ">; it is neither SDFormat, URDF nor MJCF",
                               "Give a file whose root element is <sdf>, <robot> or <mujoco>.");
            return std::nullopt;
        }
        check_version(*file_, diagnostics_);
        const Element world = root.child("world");
        if (world) {
            if (const auto second = world.node.next_sibling("world")) {
                diagnostics_.warning(file_->where(second), "second-world",
                                     "the file has several worlds; the first is used",
                                     "Put each world into a file of its own.");
            }
            return world;
        }
        if (first_model(*file_)) return root;
        if (holds_scenery_only(*file_)) {
            diagnostics_.note(root.where(), "no-model", "the file holds lights only: nothing moves",
                              "Include it in a world with models.");
            return root;
        }
        diagnostics_.error(root.where(), "no-world", "the file holds neither a <world> nor a <model>",
                           "Add one.");
        return std::nullopt;
    }

    std::size_t find_distinct(const Placement& placement) {
        const std::uint64_t hash = model_hash(placement.model) * 2 + (placement.is_static ? 1 : 0);
        for (auto [at, end] = by_hash_.equal_range(hash); at != end; ++at) {
            const Distinct& known = distinct_[at->second];
            if (known.is_static == placement.is_static && same_model(known.model, placement.model))
                return at->second;
        }
        distinct_.push_back({placement.model, placement.is_static, nullptr, std::nullopt, false});
        by_hash_.emplace(hash, distinct_.size() - 1);
        return distinct_.size() - 1;
    }

    void read_distinct(Distinct& distinct, World& world) {
        const std::size_t first = diagnostics_.items().size();
        if (auto spec = read_spec(distinct, first)) {
            validate(*spec, diagnostics_);
            distinct.left_out = diagnostics_.leave_out_since(first);
            if (distinct.left_out) return;
            world.prototypes.push_back(std::move(*spec));
            distinct.prototype = world.prototypes.size() - 1;
        } else {
            distinct.left_out = diagnostics_.leave_out_since(first);
        }
    }

    /// nullopt, and a finding behind the `first` ones, if there is nothing in it.
    std::optional<ModelSpec> read_spec(Distinct& distinct, std::size_t first) {
        distinct.tree = read_model_tree(distinct.model, includes_, import_.reader);
        ModelSpec spec = convert_model(*distinct.tree, distinct.is_static, import_);
        if (!spec.links.empty()) return spec;
        if (diagnostics_.refuses_since(first)) return std::nullopt;
        diagnostics_.warning(spec.where, "no-links", "model '" + spec.name + "' has no links; it is left out",
                             "Give it a link, or remove it.");
        return std::nullopt;
    }

    std::vector<PrototypeSource> prototype_sources() const {
        std::vector<PrototypeSource> sources;
        for (const Distinct& distinct : distinct_)
            if (distinct.prototype) sources.push_back({*distinct.prototype, distinct.model});
        return sources;
    }

    void place(const Element& world, const std::vector<Placement>& placements, SavedState& state,
               World& result) {
        const auto in_model = [&](std::size_t i, const std::string& name) -> std::optional<Pose> {
            return distinct_[distinct_of_[i]].tree->pose_of(name);
        };
        WorldFrames frames(world, placements, in_model, import_);
        InstanceCheck check;
        std::map<std::size_t, std::vector<const Placement*>> left_out;  // by distinct model
        for (std::size_t i = 0; i < placements.size(); ++i) {
            const Placement& placement = placements[i];
            const Distinct& distinct = distinct_[distinct_of_[i]];
            const std::size_t first = diagnostics_.items().size();
            ModelInstance instance{placement.name, distinct.prototype.value_or(0), frames.pose_of(i),
                                   placement.where.where()};
            bool spoilt = placement.left_out || distinct.left_out;
            if (!spoilt && distinct.prototype)
                spoilt = !state.apply(instance, result.prototypes[*distinct.prototype], diagnostics_);
            if (!spoilt && distinct.prototype) check.check(instance, diagnostics_);
            if (!spoilt && distinct.prototype)
                instance.prototype = state.scaled(instance.name, instance.prototype, result);
            if (diagnostics_.leave_out_since(first) || spoilt) {
                left_out[distinct_of_[i]].push_back(&placement);
            } else if (distinct.prototype) {
                result.instances.push_back(std::move(instance));
            }
        }
        if (result.instances.empty()) return diagnostics_.refuse_since(0);  // nothing is left
        const auto pose_of = [&](const Element& element) { return frames.pose_of(element); };
        read_look(world, includes_, pose_of, import_, result.look);
        for (const auto& [model, alike] : left_out)
            report_left_out(alike.front()->name, alike.size(), alike.front()->where.where(), diagnostics_);
    }

    ResourcePaths paths_;
    ShapeFiles files_;
    LookFiles visuals_;
    Import import_;
    IncludeStore includes_;
    Diagnostics& diagnostics_;
    std::string profile_;
    std::unique_ptr<SourceFile> file_;
    std::vector<Distinct> distinct_;
    std::unordered_multimap<std::uint64_t, std::size_t> by_hash_;
    std::vector<std::size_t> distinct_of_;  // by placement
};

/// `file`: nullptr if it could not be read.
std::optional<World> load(std::unique_ptr<SourceFile> file, const LoadOptions& options, Diagnostics& found) {
    if (!file) return std::nullopt;
    if (std::string(file->root().name()) == "mujoco")
        return load_mjcf(std::move(file), {options.search_paths, options.looks, options.keyframe}, found);
    if (!options.keyframe.empty())
        found.error(
            file->where(file->root()), "no-keyframe",
            "the file has no keyframe '" + options.keyframe + "': only files of MuJoCo have keyframes",
            "Leave it out; a <state> of SDFormat says where a world starts.");
    make_models_of_actors(file->root());
    return WorldLoader(options, found).load(std::move(file));
}

/// Findings that say the same in the same file become one, with their number and the first line.
void add_grouped(const Diagnostics& found, Diagnostics& out) {
    std::map<std::tuple<Severity, std::string, std::string, std::string, bool>, std::size_t> count;
    const auto key = [](const Diagnostic& d) {
        return std::tuple(d.severity, d.where.file, d.code, d.message, d.left_out);
    };
    for (const Diagnostic& d : found.items()) ++count[key(d)];
    for (const Diagnostic& d : found.items()) {
        auto& times = count[key(d)];
        if (times == 0) continue;
        Diagnostic grouped = d;
        if (times > 1) grouped.message += " (" + std::to_string(times) + " times, first here)";
        times = 0;
        out.add(std::move(grouped));
    }
}

}  // namespace

std::optional<World> load_world(const std::string& file, const LoadOptions& options,
                                Diagnostics& diagnostics) {
    Diagnostics found;
    auto world = load(SourceFile::read(file, found), options, found);
    add_grouped(found, diagnostics);
    return world;
}

std::optional<World> load_world_text(const std::string& text, const std::string& name,
                                     const LoadOptions& options, Diagnostics& diagnostics) {
    Diagnostics found;
    auto world = load(SourceFile::from_text(name, text, {}, found), options, found);
    add_grouped(found, diagnostics);
    return world;
}

}  // namespace roboss
