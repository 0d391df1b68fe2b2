// See bare_model.h.
#include "world/bare_model.h"

#include <algorithm>

#include "core/similar.h"

namespace roboss {
namespace {

constexpr const char* kGround = "ground_plane";

ModelInstance* find_model(World& world, const std::string& name) {
    const auto found = std::ranges::find(world.instances, name, &ModelInstance::name);
    return found == world.instances.end() ? nullptr : &*found;
}

void add_ground(World& world) {
    ModelSpec ground;
    ground.name = kGround;
    ground.is_static = true;
    ground.canonical_link = "link";
    LinkSpec link;
    link.name = "link";
    CollisionSpec plane;
    plane.name = "plane";
    plane.geometry.kind = GeometryKind::kPlane;
    link.collisions.push_back(plane);
    ground.links.push_back(std::move(link));
    world.instances.push_back({kGround, world.prototypes.size(), {}, {}});
    world.prototypes.push_back(std::move(ground));
}

/// The model gets a prototype of its own: others like it stay free.
void weld(World& world, ModelInstance& instance) {
    ModelSpec model = world.prototypes[instance.prototype];
    JointSpec joint;
    joint.name = "world_to_" + model.canonical_link;
    joint.parent = "world", joint.child = model.canonical_link;
    joint.where = model.where;
    model.joints.push_back(std::move(joint));
    model.name = instance.name;
    instance.prototype = world.prototypes.size();
    world.prototypes.push_back(std::move(model));
}

}  // namespace

Result<> complete(World& world, const BareModelOptions& options) {
    for (const std::string& name : options.fixed_base) {
        ModelInstance* const found = find_model(world, name);
        if (found == nullptr) {
            std::vector<std::string> names;
            for (const ModelInstance& instance : world.instances) names.push_back(instance.name);
            return Error{"the base to be fixed: the world has no model '" + name + "'",
                         did_you_mean(name, names, "see `roboss check` for their names"), "no-model"};
        }
        if (!world.prototypes[found->prototype].is_static) weld(world, *found);
    }
    if (options.ground && find_model(world, kGround) == nullptr) add_ground(world);
    return Ok{};
}

}  // namespace roboss
