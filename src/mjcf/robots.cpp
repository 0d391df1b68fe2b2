// Joints of MJCF stand in their child, at the pose that the file gives it, which is where the joint's
// coordinate is `ref`. RoBOSS places links where all joints are at zero, so each joint is turned back by ref.
// Coordinates, limits and springs keep the file's numbers.
#include "mjcf/robots.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "world/joint_type.h"

namespace roboss::mjcf {
namespace {

constexpr const char* kScenery = "worldbody";  // the model of the geoms in <worldbody>
constexpr int kLastShownGroup = 2;             // MuJoCo's viewer hides the others

JointSpecKind kind_of(JointMotion motion) {
    if (motion == JointMotion::kBall) return JointSpecKind::kBall;
    return motion == JointMotion::kSlide ? JointSpecKind::kPrismatic : JointSpecKind::kRevolute;
}

/// The motion of a joint at -ref, in its own frame.
Pose turned_back(const JointPart& joint) {
    if (joint.motion == JointMotion::kHinge) return {{}, axis_angle(joint.axis.xyz, -joint.ref)};
    return {joint.axis.xyz * -joint.ref, {}};
}

bool is_free(const BodyPart& body) {
    return !body.joints.empty() && body.joints.front().motion == JointMotion::kFree;
}

/// What the geoms of a body give, or its <inertial>.
Mass mass_of(const BodyPart& body) {
    const Settings& settings = *body.settings;
    const bool from_geoms = settings.inertia_from_geom == InertiaFromGeom::kAlways ||
                            (settings.inertia_from_geom == InertiaFromGeom::kAuto && !body.inertial);
    std::optional<Mass> mass;
    if (from_geoms) {
        std::vector<GeomMass> masses;
        for (const GeomPart& geom : body.geoms)
            if (geom.mass) masses.push_back(*geom.mass);
        mass = sum_of(masses, settings);
    }
    return bounded(mass ? *mass : body.inertial.value_or(Mass{}), settings);
}

VisualSpec visual_of(const GeomPart& geom) {
    VisualSpec visual;
    visual.name = geom.name;
    visual.geometry = geom.shape;
    visual.X_LV = geom.X_BG;
    visual.rgb = geom.rgb;
    visual.alpha = geom.alpha;
    return visual;
}

void add_geoms(const BodyPart& body, LinkSpec& link) {
    for (const GeomPart& geom : body.geoms) {
        if (!geom.has_shape) continue;
        if (geom.collides()) {
            CollisionSpec collision;
            collision.name = geom.name;
            collision.geometry = geom.shape;
            collision.X_LS = geom.X_BG;
            collision.surface = geom.surface;
            collision.where = geom.where;
            link.collisions.push_back(std::move(collision));
        }
        if (geom.group <= kLastShownGroup && geom.alpha > 0) link.visuals.push_back(visual_of(geom));
    }
}

std::string unused_name(std::string name, const std::vector<ModelSpec>& models, const Tree& tree) {
    const auto taken = [&] {
        return tree.find_body(name) != nullptr ||
               std::ranges::any_of(models, [&](const ModelSpec& m) { return m.name == name; });
    };
    while (taken()) name += "_";
    return name;
}

}  // namespace

std::vector<std::size_t> Robots::roots_in(const Tree& tree) {
    std::vector<std::size_t> roots(tree.bodies.size(), 0);
    for (std::size_t b = 1; b < roots.size(); ++b) {
        const std::size_t parent = tree.bodies[b].parent;
        roots[b] = parent == 0 ? b : roots[parent];
    }
    return roots;
}

std::vector<Fate> Robots::fates_in(const Tree& tree, const std::vector<std::size_t>& roots) {
    std::vector<Fate> fates(roots.size(), Fate::kScenery);
    for (std::size_t b = 1; b < roots.size(); ++b)
        if (!tree.bodies[b].joints.empty() && fates[roots[b]] == Fate::kScenery)
            fates[roots[b]] = is_free(tree.bodies[roots[b]]) ? Fate::kFree : Fate::kFixed;
    for (std::size_t b = 1; b < roots.size(); ++b)
        if (tree.bodies[b].mocap && fates[b] == Fate::kScenery) fates[b] = Fate::kMocap;
    return fates;
}

Robots::Robots(Tree& tree, const std::vector<std::pair<std::size_t, std::size_t>>& tied,
               const Reading& reading)
    : tree_(tree),
      roots_(roots_in(tree)),
      fates_(fates_in(tree, roots_)),
      X_MB_(tree.bodies.size()),
      model_of_(tree.bodies.size(), 0),
      link_index_(tree.bodies.size(), 0),
      joint_index_(tree.bodies.size()) {
    double total = 0;
    for (std::size_t b = 1; b < tree.bodies.size(); ++b) total += mass_of(tree.bodies[b]).mass;
    if (reading.settings.total_mass > 0 && total > 0) mass_factor_ = reading.settings.total_mass / total;
    // Tied trees are one model: that of the first root of them.
    std::vector<std::size_t> leader(tree.bodies.size());
    std::iota(leader.begin(), leader.end(), std::size_t{0});
    const auto first_of = [&](std::size_t root) {
        while (leader[root] != root) root = leader[root];
        return root;
    };
    for (const auto& pair : tied) {
        const std::size_t a = first_of(roots_[pair.first]), b = first_of(roots_[pair.second]);
        leader[std::max(a, b)] = std::min(a, b);
    }
    for (const BodyPart& body : tree.bodies) copy_.push_back(body.copy);
    for (std::size_t b = 0; b < tree.bodies.size(); ++b)
        if (const std::size_t first = first_of(b); first != b) copy_[b] = copy_[first] = {};
    for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
        const std::size_t root = roots_[b], first = first_of(root);
        model_of_[b] = b == root && first == b ? start_model(b) : model_of_[first];
        add_body(b);
    }
}

std::string Robots::local_name(std::size_t body) const {
    const std::size_t root = roots_[body];
    if (!tree_.bodies[body].has_name && !copy_[root].empty()) return "body_" + std::to_string(body - root);
    return local_name(body, tree_.bodies[body].name);
}

std::string Robots::local_name(std::size_t body, const std::string& part) const {
    const BodyPart& owner = tree_.bodies[body];
    const Names& copy = copy_[roots_[body]];
    if (copy.empty()) return part;
    if (!owner.has_name && part.starts_with(owner.name) && part != owner.name)
        return local_name(body) + part.substr(owner.name.size());
    if (part.size() <= copy.prefix.size() + copy.suffix.size() || !part.starts_with(copy.prefix) ||
        !part.ends_with(copy.suffix))
        return part;
    return part.substr(copy.prefix.size(), part.size() - copy.prefix.size() - copy.suffix.size());
}

std::size_t Robots::start_model(std::size_t body) {
    const BodyPart& root = tree_.bodies[body];
    ModelSpec model;
    model.name = body == 0 ? unused_name(kScenery, models_, tree_) : root.name;
    model.where = root.where;
    model.canonical_link = body == 0 ? model.name : local_name(body);
    model.is_static = fates_[body] == Fate::kScenery;
    model.kinematic = fates_[body] == Fate::kMocap;
    model.self_collide = !model.is_static && !model.kinematic;
    model.shared_names = true;
    model.may_sleep = true;
    starts_.push_back({{}, 0, root.X_PB, model.where});
    models_.push_back(std::move(model));
    return models_.size() - 1;
}

void Robots::add_body(std::size_t index) {
    const BodyPart& body = tree_.bodies[index];
    ModelSpec& model = models_[model_of_[index]];
    const bool is_root = roots_[index] == index;
    Pose X = is_root ? inverse(place_of(index)) * body.X_PB : X_MB_[body.parent] * body.X_PB;
    if (is_root && model.links.empty()) X = {};  // it is the model's frame
    const std::string parent = is_root ? "world" : local_name(body.parent);
    const std::string last = is_free(body) || model.is_static ? parent : add_joints(body, parent, X);
    X_MB_[index] = X;
    add_link(index, X);
    if (body.joints.empty() && !model.is_static) {
        JointSpec weld;
        weld.name = "fix_" + local_name(index);
        while (tree_.find_joint(weld.name)) weld.name += "_";
        weld.parent = last, weld.child = local_name(index);
        weld.X_MJ = X;
        weld.where = body.where;
        model.joints.push_back(std::move(weld));
    }
}

/// The joints of a body, with links without mass between them. Returns the parent of the last one.
std::string Robots::add_joints(const BodyPart& body, const std::string& parent, Pose& X) {
    const std::size_t index = tree_.index_of(body);
    ModelSpec& model = models_[model_of_[index]];
    std::string before = parent;
    for (std::size_t k = 0; k < body.joints.size(); ++k) {
        const JointPart& part = body.joints[k];
        const bool is_last = k + 1 == body.joints.size();
        JointSpec joint;
        joint.name = local_name(index, part.name);
        joint.kind = kind_of(part.motion);
        joint.parent = before;
        joint.child = is_last ? local_name(index) : local_name(index) + "/" + joint.name;
        joint.X_MJ = X * Pose{part.pos, {}};
        joint.where = part.where;
        joint.ball_damping = part.ball_damping;
        joint.ball_armature = part.ball_armature;
        if (part.motion != JointMotion::kBall) {
            joint.axes.push_back(part.axis);
            X = joint.X_MJ * turned_back(part) * Pose{-part.pos, {}};
        }
        before = joint.child;
        joint_index_[index].push_back(model.joints.size());
        model.joints.push_back(std::move(joint));
        if (is_last) break;
        LinkSpec between;
        between.name = before;
        between.X_ML = X;
        between.mass = 0;
        between.inertia_C = {};
        between.between_joints = true;
        between.where = part.where;
        model.links.push_back(std::move(between));
    }
    return before;
}

void Robots::add_link(std::size_t index, const Pose& X) {
    const BodyPart& body = tree_.bodies[index];
    ModelSpec& model = models_[model_of_[index]];
    LinkSpec link;
    link.name = index == 0 ? model.canonical_link : local_name(index);
    link.X_ML = X;
    link.where = body.where;
    link.gravity = body.gravity;
    const Mass mass = mass_of(body);
    link.mass = mass.mass * mass_factor_;
    link.p_LC = mass.centre;
    link.inertia_C = mass.inertia * mass_factor_;
    add_geoms(body, link);
    if (index != 0) link.lights = body.lights;
    for (const SitePart& site : body.sites)
        if (!site.name.empty()) model.frames.push_back({local_name(index, site.name), link.name, site.X_BS});
    link_index_[index] = model.links.size();
    model.links.push_back(std::move(link));
}

LinkSpec& Robots::link_of(std::size_t body) {
    return model_of(body).links[link_index_[body]];
}

JointSpec* Robots::joint_of(const Tree::JointPlace& place) {
    const auto& joints = joint_index_[place.body];
    return place.joint < joints.size() ? &model_of(place.body).joints[joints[place.joint]] : nullptr;
}

void Robots::move_to(World& world) {
    world.look.lights = tree_.bodies.front().lights;
    for (std::size_t m = 0; m < models_.size(); ++m) {
        ModelSpec& model = models_[m];
        const bool is_empty = model.is_static && std::ranges::all_of(model.links, [](const LinkSpec& link) {
                                  return link.collisions.empty() && link.visuals.empty() &&
                                         link.sensors.empty() && link.lights.empty();
                              });
        if (is_empty) continue;
        starts_[m].name = model.name, starts_[m].prototype = world.prototypes.size();
        world.instances.push_back(std::move(starts_[m]));
        world.prototypes.push_back(std::move(model));
    }
}

}  // namespace roboss::mjcf
