// A gripper on three slides and a turning wrist holds a box between a fixed and a driven finger, by friction
// alone, while it is carried along a path for a minute.
#include <support/bodies.h>

#include "accuracy/figures.h"
#include "accuracy/trial.h"

namespace roboss::bench {
namespace {

constexpr double kBoxEdge = 0.06, kFinger = 0.02, kGrip = 20;  // m, m, N
const Vec3 kBoxSize{kBoxEdge, kBoxEdge, kBoxEdge};
const SurfaceSpec kSurface = test::surface(0.6);

/// Joints: slide_x, slide_y, slide_z, wrist (about z), grip (along y). The palm is over the fingers; the box
/// goes to the model's origin.
ModelSpec gripper() {
    ModelSpec m;
    m.name = "gripper";
    const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 1}};
    const char* names[] = {"slide_x", "slide_y", "slide_z", "wrist"};
    const Pose palm{{0, 0, 0.15}, {}};
    std::string parent = "world";
    for (std::size_t i = 0; i < 4; ++i) {
        m.links.push_back(test::link(i == 3 ? "palm" : std::string("carriage_") + names[i], 1.0,
                                     test::box_inertia(1.0, {0.1, 0.2, 0.05}), palm));
        m.joints.push_back(test::joint(i == 3 ? JointSpecKind::kContinuous : JointSpecKind::kPrismatic,
                                       names[i], parent, m.links.back().name, palm, axes[i]));
        parent = m.links.back().name;
    }
    m.canonical_link = m.links.front().name;
    const Vec3 size{0.05, kFinger, 0.1};
    const double y = 0.5 * (kBoxEdge + kFinger);
    m.links[3].collisions.push_back(test::box_shape(size, kSurface, {Vec3{0, -y, 0.01} - palm.p, {}}));
    const Pose X{{0, y, 0.01}, {}};
    m.links.push_back(test::link("finger", 0.1, test::box_inertia(0.1, size), X));
    m.links.back().collisions.push_back(test::box_shape(size, kSurface));
    m.joints.push_back(test::joint(JointSpecKind::kPrismatic, "grip", "palm", "finger", X, {0, 1, 0}));
    return m;
}

/// Velocities of the slides and the wrist on a smooth path: a figure of eight, up and down, to and fro.
std::vector<double> path_velocity(double t) {
    const double start = std::fmin(1, t);  // no jolt
    const double w = 2 * kPi * 0.25;
    return {start * 0.2 * w * std::cos(w * t), start * 0.1 * 2 * w * std::cos(2 * w * t),
            start * 0.1 * 0.7 * w * std::cos(0.7 * w * t), start * 0.8 * 0.5 * w * std::cos(0.5 * w * t)};
}

Outcome carry(const Contender& contender) {
    World world = test::empty_world(contender.dt_s);
    test::place(world, gripper(), "gripper", {{0, 0, 1}, {}});
    test::place(world, test::solid_box(0.5, kBoxSize, kSurface), "box", {{0, 0, 1}, {}});
    Trial trial(contender, world);
    if (!trial.possible()) return Trial::impossible(2);
    Engine& engine = trial.engine();
    engine.drive_effort({0, 4, 0}, -kGrip);
    const auto hold = [&](double t) {
        const std::vector<double> velocity = path_velocity(t);
        for (std::size_t j = 0; j < 4; ++j) engine.drive_velocity({0, j, 0}, t <= 0 ? 0 : velocity[j], 500);
    };
    hold(0);
    trial.run(1);  // it closes
    const auto held = [&] { return inverse(trial.link(0, 3).X_WL) * trial.link(1).X_WL; };
    const Pose start = held();
    double slip = 0, fastest = 0;
    trial.run(60, 0.01, [&] {
        hold(trial.time_s() - 1);
        slip = largest(slip, corner_distance(held(), start, kBoxSize));
        fastest = largest(fastest, norm(trial.link(1).v_WC));
    });
    return trial.outcome({slip, fastest});
}

}  // namespace

std::vector<Case> gripper_cases() {
    Case c{"gripper",
           "Gripper (20 N) holding a box of 0.5 kg by friction, carried along a path, 60 s",
           "the box does not slip in the hand (mu 0.6; weight 4.9 N against 24 N of friction)",
           {{"furthest that a corner slipped", "m", 1e-4}, {"greatest speed of the box", "m/s", {}}},
           carry};
    c.also_coarse = true;
    return {c};
}

}  // namespace roboss::bench
