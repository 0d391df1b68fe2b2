// See include_changes.h. A change of a part of a model that the included file includes in turn is handed on
// to that <include>.
#include "sdf/include_changes.h"

#include <cstring>
#include <optional>
#include <sstream>
#include <string_view>

#include "sdf/sdf_text.h"

namespace roboss::sdf_import {
namespace {

constexpr const char* kParams = "experimental:params";

bool is_change(pugi::xml_node node) {
    return std::strcmp(node.name(), "plugin") == 0 || std::strcmp(node.name(), kParams) == 0;
}

/// "inner" of the id "outer::inner"; nullopt: the id does not begin with the name.
std::optional<std::string> behind(const std::string& id, const std::string& name) {
    if (name.empty() || !id.starts_with(name + "::")) return std::nullopt;
    return id.substr(name.size() + 2);
}

/// The element with this id, and this tag if there is one, under `parent`.
pugi::xml_node find_id(pugi::xml_node parent, const std::string& id, std::string_view tag) {
    for (const auto child : parent.children()) {
        const std::string name = child.attribute("name").value();
        if (!name.empty() && id == name && (tag.empty() || tag == child.name())) return child;
        if (const auto rest = behind(id, name))
            if (const auto found = find_id(child, *rest, tag)) return found;
    }
    return {};
}

/// The child that a change means: of the same tag, and name if it has one.
pugi::xml_node counterpart(pugi::xml_node parent, pugi::xml_node change) {
    if (const auto name = change.attribute("name"))
        return parent.find_child_by_attribute(change.name(), "name", name.value());
    return parent.child(change.name());
}

/// The <include> of `copy` that stands for that one of the original.
pugi::xml_node same_include(pugi::xml_node copy, pugi::xml_node original) {
    const auto text = [](pugi::xml_node include, const char* child) {
        return std::string(include.child(child).text().get());
    };
    for (const auto include : copy.children("include"))
        if (text(include, "uri") == text(original, "uri") && text(include, "name") == text(original, "name"))
            return include;
    return {};
}

bool has_elements(pugi::xml_node node) {
    for (const auto child : node.children())
        if (child.type() == pugi::node_element) return true;
    return false;
}

class Changer {
  public:
    Changer(SdfText& out, const Element& original, const SourceFile& source, const FindModel& find,
            Diagnostics& diagnostics)
        : out_(out), original_(original), source_(source), find_(find), diagnostics_(diagnostics) {}

    void apply(pugi::xml_node change, pugi::xml_node model) {
        const std::string id = change.attribute("element_id").value(), action = action_of(change);
        if (!change.attribute("element_id")) return wrong(change, "has no element_id");
        if (action == "add") return add(change, id.empty() ? model : find_id(model, id, ""), model, id);
        const auto target = find_id(model, id, change.name());
        if (!target) return hand_on(change, model, id);
        if (!action.empty()) return act(action, change, target);
        for (const auto child : change.children())
            if (child.type() == pugi::node_element) act_on_child(child, target);
    }

  private:
    static std::string action_of(pugi::xml_node change) { return change.attribute("action").value(); }

    void wrong(pugi::xml_node change, const std::string& what) {
        diagnostics_.error(
            source_.where(change), "include-params",
            "<" + std::string(change.name()) + "> in <experimental:params> " + what,
            "Write element_id=\"PART::INNER\" of an element that the included model has, and action "
            "add, modify, remove or replace.");
    }

    void act(const std::string& action, pugi::xml_node change, pugi::xml_node target) {
        if (action == "modify") return modify(change, target);
        if (action == "remove") return remove(change, target);
        if (action == "replace") return replace(change, target);
        wrong(change, "has the action '" + action + "', which is not known");
    }

    void act_on_child(pugi::xml_node change, pugi::xml_node parent) {
        const std::string action = action_of(change);
        if (action == "add") {
            insert(change, parent);
            return;
        }
        auto target = counterpart(parent, change);
        if (!target && action == "modify") target = parent.child(change.name());  // its name is what changes
        if (!target) return wrong(change, "has no counterpart in <" + std::string(parent.name()) + ">");
        act(action, change, target);
    }

    void add(pugi::xml_node change, pugi::xml_node parent, pugi::xml_node model, const std::string& id) {
        const std::string name = change.attribute("name").value();
        if (!parent) return hand_on(change, model, id);
        if (name.empty()) return wrong(change, "adds an element without a name");
        if (std::strcmp(change.name(), "plugin") != 0 && counterpart(parent, change))
            return wrong(change, "adds '" + name + "', which is there already");
        insert(change, parent);
    }

    pugi::xml_node insert(pugi::xml_node change, pugi::xml_node parent) {
        auto added = out_.copy(parent, {&source_, change});
        added.remove_attribute("element_id");
        added.remove_attribute("action");
        return added;
    }

    void modify(pugi::xml_node change, pugi::xml_node target) {
        for (const auto attribute : change.attributes()) {
            if (std::strcmp(attribute.name(), "element_id") == 0 ||
                std::strcmp(attribute.name(), "action") == 0)
                continue;
            target.remove_attribute(attribute.name());
            target.append_attribute(attribute.name()) = attribute.value();
        }
        out_.place(target, {&source_, change});
        if (!has_elements(change)) {
            if (!has_elements(target)) target.text() = change.text().get();
            return;
        }
        for (const auto child : change.children()) {
            if (child.type() != pugi::node_element) continue;
            auto part = counterpart(target, child);
            if (!part) part = target.child(child.name());
            if (part)
                modify(child, part);
            else
                wrong(child, "has no counterpart in <" + std::string(target.name()) + ">");
        }
    }

    void remove(pugi::xml_node change, pugi::xml_node target) {
        if (!has_elements(change)) {
            target.parent().remove_child(target);
            return;
        }
        for (const auto child : change.children()) {
            if (child.type() != pugi::node_element) continue;
            if (const auto part = counterpart(target, child))
                target.remove_child(part);
            else
                wrong(child, "has no counterpart in <" + std::string(target.name()) + ">");
        }
    }

    void replace(pugi::xml_node change, pugi::xml_node target) {
        if (target.attribute("name") && !change.attribute("name"))
            return wrong(change, "replaces an element by one without a name");
        auto parent = target.parent();
        parent.insert_move_after(insert(change, parent), target);
        parent.remove_child(target);
    }

    /// To the <include> of the model that has the part.
    void hand_on(pugi::xml_node change, pugi::xml_node model, const std::string& id) {
        for (const auto node : original_.node.children("include")) {
            const Element written{original_.source, node};
            const std::string name = written.child("name") ? written.text("name") : find_(written).name();
            const auto rest = id == name ? std::optional<std::string>("") : behind(id, name);
            auto include = same_include(model, node);
            if (!rest || name.empty() || !include) continue;
            auto params = include.child(kParams);
            if (!params) params = include.append_child(kParams);
            out_.copy(params, {&source_, change}).attribute("element_id") = rest->c_str();
            return;
        }
        wrong(change, "has the element_id '" + id + "', which the included model does not have");
    }

    SdfText& out_;
    const Element& original_;   // the model before the changes
    const SourceFile& source_;  // of the changes
    const FindModel& find_;
    Diagnostics& diagnostics_;
};

}  // namespace

std::string changes_in(const Element& include) {
    std::ostringstream text;
    for (const auto node : include.node.children())
        if (is_change(node)) node.print(text, "", pugi::format_raw);
    return text.str();
}

std::unique_ptr<SourceFile> changed_file(const Element& model, const Element& include, const FindModel& find,
                                         Diagnostics& diagnostics) {
    SdfText out(*model.source);
    auto sdf = out.add({}, "sdf", model.source->root());
    for (const auto attribute : model.source->root().attributes()) sdf.append_copy(attribute);
    const auto copy = out.copy(sdf, model.node);
    const std::size_t first = diagnostics.items().size();
    Changer changer(out, model, *include.source, find, diagnostics);
    for (const auto node : include.node.children()) {
        if (std::strcmp(node.name(), "plugin") == 0) out.copy(copy, {include.source, node});
        if (std::strcmp(node.name(), kParams) != 0) continue;
        for (const auto change : node.children())
            if (change.type() == pugi::node_element) changer.apply(change, copy);
    }
    if (diagnostics.refuses_since(first)) return nullptr;
    return out.read(diagnostics);
}

}  // namespace roboss::sdf_import
