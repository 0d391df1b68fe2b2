// The bodies and joints of a robot with many loops as threads share them.
//
// The tree of the bodies is cut into branches that are walked side by side: towards the tips the trunk goes
// first, towards the root it goes last. What each body computes, and the order in which its children
// add to a parent, are those of one walk over all bodies, so no bit depends on the number of threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/team.h"
#include "model/model.h"

namespace roboss {

class BodyBranches {
  public:
    /// For a robot of a type with an elimination. Fast where it is the type of the last call.
    void lay_out(const RobotType& type);

    /// visit(b) for every body, each after its parent.
    template <class Visit>
    void walk_to_tips(const Team& team, const Visit& visit) const {
        for (const std::size_t b : trunk_) visit(b);
        team.run(count(), [&](std::size_t i, std::size_t) {
            for (const std::size_t b : branch(i)) visit(b);
        });
    }

    /// visit(b) for every body, each after its children, and then pass(b), which adds something to the
    /// parent: to each parent in the order of descending numbers.
    template <class Visit, class Pass>
    void walk_to_root(const Team& team, const Visit& visit, const Pass& pass) const {
        team.run(count(), [&](std::size_t i, std::size_t) {
            const std::span<const std::size_t> bodies = branch(i);
            for (std::size_t k = bodies.size(); k-- > 0;) {
                visit(bodies[k]);
                if (k > 0) pass(bodies[k]);
            }
        });
        for (std::size_t k = trunk_and_roots_.size(); k-- > 0;) {
            const std::size_t b = trunk_and_roots_[k];
            if (is_root_[b] == 0) visit(b);
            pass(b);
        }
    }

    /// Nodes of the elimination that hold a body, ascending: first the joint to its parent.
    std::span<const std::size_t> nodes_of(std::size_t body) const {
        return std::span(nodes_).subspan(first_node_[body], first_node_[body + 1] - first_node_[body]);
    }

  private:
    std::size_t count() const { return first_.size() - 1; }
    std::span<const std::size_t> branch(std::size_t i) const {
        return std::span(bodies_).subspan(first_[i], first_[i + 1] - first_[i]);
    }
    void cut(std::span<const Body> bodies);
    void list_nodes(const JointElimination& elimination, std::size_t bodies);

    std::uint64_t stamp_ = 0;                   // of the elimination's pattern
    std::vector<std::size_t> bodies_;           // branch by branch, each ascending
    std::vector<std::size_t> first_{0};         // in these, by branch, and the end
    std::vector<std::size_t> trunk_;            // bodies in no branch, ascending
    std::vector<std::size_t> trunk_and_roots_;  // the same with the first body of each branch, ascending
    std::vector<char> is_root_;                 // by body: the first of a branch
    std::vector<std::size_t> nodes_;            // body by body
    std::vector<std::size_t> first_node_;       // in these, by body, and the end
    // buffers, by body
    std::vector<std::size_t> size_, next_;
    std::vector<int> branch_of_;
};

}  // namespace roboss
