// Robots that tests share: car, arms, pendulums, chains, spider, and a tree with everything in it.
#pragma once

#include <string>

#include <support/bodies.h>

namespace roboss::test {

struct CarOptions {
    bool sphere_wheels = false;
    double mu = 0.9;
    double max_effort = 2.0;  // N m a wheel
};

/// Skid-steer car: chassis .4 x .2 x .1 m of 5 kg, four wheels of .05 m and .3 kg at x +-.15, y +-.13. Joints
/// "wheel_0" to "wheel_3": front left, front right, rear left, rear right; positive velocity drives forward
/// (+x).
inline ModelSpec car(const CarOptions& options = {}) {
    ModelSpec m;
    m.name = "car";
    m.canonical_link = "chassis";
    const Vec3 size{0.4, 0.2, 0.1};
    LinkSpec chassis = link("chassis", 5.0, box_inertia(5.0, size), {{0, 0, 0.05}, {}});
    chassis.collisions.push_back(box_shape(size, surface(options.mu), {{0, 0, 0.02}, {}}));
    m.links.push_back(chassis);
    const double mass = 0.3, radius = 0.05, length = 0.04;
    int number = 0;
    for (double x : {0.15, -0.15}) {
        for (double y : {0.13, -0.13}) {
            const Pose X_ML{{x, y, radius}, from_rpy(-kPi / 2, 0, 0)};  // z along +y of the car
            LinkSpec wheel =
                link("wheel_" + std::to_string(number), mass, cylinder_inertia(mass, radius, length), X_ML);
            if (options.sphere_wheels) {
                wheel.inertia_C = sphere_inertia(mass, radius);
                wheel.collisions.push_back(sphere_shape(radius, surface(options.mu)));
            } else {
                wheel.collisions.push_back(cylinder_shape(radius, length, surface(options.mu)));
            }
            m.links.push_back(wheel);
            m.joints.push_back(
                joint(JointSpecKind::kContinuous, wheel.name, "chassis", wheel.name, X_ML, {0, 0, 1}));
            m.joints.back().axes[0].max_effort = options.max_effort;
            ++number;
        }
    }
    return m;
}

/// Links of a slender rod, each hanging from its joint at its own origin, centre of mass half a length down
/// its -z axis.
inline LinkSpec rod(const std::string& name, double mass, double length, const Pose& X_ML) {
    LinkSpec l = link(name, mass, box_inertia(mass, {0.04, 0.03, length}), X_ML);
    l.p_LC = {0, 0, -0.5 * length};
    return l;
}

/// A rod on one hinge about y, fixed to the world at the model's origin; hangs along -z at zero.
inline ModelSpec pendulum(double mass = 1.0, double length = 1.0) {
    ModelSpec m;
    m.name = "pendulum";
    m.canonical_link = "rod";
    m.links.push_back(rod("rod", mass, length, {}));
    m.joints.push_back(joint(JointSpecKind::kRevolute, "hinge", "world", "rod", {}, {0, 1, 0}));
    return m;
}

inline ModelSpec double_pendulum() {
    ModelSpec m = pendulum(1.0, 0.6);
    m.name = "double_pendulum";
    const Pose X{{0, 0, -0.6}, {}};
    m.links.push_back(rod("rod_2", 0.7, 0.5, X));
    m.joints.push_back(joint(JointSpecKind::kRevolute, "hinge_2", "rod", "rod_2", X, {0, 1, 0}));
    return m;
}

/// Four joints on a fixed base: yaw, then three bends in two planes.
inline ModelSpec arm() {
    ModelSpec m;
    m.name = "arm";
    m.canonical_link = "link_0";
    const Vec3 axes[] = {{0, 0, 1}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}};
    std::string parent = "world";
    double z = 1.0;
    for (int i = 0; i < 4; ++i) {
        const double length = 0.4 - 0.05 * i;
        const Pose X{{0.02 * i, -0.01 * i, z}, {}};
        LinkSpec l = rod("link_" + std::to_string(i), 2.0 - 0.4 * i, length, X);
        m.links.push_back(l);
        m.joints.push_back(
            joint(JointSpecKind::kRevolute, "joint_" + std::to_string(i), parent, l.name, X, axes[i]));
        parent = l.name;
        z -= length;
    }
    return m;
}

/// Free base and three sliding links in three directions.
inline ModelSpec prismatic_chain() {
    ModelSpec m;
    m.name = "prismatic_chain";
    m.canonical_link = "link_0";
    m.links.push_back(link("link_0", 1.5, box_inertia(1.5, {0.3, 0.2, 0.1}), {{0, 0, 0.5}, {}}));
    const Vec3 axes[] = {{1, 0.2, 0}, {0, 1, -0.3}, {0.5, 0.5, 1}};
    for (int i = 1; i <= 3; ++i) {
        const Pose X{{0.2 * i, 0.05 * i, 0.5 - 0.1 * i}, from_rpy(0.1 * i, -0.2 * i, 0.3)};
        LinkSpec l = link("link_" + std::to_string(i), 1.0 / i, box_inertia(1.0 / i, {0.1, 0.2, 0.3}), X);
        l.p_LC = {0.02, -0.03, 0.05};
        const std::string parent = "link_" + std::to_string(i - 1);
        m.links.push_back(l);
        m.joints.push_back(
            joint(JointSpecKind::kPrismatic, "slide_" + std::to_string(i), parent, l.name, X, axes[i - 1]));
    }
    return m;
}

/// Free base with six legs of three hinges.
inline ModelSpec spider() {
    ModelSpec m;
    m.name = "spider";
    m.canonical_link = "body";
    m.links.push_back(
        link("body", 4.0, box_inertia(4.0, {0.3, 0.2, 0.1}), {{0, 0, 0.3}, from_rpy(0, 0, 0.2)}));
    for (int leg = 0; leg < 6; ++leg) {
        const Quat turn = from_rpy(0, 0, leg * kPi / 3);
        std::string parent = "body";
        const Vec3 axes[] = {{0, 0, 1}, {0, 1, 0}, {0, 1, 0}};
        for (int i = 0; i < 3; ++i) {
            const Pose X{Vec3{0, 0, 0.3} + rotate(turn, Vec3{0.12 + 0.1 * i, 0, -0.03 * i}), turn};
            LinkSpec l = link("leg_" + std::to_string(leg) + "_" + std::to_string(i), 0.3,
                              box_inertia(0.3, {0.1, 0.02, 0.03}), X);
            l.p_LC = {0.05, 0, -0.01};
            m.links.push_back(l);
            m.joints.push_back(joint(JointSpecKind::kRevolute, "j" + l.name, parent, l.name, X, axes[i]));
            parent = l.name;
        }
    }
    return m;
}

/// Fixed base, then ball joint after ball joint, joint frames turned against their links.
inline ModelSpec ball_chain() {
    ModelSpec m;
    m.name = "ball_chain";
    m.canonical_link = "link_0";
    std::string parent = "world";
    for (int i = 0; i < 3; ++i) {
        const Pose X{{0.05 * i, 0, 1.0 - 0.4 * i}, from_rpy(0.3 * i, 0.1, -0.2)};
        LinkSpec l =
            link("link_" + std::to_string(i), 1.0 + 0.5 * i, box_inertia(1.0 + 0.5 * i, {0.1, 0.15, 0.4}), X);
        l.p_LC = {0.01, 0.02, -0.2};
        const Pose X_MJ = X * Pose{{0, 0.01, 0.02}, from_rpy(0.5, -0.4, 0.2 * i)};
        m.links.push_back(l);
        m.joints.push_back(joint(JointSpecKind::kBall, "ball_" + std::to_string(i), parent, l.name, X_MJ));
        parent = l.name;
    }
    return m;
}

namespace detail {

inline void add_mixed_links(ModelSpec& m) {
    const auto add = [&](const std::string& name, double mass, const Vec3& size, const Pose& X,
                         const Vec3& p_LC, const Vec3& tilt) {
        const Mat3 R = to_matrix(from_rpy(tilt.x, tilt.y, tilt.z));  // off-diagonal inertia
        LinkSpec l = link(name, mass, R * box_inertia(mass, size) * transpose(R), X);
        l.p_LC = p_LC;
        m.links.push_back(l);
    };
    add("trunk", 6.0, {0.5, 0.3, 0.2}, {{0.1, -0.2, 0.9}, from_rpy(0.1, 0.2, 0.3)}, {0.05, -0.02, 0.03},
        {0.4, 0.3, -0.5});
    add("mast", 1.0, {0.05, 0.05, 0.6}, {{0.1, -0.2, 1.3}, from_rpy(0.3, 0, 0)}, {0, 0.01, 0.1},
        {0.2, -0.1, 0.9});
    add("slider", 0.8, {0.2, 0.1, 0.1}, {{0.4, 0, 0.9}, from_rpy(0, 0.5, 0.1)}, {0.1, 0, 0.02},
        {1.0, 0.2, 0.3});
    add("bob", 1.2, {0.1, 0.2, 0.3}, {{0.7, 0, 0.8}, from_rpy(0.2, 0.3, 0.5)}, {0, 0, -0.15},
        {0.5, 0.6, 0.7});
    add("knob", 0.2, {0.1, 0.04, 0.05}, {{0.7, 0.1, 0.6}, from_rpy(0, 0, 1.0)}, {0.03, 0, 0},
        {0.1, 0.9, 0.4});
    add("limb", 1.5, {0.4, 0.1, 0.1}, {{-0.3, -0.2, 0.9}, from_rpy(0, 0, 2.8)}, {0.2, 0.02, 0},
        {0.3, 0.2, 0.1});
    add("hand", 0.5, {0.1, 0.1, 0.05}, {{-0.7, -0.2, 0.9}, from_rpy(0.7, 0, 0)}, {-0.05, 0.01, 0.01},
        {0.8, 0.1, 0.6});
}

}  // namespace detail

/// A free tree of every joint kind: welded links, slider, ball, hinges, a universal joint; damping, springs,
/// rotor inertias, tilted inertias, frames that agree with nothing.
inline ModelSpec mixed_tree() {
    ModelSpec m;
    m.name = "mixed_tree";
    m.canonical_link = "trunk";
    detail::add_mixed_links(m);
    const auto at = [&](std::size_t l, const Vec3& p, const Quat& q) { return m.links[l].X_ML * Pose{p, q}; };
    m.joints.push_back(joint(JointSpecKind::kFixed, "weld_mast", "trunk", "mast", at(1, {}, {})));
    m.joints.push_back(joint(JointSpecKind::kPrismatic, "slide", "trunk", "slider",
                             at(2, {0.01, 0, 0.02}, from_rpy(0.2, 0, 0)), {1, 1, 0.2}));
    m.joints.back().axes[0].damping = 0.7;
    m.joints.back().axes[0].spring_stiffness = 30;
    m.joints.back().axes[0].spring_reference = 0.1;
    m.joints.push_back(
        joint(JointSpecKind::kBall, "ball", "slider", "bob", at(3, {0, 0.01, 0.1}, from_rpy(0.4, 0.4, 0))));
    m.joints.push_back(joint(JointSpecKind::kFixed, "weld_knob", "bob", "knob", at(4, {}, {})));
    m.joints.push_back(joint(JointSpecKind::kUniversal, "shoulder", "mast", "limb",
                             at(5, {-0.05, 0, 0}, from_rpy(0, 0.3, 0)), {0, 0, 1}));
    m.joints.back().axes.push_back(m.joints.back().axes[0]);
    m.joints.back().axes[1].xyz = {0, 1, 0};
    m.joints.back().axes[1].damping = 0.3;
    m.joints.push_back(joint(JointSpecKind::kRevolute, "wrist", "limb", "hand",
                             at(6, {0, 0, -0.02}, from_rpy(0.1, 0.1, 0.1)), {0.3, -1, 0.5}));
    m.joints.back().axes[0].armature = 0.05;
    m.joints.back().axes[0].damping = 0.2;
    m.joints.back().axes[0].spring_stiffness = 4;
    m.joints.back().axes[0].spring_reference = -0.3;
    return m;
}

/// A ball on every link, so that the model touches the ground.
inline ModelSpec with_balls(ModelSpec model, double radius) {
    for (LinkSpec& l : model.links) l.collisions.push_back(sphere_shape(radius, surface(0.8), {l.p_LC, {}}));
    return model;
}

}  // namespace roboss::test
