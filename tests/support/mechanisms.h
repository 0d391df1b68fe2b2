// Mechanisms with closed loops, gearboxes and mimic joints for tests: planar and spatial, on the ground and
// on a free base.
#pragma once

#include <support/bodies.h>

namespace roboss::test {

/// A rod of 0.1 kg a 0.1 m between two points, its frame at the first, its x axis towards the second.
inline LinkSpec rod_between(const std::string& name, const Vec3& from, const Vec3& to) {
    const Vec3 along = to - from;
    const double length = norm(along);
    const Vec3 x = along / length;
    const Vec3 y = normalized(std::fabs(x.y) < 0.9 ? Vec3{0, 1, 0} - x * x.y : Vec3{0, 0, 1} - x * x.z);
    const Vec3 z = cross(x, y);
    const Mat3 R = transpose(Mat3{x, y, z});
    LinkSpec l = link(name, length, box_inertia(length, {length, 0.02, 0.03}), {from, to_quat(R)});
    l.p_LC = {0.5 * length, 0, 0};
    return l;
}

/// Two directions in the plane, then its normal (unit, in the joint frame).
inline JointSpec planar_joint(std::string name, std::string parent, std::string child, const Pose& X_MJ,
                              const Vec3& normal) {
    JointSpec j = joint(JointSpecKind::kPlanar, std::move(name), std::move(parent), std::move(child), X_MJ);
    j.axes.resize(3);
    tangents(normal, j.axes[0].xyz, j.axes[1].xyz);
    j.axes[2].xyz = normal;
    return j;
}

struct FourBarOptions {
    bool free_base = false;
    JointSpecKind last = JointSpecKind::kRevolute;  // the joint that closes the loop
};

/// Crank 0.2 m, coupler 0.5 m, rocker 0.4 m, ground 0.5 m in the x-z plane; all hinges about y. Joints:
/// crank, elbow, rocker, closing (rocker - coupler).
inline ModelSpec four_bar(const FourBarOptions& options = {}) {
    ModelSpec m;
    m.name = "four_bar";
    const Vec3 a{0, 0, 0}, b{0, 0, 0.2}, d{0.5, 0, 0};
    // Where circles of 0.5 m about b and 0.4 m about d meet.
    const Vec3 bd = d - b;
    const double distance = norm(bd);
    const double along = (0.25 - 0.16 + distance * distance) / (2 * distance);
    const double up = std::sqrt(0.25 - along * along);
    const Vec3 e = bd / distance;
    const Vec3 c = b + e * along + Vec3{-e.z, 0, e.x} * up;
    m.links = {rod_between("crank", a, b), rod_between("coupler", b, c), rod_between("rocker", d, c)};
    m.canonical_link = "crank";
    std::string ground = "world";
    if (options.free_base) {
        m.links.push_back(link("plate", 1.5, box_inertia(1.5, {0.6, 0.2, 0.1}), {{0.25, 0.02, -0.05}, {}}));
        m.canonical_link = ground = "plate";
    }
    const auto hinge = [&](const char* name, const std::string& parent, const char* child, const Vec3& at) {
        m.joints.push_back(joint(JointSpecKind::kRevolute, name, parent, child, {at, {}}, {0, 1, 0}));
    };
    hinge("crank", ground, "crank", a);
    hinge("elbow", "crank", "coupler", b);
    hinge("rocker", ground, "rocker", d);
    hinge("closing", "rocker", "coupler", c);
    m.joints.back().kind = options.last;
    if (options.last == JointSpecKind::kBall) m.joints.back().axes.clear();
    return m;
}

/// Cranks of 0.2 m, coupler and ground of 0.5 m: folds flat twice a turn, and may then go on crossed.
inline ModelSpec parallelogram() {
    ModelSpec m = four_bar();
    const Vec3 a{0, 0, 0}, b{0, 0, 0.2}, c{0.5, 0, 0.2}, d{0.5, 0, 0};
    m.links = {rod_between("crank", a, b), rod_between("coupler", b, c), rod_between("rocker", d, c)};
    m.joints[3].X_MJ.p = c;
    return m;
}

/// A platform on six struts (Stewart, Gough): each a universal joint below, a slide, a ball above.
inline ModelSpec stewart() {
    ModelSpec m;
    m.name = "stewart";
    m.canonical_link = "platform";
    m.links.push_back(link("platform", 3.0, Mat3::diagonal(0.05, 0.06, 0.1), {{0, 0, 0.8}, {}}));
    for (int i = 0; i < 6; ++i) {
        const std::string n = std::to_string(i);
        const double low = kPi / 3 * (i / 2) * 2 + (i % 2 == 0 ? -0.2 : 0.2);
        const double high = kPi / 3 * (i / 2) * 2 + (i % 2 == 0 ? -0.8 : 0.8);
        const Vec3 foot{0.6 * std::cos(low), 0.6 * std::sin(low), 0};
        const Vec3 head{0.3 * std::cos(high), 0.3 * std::sin(high), 0.8};
        const Vec3 middle = (foot + head) * 0.5;
        m.links.push_back(rod_between("tube_" + n, foot, middle));
        m.links.push_back(rod_between("piston_" + n, middle, head));
        const Quat q = m.links.back().X_ML.q;
        m.joints.push_back(
            joint(JointSpecKind::kUniversal, "foot_" + n, "world", "tube_" + n, {foot, q}, {0, 1, 0}));
        m.joints.back().axes.emplace_back();
        m.joints.back().axes[1].xyz = {0, 0, 1};
        m.joints.push_back(joint(JointSpecKind::kPrismatic, "strut_" + n, "tube_" + n, "piston_" + n,
                                 {middle, q}, {1, 0, 0}));
        m.joints.push_back(joint(JointSpecKind::kBall, "head_" + n, "piston_" + n, "platform", {head, q}));
    }
    return m;
}

/// A free base and a chain of every joint kind back to it, frames and inertias that agree with nothing;
/// `closing` is the kind of the last joint. Two or more degrees of freedom are left beside the base's six.
inline ModelSpec ring_of_all_kinds(JointSpecKind closing) {
    ModelSpec m;
    m.name = "ring";
    m.canonical_link = "base";
    const auto add_link = [&](const std::string& name, double mass, const Vec3& p, const Vec3& rpy) {
        const Mat3 R = to_matrix(from_rpy(rpy.z, rpy.x, rpy.y));
        m.links.push_back(link(name, mass, R * box_inertia(mass, {0.2, 0.3, 0.15}) * transpose(R),
                               {p, from_rpy(rpy.x, rpy.y, rpy.z)}));
        m.links.back().p_LC = {0.03, -0.02, 0.05};
    };
    add_link("base", 3.0, {0, 0, 0}, {0.1, 0.2, 0.3});
    add_link("arm", 1.0, {0.3, 0.1, 0.2}, {0.4, 0, -0.3});
    add_link("slider", 0.8, {0.5, 0.1, 0.4}, {0, 0.6, 0.2});
    add_link("nut", 0.6, {0.6, 0.3, 0.5}, {0.7, 0.1, 0});
    add_link("limb", 1.2, {0.4, 0.5, 0.4}, {-0.2, 0.5, 0.1});
    add_link("hand", 0.5, {0.2, 0.5, 0.2}, {0.3, -0.6, 0.2});
    const auto add = [&](JointSpecKind kind, const std::string& name, std::size_t to, const Vec3& axis) {
        const Pose X =
            m.links[to].X_ML * Pose{{-0.1, 0.02, -0.05}, from_rpy(0.3, 0.1 * static_cast<double>(to), 0)};
        m.joints.push_back(joint(kind, name, m.links[to - 1].name, m.links[to].name, X, axis));
        AxisSpec& first = m.joints.back().axes[0];
        first.damping = 0.3, first.spring_stiffness = 2, first.armature = 0.01;
        if (kind == JointSpecKind::kBall) m.joints.back().axes.clear();
        if (kind == JointSpecKind::kScrew) m.joints.back().screw_pitch = 0.07;
        if (kind != JointSpecKind::kUniversal && kind != JointSpecKind::kRevolute2) return;
        AxisSpec second = first;
        second.xyz = normalized(cross(first.xyz, Vec3{0.5, 0.2, -0.3}));
        m.joints.back().axes.push_back(second);
    };
    add(JointSpecKind::kRevolute, "hinge", 1, {0.2, 1, 0.1});
    add(JointSpecKind::kPrismatic, "slide", 2, {1, 0.3, 0.2});
    add(JointSpecKind::kScrew, "thread", 3, {0.1, -0.4, 1});
    add(JointSpecKind::kUniversal, "cardan", 4, {1, 0.2, 0});
    add(JointSpecKind::kRevolute2, "wheel", 5, {0, 0.3, 1});
    m.links.push_back(
        link("tip", 0.4, box_inertia(0.4, {0.1, 0.2, 0.1}), {{0.05, 0.3, 0.1}, from_rpy(0.2, 0, 1)}));
    add(JointSpecKind::kContinuous, "turn", 6, {0.4, 0.1, -1});
    JointSpec last = joint(closing, "closing", "base", "tip", {{0.02, 0.2, 0.05}, from_rpy(0.1, 0.4, -0.2)},
                           {0.3, -0.2, 1});
    if (closing == JointSpecKind::kPlanar)
        last = planar_joint("closing", "base", "tip", last.X_MJ, last.axes[0].xyz);
    if (closing == JointSpecKind::kBall) last.axes.clear();
    if (closing == JointSpecKind::kScrew) last.screw_pitch = -0.11;
    if (closing == JointSpecKind::kUniversal) {
        last.axes.emplace_back();
        last.axes[1].xyz = normalized(Vec3{1, 0.4, 0.1});
    }
    m.joints.push_back(last);
    return m;
}

/// Two wheels on hinges about z of one frame, 0.02 and 0.05 kg m^2. `free_base`: the frame floats.
inline ModelSpec two_wheels(bool free_base = false) {
    ModelSpec m;
    m.name = "wheels";
    m.canonical_link = "frame";
    m.links = {link("frame", 2.0, Mat3::diagonal(0.1, 0.1, 0.1)),
               link("small", 0.5, Mat3::diagonal(0.01, 0.01, 0.02), {{0.3, 0, 0}, {}}),
               link("large", 1.0, Mat3::diagonal(0.03, 0.03, 0.05), {{-0.3, 0, 0}, {}})};
    m.joints = {joint(JointSpecKind::kContinuous, "small", "frame", "small", {{0.3, 0, 0}, {}}, {0, 0, 1}),
                joint(JointSpecKind::kContinuous, "large", "frame", "large", {{-0.3, 0, 0}, {}}, {0, 0, 1})};
    if (!free_base) m.joints.push_back(joint(JointSpecKind::kFixed, "ground", "world", "frame", {}));
    return m;
}

/// The large wheel turns against the small one, `ratio` times as fast.
inline ModelSpec geared_wheels(double ratio, bool free_base = false) {
    ModelSpec m = two_wheels(free_base);
    JointSpec gearbox = joint(JointSpecKind::kGearbox, "gearbox", "small", "large", {}, {0, 0, 1});
    gearbox.axes.emplace_back();
    gearbox.gearbox_ratio = ratio;
    gearbox.gearbox_reference = "frame";
    m.joints.push_back(gearbox);
    return m;
}

}  // namespace roboss::test
