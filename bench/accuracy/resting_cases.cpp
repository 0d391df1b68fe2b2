// Bodies that rest on each other for a minute.
#include <support/bodies.h>

#include "accuracy/figures.h"
#include "accuracy/trial.h"

namespace roboss::bench {
namespace {

constexpr double kEdge = 0.2;
const Vec3 kSize{kEdge, kEdge, kEdge};

/// The world's instances behind the ground are boxes of kSize: furthest that a corner of any came from its
/// start.
Outcome rest(const Contender& contender, const World& world, double duration) {
    Trial trial(contender, world);
    if (!trial.possible()) return Trial::impossible(1);
    std::vector<Pose> start;
    for (const ModelInstance& instance : world.instances) start.push_back(instance.X_WM);
    double drift = 0;
    trial.run(duration, 0.5, [&] {
        for (std::size_t i = 1; i < start.size(); ++i)
            drift = largest(drift, corner_distance(trial.link(i).X_WL, start[i], kSize));
    });
    return trial.outcome({drift});
}

World ground_world(double dt_s) {
    World world = test::empty_world(dt_s);
    test::place(world, test::ground(test::surface(0.6)), "ground");
    return world;
}

/// Another box of the prototype.
void add_box(World& world, std::size_t prototype, const Vec3& p) {
    world.instances.push_back({"box_" + std::to_string(world.instances.size()), prototype, {p, {}}, {}});
}

Outcome stack(const Contender& contender) {
    World world = ground_world(contender.dt_s);
    world.prototypes.push_back(test::solid_box(1.0, kSize, test::surface(0.6)));
    for (int i = 0; i < 10; ++i) add_box(world, 1, {0, 0, kEdge * (0.5 + i)});
    return rest(contender, world, 60);
}

Outcome pyramid(const Contender& contender) {
    constexpr int kRows = 10;
    constexpr double kPitch = 1.1 * kEdge;
    World world = ground_world(contender.dt_s);
    world.prototypes.push_back(test::solid_box(1.0, kSize, test::surface(0.6)));
    for (int row = 0; row < kRows; ++row)
        for (int i = 0; i + row < kRows; ++i)
            add_box(world, 1, {kPitch * (i + 0.5 * row - 0.5 * kRows), 0, kEdge * (0.5 + row)});
    return rest(contender, world, 60);
}

Outcome heavy_on_light(const Contender& contender) {
    World world = ground_world(contender.dt_s);
    for (const double mass : {1.0, 1000.0})
        world.prototypes.push_back(test::solid_box(mass, kSize, test::surface(0.6)));
    for (int i = 0; i < 2; ++i) add_box(world, static_cast<std::size_t>(i) + 1, {0, 0, kEdge * (0.5 + i)});
    return rest(contender, world, 10);
}

}  // namespace

std::vector<Case> resting_cases() {
    const std::vector<Quantity> drift{{"furthest that a corner came", "m", 1e-3}};
    const std::string still = "they stand: nothing moves";
    std::vector<Case> cases{
        {"stack", "Stack of ten boxes of 0.2 m, 60 s", still, drift, stack},
        {"pyramid", "Pyramid of 55 boxes, 60 s", still, drift, pyramid},
        {"heavy-on-light", "1000 kg on 1 kg, boxes of 0.2 m, 10 s", still, drift, heavy_on_light, false}};
    for (Case& c : cases) {
        c.slow = c.name == "pyramid";
        c.also_coarse = !c.slow;
    }
    return cases;
}

}  // namespace roboss::bench
