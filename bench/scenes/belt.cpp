// Parcels on a conveyor belt: a static box whose surface moves. They slip until friction has brought them to
// the belt's speed, and then ride. Both are known in closed form.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <support/bodies.h>

#include "scenes/overlap.h"
#include "scenes/scene.h"

namespace roboss::bench {
namespace {

constexpr double kSpeed = 1.0, kMu = 0.6;       // m/s
constexpr double kTop = 0.5, kSpacing = 0.5;    // m
constexpr std::size_t kAbreast = 10;            // parcels in a row across the belt
const Vec3 kParcel{0.3, 0.2, 0.15};             // m
constexpr double kMass = 2.0, kGravity = 9.81;  // kg, m/s^2
constexpr double kSlower = 0.01, kAway = 0.02;  // of the speed; m

/// Where a parcel that was put down at rest is after t: it slips for v / (mu g).
double carried(double t) {
    const double slipping = kSpeed / (kMu * kGravity);
    return t < slipping ? 0.5 * kMu * kGravity * t * t : kSpeed * (t - 0.5 * slipping);
}

Verdict judge(const World& world, const Engine& engine, Tick tick) {
    const double t = static_cast<double>(tick) * kSceneDt;
    double off_speed = 0, off_place = 0;
    for (std::size_t i = 1; i < world.instances.size(); ++i) {
        const LinkState parcel = engine.link({i, 0});
        const Vec3 start = world.instances[i].X_WM.p;
        off_speed = std::max(off_speed, norm(parcel.v_WC - Vec3{kSpeed, 0, 0}));
        off_place = std::max(off_place, norm(parcel.X_WL.p - start - Vec3{carried(t), 0, 0}));
    }
    const Overlap overlap = measure_overlap(world, engine);
    char text[160];
    std::snprintf(
        text, sizeof text,
        "off the belt's speed by at most %.1e m/s, off the closed form by %.2f mm; deepest overlap %.2f mm",
        off_speed, 1e3 * off_place, 1e3 * overlap.deepest_m);
    const bool riding = t > 2 * kSpeed / (kMu * kGravity);
    return {off_place < kAway && (!riding || off_speed < kSlower * kSpeed), text};
}

ModelSpec belt(double length) {
    const double width = kSpacing * static_cast<double>(kAbreast + 1);
    ModelSpec model = test::scenery(
        test::box_shape({length, width, kTop}, test::surface(kMu), {{0.5 * length - 1, 0, 0.5 * kTop}, {}}));
    SurfaceVelocitySpec motion;
    motion.link = LinkNames{model.links[0].name};
    motion.linear = {kSpeed, 0, 0};
    motion.fixed = true;
    model.onboard.push_back({"belt", motion, {}});
    return model;
}

}  // namespace

Scene belt_scene(std::size_t parcels) {
    Scene scene;
    scene.robots = parcels;
    World& world = scene.world = test::empty_world(kSceneDt);
    world.name = "belt";
    const std::size_t rows = (parcels + kAbreast - 1) / kAbreast;
    test::place(world, belt(kSpacing * static_cast<double>(rows) + 40), "belt");
    world.prototypes.push_back(test::solid_box(kMass, kParcel, test::surface(kMu)));
    for (std::size_t i = 0; i < parcels; ++i) {
        const double abreast = static_cast<double>(i % kAbreast) - 0.5 * static_cast<double>(kAbreast - 1);
        const Vec3 p{kSpacing * static_cast<double>(i / kAbreast), kSpacing * abreast,
                     kTop + 0.5 * kParcel.z};
        world.instances.push_back({"parcel_" + std::to_string(i), 1, {p, {}}, {}});
    }
    scene.start = [](Engine&) {};
    scene.judge = [copy = world](const Engine& engine, Tick tick) { return judge(copy, engine, tick); };
    return scene;
}

}  // namespace roboss::bench
