// <roboss:surface_velocity> in a link or a collision: a surface that moves along itself.
#include <cstring>

#include "sdf/known_children.h"
#include "sdf/parameter_reader.h"

namespace roboss::sdf_import {
namespace {

constexpr const char* kElement = "roboss:surface_velocity";
constexpr const char* kMotionChildren[] = {"linear", "angular", "topic", "fixed"};

}  // namespace

bool takes_part_in_motion(const Element& collision) {
    const pugi::xml_node link = collision.node.parent();
    if (link.child(kElement) || collision.node.child(kElement)) return true;
    for (const auto other : link.children("collision"))
        if (other.child(kElement)) return false;
    return true;
}

void convert_surface_velocity(const Element& element, const std::string& scope, const Import& import,
                              ModelSpec& model) {
    pugi::xml_node link = element.node.parent();
    if (std::strcmp(link.name(), "collision") == 0) link = link.parent();
    report_unknown_children(element, kMotionChildren, import.diagnostics());
    SurfaceVelocitySpec spec;
    SurfaceVelocitySpec::parameters(ParameterReader{element, scope, import}, spec);
    spec.link = LinkNames{scope + link.attribute("name").value()};
    for (const OnboardSpec& other : model.onboard) {
        const auto* known = std::get_if<SurfaceVelocitySpec>(&other.parameters);
        if (known == nullptr || known->link != spec.link) continue;
        if (*known != spec)
            import.diagnostics().warning(
                element.where(), "second-surface-velocity",
                "link '" + spec.link.front() + "' has another <roboss:surface_velocity>; this one is ignored",
                "The surfaces of a link move alike: make a link for each.");
        return;
    }
    model.onboard.push_back({kElement, std::move(spec), element.where()});
}

}  // namespace roboss::sdf_import
