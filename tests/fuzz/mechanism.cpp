#include "fuzz/mechanism.h"

#include <cmath>
#include <span>
#include <string>

#include <support/bodies.h>
#include <support/mechanisms.h>

namespace roboss::fuzz {
namespace {

bool chance(Random& random, double probability) {
    return random.uniform(0, 1) < probability;
}

/// Evenly spread over the orders of magnitude.
double magnitude(Random& random, double low, double high) {
    return std::exp(random.uniform(std::log(low), std::log(high)));
}

Vec3 direction(Random& random) {
    for (;;) {
        const Vec3 v = random.vector(1);
        const double n = norm(v);
        if (n > 0.1 && n <= 1) return v / n;
    }
}

Vec3 box_size(Random& random) {
    const double x = magnitude(random, 0.05, 0.3), y = magnitude(random, 0.05, 0.3);
    return {x, y, magnitude(random, 0.05, 0.3)};
}

SurfaceSpec random_surface(Random& random, double restitution_most) {
    const double mu = random.uniform(0, 1);
    const double restitution = random.uniform(0, restitution_most);
    return test::surface(mu, chance(random, 0.4) ? restitution : 0.0);
}

/// A shape about as large as a box of `size`.
CollisionSpec random_shape(Random& random, const Vec3& size, const SurfaceSpec& surface, const Pose& X_LS) {
    const double radius = 0.5 * std::fmin(size.x, size.y);
    switch (random.integer(0, 4)) {
        case 0:
            return test::sphere_shape(radius, surface, X_LS);
        case 1:
            return test::cylinder_shape(radius, size.z, surface, X_LS);
        case 2: {
            CollisionSpec c = test::collision(GeometryKind::kCapsule, surface, X_LS);
            c.geometry.radius = radius, c.geometry.length = size.z;
            return c;
        }
        case 3: {
            CollisionSpec c = test::collision(GeometryKind::kEllipsoid, surface, X_LS);
            c.geometry.size = size * 0.5;
            return c;
        }
        default:
            return test::box_shape(size, surface, X_LS);
    }
}

LinkSpec random_link(Random& random, const std::string& name, const Pose& X_ML,
                     const MechanismOptions& options) {
    const Vec3 size = box_size(random);
    const double mass = magnitude(random, 0.1, 5);
    const Mat3 tilt = to_matrix(random.rotation());
    LinkSpec l = test::link(name, mass, tilt * test::box_inertia(mass, size) * transpose(tilt), X_ML);
    l.p_LC = random.vector(0.05);
    const SurfaceSpec surface = random_surface(random, options.restitution_most);
    const CollisionSpec shape = random_shape(random, size, surface, {l.p_LC, to_quat(tilt)});
    if (options.shapes) l.collisions.push_back(shape);
    return l;
}

/// Everything that an axis may have.
void vary_axis(Random& random, bool slides, AxisSpec& axis) {
    const double low = random.uniform(slides ? -0.3 : -2.0, -0.05),
                 high = random.uniform(0.05, slides ? 0.3 : 2.0);
    if (chance(random, slides ? 1.0 : 0.45)) axis.lower = low, axis.upper = high;
    const double stiffness = magnitude(random, 1e2, 1e6), dissipation = magnitude(random, 1e-1, 1e2);
    if (chance(random, 0.2)) axis.limit_stiffness = stiffness, axis.limit_dissipation = dissipation;
    const double damping = magnitude(random, 1e-4, 1e-1);
    if (chance(random, 0.35)) axis.damping = damping;
    const double friction = magnitude(random, 1e-3, 1e-1);
    if (chance(random, 0.35)) axis.friction = friction;
    const double spring = magnitude(random, 0.1, 30), reference = random.uniform(-0.5, 0.5);
    if (chance(random, 0.2)) axis.spring_stiffness = spring, axis.spring_reference = reference;
    const double armature = magnitude(random, 1e-4, 1e-2);
    if (chance(random, 0.15)) axis.armature = armature;
}

void store_nothing(AxisSpec& axis) {
    const AxisSpec plain;
    axis.limit_stiffness = plain.limit_stiffness, axis.limit_dissipation = plain.limit_dissipation;
    axis.spring_stiffness = axis.armature = 0;
}

void vary_axes(Random& random, const MechanismOptions& options, JointSpec& joint) {
    for (AxisSpec& axis : joint.axes) {
        vary_axis(random, joint.kind == JointSpecKind::kPrismatic, axis);
        if (!options.stores) store_nothing(axis);
        // What slides has limits, so that it stays within reach and gravity does not drive a screw beyond all
        // speeds.
        if (joint.kind == JointSpecKind::kScrew && !axis.has_limits()) axis.lower = -6, axis.upper = 6;
    }
    const double damping = magnitude(random, 1e-4, 1e-1);
    if (joint.kind == JointSpecKind::kBall && chance(random, 0.35)) joint.ball_damping = damping;
}

JointSpecKind random_kind(Random& random, const MechanismOptions& options) {
    return options
        .kinds[static_cast<std::size_t>(random.integer(0, static_cast<int>(options.kinds.size()) - 1))];
}

int freedoms(JointSpecKind kind) {
    return kind == JointSpecKind::kBall ? 3 : kind == JointSpecKind::kUniversal ? 2 : 1;
}

/// A joint of that kind without limits, damping or any other force.
JointSpec bare_joint(Random& random, JointSpecKind kind, const std::string& name, const std::string& parent,
                     const std::string& child, const Pose& X_MJ) {
    const Vec3 axis = direction(random), other = direction(random);
    if (kind == JointSpecKind::kBall) return test::joint(kind, name, parent, child, X_MJ);
    JointSpec j = test::joint(kind, name, parent, child, X_MJ, axis);
    if (kind == JointSpecKind::kScrew)
        j.screw_pitch = random.uniform(0.01, 0.1) * (chance(random, 0.5) ? 1 : -1);
    if (kind == JointSpecKind::kUniversal) {
        j.axes.emplace_back();
        const Vec3 across = cross(axis, other);
        j.axes[1].xyz =
            norm(across) > 0.1 ? normalized(across) : normalized(cross(axis, Vec3{axis.y, axis.z, -axis.x}));
    }
    return j;
}

std::string link_name(int i) {
    return "link_" + std::to_string(i);
}

/// Adds link number `i` with a joint of that kind to link `parent` (-1: the world), a hand's breadth away
/// from it.
void add_limb(Random& random, const MechanismOptions& options, int i, int parent, JointSpecKind kind,
              ModelSpec& m) {
    const Pose X_MP = parent < 0 ? Pose{} : m.links[static_cast<std::size_t>(parent)].X_ML;
    const Pose X_MJ{X_MP.p + direction(random) * random.uniform(0.05, 0.2), random.rotation()};
    const Pose X_ML{X_MJ.p + direction(random) * random.uniform(0.05, 0.2), random.rotation()};
    m.links.push_back(random_link(random, link_name(i), X_ML, options));
    m.joints.push_back(bare_joint(random, kind, "joint_" + std::to_string(i),
                                  parent < 0 ? "world" : link_name(parent), link_name(i), X_MJ));
    if (!options.bare) vary_axes(random, options, m.joints.back());
}

ModelSpec named(const std::string& name) {
    ModelSpec m;
    m.name = name;
    m.canonical_link = link_name(0);
    return m;
}

/// Turns half of these joints into planar ones in one mechanism of eight. The numbers come from a stream of
/// their own, so a seed's other mechanisms are what they were before planar joints were drawn.
void make_some_planar(const Random& after, const MechanismOptions& options, std::span<JointSpec> joints) {
    if (!options.planar) return;
    Random seed = after;
    Random random(static_cast<std::uint64_t>(seed.integer(0, 1 << 30)));
    if (!chance(random, 0.125)) return;
    for (JointSpec& joint : joints) {
        const Vec3 normal = direction(random);
        if (!chance(random, 0.5)) continue;
        joint = test::planar_joint(joint.name, joint.parent, joint.child, joint.X_MJ, normal);
        if (options.bare) continue;
        for (std::size_t k = 0; k < joint.axes.size(); ++k) {
            vary_axis(random, k < 2, joint.axes[k]);
            if (!options.stores) store_nothing(joint.axes[k]);
        }
    }
}

ModelSpec random_ring(Random& random, const MechanismOptions& options) {
    ModelSpec m = named("ring");
    const int links = random.integer(3, 5);  // behind the base
    std::vector<JointSpecKind> kinds;
    JointSpecKind closing = JointSpecKind::kBall;
    int freedom = 0;
    while (freedom < 7) {  // one of them is left when the loop is closed
        kinds.clear(), closing = random_kind(random, options), freedom = freedoms(closing);
        for (int i = 0; i < links; ++i)
            kinds.push_back(random_kind(random, options)), freedom += freedoms(kinds.back());
    }
    m.links.push_back(random_link(random, link_name(0), {{}, random.rotation()}, options));
    for (int i = 1; i <= links; ++i)
        add_limb(random, options, i, i - 1, kinds[static_cast<std::size_t>(i - 1)], m);
    make_some_planar(random, options, m.joints);
    const Vec3 middle = (m.links.front().X_ML.p + m.links.back().X_ML.p) * 0.5;
    m.joints.push_back(bare_joint(random, closing, "closing", link_name(0), link_name(links),
                                  {middle + random.vector(0.05), random.rotation()}));
    return m;
}

}  // namespace

ModelSpec with_own_joint_names(ModelSpec model) {
    for (JointSpec& j : model.joints) j.name = "joint_" + j.name;
    return model;
}

ModelSpec random_tree(Random& random, const MechanismOptions& options) {
    ModelSpec m = named("tree");
    const int links = random.integer(options.links_least, options.links_most);
    if (!options.fixed_base)
        m.links.push_back(random_link(random, link_name(0), {{}, random.rotation()}, options));
    for (int i = static_cast<int>(m.links.size()); i < links; ++i) {
        const int parent = options.fixed_base && i == 0 ? -1 : random.integer(0, i - 1);
        add_limb(random, options, i, parent, random_kind(random, options), m);
    }
    make_some_planar(random, options, m.joints);
    return m;
}

ModelSpec random_loop(Random& random, const MechanismOptions& options) {
    if (chance(random, 0.7)) return random_ring(random, options);
    test::FourBarOptions four_bar;
    four_bar.free_base = true;
    four_bar.last = chance(random, 0.5) ? JointSpecKind::kRevolute : JointSpecKind::kBall;
    ModelSpec m = with_own_joint_names(test::four_bar(four_bar));
    for (std::size_t j = 0; j < 3; ++j) vary_axis(random, false, m.joints[j].axes[0]);
    return m;
}

ModelSpec random_net(Random& random, MechanismOptions options) {
    options.stores = options.planar = false;
    options.bare = chance(random, 0.5);
    ModelSpec m = named("net");
    const int loops = random.integer(6, 9), links = loops + random.integer(3, 6);  // behind the base
    m.links.push_back(random_link(random, link_name(0), {{}, random.rotation()}, options));
    for (int i = 1; i <= links; ++i) {
        const JointSpecKind kind = chance(random, 0.2) ? random_kind(random, options) : JointSpecKind::kBall;
        add_limb(random, options, i, random.integer(0, i - 1), kind, m);
    }
    for (int k = 0; k < loops; ++k) {
        const int a = random.integer(0, links), other = random.integer(0, links - 1);
        const int b = other < a ? other : other + 1;
        const auto at = [&](int i) { return m.links[static_cast<std::size_t>(i)].X_ML.p; };
        m.joints.push_back(bare_joint(random, JointSpecKind::kBall, "closing_" + std::to_string(k),
                                      link_name(a), link_name(b),
                                      {(at(a) + at(b)) * 0.5 + random.vector(0.05), random.rotation()}));
    }
    return m;
}

ModelSpec random_coupled(Random& random, const MechanismOptions& options) {
    const double ratio = random.uniform(0.3, 3) * (chance(random, 0.5) ? 1 : -1);
    if (chance(random, 0.25)) {
        ModelSpec m = with_own_joint_names(test::geared_wheels(ratio, true));
        for (std::size_t j = 0; j < 2; ++j) vary_axis(random, false, m.joints[j].axes[0]);
        for (std::size_t j = 0; j < 2; ++j)
            m.joints[j].axes[0].lower = -1e16, m.joints[j].axes[0].upper = 1e16;
        return m;
    }
    for (;;) {
        MechanismOptions some = options;
        some.links_least = 3;
        ModelSpec m = random_tree(random, some);
        std::vector<JointSpec*> single;
        for (JointSpec& j : m.joints)
            if (j.axes.size() == 1) single.push_back(&j);
        if (single.size() < 2) continue;
        MimicSpec mimic;
        mimic.joint = single[0]->name;
        mimic.multiplier = ratio;
        single[1]->axes[0].mimic = mimic;
        m.name = "coupled";
        return m;
    }
}

ModelSpec random_solid(Random& random, double restitution_most) {
    MechanismOptions options;
    options.shapes = true;
    options.restitution_most = restitution_most;
    ModelSpec m = named("solid");
    m.links.push_back(random_link(random, link_name(0), {}, options));
    return m;
}

double start_radius(const ModelSpec& model) {
    constexpr double kLink = 0.35;  // no part of a link is further from its frame
    double radius = 0;
    for (const LinkSpec& l : model.links) radius = std::fmax(radius, norm(l.X_ML.p) + kLink);
    return radius;
}

}  // namespace roboss::fuzz
