// Walks over the elements of a COLLADA file as assimp does: by name, and deep.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "xml/source_file.h"

namespace roboss::collada {

using Node = pugi::xml_node;

inline bool is(Node node, std::initializer_list<std::string_view> names) {
    return std::ranges::find(names, std::string_view(node.name())) != names.end();
}

/// Every element below `top`, parents before their children; without recursion.
template <class Take>
void each_below(Node top, const Take& take) {
    Node node = top.first_child();
    while (node) {
        if (node.type() == pugi::node_element) take(node);
        if (node.first_child()) {
            node = node.first_child();
            continue;
        }
        while (node != top && !node.next_sibling()) node = node.parent();
        if (node == top) return;
        node = node.next_sibling();
    }
}

}  // namespace roboss::collada
