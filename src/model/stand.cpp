// What stands still and yet has a state: static models that carry sensors or on-board controllers.
#include <algorithm>
#include <cmath>

#include "geometry/shape_bounds.h"
#include "model/compile_type.h"

namespace roboss {
namespace {

/// Holds the scenery whose surfaces the controllers move, in the model's frame. Planes have no end: they
/// stand still.
Aabb driven_scenery(const ModelSpec& spec, const RobotType& type, ShapeStore& shapes,
                    Diagnostics& diagnostics) {
    Aabb all;
    for (std::size_t l = 0; l < spec.links.size(); ++l) {
        if (!moves_surface(type, LinkId(l))) continue;
        for (const CollisionSpec& collision : spec.links[l].collisions) {
            if (!collision.moves) continue;
            const Transform X_ML = to_transform(spec.links[l].X_ML * collision.X_LS);
            for (const PlacedShape& placed : shapes.shapes_of(collision, true)) {
                if (placed.shape.kind == ShapeKind::kPlane) {
                    diagnostics.warning(
                        collision.where, "plane-that-moves",
                        "the plane '" + collision.name + "' of model '" + spec.name +
                            "' stands still: a plane has no end, so its motion cannot be commanded",
                        "Write a box, or <fixed>true</fixed> in its <roboss:surface_velocity>.");
                    continue;
                }
                all.include(bounds(placed.shape, {X_ML.R, X_ML * placed.p_CS}));
            }
        }
    }
    return all;
}

double farthest_corner(const Aabb& box) {
    const auto most = [](double a, double b) { return std::max(std::fabs(a), std::fabs(b)); };
    return norm(Vec3{most(box.min.x, box.max.x), most(box.min.y, box.max.y), most(box.min.z, box.max.z)});
}

}  // namespace

Link to_link(const LinkSpec& spec, int body, const Transform& X_BL) {
    Link link;
    link.name = spec.name;
    link.body = body;
    link.X_BL = X_BL;
    link.p_BC = X_BL * spec.p_LC;
    link.mass = spec.mass, link.gravity = spec.gravity;
    link.inertia_C = X_BL.R * spec.inertia_C * transpose(X_BL.R);
    return link;
}

bool always_flows(const OnboardSpec& onboard) {
    const auto* motion = std::get_if<SurfaceVelocitySpec>(&onboard.parameters);
    return motion != nullptr && motion->fixed;
}

bool moves_surface(const RobotType& type, LinkId link) {
    return std::ranges::any_of(type.onboard, [&](const OnboardInfo& info) {
        const std::vector<std::string> moved = surfaces_moved(info.spec.parameters);
        return std::ranges::find(moved, type.links[link.index()].name) != moved.end();
    });
}

RobotType stand_of(const ModelSpec& spec, ShapeStore& shapes, Diagnostics& diagnostics) {
    RobotType type;
    type.name = spec.name;
    type.free_base = false;
    type.is_static = true;
    for (const LinkSpec& link : spec.links) {
        const LinkId id(type.links.size());
        const Transform X_BL = to_transform(link.X_ML);
        type.links.push_back(to_link(link, -1, X_BL));
        std::vector<std::size_t> counts;  // of shapes, by collision
        if (!link.sensors.empty())
            for (const CollisionSpec& collision : link.collisions)
                counts.push_back(shapes.shapes_of(collision, true).size());
        for (const SensorSpec& sensor : link.sensors)
            type.sensors.push_back({with_chosen_shapes(sensor, link, counts, diagnostics), id});
    }
    ModelSpec commanded = spec;
    std::erase_if(commanded.onboard, always_flows);
    add_onboard(commanded, true, type, diagnostics);
    type.scenery = driven_scenery(spec, type, shapes, diagnostics);
    if (!type.scenery.empty()) type.reach = farthest_corner(type.scenery);
    type.hash = type_hash(type);
    return type;
}

}  // namespace roboss
