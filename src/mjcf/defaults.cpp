// See defaults.h.
#include "mjcf/defaults.h"

#include <algorithm>
#include <cstring>

#include "core/similar.h"

namespace roboss::mjcf {
namespace {

/// Name of the elements that hold an element's defaults.
const char* default_name(const char* name) {
    constexpr const char* kEqualities[] = {"connect", "weld", "flex"};
    for (const char* equality : kEqualities)
        if (std::strcmp(name, equality) == 0) return "equality";
    if (std::strcmp(name, "spatial") == 0 || std::strcmp(name, "fixed") == 0) return "tendon";
    return name;
}

}  // namespace

Defaults::Defaults(const Document& document, Diagnostics& diagnostics)
    : document_(document), diagnostics_(diagnostics) {
    classes_[main_] = {};
    for (const Element& section : document.children(document.root(), "default")) read(section, "", true);
}

void Defaults::read(const Element& section, const std::string& parent, bool is_outermost) {
    std::string name = section.node.attribute("class").value();
    if (is_outermost) {
        if (!name.empty() && name != main_ && classes_[main_].sections.empty()) {
            classes_.erase(main_);
            main_ = name;
        }
        name = main_;
    } else if (name.empty()) {
        diagnostics_.error(section.where(), "no-class", "a <default> within another one has no class",
                           "Write its class attribute.");
        return;
    } else if (classes_.count(name) > 0) {
        diagnostics_.error(section.where(), "duplicate-class", "there are two default classes '" + name + "'",
                           "Give each a name of its own.");
        return;
    }
    Class& made = classes_[name];
    made.parent = parent;
    made.sections.push_back(section);
    for (const Element& child : document_.children(section, "default")) read(child, name, false);
}

const Defaults::Class* Defaults::class_of(const Element& element, const std::string& childclass) const {
    std::string name = element.node.attribute("class").value();
    if (name.empty()) name = childclass.empty() ? main_ : childclass;
    const auto found = classes_.find(name);
    if (found != classes_.end()) return &found->second;
    std::vector<std::string> names;
    for (const auto& [known, unused] : classes_) names.push_back(known);
    diagnostics_.error(element.where(), "unknown-class",
                       "<" + std::string(element.node.name()) + "> names the default class '" + name +
                           "', which the file does not have",
                       did_you_mean(name, names, "Write <default class=\"" + name + "\">."));
    return &classes_.at(main_);
}

Attributes Defaults::of(const Element& element, const std::string& childclass) const {
    std::vector<Element> chain{element};
    const char* const wanted = default_name(element.node.name());
    for (const Class* at = class_of(element, childclass); at != nullptr;) {
        for (auto section = at->sections.rbegin(); section != at->sections.rend(); ++section) {
            const std::vector<Element> found = document_.children(*section, wanted);
            chain.insert(chain.end(), found.rbegin(), found.rend());
        }
        at = at->parent.empty() ? nullptr : &classes_.at(at->parent);
    }
    return {std::move(chain), diagnostics_};
}

std::vector<Element> Defaults::actuator_defaults(const Element& element) const {
    constexpr const char* kActuators[] = {"general",     "motor",       "position", "velocity",
                                          "intvelocity", "damper",      "cylinder", "muscle",
                                          "adhesion",    "orientation", "pid",      "dcmotor"};
    std::vector<std::vector<Element>> by_class;
    for (const Class* at = class_of(element, ""); at != nullptr;) {
        std::vector<Element>& found = by_class.emplace_back();
        for (const Element& section : at->sections)
            for (const Element& child : document_.children(section))
                if (std::ranges::any_of(kActuators, [&](const char* name) {
                        return std::strcmp(child.node.name(), name) == 0;
                    }))
                    found.push_back(child);
        at = at->parent.empty() ? nullptr : &classes_.at(at->parent);
    }
    std::vector<Element> all;
    for (auto found = by_class.rbegin(); found != by_class.rend(); ++found)
        all.insert(all.end(), found->begin(), found->end());
    return all;
}

}  // namespace roboss::mjcf
