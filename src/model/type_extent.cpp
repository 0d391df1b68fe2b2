// What the bodies of a type amount to: their masses, how far its shapes reach, which of them may meet.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "model/compile_type.h"
#include "model/joint_motion.h"

namespace roboss {
namespace {

Mat3 point_inertia(double mass, const Vec3& d) {
    const double dd = norm_squared(d);
    return Mat3{{dd - d.x * d.x, -d.x * d.y, -d.x * d.z},
                {-d.x * d.y, dd - d.y * d.y, -d.y * d.z},
                {-d.x * d.z, -d.y * d.z, dd - d.z * d.z}} *
           mass;
}

/// How far the joint of a body can slide along its axis.
double slide_range(const RobotType& type, const Body& body) {
    const double per_unit = std::fabs(slide_of(body));
    if (per_unit == 0) return 0.0;
    const Dof& dof = type.dofs[static_cast<std::size_t>(body.v_index - type.base_nv())];
    return per_unit * std::max(std::fabs(dof.lower), std::fabs(dof.upper));
}

/// How far the shapes of the base [0] and of each body and those that hang on it [1 + body] are from its
/// frame, in every pose; `of_none` where there are none.
std::vector<double> extents_of(const RobotType& type, double of_none) {
    std::vector<double> extent(type.bodies.size() + 1, of_none);
    for (const BodyShape& s : type.shapes) {
        double& e = extent[static_cast<std::size_t>(s.body + 1)];
        e = std::max(e, norm(s.X_BS.p) + bounding_radius(s.shape));
    }
    for (std::size_t b = type.bodies.size(); b-- > 0;) {
        const Body& body = type.bodies[b];
        if (body.joint == JointKind::kFree) continue;
        double& e = extent[static_cast<std::size_t>(body.parent + 1)];
        e = std::max(e, norm(body.X_PJ.p) + slide_range(type, body) + extent[b + 1]);
    }
    return extent;
}

/// For each body the nearest one before it, towards the base, that carries a link. A joint of several motions
/// puts bodies without links between the two that it joins; so do several joints of one body (MJCF).
std::vector<int> parents_with_links(const RobotType& type, const ModelSpec* spec) {
    std::set<std::string> between;
    if (spec != nullptr)
        for (const LinkSpec& link : spec->links)
            if (link.between_joints) between.insert(link.name);
    std::vector<char> has_link(type.bodies.size(), 0);
    for (const Link& link : type.links)
        if (link.body >= 0 && between.count(link.name) == 0)
            has_link[static_cast<std::size_t>(link.body)] = 1;
    std::vector<int> parents;
    for (const Body& body : type.bodies) {
        int parent = body.parent;
        while (parent >= 0 && !has_link[static_cast<std::size_t>(parent)])
            parent = type.bodies[static_cast<std::size_t>(parent)].parent;
        parents.push_back(parent);
    }
    return parents;
}

/// The bodies that the file keeps from touching, each pair both ways.
std::set<std::pair<int, int>> excluded_pairs(const RobotType& type, const ModelSpec* spec) {
    std::set<std::pair<int, int>> pairs;
    if (spec == nullptr) return pairs;
    for (const auto& names : spec->no_contact) {
        const auto first = type.find_link(names.first), second = type.find_link(names.second);
        if (!first || !second) continue;
        const int a = type.links[first->index()].body, b = type.links[second->index()].body;
        pairs.insert({{a, b}, {b, a}});
    }
    return pairs;
}

bool loop_joins(const RobotType& type, int a, int b) {
    return std::any_of(type.loops.begin(), type.loops.end(), [&](const LoopJoint& loop) {
        return (loop.body_a == a && loop.body_b == b) || (loop.body_a == b && loop.body_b == a);
    });
}

}  // namespace

void add_mass(Body& body, const Link& link) {
    const double total = body.mass + link.mass;
    if (total <= 0) return;
    const Vec3 centre = (body.p_BC * body.mass + link.p_BC * link.mass) * (1.0 / total);
    body.inertia_C = body.inertia_C + point_inertia(body.mass, body.p_BC - centre) + link.inertia_C +
                     point_inertia(link.mass, link.p_BC - centre);
    if (link.gravity && link.mass > 0) {
        const double felt = body.gravity_mass + link.mass;
        body.p_BG = (body.p_BG * body.gravity_mass + link.p_BC * link.mass) * (1.0 / felt);
        body.gravity_mass = felt;
    }
    body.p_BC = centre;
    body.mass = total;
}

double reach_of(const RobotType& type) {
    const std::vector<double> extent = extents_of(type, 0.0);
    return std::max(extent[0], extent.size() > 1 && type.free_base ? extent[1] : 0.0);
}

ReachSphere reach_sphere_of(const RobotType& type) {
    const ReachSphere about_base{{}, type.reach};
    if (type.free_base || type.kinematic || type.is_static || !type.scenery.empty()) return about_base;
    if (type.shapes.empty()) return {};
    const std::vector<double> extent = extents_of(type, -std::numeric_limits<double>::infinity());
    const auto arm = [&](std::size_t b) { return slide_range(type, type.bodies[b]) + extent[b + 1]; };
    ReachSphere sphere;
    double longest = 0;
    for (std::size_t b = 0; b < type.bodies.size(); ++b)
        if (type.bodies[b].parent < 0 && arm(b) > longest)
            longest = arm(b), sphere.centre = type.bodies[b].X_PJ.p;
    for (std::size_t b = 0; b < type.bodies.size(); ++b)
        if (type.bodies[b].parent < 0)
            sphere.radius = std::max(sphere.radius, norm(type.bodies[b].X_PJ.p - sphere.centre) + arm(b));
    for (const BodyShape& s : type.shapes)
        if (s.body < 0)
            sphere.radius =
                std::max(sphere.radius, norm(s.X_BS.p - sphere.centre) + bounding_radius(s.shape));
    return sphere.radius < about_base.radius ? sphere : about_base;
}

std::vector<std::pair<int, int>> self_pairs_of(const RobotType& type, const ModelSpec* spec) {
    const std::vector<int> parents = parents_with_links(type, spec);
    const auto parent = [&](int b) { return b < 0 ? -2 : parents[static_cast<std::size_t>(b)]; };
    const std::set<std::pair<int, int>> excluded = excluded_pairs(type, spec);
    std::vector<std::pair<int, int>> pairs;
    for (std::size_t a = 0; a < type.shapes.size(); ++a) {
        for (std::size_t b = a + 1; b < type.shapes.size(); ++b) {
            const int ba = type.shapes[a].body, bb = type.shapes[b].body;
            if (ba == bb || parent(ba) == bb || parent(bb) == ba || loop_joins(type, ba, bb)) continue;
            if (excluded.count({ba, bb}) > 0) continue;
            pairs.emplace_back(static_cast<int>(a), static_cast<int>(b));
        }
    }
    return pairs;
}

}  // namespace roboss
