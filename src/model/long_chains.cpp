// Chains of joints that are too long to be stepped.
#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "model/compile_type.h"

namespace roboss {

bool report_long_chains(const RobotType& type, const ModelSpec& spec, Diagnostics& diagnostics) {
    constexpr std::size_t kEntriesMost = 32'000'000;  // a chain of 8000
    std::vector<std::size_t> depth(type.dof_parent.size(), 1);
    std::size_t entries = 0, deepest = 0;
    for (std::size_t i = 0; i < depth.size(); ++i) {
        if (type.dof_parent[i] >= 0) depth[i] += depth[static_cast<std::size_t>(type.dof_parent[i])];
        entries += depth[i], deepest = std::max(deepest, depth[i]);
    }
    if (entries <= kEntriesMost) return true;
    diagnostics.error(spec.where, "chain-too-long",
                      "model '" + spec.name + "' has " + std::to_string(depth.size()) +
                          " degrees of freedom, up to " + std::to_string(deepest) +
                          " of them in one chain: its mass matrix would have " + std::to_string(entries) +
                          " entries, and at most " + std::to_string(kEntriesMost) + " can be stepped",
                      "Divide the chain into several models, or give it fewer joints.");
    return false;
}

}  // namespace roboss
