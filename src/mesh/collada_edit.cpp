// Attributes and elements are changed in the document that was checked: what assimp reads is written from it.
#include "mesh/collada_edit.h"

#include <algorithm>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/collada_elements.h"

namespace roboss {
namespace {

using collada::is;
using collada::Node;

void remove(Node top, std::initializer_list<std::string_view> names) {
    std::vector<Node> found;
    collada::each_below(top, [&](Node node) {
        if (is(node, names)) found.push_back(node);
    });
    // From the end: what lies inside goes before what holds it.
    for (auto node = found.rbegin(); node != found.rend(); ++node) node->parent().remove_child(*node);
}

/// The geometry behind each skin or morph, by the controller's id; both with "#" before them.
std::map<std::string, std::string> geometry_by_controller(Node collada) {
    std::map<std::string, std::string> sources;
    collada::each_below(collada, [&](Node node) {
        if (!is(node, {"skin", "morph"}) || !is(node.parent(), {"controller"})) return;
        const std::string id = node.parent().attribute("id").value();
        if (!id.empty()) sources.emplace("#" + id, node.attribute("source").value());
    });
    for (auto& [id, source] : sources)  // a skin of a morph
        for (std::size_t step = 0; step < sources.size() && sources.contains(source); ++step)
            source = sources.at(source);
    return sources;
}

void join_texts(Node collada) {
    std::vector<Node> split;
    const auto is_text = [](Node node) {
        return node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata;
    };
    collada::each_below(collada, [&](Node node) {
        const auto children = node.children();
        if (std::count_if(children.begin(), children.end(), is_text) > 1) split.push_back(node);
    });
    for (Node node : split) {
        std::string whole;
        for (Node child = node.first_child(); child;) {
            const Node next = child.next_sibling();
            if (is_text(child)) {
                whole += (whole.empty() ? "" : " ") + std::string(child.value());
                node.remove_child(child);
            }
            child = next;
        }
        node.prepend_child(pugi::node_pcdata).set_value(whole.c_str());
    }
}

}  // namespace

void put_collada_at_rest(Node collada) {
    const auto sources = geometry_by_controller(collada);
    remove(collada, {"library_animations", "library_animation_clips", "library_controllers", "hex"});
    collada::each_below(collada, [&](Node node) {
        if (!is(node, {"instance_controller"})) return;
        const auto found = sources.find(node.attribute("url").value());
        node.set_name("instance_geometry");
        node.remove_attribute("url");
        node.append_attribute("url") = found == sources.end() ? "#" : found->second.c_str();
    });
    join_texts(collada);
}

void drop_collada_pictures(Node collada) {
    remove(collada, {"texture", "newparam", "image", "library_images"});
}

}  // namespace roboss
