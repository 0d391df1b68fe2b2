// See body_branches.h.
#include "physics/dynamics/body_branches.h"

namespace roboss {

void BodyBranches::lay_out(const RobotType& type) {
    const JointElimination& elimination = type.elimination;
    if (stamp_ == elimination.pattern.stamp()) return;
    stamp_ = elimination.pattern.stamp();
    cut(type.bodies);
    list_nodes(elimination, type.bodies.size());
}

/// Into branches of at most a sixteenth of the bodies.
void BodyBranches::cut(std::span<const Body> bodies) {
    constexpr std::size_t kBranches = 16;
    const std::size_t most = bodies.size() / kBranches;
    size_.assign(bodies.size(), 1);  // of each body's subtree
    for (std::size_t b = bodies.size(); b-- > 0;)
        if (bodies[b].parent >= 0) size_[static_cast<std::size_t>(bodies[b].parent)] += size_[b];
    branch_of_.assign(bodies.size(), -1), is_root_.assign(bodies.size(), 0);
    first_.assign(1, 0), trunk_.clear(), trunk_and_roots_.clear();
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const int parent = bodies[b].parent;
        if (parent >= 0) branch_of_[b] = branch_of_[static_cast<std::size_t>(parent)];
        if (branch_of_[b] < 0 && size_[b] <= most) {
            branch_of_[b] = static_cast<int>(count());
            first_.push_back(first_.back() + size_[b]);
            is_root_[b] = 1;
        }
        if (branch_of_[b] < 0) trunk_.push_back(b);
        if (branch_of_[b] < 0 || is_root_[b] != 0) trunk_and_roots_.push_back(b);
    }
    bodies_.resize(first_.back());
    next_.assign(first_.begin(), first_.end() - 1);
    for (std::size_t b = 0; b < bodies.size(); ++b)
        if (branch_of_[b] >= 0) bodies_[next_[static_cast<std::size_t>(branch_of_[b])]++] = b;
}

void BodyBranches::list_nodes(const JointElimination& elimination, std::size_t bodies) {
    first_node_.assign(bodies + 1, 0);
    const auto each_side = [&](const auto& visit) {
        for (std::size_t k = 0; k < elimination.nodes.size(); ++k)
            for (const int body : {elimination.nodes[k].body_a, elimination.nodes[k].body_b})
                if (body >= 0) visit(static_cast<std::size_t>(body), k);
    };
    each_side([&](std::size_t body, std::size_t) { ++first_node_[body + 1]; });
    for (std::size_t b = 0; b < bodies; ++b) first_node_[b + 1] += first_node_[b];
    nodes_.resize(first_node_.back());
    next_.assign(first_node_.begin(), first_node_.end() - 1);
    each_side([&](std::size_t body, std::size_t k) { nodes_[next_[body]++] = k; });
}

}  // namespace roboss
