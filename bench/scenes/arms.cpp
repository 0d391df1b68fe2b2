// Arms of four joints on fixed bases, whose servos follow a path in joint space: articulated dynamics and
// motors without any contact.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <support/robots.h>

#include "scenes/scene.h"

namespace roboss::bench {
namespace {

constexpr double kSpacing = 3.0;                                    // m
constexpr std::array<double, 4> kStiffness{4000, 4000, 2000, 500};  // N m/rad
constexpr std::array<double, 4> kDamping{60, 60, 30, 10};           // N m s/rad
constexpr double kEffort = 150;                                     // N m
constexpr std::array<double, 4> kAmplitude{0.8, 0.6, 0.7, 1.0};     // rad
constexpr std::array<double, 4> kFrequency{0.4, 0.5, 0.7, 0.9};     // Hz
constexpr double kOff = 0.15;  // rad; a servo trails by damping / stiffness times its speed

double path(std::size_t arm, std::size_t joint, Tick tick) {
    const double t = static_cast<double>(tick) * kSceneDt;
    const double turns = kFrequency[joint] * t + 0.01 * static_cast<double>(arm);
    return kAmplitude[joint] * std::min(1.0, t / 0.3) * std::sin(2 * kPi * turns);
}

ModelSpec scene_arm() {
    ModelSpec model = test::arm();
    for (std::size_t j = 0; j < 4; ++j) {
        AxisSpec& axis = model.joints[j].axes[0];
        axis.position_gain = kStiffness[j], axis.velocity_gain = kDamping[j];
    }
    return model;
}

void drive(Engine& engine, std::size_t arms, Tick tick) {
    for (std::size_t i = 0; i < arms; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            engine.drive_position({i, j, 0}, {path(i, j, tick), kStiffness[j], kDamping[j], kEffort});
}

Verdict judge(const Engine& engine, std::size_t arms, Tick tick) {
    double off = 0;
    for (std::size_t i = 0; i < arms; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            off = std::max(off, std::fabs(engine.joint({i, j, 0}).position - path(i, j, tick)));
    char text[80];
    std::snprintf(text, sizeof text, "at most %.3f rad off the path", off);
    return {off < kOff, text};
}

}  // namespace

Scene arms_scene(std::size_t arms) {
    Scene scene;
    scene.robots = arms;
    scene.world = test::empty_world(kSceneDt);
    scene.world.name = "arms";
    scene.world.prototypes.push_back(scene_arm());
    const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(arms))));
    for (std::size_t i = 0; i < arms; ++i) {
        const Vec3 p{kSpacing * static_cast<double>(i % side), kSpacing * static_cast<double>(i / side), 1};
        scene.world.instances.push_back({"arm_" + std::to_string(i), 0, {p, {}}, {}});
    }
    scene.start = [arms](Engine& engine) { drive(engine, arms, 0); };
    scene.control = [arms](Engine& engine, Tick tick) { drive(engine, arms, tick); };
    scene.judge = [arms](const Engine& engine, Tick tick) { return judge(engine, arms, tick); };
    return scene;
}

}  // namespace roboss::bench
