// Which robot looks like what: by the names of models and links.
#include "scene/scene.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/hash.h"
#include "scene/shape_table.h"

namespace roboss {
namespace {

const Vec3 kGround{0.50, 0.53, 0.57};  // darker than a body without material that stands on it
const Vec3 kScenery{0.55, 0.60, 0.68};

/// A pleasant colour for what has none, the same for the same name.
Vec3 colour_of(const std::string& name) {
    static constexpr Vec3 kPalette[] = {{0.23, 0.49, 0.77}, {0.90, 0.49, 0.13}, {0.33, 0.66, 0.41},
                                        {0.77, 0.31, 0.32}, {0.51, 0.45, 0.70}, {0.58, 0.47, 0.38},
                                        {0.85, 0.55, 0.76}, {0.10, 0.65, 0.68}};
    Hash hash;
    hash.add(std::string_view(name));
    return kPalette[hash.value() % std::size(kPalette)];
}

bool has_visuals(const ModelSpec& spec) {
    return std::any_of(spec.links.begin(), spec.links.end(),
                       [](const LinkSpec& link) { return !link.visuals.empty(); });
}

class SceneMaker {
  public:
    SceneMaker(const Model& model, std::span<const World* const> worlds) : model_(model), worlds_(worlds) {
        for (const World* world : worlds)
            for (const ModelInstance& instance : world->instances)
                specs_[instance.name] = &world->prototypes[instance.prototype];
    }

    Scene make() {
        std::map<std::pair<TypeId, const ModelSpec*>, std::size_t> known;
        for (const Robot& robot : model_.robots) {
            const std::pair key(robot.type, spec_of(robot));
            const auto [entry, is_new] = known.try_emplace(key, scene_.types.size());
            if (is_new) add_type(robot.type, key.second);
            scene_.robots.push_back(entry->second);
        }
        for (const World* world : worlds_) {
            add_world_statics(*world);
            add_look(*world);
        }
        add_other_statics();
        for (const StaticShape& from : model_.statics) add_flow(from);
        scene_.meshes = shapes_.take_meshes();
        scene_.textures = shapes_.take_textures();
        return std::move(scene_);
    }

  private:
    /// What a World says of a robot; a robot of several is called MODEL::LINK. nullptr: nothing.
    const ModelSpec* spec_of(const Robot& robot) const {
        const RobotType& type = model_.types[robot.type.index()];
        for (std::size_t end = robot.name.size(); end != std::string::npos && end > 0;
             end = robot.name.rfind("::", end - 1)) {
            const auto found = specs_.find(robot.name.substr(0, end));
            if (found == specs_.end()) continue;
            const ModelSpec& spec = *found->second;
            const bool fits = std::all_of(type.links.begin(), type.links.end(), [&](const Link& link) {
                return link_of(spec, link.name) != nullptr;
            });
            if (fits && spec.is_static == type.is_static) return &spec;
        }
        return nullptr;
    }

    static const LinkSpec* link_of(const ModelSpec& spec, const std::string& name) {
        const auto found = std::find_if(spec.links.begin(), spec.links.end(),
                                        [&](const LinkSpec& link) { return link.name == name; });
        return found == spec.links.end() ? nullptr : &*found;
    }

    void add_type(TypeId id, const ModelSpec* spec) {
        const RobotType& type = model_.types[id.index()];
        SceneType result{id, std::vector<SceneLink>(type.links.size())};
        const Vec3 rgb = colour_of(type.name);
        for (const BodyShape& from : type.shapes) {
            SceneShape shape = shapes_.shape_of(from.shape);
            const Link& link = type.links[from.link.index()];
            shape.frame = to_pose(inverse(link.X_BL) * from.X_BS);
            shape.rgb = rgb;
            shape.name = link.name;
            shape.still = !from.moves;
            result.links[from.link.index()].collisions.push_back(std::move(shape));
        }
        const bool drawn = spec != nullptr && has_visuals(*spec);
        for (std::size_t l = 0; l < type.links.size(); ++l) {
            SceneLink& link = result.links[l];
            if (type.is_static) continue;  // its visuals are scenery
            if (spec != nullptr) link.lights = link_of(*spec, type.links[l].name)->lights;
            if (!drawn) {
                link.visuals = link.collisions;
                continue;
            }
            const std::vector<VisualSpec>& visuals = link_of(*spec, type.links[l].name)->visuals;
            for (const VisualSpec& visual : visuals) add_visual(visual, Pose{}, visual.name, link.visuals);
            const bool unreadable = link.visuals.empty() && !visuals.empty();
            if (unreadable) link.visuals = link.collisions;
        }
        scene_.types.push_back(std::move(result));
    }

    /// Bright highlights make it smoother, where no <pbr> says how smooth it is.
    static void add_shine(const VisualSpec& visual, SceneFinish& finish) {
        constexpr double kDull = 0.35, kRough = 0.9, kGloss = 0.5;
        if (visual.emissive && norm(*visual.emissive) > 0) finish.emissive = visual.emissive;
        if (!visual.specular || finish.roughness || finish.roughness_map) return;
        const Vec3& s = *visual.specular;
        // Roughness has no colour: a coloured highlight shines as its weakest part does.
        const double bright = std::min({s.x, s.y, s.z});
        if (bright >= kDull) finish.roughness = kRough - kGloss * std::min(1.0, bright);
    }

    void add_visual(const VisualSpec& visual, const Pose& X_FL, const std::string& name,
                    std::vector<SceneShape>& shapes) {
        std::optional<SceneShape> shape = shapes_.shape_of(visual.geometry);
        if (!shape) return;
        shape->name = name;
        shape->frame = X_FL * visual.X_LV;
        const bool plain_ground =
            visual.geometry.kind == GeometryKind::kPlane && visual.rgb == VisualSpec{}.rgb;
        shape->rgb = plain_ground ? kGround : visual.rgb;
        shape->alpha = visual.alpha;
        shape->finish = shapes_.finish_of(visual.finish);
        add_shine(visual, shape->finish);
        shape->casts = visual.cast_shadows;
        shape->label = visual.label;
        shape->labels_model = visual.labels_model;
        shape->temperature = visual.temperature;
        shape->visibility_flags = visual.visibility_flags;
        shapes.push_back(std::move(*shape));
    }

    /// Static models with visuals; those without are left to add_other_statics().
    void add_world_statics(const World& world) {
        for (const ModelInstance& instance : world.instances) {
            const ModelSpec& spec = world.prototypes[instance.prototype];
            if (!spec.is_static || !has_visuals(spec)) continue;
            for (const LinkSpec& link : spec.links) {
                for (const VisualSpec& visual : link.visuals)
                    add_visual(visual, instance.X_WM * link.X_ML,
                               instance.name + "::" + link.name + "::" + visual.name, scene_.statics);
                for (const CollisionSpec& collision : link.collisions)
                    drawn_.insert(instance.name + "::" + link.name + "::" + collision.name);
            }
        }
    }

    /// The first world's sky and camera; the lights of all, those of scenery included.
    void add_look(const World& world) {
        WorldLook& look = scene_.look;
        if (!look.scene) look.scene = world.look.scene;
        if (!look.camera) look.camera = world.look.camera;
        look.lights.insert(look.lights.end(), world.look.lights.begin(), world.look.lights.end());
        for (const ModelInstance& instance : world.instances) {
            const ModelSpec& spec = world.prototypes[instance.prototype];
            if (!spec.is_static) continue;
            for (const LinkSpec& link : spec.links)
                for (LightSpec light : link.lights) {
                    light.X_FL = instance.X_WM * link.X_ML * light.X_FL;
                    look.lights.push_back(std::move(light));
                }
        }
    }

    void add_other_statics() {
        for (const StaticShape& from : model_.statics) {
            if (drawn_.contains(from.name)) continue;
            SceneShape shape = shapes_.shape_of(from.shape);
            shape.name = from.name;
            shape.frame = to_pose(from.X_WS);
            shape.rgb = from.shape.kind == ShapeKind::kPlane ? kGround : kScenery;
            scene_.statics.push_back(std::move(shape));
        }
    }

    /// Scenery whose surface moves, or may.
    void add_flow(const StaticShape& from) {
        if (!from.may_flow()) return;
        SceneFlow flow;
        flow.shape = shapes_.shape_of(from.shape);
        flow.shape.name = from.name;
        flow.shape.frame = to_pose(from.X_WS);
        flow.motion = from.flow;
        if (from.driven) flow.robot = from.robot, flow.link = from.link;
        scene_.flows.push_back(std::move(flow));
    }

    const Model& model_;
    std::span<const World* const> worlds_;
    std::map<std::string, const ModelSpec*> specs_;  // by the names of their instances
    std::set<std::string> drawn_;                    // scenery whose visuals are there
    ShapeTable shapes_;
    Scene scene_;
};

}  // namespace

Scene make_scene(const Model& model, std::span<const World* const> worlds) {
    return SceneMaker(model, worlds).make();
}

Scene make_scene(const Model& model, const World* world) {
    return make_scene(model, std::span(&world, world != nullptr ? 1 : 0));
}

}  // namespace roboss
