// Collects the models of a world.
#include "sdf/placements.h"

#include <cstring>

#include "sdf/known_elements.h"

namespace roboss::sdf_import {
namespace {

std::optional<Placement> placement_of_include(const Element& include, IncludeStore& includes,
                                              const Import& import) {
    if (include.node.attribute("merge").as_bool()) {
        import.diagnostics().warning(include.where(), "merge",
                                     "merge=\"true\" has no meaning in a world; the model is included whole",
                                     "Remove the attribute.");
    }
    report_unknown_elements(include, import.diagnostics());
    const Element model = includes.model_of(include);
    if (!model) return std::nullopt;
    auto placement = placement_of(model, includes, import);
    placement->where = include;
    placement->relative_to.clear();  // its own <pose> is that of a file by itself
    if (include.child("name")) placement->name = include.text("name");
    if (const Element pose = include.child("pose")) {
        placement->X_RP = import.reader.pose(pose);
        placement->relative_to = relative_to(pose);
    }
    if (include.child("placement_frame")) placement->placement_frame = include.text("placement_frame");
    placement->is_static = import.reader.boolean(include, "static", placement->is_static);
    return placement;
}

void add_population(const Element& population, IncludeStore& includes, const Import& import,
                    std::vector<Placement>& out) {
    const Element model = population.child("model");
    // Gazebo's form is <model name="x"><include>...</include></model>: the include is then what is cloned.
    const Element only_include = model.child("link") ? Element{} : model.child("include");
    const Element source = only_include ? only_include : model ? model : population.child("include");
    if (!source) {
        import.diagnostics().error(population.where(), "population", "<population> has no <model> to clone",
                                   "Add <model> with an <include> or with links.");
        return;
    }
    const auto clone = placement_of(source, includes, import);
    const auto poses = population_poses(population, import);
    if (!clone) return;
    const std::string name = model && !model.name().empty() ? model.name() : clone->name;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        Placement placement = *clone;
        placement.name = name + "_clone_" + std::to_string(i);
        placement.X_RP = poses[i];
        placement.relative_to = relative_to(population.child("pose"));
        placement.where = population;
        out.push_back(std::move(placement));
    }
}

}  // namespace

std::optional<Placement> placement_of(const Element& element, IncludeStore& includes, const Import& import) {
    if (std::strcmp(element.node.name(), "include") == 0)
        return placement_of_include(element, includes, import);
    Placement placement;
    placement.name = element.name();
    placement.model = element;
    placement.where = element;
    placement.X_RP = import.reader.pose(element.child("pose"));
    placement.relative_to = relative_to(element.child("pose"));
    placement.placement_frame = element.node.attribute("placement_frame").value();
    placement.is_static = import.reader.boolean(element, "static", false);
    return placement;
}

std::vector<Placement> collect_placements(const Element& world, IncludeStore& includes,
                                          const Import& import) {
    std::vector<Placement> placements;
    for (const auto node : world.node.children()) {
        const Element element{world.source, node};
        const std::size_t first = import.diagnostics().items().size(), placed = placements.size();
        if (std::strcmp(node.name(), "model") == 0 || std::strcmp(node.name(), "include") == 0) {
            if (auto placement = placement_of(element, includes, import))
                placements.push_back(std::move(*placement));
        } else if (std::strcmp(node.name(), "population") == 0) {
            add_population(element, includes, import, placements);
        }
        if (!import.diagnostics().leave_out_since(first)) continue;
        for (std::size_t i = placed; i < placements.size(); ++i) placements[i].left_out = true;
    }
    return placements;
}

}  // namespace roboss::sdf_import
