// See joint_elimination.h.
#include "model/joint_elimination.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "model/model.h"

namespace roboss {
namespace {

// Robots with fewer loops are faster with the dense matrix (docs/decisions/0032-many-loops.md).
constexpr std::size_t kLoopsMin = 6;
// Bodies, and directions of one body, that differ more would cost digits.
constexpr double kMassRatioMax = 1e4, kInertiaRatioMax = 1e5;

/// What J M^-1 J^T over all joints does not hold: rotors, couplings of coordinates, added mass.
bool is_plain(const RobotType& type) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const Body& body : type.bodies) {
        const Mat3& I = body.inertia_C;
        const auto [low, high] = std::minmax({I.r0.x, I.r1.y, I.r2.z});
        if (!(body.mass > 0) || !(low > 0) || !(high <= kInertiaRatioMax * low)) return false;
        least = std::min(least, body.mass), most = std::max(most, body.mass);
    }
    const auto has_rotor = [](const Dof& dof) { return dof.armature != 0; };
    const auto joins_nothing = [](const LoopJoint& loop) { return loop.body_a == loop.body_b; };
    return most <= kMassRatioMax * least && type.couplings.empty() && type.fluids.empty() &&
           !type.feels_flow && std::ranges::none_of(type.dofs, has_rotor) &&
           std::ranges::none_of(type.loops, joins_nothing);
}

std::vector<JointElimination::Node> joints_of(const RobotType& type) {
    std::vector<JointElimination::Node> nodes;
    for (std::size_t b = 0; b < type.bodies.size(); ++b)
        nodes.push_back({type.bodies[b].parent, static_cast<int>(b), -1});
    for (std::size_t i = 0; i < type.loops.size(); ++i)
        nodes.push_back({type.loops[i].body_a, type.loops[i].body_b, static_cast<int>(i)});
    return nodes;
}

/// By body: the joints that hold it.
std::vector<std::vector<int>> joints_by_body(const RobotType& type,
                                             const std::vector<JointElimination::Node>& nodes) {
    std::vector<std::vector<int>> by_body(type.bodies.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
        for (const int body : {nodes[i].body_a, nodes[i].body_b})
            if (body >= 0) by_body[static_cast<std::size_t>(body)].push_back(static_cast<int>(i));
    return by_body;
}

void couple(const RobotType& type, JointElimination& out) {
    const std::vector<std::vector<int>> by_body = joints_by_body(type, out.nodes);
    std::vector<std::pair<int, int>> links;
    for (const std::vector<int>& joints : by_body)
        for (std::size_t i = 0; i < joints.size(); ++i)
            for (std::size_t j = i + 1; j < joints.size(); ++j) links.emplace_back(joints[i], joints[j]);
    out.pattern.analyse(out.nodes.size(), links);
    const auto position = [&](int node) { return out.pattern.position(static_cast<std::size_t>(node)); };
    for (std::size_t b = 0; b < by_body.size(); ++b)
        for (const int p : by_body[b])
            for (const int q : by_body[b])
                if (position(p) <= position(q)) out.couplings.push_back({static_cast<int>(b), p, q});
    std::ranges::stable_sort(out.couplings, {}, [&](const auto& coupling) { return position(coupling.p); });
    out.coupling_first.assign(out.nodes.size() + 1, 0);
    for (const JointElimination::Coupling& coupling : out.couplings)
        ++out.coupling_first[position(coupling.p) + 1];
    for (std::size_t k = 0; k < out.nodes.size(); ++k) out.coupling_first[k + 1] += out.coupling_first[k];
}

}  // namespace

JointElimination joint_elimination(const RobotType& type) {
    JointElimination out;
    if (type.loops.size() < kLoopsMin || !is_plain(type)) return out;
    out.nodes = joints_of(type);
    couple(type, out);
    return out;
}

}  // namespace roboss
