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

}  // namespace

bool is_foreign(const std::string& name) {
    return name.find(':') != std::string::npos && name.rfind("roboss:", 0) != 0;
}

void report_foreign(const Element& element, Diagnostics& diagnostics) {
    diagnostics.note(element.where(), "foreign-element",
                     "<" + std::string(element.node.name()) + "> in <" + element.node.parent().name() +
                         "> is not for RoBOSS and is ignored");
}

void report_unknown_children(const Element& block, std::span<const char* const> known,
                             Diagnostics& diagnostics) {
    for (const auto node : block.node.children()) {
        const std::string name = node.name();
        if (node.type() != pugi::node_element) continue;
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        if (is_foreign(name))
            report_foreign({block.source, node}, diagnostics);
        else
            diagnostics.warning(block.source->where(node), "unknown-element",
                                "<" + name + "> in <" + block.node.name() + "> is not known and is ignored",
                                "Check the spelling and the place. Known: " + listed(known) + ".");
    }
}

}  // namespace roboss::sdf_import
