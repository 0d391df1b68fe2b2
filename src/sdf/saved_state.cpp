// Poses in a <state> are in the world, of nested models and links too. <acceleration> and <wrench> are
// results of the last step, from which nothing starts.
#include "sdf/saved_state.h"

#include <algorithm>
#include <cstring>

#include "sdf/known_children.h"

namespace roboss::sdf_import {
namespace {

constexpr const char* kState[] = {"sim_time",  "wall_time", "real_time", "iterations", "insertions",
                                  "deletions", "model",     "light",     "population"};
constexpr const char* kModel[] = {"joint", "model", "frame", "pose", "scale", "link", "light"};
constexpr const char* kLink[] = {"velocity", "acceleration", "wrench", "collision", "pose"};

/// A <pose> of a state, in the world; nullopt: there is none.
std::optional<Pose> pose_in_world(const Element& parent, const Import& import) {
    const Element pose = parent.child("pose");
    if (!pose) return std::nullopt;
    if (const std::string frame = relative_to(pose); !frame.empty() && frame != "world")
        import.diagnostics().warning(pose.where(), "state-frame",
                                     "a pose of a <state> is in the world, not in '" + frame + "'",
                                     "Write it in the world.");
    return import.reader.pose(pose);
}

/// The scale of a model of a state; empty: 1 1 1.
std::optional<Vec3> read_scale(const Element& model, const Import& import) {
    const Element scale = model.child("scale");
    if (!scale) return std::nullopt;
    const Vec3 factors = import.reader.vector(model, "scale", {1, 1, 1});
    if (factors.x > 0 && factors.y > 0 && factors.z > 0) return factors;
    import.diagnostics().warning(scale.where(), "state-scale",
                                 "<scale> of '" + model.name() +
                                     "' in the <state> has no effect: it is not "
                                     "positive along all axes",
                                 "Write three numbers above 0.");
    return std::nullopt;
}

}  // namespace

SavedState::SavedState(const Element& world, const Import& import) : state_(world.child("state")) {
    if (!state_) return;
    Diagnostics& diagnostics = import.diagnostics();
    diagnostics.note(
        state_.where(), "state",
        "the saved <state> is applied: models, links and joints start as it says, at time 0; its "
        "times, lights, <acceleration> and <wrench> have no effect");
    if (const auto second = state_.node.next_sibling("state"))
        diagnostics.warning(state_.source->where(second), "second-state",
                            "the world has several <state>s; the first is applied",
                            "Remove the others, or put the one that counts first.");
    report_unknown_children(state_, kState, diagnostics);
    for (const auto node : state_.node.children("model")) {
        const Element element{state_.source, node};
        SavedModel& model = models_[element.name()];
        model.where = element;
        const std::size_t first = diagnostics.items().size();
        model.X_WM = pose_in_world(element, import);
        read_model(element, "", import, model);
        model.is_wrong = diagnostics.leave_out_since(first);
    }
}

void SavedState::read_model(const Element& element, const std::string& prefix, const Import& import,
                            SavedModel& model) {
    report_unknown_children(element, kModel, import.diagnostics());
    if (const auto scale = read_scale(element, import)) model.scale.emplace_back(prefix, *scale);
    read_links(element, prefix, import, model);
    read_axes(element, prefix, import, model);
    for (const auto node : element.node.children("model")) {
        const Element nested{element.source, node};
        read_model(nested, prefix + nested.name() + "::", import, model);
    }
}

void SavedState::read_links(const Element& element, const std::string& prefix, const Import& import,
                            SavedModel& model) {
    for (const auto node : element.node.children("link")) {
        const Element link{element.source, node};
        report_unknown_children(link, kLink, import.diagnostics());
        LinkStart start;
        start.link = prefix + link.name();
        start.X_WL = pose_in_world(link, import);
        const std::array<double, 6> v = import.reader.six(link, "velocity");
        start.linear = {v[0], v[1], v[2]};
        start.angular = {v[3], v[4], v[5]};
        model.links.push_back(std::move(start));
    }
}

void SavedState::read_axes(const Element& element, const std::string& prefix, const Import& import,
                           SavedModel& model) {
    for (const auto joint : element.node.children("joint"))
        for (const auto angle : joint.children("angle")) {
            const Element source{element.source, angle};
            AxisStart start;
            start.joint = prefix + joint.attribute("name").value();
            start.axis = angle.attribute("axis").as_int(0);
            start.position = import.reader.value(source, 0);
            model.axes.push_back(std::move(start));
        }
}

void SavedState::change(std::vector<Placement>& placements, IncludeStore& includes,
                        const Import& import) const {
    if (!state_) return;
    if (const Element insertions = state_.child("insertions"))
        for (Placement& inserted : collect_placements(insertions, includes, import))
            placements.push_back(std::move(inserted));
    for (const auto name : state_.child("deletions").node.children("name")) {
        const std::string gone = name.text().get();
        std::erase_if(placements, [&](const Placement& p) { return p.name == gone; });
    }
}

bool SavedState::apply(ModelInstance& instance, const ModelSpec& spec, Diagnostics& diagnostics) {
    const auto found = models_.find(instance.name);
    if (found == models_.end()) return true;
    SavedModel& saved = found->second;
    saved.is_used = true;
    if (saved.is_wrong) return false;
    if (saved.X_WM) instance.X_WM = *saved.X_WM;
    if (spec.is_static) return true;
    instance.links = saved.links;
    instance.axes = saved.axes;
    for (const LinkStart& start : saved.links) {
        const auto has_its_name = [&](const LinkSpec& link) { return link.name == start.link; };
        if (std::none_of(spec.links.begin(), spec.links.end(), has_its_name))
            diagnostics.note(saved.where.where(), "state-unknown-link",
                             "the <state> has a link '" + start.link + "' that model '" + instance.name +
                                 "' does not have");
    }
    return true;
}

std::size_t SavedState::scaled(const std::string& name, std::size_t prototype, World& world) {
    const auto found = models_.find(name);
    if (found == models_.end()) return prototype;
    const ModelScale& scale = found->second.scale;
    if (std::ranges::all_of(scale, [](const auto& entry) { return entry.second == Vec3{1, 1, 1}; }))
        return prototype;
    for (const Scaled& known : scaled_)
        if (known.from == prototype && known.scale == scale) return known.to;
    ModelSpec model = world.prototypes[prototype];
    scale_shapes(scale, model);
    world.prototypes.push_back(std::move(model));
    scaled_.push_back({prototype, world.prototypes.size() - 1, scale});
    return scaled_.back().to;
}

void SavedState::report_unused(Diagnostics& diagnostics) const {
    for (const auto node : state_.node.children("model")) {
        const std::string name = node.attribute("name").value();
        const auto found = models_.find(name);
        if (found != models_.end() && !found->second.is_used)
            diagnostics.note(found->second.where.where(), "state-unknown-model",
                             "the <state> has a model '" + name + "' that the world does not have");
    }
}

}  // namespace roboss::sdf_import
