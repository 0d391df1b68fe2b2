// Six-legged walkers: a box, six legs of three hinges with position servos. They stand for a second, then
// walk in a tripod gait: three legs carry and sweep backwards while the other three swing forwards.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <support/bodies.h>

#include "scenes/scene.h"

namespace roboss::bench {
namespace {

constexpr double kMu = 0.9;
constexpr double kSpacing = 1.0;  // m
constexpr double kHeading = 0.3;  // rad
const Vec3 kTrunk{0.26, 0.16, 0.06};
constexpr double kTrunkMass = 1.2;
constexpr double kCoxa = 0.03, kFemur = 0.08, kTibia = 0.12;              // m
constexpr double kCoxaMass = 0.05, kFemurMass = 0.08, kTibiaMass = 0.07;  // kg
constexpr double kFemurUp = kPi / 6, kTibiaUp = -75 * kPi / 180;          // from the horizontal, standing
constexpr double kFoot = 0.012;                                           // m, radius
constexpr double kStiffness = 30, kDamping = 0.3, kEffort = 4;            // N m/rad, N m s/rad, N m
constexpr Tick kStanding = 500, kPeriod = 250;                            // ticks
constexpr double kSweep = 0.2, kLift = 0.35;                              // rad

double standing_height() {
    return kTibia * std::sin(-kTibiaUp) - kFemur * std::sin(kFemurUp) + kFoot;
}

LinkSpec rod(const std::string& name, double mass, double length, const Pose& X_ML) {
    LinkSpec link = test::link(name, mass, test::box_inertia(mass, {length, 0.02, 0.02}), X_ML);
    link.p_LC = {0.5 * length, 0, 0};
    return link;
}

/// The leg whose hip is at (x, y) of the trunk; it points outwards, along its links' x.
void add_leg(ModelSpec& model, int leg, double x, double y) {
    const std::string number = std::to_string(leg);
    const auto add = [&](const std::string& part, const std::string& parent, double mass, double length,
                         const Pose& X_ML, const Vec3& axis) {
        model.links.push_back(rod(part + number, mass, length, X_ML));
        model.joints.push_back(test::joint(JointSpecKind::kRevolute, "joint_" + part + number, parent,
                                           part + number, X_ML, axis));
        AxisSpec& a = model.joints.back().axes[0];
        a.lower = -1.5, a.upper = 1.5, a.max_effort = kEffort;
        a.position_gain = kStiffness, a.velocity_gain = kDamping;
    };
    const Quat out = from_rpy(0, 0, y > 0 ? kPi / 2 : -kPi / 2);
    const Pose X_coxa{{x, y, standing_height()}, out};
    const Pose X_femur = X_coxa * Pose{{kCoxa, 0, 0}, axis_angle({0, -1, 0}, kFemurUp)};
    const Pose X_tibia = X_femur * Pose{{kFemur, 0, 0}, axis_angle({0, -1, 0}, kTibiaUp - kFemurUp)};
    add("coxa_", "trunk", kCoxaMass, kCoxa, X_coxa, {0, 0, 1});
    add("femur_", "coxa_" + number, kFemurMass, kFemur, X_femur, {0, -1, 0});
    add("tibia_", "femur_" + number, kTibiaMass, kTibia, X_tibia, {0, -1, 0});
    model.links.back().collisions.push_back(
        test::sphere_shape(kFoot, test::surface(kMu), {{kTibia, 0, 0}, {}}));
}

/// Legs 0 to 5: front left, front right, middle left, ...; joints 3 * leg + (0 coxa, 1 femur, 2 tibia).
ModelSpec spider() {
    ModelSpec model;
    model.name = "spider";
    model.canonical_link = "trunk";
    model.links.push_back(test::link("trunk", kTrunkMass, test::box_inertia(kTrunkMass, kTrunk),
                                     {{0, 0, standing_height()}, {}}));
    model.links[0].collisions.push_back(test::box_shape(kTrunk, test::surface(kMu)));
    int leg = 0;
    for (double x : {0.1, 0.0, -0.1})
        for (double y : {0.08, -0.08}) add_leg(model, leg++, x, y);
    return model;
}

/// Targets of a leg's three joints.
std::array<double, 3> gait(int leg, Tick tick) {
    if (tick < kStanding) return {0, 0, 0};
    const int row = leg / 2, side = leg % 2;  // 0: left
    const double ramp = std::min(1.0, static_cast<double>(tick - kStanding) / kPeriod);
    const bool first_tripod = (row + side) % 2 == 0;
    const double turns = static_cast<double>(tick - kStanding) / kPeriod + (first_tripod ? 0.0 : 0.5);
    const double phase = turns - std::floor(turns);
    const bool swings = phase < 0.5;
    const double way = swings ? 2 * phase : 2 * phase - 1;  // of this half, 0 to 1
    const double ahead = swings ? -std::cos(kPi * way) : 1 - 2 * way;
    const double lift = swings ? std::sin(kPi * way) : 0;
    // Turning a left leg forwards is a negative yaw, a right one a positive.
    return {(side == 0 ? -1 : 1) * kSweep * ramp * ahead, kLift * ramp * lift, 0};
}

void drive(Engine& engine, std::size_t spiders, Tick tick) {
    for (int leg = 0; leg < 6; ++leg) {
        const std::array<double, 3> target = gait(leg, tick);
        for (std::size_t part = 0; part < 3; ++part)
            for (std::size_t i = 1; i <= spiders; ++i)
                engine.drive_position({i, static_cast<std::size_t>(3 * leg) + part, 0},
                                      {target[part], kStiffness, kDamping, kEffort});
    }
}

/// They hold their height; once they walk they have walked, straight ahead.
Verdict judge(const World& world, const Engine& engine, Tick tick) {
    double slowest = 1e9, aside = 0, sag = 0, lean = 0;
    const double walked = static_cast<double>(std::max<Tick>(tick - kStanding - kPeriod, 0)) * kSceneDt;
    for (std::size_t i = 1; i < world.instances.size(); ++i) {
        const LinkState trunk = engine.link({i, 0});
        const Pose& X_WM = world.instances[i].X_WM;
        const Vec3 way = rotate(conjugate(X_WM.q), trunk.X_WL.p - X_WM.p);
        slowest = std::min(slowest, walked > 0 ? way.x / walked : 0.0);
        aside = std::max(aside, std::fabs(way.y));
        sag = std::max(sag, std::fabs(trunk.X_WL.p.z - standing_height()));
        lean = std::max(lean, 1 - rotate(trunk.X_WL.q, {0, 0, 1}).z);
    }
    char text[160];
    std::snprintf(text, sizeof text,
                  "%.3f m/s ahead, %.0f mm aside, height at most %.1f mm off, leaning %.1f degrees", slowest,
                  1e3 * aside, 1e3 * sag, std::acos(std::max(-1.0, 1 - lean)) * 180 / kPi);
    const bool walks = tick < kStanding + 2 * kPeriod || slowest > 0.15;
    return {walks && sag < 0.015 && aside < 0.1 && lean < 0.02, text};
}

}  // namespace

Scene spiders_scene(std::size_t spiders) {
    Scene scene;
    scene.robots = spiders;
    scene.world = test::empty_world(kSceneDt);
    scene.world.name = "spiders";
    test::place(scene.world, test::ground(test::surface(kMu)), "ground");
    scene.world.prototypes.push_back(spider());
    const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(spiders))));
    for (std::size_t i = 0; i < spiders; ++i) {
        const Vec3 p{kSpacing * static_cast<double>(i % side), kSpacing * static_cast<double>(i / side), 0};
        scene.world.instances.push_back(
            {"spider_" + std::to_string(i), 1, {p, from_rpy(0, 0, kHeading)}, {}});
    }
    scene.start = [spiders](Engine& engine) { drive(engine, spiders, 0); };
    scene.control = [spiders](Engine& engine, Tick tick) {
        if (tick >= kStanding) drive(engine, spiders, tick);
    };
    scene.judge = [world = scene.world](const Engine& engine, Tick tick) {
        return judge(world, engine, tick);
    };
    return scene;
}

}  // namespace roboss::bench
