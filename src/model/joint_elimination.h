// The joints of a robot with many loops as a graph, and the order in which their reactions are eliminated.
//
// With every body for itself, J M^-1 J^T over the conditions of *all* joints, of the tree and of the loops
// alike, is sparse: two joints are coupled only where they hold the same body (Baraff 1996, Linear-time
// dynamics using Lagrange multipliers). Its factor costs what the joints of a cut through the mechanism cost,
// where the same matrix of the loops alone, in the coordinates of the tree, is full.
#pragma once

#include <cstddef>
#include <vector>

namespace roboss {

struct RobotType;

struct JointElimination {
    /// A joint, by the order of elimination. Joints of the tree join body B to its parent A.
    struct Node {
        int body_a = -1, body_b = -1;  // in RobotType::bodies; -1: the fixed base
        int loop = -1;                 // in RobotType::loops; -1: of the tree
        std::size_t first = 0,         // those that are coupled to it when it is eliminated:
            last = 0;                  // [first, last) of `ends`
    };
    /// Two joints, or one and itself, at the same body; `p` is eliminated first.
    struct Coupling {
        int body = 0;
        int p = 0, q = 0;  // in `nodes`
        int edge = -1;     // in `ends`, from p to q; -1: p is q
    };

    std::vector<Node> nodes;  // none: the robot is better off without
    std::vector<int> ends;    // in `nodes`; ascending for each node
    std::vector<Coupling> couplings;

    bool empty() const { return nodes.empty(); }
};

/// Of a robot with many loops and nothing but rigid bodies and joints; of another type empty.
JointElimination joint_elimination(const RobotType& type);

}  // namespace roboss
