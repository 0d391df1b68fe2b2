// A square net of plates with a ball joint between neighbours, hanging on two corners. It starts as a bowl
// and swings: nothing but joints, most of them in loops, and no contact. The figures count plates.
//
// A bowl, for a flat net is in a singular configuration: there engines differ in what they make of it, and
// not only in speed.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <support/bodies.h>

#include "scenes/joint_gap.h"
#include "scenes/scene.h"

namespace roboss::bench {
namespace {

constexpr double kSpacing = 0.1;  // m
const Vec3 kPlate{0.08, 0.08, 0.02};
constexpr double kMass = 0.05;  // kg
constexpr double kBowl = 0.6;   // depth over half the length

std::string plate_name(std::size_t row, std::size_t column) {
    return "plate_" + std::to_string(row) + "_" + std::to_string(column);
}

/// Of the plate, in the bowl that the net is at the start.
Vec3 place_of(std::size_t row, std::size_t column, std::size_t side) {
    const double length = kSpacing * static_cast<double>(side - 1);
    const double x = kSpacing * static_cast<double>(column), y = kSpacing * static_cast<double>(row);
    const auto rise = [&](double d) { return kBowl * d * (d - length) / length; };
    return {x, y, rise(x) + rise(y)};
}

/// Joints in the order that makes the tree a comb: the last of a loop is the one that closes it.
ModelSpec net(std::size_t side) {
    ModelSpec model;
    model.name = "net";
    model.canonical_link = plate_name(0, 0);
    for (std::size_t r = 0; r < side; ++r)
        for (std::size_t c = 0; c < side; ++c)
            model.links.push_back(test::link(plate_name(r, c), kMass, test::box_inertia(kMass, kPlate),
                                             {place_of(r, c, side), {}}));
    const auto join = [&](const std::string& parent, const std::string& child, const Vec3& p) {
        model.joints.push_back(
            test::joint(JointSpecKind::kBall, parent + "_" + child, parent, child, {p, {}}));
    };
    const auto join_to = [&](std::size_t r, std::size_t c, std::size_t row, std::size_t column) {
        join(plate_name(r, c), plate_name(row, column),
             (place_of(r, c, side) + place_of(row, column, side)) * 0.5);
    };
    join("world", plate_name(0, 0), place_of(0, 0, side));
    for (std::size_t r = 1; r < side; ++r) join_to(r - 1, 0, r, 0);
    for (std::size_t r = 0; r < side; ++r)
        for (std::size_t c = 1; c < side; ++c) join_to(r, c - 1, r, c);
    for (std::size_t r = 1; r < side; ++r)
        for (std::size_t c = 1; c < side; ++c) join_to(r - 1, c, r, c);
    join("world", plate_name(0, side - 1), place_of(0, side - 1, side));
    return model;
}

/// J, of motion and height.
double energy(const World& world, const Engine& engine) {
    double sum = 0;
    for (std::size_t l = 0; l < world.prototypes[0].links.size(); ++l) {
        const LinkSpec& spec = world.prototypes[0].links[l];
        const LinkState state = engine.link({0, l});
        const Vec3 w = rotate(conjugate(state.X_WL.q), state.angular);
        sum += spec.mass * (0.5 * norm_squared(state.v_WC) - dot(world.gravity, state.X_WL * spec.p_LC)) +
               0.5 * dot(w, spec.inertia_C * w);
    }
    return sum;
}

double energy_at_start(const World& world) {
    double sum = 0;
    for (const LinkSpec& spec : world.prototypes[0].links)
        sum -= spec.mass * dot(world.gravity, spec.X_ML * spec.p_LC);
    return sum;
}

/// Energy is measured by what the plates' weights do over half the net's length.
Verdict judge(const World& world, const Engine& engine, std::size_t side) {
    constexpr double kMostGap = 0.01, kMostGain = 0.5;  // m; relative
    const double fall = 0.5 * kSpacing * static_cast<double>(side);
    const double unit = kMass * static_cast<double>(side * side) * norm(world.gravity) * fall;
    const double gap = widest_joint_gap(world, engine);
    const double gain = (energy(world, engine) - energy_at_start(world)) / unit;
    char text[120];
    std::snprintf(text, sizeof text, "joints open by at most %.2f mm, energy %+.2f %% of that of the fall",
                  1e3 * gap, 100 * gain);
    return {gap < kMostGap && gain < kMostGain, text};
}

}  // namespace

Scene joint_grid_scene(std::size_t plates) {
    const auto side = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(plates))));
    Scene scene;
    scene.robots = side * side;
    scene.world = test::empty_world(kSceneDt);
    scene.world.name = "joint_grid";
    test::place(scene.world, net(side), "net");
    scene.start = [](Engine&) {};
    scene.judge = [world = scene.world, side](const Engine& engine, Tick) {
        return judge(world, engine, side);
    };
    return scene;
}

}  // namespace roboss::bench
