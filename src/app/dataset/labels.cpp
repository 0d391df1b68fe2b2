// See labels.h.
#include "app/dataset/labels.h"

#include <algorithm>
#include <set>

namespace roboss {
namespace {

constexpr int kLabelMost = 255;

template <class Visit>
void visit_visuals(ModelSpec& model, Visit&& visit) {
    for (LinkSpec& link : model.links)
        for (VisualSpec& visual : link.visuals) visit(visual);
}

bool has_labels(World& world) {
    bool found = false;
    for (ModelSpec& model : world.prototypes)
        visit_visuals(model, [&](const VisualSpec& visual) { found |= visual.label != 0; });
    return found;
}

void label_models(World& world) {
    std::map<std::string, int> labels;
    for (ModelSpec& model : world.prototypes) {
        if (model.is_static) continue;
        const int next = std::min(static_cast<int>(labels.size()) + 1, kLabelMost);
        const int label = labels.try_emplace(kind_of_model(model.name), next).first->second;
        visit_visuals(model, [&](VisualSpec& visual) { visual.label = label, visual.labels_model = true; });
    }
}

LabelNames names_of(World& world) {
    std::map<int, std::set<std::string>> kinds;
    for (ModelSpec& model : world.prototypes)
        visit_visuals(model, [&](const VisualSpec& visual) {
            if (visual.label != 0) kinds[visual.label].insert(kind_of_model(model.name));
        });
    LabelNames names;
    for (const auto& [label, of_label] : kinds)
        for (const std::string& kind : of_label) names[label] += (names[label].empty() ? "" : "|") + kind;
    return names;
}

}  // namespace

std::string kind_of_model(const std::string& model) {
    const std::size_t end = model.find_last_not_of("0123456789");
    if (end == std::string::npos || end + 1 == model.size()) return model;
    const std::size_t last = model.find_last_not_of("_- .", end);
    return last == std::string::npos ? model : model.substr(0, last + 1);
}

LabelNames label_world(World& world, const std::string& choice) {
    if (choice == "models" || (choice == "auto" && !has_labels(world))) label_models(world);
    return names_of(world);
}

}  // namespace roboss
