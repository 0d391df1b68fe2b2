// A Model that is not known (of a journal from before this run) looks like the world file.
#include "app/viewer/model_visuals.h"

#include "model/edit.h"

namespace roboss {

void ModelVisuals::begin(const Model& model, World world) {
    worlds_.push_back(std::make_shared<const World>(std::move(world)));
    by_model_[model.hash] = {0};
}

void ModelVisuals::change(const Model& from, const Model& to) {
    const auto known = by_model_.find(from.hash);
    if (known != by_model_.end()) by_model_.try_emplace(to.hash, std::vector(known->second));
}

void ModelVisuals::add(const Addition& addition, World world, const Pose& X_WA, const std::string& name) {
    for (ModelInstance& instance : world.instances) {
        instance.name = name_in_model(addition.added, instance.name, name);
        instance.X_WM = X_WA * instance.X_WM;
    }
    std::vector<std::size_t> indices = indices_of(addition.from);
    indices.push_back(worlds_.size());
    worlds_.push_back(std::make_shared<const World>(std::move(world)));
    by_model_[addition.to.hash] = std::move(indices);
}

std::vector<std::size_t> ModelVisuals::indices_of(const Model& model) const {
    if (const auto known = by_model_.find(model.hash); known != by_model_.end()) return known->second;
    return worlds_.empty() ? std::vector<std::size_t>() : std::vector<std::size_t>{0};
}

std::vector<const World*> ModelVisuals::of(const Model& model) const {
    std::vector<const World*> worlds;
    for (const std::size_t index : indices_of(model)) worlds.push_back(worlds_[index].get());
    return worlds;
}

}  // namespace roboss
