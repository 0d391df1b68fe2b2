// The joint graph of one SDF model, its connected parts, and the spanning tree that the dynamics walk: which
// joints are cut where joints close kinematic loops.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "world/world.h"

namespace roboss {

/// An edge as the tree walks it; `reversed`: from the SDF child to the SDF parent.
struct JointEdge {
    std::size_t joint = 0;
    std::size_t to = 0;
    bool reversed = false;
};

/// The nodes that a joint connects.
struct JointEnds {
    std::size_t parent = 0, child = 0;
};

/// A node is a link; node links.size() is the world.
struct JointGraph {
    std::vector<std::optional<JointEnds>> ends;        // of all joints; none: it names no such link
    std::vector<std::vector<JointEdge>> edges;         // of the spanning forest, joints in file order
    std::vector<std::size_t> cut;                      // joints that would close a loop, ascending
    std::vector<std::vector<std::size_t>> neighbours;  // by any joint, cut ones too
    std::vector<char> is_child;                        // a link that some joint names as its child
    std::size_t world = 0;
};

/// Of the joints around a loop the one is cut that has least to do: fixed joints never where another one can
/// be, joints that others follow or sensors read hardly, then those with motor gains, limits, friction,
/// armature or a start position, then those with damping or a spring, then passive ones; of equals the last
/// in the file.
JointGraph build_joint_graph(const ModelSpec& spec);

/// The links of one robot, ascending.
struct LinkedPart {
    std::vector<std::size_t> links;
    bool fixed_base = false;  // a joint connects it with the world
};

/// The parts that joints connect other than through the world, ordered by their first links. Parts with fixed
/// bases become one where two tied links are in different ones.
std::vector<LinkedPart> connected_parts(const JointGraph& graph,
                                        const std::vector<std::pair<std::size_t, std::size_t>>& tied);

}  // namespace roboss
