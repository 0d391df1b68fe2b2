// Compares XML trees element by element; the hash only chooses whom to compare with.
#include "sdf/same_model.h"

#include <cstring>

#include "core/hash.h"

namespace roboss::sdf_import {
namespace {

bool top_attribute_counts(const char* name) {
    return std::strcmp(name, "name") != 0 && std::strcmp(name, "placement_frame") != 0;
}

bool top_child_counts(pugi::xml_node child) {
    return child.type() != pugi::node_element || std::strcmp(child.name(), "pose") != 0;
}

void hash_tree(pugi::xml_node node, bool top, Hash& hash) {
    hash.add(std::string_view(node.type() == pugi::node_element ? node.name() : node.value()));
    for (const auto attribute : node.attributes()) {
        if (top && !top_attribute_counts(attribute.name())) continue;
        hash.add(std::string_view(attribute.name()));
        hash.add(std::string_view(attribute.value()));
    }
    for (const auto child : node.children()) {
        if (!top || top_child_counts(child)) hash_tree(child, false, hash);
    }
    hash.add(std::uint64_t{1});  // closes the element
}

bool same_attributes(pugi::xml_node a, pugi::xml_node b, bool top) {
    const auto next = [&](pugi::xml_attribute x) {
        while (x && top && !top_attribute_counts(x.name())) x = x.next_attribute();
        return x;
    };
    auto x = next(a.first_attribute()), y = next(b.first_attribute());
    while (x && y) {
        if (std::strcmp(x.name(), y.name()) != 0 || std::strcmp(x.value(), y.value()) != 0) return false;
        x = next(x.next_attribute());
        y = next(y.next_attribute());
    }
    return !x && !y;
}

bool same_tree(pugi::xml_node a, pugi::xml_node b, bool top) {
    if (a.type() != b.type() || std::strcmp(a.name(), b.name()) != 0 ||
        std::strcmp(a.value(), b.value()) != 0)
        return false;
    if (!same_attributes(a, b, top)) return false;
    const auto next = [&](pugi::xml_node x) {
        while (x && top && !top_child_counts(x)) x = x.next_sibling();
        return x;
    };
    auto x = next(a.first_child()), y = next(b.first_child());
    while (x && y) {
        if (!same_tree(x, y, false)) return false;
        x = next(x.next_sibling());
        y = next(y.next_sibling());
    }
    return !x && !y;
}

}  // namespace

std::uint64_t model_hash(const Element& model) {
    Hash hash;
    hash_tree(model.node, true, hash);
    return hash.value();
}

bool same_model(const Element& a, const Element& b) {
    return a.source == b.source && same_tree(a.node, b.node, true);
}

}  // namespace roboss::sdf_import
