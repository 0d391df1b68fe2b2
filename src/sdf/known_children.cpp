// See known_children.h.
#include "sdf/known_children.h"

#include <algorithm>

namespace roboss::sdf_import {
namespace {

std::string listed(std::span<const char* const> names) {
    std::string all;
    for (const char* name : names) all += (all.empty() ? "<" : ", <") + std::string(name) + ">";
    return all;
}

bool is_foreign(const std::string& name) {
    return name.find(':') != std::string::npos && name.rfind("roboss:", 0) != 0;
}

}  // namespace

void report_unknown_children(const Element& block, std::span<const char* const> known,
                             Diagnostics& diagnostics) {
    for (const auto node : block.node.children()) {
        const std::string name = node.name();
        if (node.type() != pugi::node_element) continue;
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        const SourceLocation where = block.source->where(node);
        const std::string parent = block.node.name();
        if (is_foreign(name))
            diagnostics.note(where, "foreign-element", "<" + name + "> in <" + parent + "> is ignored");
        else
            diagnostics.warning(where, "unknown-element",
                                "<" + name + "> in <" + parent + "> is not known and is ignored",
                                "Check the spelling and the place. Known: " + listed(known) + ".");
    }
}

}  // namespace roboss::sdf_import
