// Takes joints in the order of the file; the first to claim a child link has it.
#include "world/tree.h"

#include <unordered_map>

namespace roboss {

std::vector<bool> tree_joints(const ModelSpec& model) {
    std::unordered_map<std::string, std::string> parent_of;  // link to the link it hangs on ("": nothing yet)
    for (const LinkSpec& link : model.links) parent_of.emplace(link.name, "");
    const auto is_ancestor = [&](const std::string& link, std::string of) {
        while (!of.empty() && of != "world") {
            if (of == link) return true;
            of = parent_of.at(of);
        }
        return false;
    };
    std::vector<bool> result;
    for (const JointSpec& joint : model.joints) {
        const auto child = parent_of.find(joint.child);
        const bool known = child != parent_of.end() && (joint.parent == "world" || parent_of.count(joint.parent) > 0);
        const bool taken = known && child->second.empty() && !is_ancestor(joint.child, joint.parent);
        if (taken) child->second = joint.parent;
        result.push_back(taken);
    }
    return result;
}

}  // namespace roboss
