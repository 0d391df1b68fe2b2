// Cars on an empty plane: what a robot costs that meets nobody.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "scenes/car_drive.h"

namespace roboss::bench {
namespace {

constexpr double kSpacing = 1.5;  // m
constexpr double kHeading = 0.3;  // rad; no axis of the world is special

/// All cars drive at wheel speed times radius, upright.
Verdict judge_cars(const Engine& engine, std::size_t cars) {
    double slowest = 1e9, fastest = -1e9, height_min = 1e9, height_max = -1e9;
    const Vec3 ahead{std::cos(kHeading), std::sin(kHeading), 0};
    for (std::size_t i = 1; i <= cars; ++i) {
        const LinkState chassis = engine.link({i, 0});
        const double speed = dot(chassis.v_WC, ahead);
        slowest = std::min(slowest, speed), fastest = std::max(fastest, speed);
        height_min = std::min(height_min, chassis.X_WL.p.z);
        height_max = std::max(height_max, chassis.X_WL.p.z);
    }
    char text[120];
    std::snprintf(text, sizeof text, "%.4f to %.4f m/s, height %.2f mm off at most", slowest, fastest,
                  1e3 * std::max(std::fabs(height_min - 0.05), std::fabs(height_max - 0.05)));
    return {slowest > 0.475 && fastest < 0.525 && height_min > 0.045 && height_max < 0.055, text};
}

}  // namespace

Scene cars_scene(std::size_t cars) {
    Scene scene;
    scene.robots = cars;
    scene.world = test::empty_world(kSceneDt);
    scene.world.name = "cars";
    test::place(scene.world, test::ground(test::surface(kCarMu)), "ground");
    scene.world.prototypes.push_back(scene_car());
    const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(cars))));
    for (std::size_t i = 0; i < cars; ++i) {
        const Vec3 p{kSpacing * static_cast<double>(i % side), kSpacing * static_cast<double>(i / side), 0};
        scene.world.instances.push_back({"car_" + std::to_string(i), 1, {p, from_rpy(0, 0, kHeading)}, {}});
    }
    scene.start = [cars](Engine& engine) {
        for (std::size_t i = 1; i <= cars; ++i) drive_car(engine, i, kWheelSpeed);
    };
    scene.judge = [cars](const Engine& engine, Tick) { return judge_cars(engine, cars); };
    return scene;
}

}  // namespace roboss::bench
