// compile(World) -> Model: types once, robots placed, static scenery flattened and put into its BVH,
// everything hashed.
#include <algorithm>
#include <map>

#include "model/accuracy.h"
#include "model/compile_type.h"
#include "model/seal.h"
#include "model/start_state.h"
#include "world/left_out.h"

namespace roboss {
namespace {

/// What one prototype compiles to: robot parts, or static shapes in its model frame.
struct CompiledPrototype {
    std::vector<CompiledPart> parts;
    std::vector<TypeId> types;
    bool left_out = false;  // it has errors
};

bool has_sensors(const ModelSpec& spec) {
    return std::any_of(spec.links.begin(), spec.links.end(), [](const LinkSpec& link) {
        return std::any_of(link.sensors.begin(), link.sensors.end(),
                           [](const SensorSpec& s) { return s.measures(); });
    });
}

/// Static models with nothing but surface motions that take no command need no state.
bool has_controllers(const ModelSpec& spec) {
    return std::ranges::any_of(spec.onboard,
                               [](const OnboardSpec& onboard) { return !always_flows(onboard); });
}

/// How the surface of a static link always moves.
SurfaceFlow flow_of(const ModelSpec& spec, const LinkSpec& link, const Transform& X_WL) {
    for (const OnboardSpec& onboard : spec.onboard) {
        const auto* motion = std::get_if<SurfaceVelocitySpec>(&onboard.parameters);
        if (motion != nullptr && motion->fixed && motion->link.front() == link.name)
            return {X_WL.R * motion->linear, X_WL.R * motion->angular, {}, X_WL.p};
    }
    return {};
}

/// Shapes of a static model; `owner`, of type `stand`: the robot that carries its sensors and controllers, if
/// any.
void add_statics(const ModelSpec& spec, const ModelInstance& instance, RobotId owner, const RobotType* stand,
                 ShapeStore& shapes, Model& model) {
    for (std::size_t l = 0; l < spec.links.size(); ++l) {
        const LinkSpec& link = spec.links[l];
        const SurfaceFlow flow = flow_of(spec, link, to_transform(instance.X_WM * link.X_ML));
        const bool driven = stand != nullptr && moves_surface(*stand, LinkId(l));
        for (const CollisionSpec& collision : link.collisions) {
            for (const PlacedShape& placed : shapes.shapes_of(collision, true)) {
                StaticShape shape;
                shape.shape = placed.shape;
                shape.X_WS = to_transform(instance.X_WM * link.X_ML * collision.X_LS);
                shape.X_WS.p += shape.X_WS.R * placed.p_CS;
                shape.material = to_material(collision.surface);
                shape.laser_retro = collision.laser_retro;
                shape.name = instance.name + "::" + link.name + "::" + collision.name;
                shape.robot = owner;
                if (owner.valid()) shape.link = LinkId(l);
                if (collision.moves) shape.flow = flow;
                shape.driven = driven && collision.moves && shape.shape.kind != ShapeKind::kPlane;
                model.statics.push_back(shape);
            }
        }
    }
}

using KnownTypes = std::map<std::pair<std::uint64_t, std::string>, TypeId>;

/// Types equal in every number and name are one type, whatever prototype they come from.
TypeId intern_type(RobotType type, Model& model, KnownTypes& known) {
    const auto [entry, is_new] = known.try_emplace({type.hash, ros_names(type)}, TypeId(model.types.size()));
    if (is_new) model.types.push_back(std::move(type));
    return entry->second;
}

std::vector<CompiledPrototype> compile_prototypes(const World& world, ShapeStore& shapes, Model& model,
                                                  Diagnostics& diagnostics) {
    std::vector<CompiledPrototype> prototypes(world.prototypes.size());
    KnownTypes known;
    const Surroundings around{!model.fluid.densities.empty(),
                              world.wind_effects ? &*world.wind_effects : nullptr};
    for (std::size_t p = 0; p < world.prototypes.size(); ++p) {
        const ModelSpec& spec = world.prototypes[p];
        const std::size_t first = diagnostics.items().size();
        if (!spec.is_static) {
            prototypes[p].parts = compile_parts(spec, around, shapes, diagnostics);
        } else if (has_sensors(spec) || has_controllers(spec)) {
            RobotType stand = stand_of(spec, shapes, diagnostics);
            if (has_sensors(spec) || !stand.onboard.empty())
                prototypes[p].parts = {{std::move(stand), "", Pose{}}};
        }
        prototypes[p].left_out = diagnostics.leave_out_since(first);
        if (prototypes[p].left_out) continue;
        for (const CompiledPart& part : prototypes[p].parts)
            prototypes[p].types.push_back(intern_type(part.type, model, known));
    }
    return prototypes;
}

/// Instance `index` of the world: its robots, or its shapes among the scenery (bad ones are reported).
void place(const World& world, std::size_t index, const CompiledPrototype& prototype, ShapeStore& shapes,
           Model& model, Diagnostics& diagnostics) {
    const ModelInstance& instance = world.instances[index];
    const ModelSpec& spec = world.prototypes[instance.prototype];
    if (spec.is_static) {
        const bool stands = !prototype.parts.empty();
        add_statics(spec, instance, stands ? RobotId(model.robots.size()) : RobotId(),
                    stands ? &prototype.parts.front().type : nullptr, shapes, model);
    }
    for (std::size_t p = 0; p < prototype.parts.size(); ++p) {
        const CompiledPart& part = prototype.parts[p];
        model.robots.push_back({instance.name + part.suffix, prototype.types[p], instance.X_WM * part.X_MR,
                                static_cast<std::uint32_t>(index)});
        if (!spec.is_static) set_start(instance, part.type, model.robots.back(), diagnostics);
    }
}

}  // namespace

std::shared_ptr<const Model> compile(const World& world, const CompileOptions& options,
                                     Diagnostics& diagnostics) {
    const std::size_t first = diagnostics.items().size();
    auto model = std::make_shared<Model>();
    model->name = world.name;
    model->dt_s = options.dt_s.value_or(world.dt_s);
    model->gravity = world.gravity;
    model->magnetic_field_T = world.magnetic_field_T;
    model->wind = world.wind;
    model->air_density = world.air_density;
    if (world.wind_effects) model->wind_regions = world.wind_effects->regions;
    if (world.buoyancy) model->fluid = FluidLayers::of(*world.buoyancy);
    model->spherical = world.spherical;
    model->sleep = options.sleep.value_or(world.sleep);
    for (const AccuracySpec& spec : world.accuracy) apply(spec, model->accuracy, diagnostics);
    apply(options.accuracy, model->accuracy, diagnostics);
    model->precision = options.precision.value_or(world.precision);
    if (!(model->dt_s > 0 && model->dt_s <= 1.0))
        diagnostics.error({world.file, 0}, "bad-step",
                          "the step of " + std::to_string(model->dt_s) + " s is not in (0, 1] s",
                          "set <physics><max_step_size> or --dt to a few milliseconds");

    ShapeStore shapes(*model, diagnostics);
    const std::vector<CompiledPrototype> prototypes = compile_prototypes(world, shapes, *model, diagnostics);
    std::map<std::size_t, std::vector<std::size_t>> left_out;  // instances by prototype
    std::size_t left = world.instances.size();
    for (std::size_t i = 0; i < world.instances.size(); ++i) {
        const CompiledPrototype& prototype = prototypes[world.instances[i].prototype];
        const std::size_t found = diagnostics.items().size(), statics = model->statics.size();
        if (!prototype.left_out) place(world, i, prototype, shapes, *model, diagnostics);
        if (!diagnostics.leave_out_since(found) && !prototype.left_out) continue;
        model->statics.resize(statics);
        left_out[world.instances[i].prototype].push_back(i);
        --left;
    }
    if (left == 0) diagnostics.refuse_since(first);
    for (const auto& [prototype, alike] : left_out) {
        const ModelInstance& instance = world.instances[alike.front()];
        if (left > 0) report_left_out(instance.name, alike.size(), instance.where, diagnostics);
    }
    seal(*model);
    return diagnostics.refuses_since(first) ? nullptr : model;
}

}  // namespace roboss
