// Boxes, spheres and cylinders that fall in layers onto a plane and onto each other: three layers, or twenty
// that collapse under their weight.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <support/bodies.h>

#include "scenes/overlap.h"
#include "scenes/random.h"
#include "scenes/scene.h"

namespace roboss::bench {
namespace {

constexpr double kMu = 0.6;
constexpr double kSpacing = 0.22, kLayer = 0.3;  // m
constexpr std::uint64_t kSeed = 3000;

constexpr std::size_t kShallow = 3, kDeep = 20;  // layers

Verdict judge(const World& world, const Engine& engine, Tick tick, std::size_t layers) {
    const Overlap overlap = measure_overlap(world, engine);
    double lowest = 1e9, highest = -1e9;
    for (std::size_t i = 1; i < world.instances.size(); ++i) {
        const double z = engine.link({i, 0}).X_WL.p.z;
        lowest = std::min(lowest, z), highest = std::max(highest, z);
    }
    char text[120];
    std::snprintf(text, sizeof text, "z %.3f to %.3f m, deepest overlap %.2f mm", lowest, highest,
                  1e3 * overlap.deepest_m);
    const bool landed = tick < 800 || highest < (layers == kShallow ? 0.6 : 2.5);
    return {lowest > 0.03 && landed && overlap.deepest_m < 0.02, text};
}

Scene make_scene(const char* name, std::size_t shapes, std::size_t layers) {
    Scene scene;
    scene.robots = shapes;
    World& world = scene.world = test::empty_world(kSceneDt);
    world.name = name;
    const SurfaceSpec surface = test::surface(kMu);
    test::place(world, test::ground(surface), "ground");
    world.prototypes.push_back(test::solid_box(1.0, {0.1, 0.12, 0.08}, surface));
    world.prototypes.push_back(test::solid_sphere(0.8, 0.05, surface));
    world.prototypes.push_back(test::solid_cylinder(0.8, 0.05, 0.1, surface));
    Random random(kSeed);
    const auto side = static_cast<std::size_t>(
        std::ceil(std::sqrt(static_cast<double>(shapes) / static_cast<double>(layers))));
    for (std::size_t i = 0; i < shapes; ++i) {
        const std::size_t place = i / layers, layer = i % layers;
        const Vec3 p{kSpacing * static_cast<double>(place % side) + random.uniform(-0.05, 0.05),
                     kSpacing * static_cast<double>(place / side) + random.uniform(-0.05, 0.05),
                     0.15 + kLayer * static_cast<double>(layer)};
        const double roll = random.uniform(-3, 3), pitch = random.uniform(-1.5, 1.5);
        const Quat q = from_rpy(roll, pitch, random.uniform(-3, 3));
        world.instances.push_back({"shape_" + std::to_string(i), 1 + (i + place) % 3, {p, q}, {}});
    }
    scene.start = [](Engine&) {};
    scene.judge = [copy = world, layers](const Engine& engine, Tick tick) {
        return judge(copy, engine, tick, layers);
    };
    return scene;
}

}  // namespace

Scene shapes_scene(std::size_t shapes) {
    return make_scene("shapes", shapes, kShallow);
}

Scene deep_pile_scene(std::size_t shapes) {
    return make_scene("deep pile", shapes, kDeep);
}

}  // namespace roboss::bench
