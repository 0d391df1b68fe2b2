// Humanoids whose links are cut into some thousand convex hulls, as V-HACD and CoACD do with the meshes of a
// robot. They fall freely and bend, and nothing touches: what is measured is finding that out.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <support/meshes.h>

#include "scenes/scene.h"

namespace roboss::bench {
namespace {

constexpr double kSpacing = 1.5;      // m
constexpr double kHeight = 100;       // m, over nothing
constexpr double kOff = 0.05;         // m, from the path of the fall: integrators of first order
constexpr std::size_t kQuarters = 4;  // of a slab

/// A limb along z of the model's frame.
struct Limb {
    const char* name;
    const char* parent;
    Vec3 top;  // where its joint is; m
    Vec3 axis;
    double length, radius;  // m; a negative length goes up
    double mass;            // kg
    int slabs;              // of four hulls each
};

constexpr std::array kLimbs{
    Limb{"pelvis", nullptr, {0, 0, 0.10}, {}, 0.18, 0.12, 9, 20},
    Limb{"torso", "pelvis", {0, 0, 0.12}, {0, 0, 1}, -0.45, 0.14, 20, 40},
    Limb{"head", "torso", {0, 0, 0.62}, {0, 1, 0}, -0.22, 0.09, 4, 20},
    Limb{"thigh", "pelvis", {0, 0.2, -0.12}, {0, 1, 0}, 0.38, 0.07, 7, 15},
    Limb{"shin", "thigh", {0, 0.2, -0.54}, {0, 1, 0}, 0.36, 0.05, 3, 15},
    Limb{"foot", "shin", {0, 0.2, -0.94}, {1, 0, 0}, 0.06, 0.08, 1, 10},
    Limb{"upper_arm", "torso", {0, 0.32, 0.50}, {0, 1, 0}, 0.26, 0.045, 2, 10},
    Limb{"forearm", "upper_arm", {0, 0.32, 0.20}, {0, 1, 0}, 0.22, 0.04, 1.2, 10},
    Limb{"hand", "forearm", {0, 0.32, -0.06}, {1, 0, 0}, 0.18, 0.04, 0.5, 25},
};

/// A quarter of a slab of a limb between two heights, one of its corners on the axis.
MeshSpec wedge(double radius, double low, double high, std::size_t quarter) {
    constexpr std::size_t kArc = 4;  // corners on the rim
    MeshSpec mesh;
    mesh.source = "wedge";
    for (const double z : {low, high}) {
        mesh.vertices.push_back({0, 0, z});
        for (std::size_t k = 0; k < kArc; ++k) {
            const double angle =
                0.5 * kPi * (static_cast<double>(quarter) + static_cast<double>(k) / (kArc - 1));
            mesh.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
        }
    }
    constexpr std::uint32_t n = kArc + 1;
    for (std::uint32_t k = 1; k + 1 < n; ++k)
        mesh.triangles.push_back({0, k + 1, k}), mesh.triangles.push_back({n, n + k, n + k + 1});
    for (std::uint32_t k = 0; k < n; ++k) {
        const std::uint32_t next = (k + 1) % n;
        mesh.triangles.push_back({k, next, n + next}), mesh.triangles.push_back({k, n + next, n + k});
    }
    return mesh;
}

LinkSpec cut_limb(const Limb& limb, const std::string& name, double side) {
    const double length = std::fabs(limb.length), middle = limb.top.z - 0.5 * limb.length;
    LinkSpec link = test::link(name, limb.mass, test::cylinder_inertia(limb.mass, limb.radius, length),
                               {{limb.top.x, side * limb.top.y, middle}, {}});
    const double slab = length / limb.slabs;
    for (int k = 0; k < limb.slabs; ++k) {
        // As thick as a limb is: a spindle.
        const double low = -0.5 * length + slab * k, bulge = (low + 0.5 * slab) / length;
        const double radius = limb.radius * (1 - bulge * bulge);
        for (std::size_t quarter = 0; quarter < kQuarters; ++quarter)
            link.collisions.push_back(
                test::mesh_shape(wedge(radius, low, low + slab, quarter), test::surface(0.8)));
    }
    return link;
}

void add_limb(const Limb& limb, const std::string& suffix, double side, ModelSpec& model) {
    const std::string name = limb.name + suffix;
    model.links.push_back(cut_limb(limb, name, side));
    if (limb.parent == nullptr) return;
    const bool of_a_pair = std::any_of(model.links.begin(), model.links.end(),
                                       [&](const LinkSpec& l) { return l.name == limb.parent + suffix; });
    model.joints.push_back(test::joint(JointSpecKind::kRevolute, name + "_joint",
                                       of_a_pair ? limb.parent + suffix : limb.parent, name,
                                       {{limb.top.x, side * limb.top.y, limb.top.z}, {}}, limb.axis));
    AxisSpec& axis = model.joints.back().axes[0];
    axis.damping = 0.2;
    axis.lower = -0.5, axis.upper = 0.5;
}

ModelSpec humanoid() {
    ModelSpec model;
    model.name = "humanoid";
    model.canonical_link = kLimbs[0].name;
    model.self_collide = true;
    for (const Limb& limb : kLimbs)
        if (limb.top.y == 0) add_limb(limb, "", 0, model);
    for (const auto& [suffix, side] : {std::pair{"_left", 1.0}, std::pair{"_right", -1.0}})
        for (const Limb& limb : kLimbs)
            if (limb.top.y != 0) add_limb(limb, suffix, side, model);
    return model;
}

/// Joints bend by turns to and fro.
void start(Engine& engine, const World& world) {
    for (std::size_t i = 0; i < world.instances.size(); ++i)
        for (std::size_t j = 0; j < world.prototypes[0].joints.size(); ++j)
            engine.set_joint({i, j, 0}, {0, j % 2 == 0 ? 0.5 : -0.5});
}

/// The centre of mass falls as a stone does.
Verdict judge(const Engine& engine, const World& world, Tick tick) {
    const ModelSpec& model = world.prototypes[0];
    const double t = static_cast<double>(tick) * kSceneDt, fallen = 0.5 * world.gravity.z * t * t;
    double off = 0;
    for (std::size_t i = 0; i < world.instances.size(); ++i) {
        Vec3 moment, at_start;
        double mass = 0;
        for (std::size_t l = 0; l < model.links.size(); ++l) {
            const double m = model.links[l].mass;
            moment += engine.link({i, l}).X_WL.p * m, mass += m;
            at_start += (world.instances[i].X_WM * model.links[l].X_ML).p * m;
        }
        const Vec3 expected = at_start / mass + Vec3{0, 0, fallen};
        off = std::max(off, norm(moment / mass - expected) / (1 + std::fabs(fallen)));
    }
    char text[80];
    std::snprintf(text, sizeof text, "at most %.4f off the fall of a stone", off);
    return {off < kOff, text};
}

}  // namespace

Scene many_hulls_scene(std::size_t humanoids) {
    Scene scene;
    scene.robots = humanoids;
    scene.world = test::empty_world(kSceneDt);
    scene.world.name = "many_hulls";
    scene.world.prototypes.push_back(humanoid());
    for (std::size_t i = 0; i < humanoids; ++i)
        scene.world.instances.push_back(
            {"humanoid_" + std::to_string(i),
             0,
             {{kSpacing * static_cast<double>(i % 5), kSpacing * static_cast<double>(i / 5), kHeight}, {}},
             {}});
    const World& world = scene.world;
    scene.start = [world](Engine& engine) { start(engine, world); };
    scene.judge = [world](const Engine& engine, Tick tick) { return judge(engine, world, tick); };
    return scene;
}

}  // namespace roboss::bench
