// The table of elements that have no effect, and the walk that finds them.
#include "sdf/ignored_elements.h"

#include <cstring>

#include "sdf/element_reader.h"

namespace roboss::sdf_import {
namespace {

struct ElementWithoutEffect {
    const char* parent;
    const char* name;
    const char* except;  // type of joint that does read it
    Severity severity;
    const char* why;
    const char* remedy;
};

constexpr Severity kNote = Severity::kNote, kWarning = Severity::kWarning;

constexpr ElementWithoutEffect kIgnored[] = {
    {"link", "velocity_decay", "", kWarning, "bodies lose speed by the air and at joints only",
     "Write <roboss:drag><linear> for a force against the velocity, or <damping> at the joints."},
    {"link", "must_be_base_link", "", kNote, "the tree of joints shows which link is the base", ""},
    {"link", "battery", "", kNote, "motors are not fed by batteries", ""},
    {"link", "projector", "", kNote, "projectors are not simulated", ""},
    {"link", "audio_source", "", kNote, "sound is not simulated", ""},
    {"link", "audio_sink", "", kNote, "sound is not simulated", ""},
    {"link", "particle_emitter", "", kNote, "particles are not simulated", ""},
    {"contact", "collide_without_contact_bitmask", "", kNote, "shapes that meet by their bitmasks do collide",
     "Give the shape a <collide_bitmask> of 0 to keep it from colliding."},
    {"metal", "environment_map", "", kNote, "the viewer has its own sky", ""},
    {"metal", "ambient_occlusion_map", "", kNote, "it is not drawn", ""},
    {"metal", "emissive_map", "", kNote, "nothing is drawn as if it shone", ""},
    {"metal", "light_map", "", kNote, "light is drawn as it falls", ""},
    {"specular", "specular_map", "", kNote, "only colour and normals of <specular> are drawn",
     "Write <metal>."},
    {"specular", "glossiness_map", "", kNote, "only colour and normals of <specular> are drawn",
     "Write <metal>."},
    {"inertial", "auto_inertia_params", "", kWarning, "parameters of a mesh's automatic inertia are not read",
     "Write the link's <mass> and <inertia>."},
    {"collision", "auto_inertia_params", "", kWarning,
     "parameters of a mesh's automatic inertia are not read", "Write the link's <mass> and <inertia>."},
    {"model", "gripper", "", kWarning, "what a hand holds, it holds by friction; nothing is attached to it",
     "Close the fingers with an effort order, and give them friction."},
    {"joint", "thread_pitch", "screw", kNote, "only a screw joint has a thread", "Write type=\"screw\"."},
    {"joint", "screw_thread_pitch", "screw", kNote, "only a screw joint has a thread",
     "Write type=\"screw\"."},
    {"joint", "gearbox_ratio", "gearbox", kNote, "only a gearbox joint has a ratio",
     "Write type=\"gearbox\", or <mimic> in the <axis>."},
    {"joint", "gearbox_reference_body", "gearbox", kNote, "only a gearbox joint has a reference body",
     "Write type=\"gearbox\", or <mimic> in the <axis>."},
};

/// Nothing in it but zeros.
bool says_zero(const pugi::xml_node& node) {
    for (const auto child : node.children()) {
        if (child.type() == pugi::node_element && !says_zero(child)) return false;
        if (child.type() != pugi::node_pcdata) continue;
        for (const std::string_view word : words_of(child.value()))
            if (word != "false" && parse_number(word) != 0.0) return false;
    }
    return node.attributes_begin() == node.attributes_end();
}

bool matches(const ElementWithoutEffect& ignored, const pugi::xml_node& node) {
    const pugi::xml_node parent = node.parent();
    return std::strcmp(node.name(), ignored.name) == 0 && std::strcmp(parent.name(), ignored.parent) == 0 &&
           (*ignored.except == '\0' || std::strcmp(parent.attribute("type").value(), ignored.except) != 0);
}

}  // namespace

void report_ignored_elements(const Element& model, Diagnostics& diagnostics) {
    for (const auto node : model.node.children()) {
        if (node.type() != pugi::node_element || std::strcmp(node.name(), "plugin") == 0) continue;
        const Element element{model.source, node};
        for (const ElementWithoutEffect& ignored : kIgnored) {
            if (!matches(ignored, node) || says_zero(node)) continue;
            const std::string message = "<" + std::string(ignored.name) + "> has no effect: " + ignored.why;
            if (ignored.severity == kWarning)
                diagnostics.warning(element.where(), "ignored-element", message, ignored.remedy);
            else
                diagnostics.note(element.where(), "ignored-element", message, ignored.remedy);
        }
        report_ignored_elements(element, diagnostics);
    }
}

}  // namespace roboss::sdf_import
