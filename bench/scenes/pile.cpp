// Bodies with four legs on hinges without motors, dropped in layers into a box: a pile of robots with joints.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <support/bodies.h>

#include "scenes/joint_gap.h"
#include "scenes/overlap.h"
#include "scenes/random.h"
#include "scenes/scene.h"

namespace roboss::bench {
namespace {

constexpr double kMu = 0.6;
constexpr double kSpacing = 0.3, kLayer = 0.26;  // m
constexpr double kWall = 0.1;                    // m, thick
const Vec3 kTrunk{0.14, 0.09, 0.04};
constexpr double kTrunkMass = 0.5, kLegMass = 0.05;  // kg
constexpr double kLeg = 0.09, kLegRadius = 0.012;    // m
constexpr double kSpread = 0.7;                      // rad, of a leg from the vertical
constexpr double kTurn = 0.6;                        // rad, of a leg to either side
constexpr double kDamping = 2e-3;                    // N m s/rad
constexpr std::uint64_t kSeed = 500;

void add_leg(ModelSpec& model, int leg, double x, double y) {
    const std::string name = "leg_" + std::to_string(leg);
    const Pose X_hip{{x, y, 0}, from_rpy(y > 0 ? -kSpread : kSpread, 0, 0)};  // the leg points along -z
    const Pose X_ML = X_hip * Pose{{0, 0, -0.5 * kLeg}, {}};
    const double length = kLeg - 2 * kLegRadius;
    LinkSpec link = test::link(name, kLegMass, test::cylinder_inertia(kLegMass, kLegRadius, kLeg), X_ML);
    link.collisions.push_back(test::collision(GeometryKind::kCapsule, test::surface(kMu)));
    link.collisions.back().geometry.radius = kLegRadius;
    link.collisions.back().geometry.length = length;
    model.links.push_back(link);
    model.joints.push_back(
        test::joint(JointSpecKind::kRevolute, "hip_" + std::to_string(leg), "trunk", name, X_hip, {0, 1, 0}));
    AxisSpec& axis = model.joints.back().axes[0];
    axis.lower = -kTurn, axis.upper = kTurn, axis.damping = kDamping;
}

ModelSpec four_legs() {
    ModelSpec model;
    model.name = model.canonical_link = "trunk";
    model.links.push_back(test::link("trunk", kTrunkMass, test::box_inertia(kTrunkMass, kTrunk)));
    model.links[0].collisions.push_back(test::box_shape(kTrunk, test::surface(kMu)));
    int leg = 0;
    for (const double x : {0.06, -0.06})
        for (const double y : {0.05, -0.05}) add_leg(model, leg++, x, y);
    return model;
}

/// Four walls around a square of `side` with a corner at the origin.
ModelSpec walls(double side, double height) {
    ModelSpec model = test::scenery(test::box_shape({kWall, side + 2 * kWall, height}, test::surface(kMu),
                                                    {{-0.5 * kWall, 0.5 * side, 0.5 * height}, {}}));
    const auto add = [&](const Vec3& size, double x, double y) {
        model.links[0].collisions.push_back(
            test::box_shape(size, test::surface(kMu), {{x, y, 0.5 * height}, {}}));
    };
    add({kWall, side + 2 * kWall, height}, side + 0.5 * kWall, 0.5 * side);
    add({side, kWall, height}, 0.5 * side, -0.5 * kWall);
    add({side, kWall, height}, 0.5 * side, side + 0.5 * kWall);
    return model;
}

Verdict judge(const World& world, const Engine& engine, double side, double height) {
    constexpr double kMost = 0.02, kMostGap = 0.01;  // m
    const Overlap overlap = measure_overlap(world, engine);
    const double gap = widest_joint_gap(world, engine);
    double highest = 0;
    bool inside = true;
    for (std::size_t i = 2; i < world.instances.size(); ++i) {
        const Vec3 p = engine.link({i, 0}).X_WL.p;
        highest = std::max(highest, p.z);
        inside &= p.z > 0 && p.z < height && std::min(p.x, p.y) > 0 && std::max(p.x, p.y) < side;
    }
    char text[160];
    std::snprintf(text, sizeof text,
                  "%s, up to %.2f m; deepest overlap %.2f mm, joints open by at most %.2f mm",
                  inside ? "all in the box" : "some outside", highest, 1e3 * overlap.deepest_m, 1e3 * gap);
    return {inside && overlap.deepest_m < kMost && gap < kMostGap, text};
}

}  // namespace

Scene pile_scene(std::size_t robots) {
    Scene scene;
    scene.robots = robots;
    World& world = scene.world = test::empty_world(kSceneDt);
    world.name = "pile";
    const auto per_side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(robots) / 1.5)));
    const std::size_t per_layer = per_side * per_side, layers = (robots + per_layer - 1) / per_layer;
    const double side = kSpacing * static_cast<double>(per_side),
                 height = kLayer * static_cast<double>(layers + 1);
    test::place(world, test::ground(test::surface(kMu)), "ground");
    test::place(world, walls(side, height), "box");
    world.prototypes.push_back(four_legs());
    Random random(kSeed);
    for (std::size_t i = 0; i < robots; ++i) {
        const std::size_t place = i % per_layer, layer = i / per_layer;
        const Vec3 p{kSpacing * (static_cast<double>(place % per_side) + 0.5),
                     kSpacing * (static_cast<double>(place / per_side) + 0.5),
                     0.2 + kLayer * static_cast<double>(layer)};
        const double roll = random.uniform(-3, 3), pitch = random.uniform(-1.5, 1.5);
        const Quat q = from_rpy(roll, pitch, random.uniform(-3, 3));
        world.instances.push_back({"robot_" + std::to_string(i), 2, {p, q}, {}});
    }
    scene.start = [](Engine&) {};
    scene.judge = [copy = world, side, height](const Engine& engine, Tick) {
        return judge(copy, engine, side, height);
    };
    return scene;
}

}  // namespace roboss::bench
