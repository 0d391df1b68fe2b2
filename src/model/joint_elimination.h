// The joints of a robot with many loops as a graph, and the order in which their reactions are eliminated.
//
// With every body for itself, J M^-1 J^T over the conditions of *all* joints, of the tree and of the loops
// alike, is sparse: two joints are coupled only where they hold the same body (Baraff 1996, Linear-time
// dynamics using Lagrange multipliers). Its factor costs what the joints of a cut through the mechanism cost,
// where the same matrix of the loops alone, in the coordinates of the tree, is full.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/block_pattern.h"

namespace roboss {

struct RobotType;

struct JointElimination {
    /// A joint. Joints of the tree join body B to its parent A; node b is the joint of body b, then come the
    /// loops.
    struct Node {
        int body_a = -1, body_b = -1;  // in RobotType::bodies; -1: the fixed base
        int loop = -1;                 // in RobotType::loops; -1: of the tree
    };
    /// Two joints, or one and itself, at the same body; `p` is eliminated first.
    struct Coupling {
        int body = 0;
        int p = 0, q = 0;  // in `nodes`
    };

    std::vector<Node> nodes;  // none: the robot is better off without
    BlockPattern pattern;     // of these

    bool empty() const { return nodes.empty(); }
    /// Those of which the joint at a position of the pattern is the first.
    std::span<const Coupling> couplings_at(std::size_t position) const {
        return std::span(couplings).subspan(coupling_first[position],
                                            coupling_first[position + 1] - coupling_first[position]);
    }

    std::vector<Coupling> couplings;          // by the position of p
    std::vector<std::size_t> coupling_first;  // by position, and the end
};

/// Of a robot with many loops and nothing but rigid bodies and joints; of another type empty.
JointElimination joint_elimination(const RobotType& type);

}  // namespace roboss
