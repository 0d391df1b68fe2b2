// Each foot follows a path in its hip's frame: straight back on the ground, forward through the air; yaw, hip
// and knee angles follow in closed form.
#include "scenes/hexapod.h"

#include <algorithm>
#include <cmath>

#include <support/bodies.h>

namespace roboss::bench {
namespace {

constexpr double kCoxa = 0.05, kFemur = 0.1, kTibia = 0.15, kFoot = 0.015;  // m
constexpr double kReach = 0.17;                        // of the foot from the yaw axis, m
constexpr double kFootDepth = kHexapodHeight - kFoot;  // below the hip, m
constexpr Engine::Servo kServo{0, 150, 1.5, 15};

struct LegAngles {
    double yaw = 0, hip = 0, knee = 0;  // pitch positive downwards
};

/// Foot at (outward, aside, down) of the yaw axis.
LegAngles reach_for(double outward, double aside, double down) {
    const double r = std::hypot(outward, aside) - kCoxa, d = std::hypot(r, down);
    const double at_hip = std::acos((kFemur * kFemur + d * d - kTibia * kTibia) / (2 * kFemur * d));
    const double knee = std::acos((d * d - kFemur * kFemur - kTibia * kTibia) / (2 * kFemur * kTibia));
    return {std::atan2(aside, outward), std::atan2(down, r) - at_hip, knee};
}

bool is_left(std::size_t leg) {
    return leg % 2 == 0;
}

Pose hip_in_body(std::size_t leg) {
    const double x = 0.16 * (1 - static_cast<double>(leg / 2)), y = is_left(leg) ? 0.1 : -0.1;
    return {{x, y, 0}, from_rpy(0, 0, is_left(leg) ? kPi / 2 : -kPi / 2)};
}

/// A link of the leg along its own x.
void add_link(ModelSpec& m, const std::string& name, const std::string& parent, double mass, double length,
              const Pose& X_ML, const Vec3& axis) {
    LinkSpec l = test::link(name, mass, test::box_inertia(mass, {length, 0.03, 0.03}), X_ML);
    l.p_LC = {0.5 * length, 0, 0};
    m.links.push_back(l);
    m.joints.push_back(test::joint(JointSpecKind::kRevolute, "joint_" + name, parent, name, X_ML, axis));
    m.joints.back().axes[0].max_effort = kServo.max_effort;
    m.joints.back().axes[0].lower = -2, m.joints.back().axes[0].upper = 2;
}

void add_leg(ModelSpec& m, std::size_t leg) {
    const LegAngles stand = reach_for(kReach, 0, kFootDepth);
    const std::string n = std::to_string(leg);
    const Pose coxa = hip_in_body(leg);
    const Pose femur = coxa * Pose{{kCoxa, 0, 0}, from_rpy(0, stand.hip, 0)};
    const Pose tibia = femur * Pose{{kFemur, 0, 0}, from_rpy(0, stand.knee, 0)};
    add_link(m, "coxa_" + n, "body", 0.1, kCoxa, coxa, {0, 0, 1});
    add_link(m, "femur_" + n, "coxa_" + n, 0.15, kFemur, femur, {0, 1, 0});
    add_link(m, "tibia_" + n, "femur_" + n, 0.1, kTibia, tibia, {0, 1, 0});
    m.links.back().collisions.push_back(test::sphere_shape(kFoot, test::surface(0.9), {{kTibia, 0, 0}, {}}));
}

}  // namespace

ModelSpec hexapod() {
    ModelSpec m;
    m.name = "hexapod";
    m.canonical_link = "body";
    const Vec3 size{0.4, 0.2, 0.08};
    m.links.push_back(test::link("body", 3.0, test::box_inertia(3.0, size)));
    m.links.back().collisions.push_back(test::box_shape(size, test::surface(0.9)));
    for (std::size_t leg = 0; leg < kHexapodLegs; ++leg) add_leg(m, leg);
    return m;
}

std::array<double, 3 * kHexapodLegs> hexapod_angles(const Gait& gait, double t) {
    const LegAngles stand = reach_for(kReach, 0, kFootDepth);
    const double walked = std::fmax(0, t - gait.start), ramp = std::fmin(1, walked);
    const double stride = ramp * gait.speed * gait.period / 2;
    std::array<double, 3 * kHexapodLegs> angles{};
    for (std::size_t leg = 0; leg < kHexapodLegs; ++leg) {
        const bool second = (leg % 2 + leg / 2) % 2 == 1;  // of the two tripods
        double phase = walked / gait.period + (second ? 0.75 : 0.25);
        phase -= std::floor(phase);
        const bool stands = phase < 0.5;
        const double s = stands ? 2 * phase : 2 * phase - 1;
        const double forward = stride * (stands ? 0.5 - s : -0.5 * std::cos(kPi * s));
        const double rise = stands ? 0 : ramp * gait.lift * std::sin(kPi * s);
        const LegAngles now = reach_for(kReach, is_left(leg) ? -forward : forward, kFootDepth - rise);
        angles[3 * leg] = now.yaw;
        angles[3 * leg + 1] = now.hip - stand.hip;
        angles[3 * leg + 2] = now.knee - stand.knee;
    }
    return angles;
}

void walk(Engine& engine, std::size_t instance, const Gait& gait, double t) {
    const std::array<double, 3 * kHexapodLegs> angles = hexapod_angles(gait, t);
    for (std::size_t j = 0; j < angles.size(); ++j) {
        Engine::Servo servo = kServo;
        servo.position = angles[j];
        engine.drive_position({instance, j, 0}, servo);
    }
}

}  // namespace roboss::bench
