// See placed_copies.h.
#include "scene/placed_copies.h"

#include <utility>

#include "model/edit.h"

namespace roboss {

World placed_copies(World world, const Model& added, std::span<const CopyPlace> places) {
    const std::vector<ModelInstance> once = std::exchange(world.instances, {});
    world.instances.reserve(once.size() * places.size());
    for (const CopyPlace& place : places)
        for (ModelInstance instance : once) {
            instance.name = name_in_model(added, instance.name, place.name);
            instance.X_WM = place.X_WA * instance.X_WM;
            world.instances.push_back(std::move(instance));
        }
    return world;
}

}  // namespace roboss
