// A square net of plates with a ball joint between neighbours, hanging on two corners. It starts as a bowl
// and swings: nothing but joints, most of them in loops, and no contact. The figures count plates.
//
// A bowl, for a flat net is in a singular configuration: there engines differ in what they make of it, and
// not only in speed.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <support/joint_net.h>

#include "scenes/joint_gap.h"
#include "scenes/scene.h"

namespace roboss::bench {
namespace {

constexpr double kBowl = 0.6;  // depth over half the length

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
    const double fall = 0.5 * test::kNetSpacing * static_cast<double>(side);
    const double unit = test::kNetPlateMass * static_cast<double>(side * side) * norm(world.gravity) * fall;
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
    test::place(scene.world, test::joint_net(side, kBowl), "net");
    scene.start = [](Engine&) {};
    scene.judge = [world = scene.world, side](const Engine& engine, Tick) {
        return judge(world, engine, side);
    };
    return scene;
}

}  // namespace roboss::bench
