// The arrangement of gz-sim's example world 3k_shapes: three rows of boxes, cylinders and spheres of a metre,
// at rest on the ground, 1.5 m apart, 1 ms a step. Nothing happens, so what is measured is what rest costs:
// of bodies that are awake, and of bodies that may fall asleep.
#include <algorithm>
#include <cstdio>

#include <support/bodies.h>

#include "scenes/scene.h"

namespace roboss::bench {
namespace {

constexpr double kDt = 0.001, kSpacing = 1.5, kFirst = -750;  // s, m, m
constexpr int kFallAsleep = 3000;                             // ticks; engines wait for 0.5 to 2 s
constexpr double kMoved = 1e-3;                               // m, in a run

ModelSpec shape(const char* name, double mass, double moment, const CollisionSpec& collision) {
    ModelSpec model = test::one_link(test::link("link", mass, Mat3::diagonal(moment, moment, moment)));
    model.name = name;
    model.links[0].collisions.push_back(collision);
    return model;
}

Verdict judge(const World& world, const Engine& engine) {
    double moved = 0, fastest = 0;
    for (std::size_t i = 1; i < world.instances.size(); ++i) {
        const LinkState state = engine.link({i, 0});
        moved = std::max(moved, norm(state.X_WL.p - world.instances[i].X_WM.p));
        fastest = std::max(fastest, norm(state.v_WC));
    }
    char text[120];
    std::snprintf(text, sizeof text, "moved by at most %.3f mm, at most %.1e m/s", 1e3 * moved, fastest);
    return {moved < kMoved, text};
}

Scene make_scene(std::size_t shapes, bool sleep) {
    Scene scene;
    scene.robots = shapes;
    scene.dt_s = kDt, scene.sleep = sleep;
    scene.settle = sleep ? kFallAsleep : 0;
    World& world = scene.world = test::empty_world(kDt);
    world.name = "3k_shapes";
    world.sleep = sleep;
    const SurfaceSpec surface = test::surface(1.0);
    test::place(world, test::ground(surface), "ground");
    world.prototypes.push_back(shape("box", 1, 1, test::box_shape({1, 1, 1}, surface)));
    world.prototypes.push_back(shape("cylinder", 2, 2, test::cylinder_shape(0.5, 1, surface)));
    world.prototypes.push_back(shape("sphere", 3, 3, test::sphere_shape(0.5, surface)));
    constexpr double kRow[] = {0, -kSpacing, kSpacing};  // m, y of boxes, cylinders, spheres
    for (std::size_t i = 0; i < shapes; ++i) {
        const Vec3 p{kFirst + kSpacing * static_cast<double>(i / 3), kRow[i % 3], 0.5};
        world.instances.push_back({"shape_" + std::to_string(i), 1 + i % 3, {p, {}}, {}});
    }
    scene.start = [](Engine&) {};
    scene.judge = [copy = world](const Engine& engine, Tick) { return judge(copy, engine); };
    return scene;
}

}  // namespace

Scene resting_shapes_scene(std::size_t shapes) {
    return make_scene(shapes, false);
}

Scene sleeping_shapes_scene(std::size_t shapes) {
    return make_scene(shapes, true);
}

}  // namespace roboss::bench
