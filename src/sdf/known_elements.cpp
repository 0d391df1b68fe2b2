// See known_elements.h. The rows follow the description of SDFormat 1.12 (sdformat.org/spec).
#include "sdf/known_elements.h"

#include <algorithm>
#include <cstring>
#include <string_view>

namespace roboss::sdf_import {
namespace {

/// Children and attributes that an element may have; names between blanks.
struct SdfElement {
    std::string_view name;
    std::string_view parent;  // empty: any
    std::string_view children;
    std::string_view attributes;
};

constexpr std::string_view kAxisHolds = "xyz dynamics limit mimic initial_position use_parent_model_frame";
constexpr std::string_view kRoundHolds = "radius length";

constexpr SdfElement kSdfElements[] = {
    {"model", "",
     "static self_collide allow_auto_disable enable_wind frame pose link joint plugin gripper include model "
     "model_state",
     "name namespace canonical_link placement_frame"},
    {"include", "", "uri name namespace pose static placement_frame plugin model_state", "merge"},
    {"frame", "", "pose", "name attached_to"},
    {"pose", "inertial", "", "rotation_format degrees"},
    {"pose", "", "", "relative_to rotation_format degrees frame"},
    {"link", "",
     "gravity enable_wind self_collide kinematic must_be_base_link velocity_decay pose inertial collision "
     "visual "
     "sensor projector audio_sink audio_source battery light particle_emitter",
     "name"},
    {"inertial", "", "mass density auto_inertia_params pose inertia fluid_added_mass", "auto"},
    {"inertia", "", "ixx ixy ixz iyy iyz izz", ""},
    {"fluid_added_mass", "", "xx xy xz xp xq xr yy yz yp yq yr zz zp zq zr pp pq pr qq qr rr", ""},
    {"collision", "", "laser_retro max_contacts density auto_inertia_params pose geometry surface", "name"},
    {"geometry", "", "empty box capsule cone cylinder ellipsoid heightmap image mesh plane polyline sphere",
     ""},
    {"box", "", "size", ""},
    {"capsule", "", kRoundHolds, ""},
    {"cone", "", kRoundHolds, ""},
    {"cylinder", "", kRoundHolds, ""},
    {"ellipsoid", "", "radii", ""},
    {"sphere", "", "radius", ""},
    {"plane", "", "normal size", ""},
    {"polyline", "", "point height", ""},
    {"image", "", "uri scale threshold height granularity", ""},
    {"mesh", "", "uri submesh scale convex_decomposition", "optimization"},
    {"submesh", "", "name center", ""},
    {"convex_decomposition", "", "max_convex_hulls voxel_resolution", ""},
    {"heightmap", "", "uri size pos texture blend use_terrain_paging sampling", ""},
    {"texture", "", "size diffuse normal", ""},
    {"blend", "", "min_height fade_dist", ""},
    {"surface", "", "bounce friction contact soft_contact", ""},
    {"bounce", "", "restitution_coefficient threshold", ""},
    {"friction", "surface", "torsional ode bullet", ""},
    {"torsional", "", "coefficient use_patch_radius patch_radius surface_radius ode", ""},
    {"ode", "torsional", "slip", ""},
    {"ode", "friction", "mu mu2 fdir1 slip1 slip2", ""},
    {"bullet", "friction", "friction friction2 fdir1 rolling_friction", ""},
    {"contact", "",
     "collide_without_contact collide_without_contact_bitmask collide_bitmask category_bitmask "
     "poissons_ratio "
     "elastic_modulus ode bullet",
     ""},
    {"ode", "contact", "soft_cfm soft_erp kp kd max_vel min_depth", ""},
    {"bullet", "contact", "soft_cfm soft_erp kp kd split_impulse split_impulse_penetration_threshold", ""},
    {"soft_contact", "", "dart", ""},
    {"dart", "", "bone_attachment stiffness damping flesh_mass_fraction", ""},
    {"joint", "",
     "parent child gearbox_ratio gearbox_reference_body thread_pitch screw_thread_pitch axis axis2 physics "
     "pose "
     "sensor",
     "name type"},
    {"axis", "", kAxisHolds, ""},
    {"axis2", "", kAxisHolds, ""},
    {"xyz", "", "", "expressed_in"},
    {"dynamics", "", "damping friction spring_reference spring_stiffness", ""},
    {"limit", "", "lower upper effort velocity stiffness dissipation", ""},
    {"mimic", "", "multiplier offset reference", "joint axis"},
};

/// Read, or reported, by others.
constexpr std::string_view kElsewhere =
    "visual sensor light plugin gripper physics projector audio_sink audio_source battery particle_emitter "
    "velocity_decay model_state auto_inertia_params";

bool is_among(std::string_view name, std::string_view names) {
    for (std::size_t at = names.find(name); at != names.npos; at = names.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        if ((at == 0 || names[at - 1] == ' ') && (end == names.size() || names[end] == ' ')) return true;
    }
    return false;
}

const SdfElement& known_of(pugi::xml_node node) {
    static constexpr SdfElement kLeaf{};
    const std::string_view parent = node.parent().name();
    const auto row = std::ranges::find_if(kSdfElements, [&](const SdfElement& known) {
        return known.name == node.name() && (known.parent.empty() || known.parent == parent);
    });
    return row == std::end(kSdfElements) ? kLeaf : *row;
}

bool has_namespace(const char* name) {
    return std::strchr(name, ':') != nullptr;
}

class ElementWalk {
  public:
    ElementWalk(const SourceFile& source, Diagnostics& diagnostics)
        : source_(source), diagnostics_(diagnostics), is_old_(version_of(source) < 107) {}

    void visit(pugi::xml_node node) const {
        const SdfElement& known = known_of(node);
        for (const auto attribute : node.attributes())
            if (*attribute.value() != '\0' && !is_known(attribute.name(), known.attributes, "frame"))
                report(node, "the attribute " + std::string(attribute.name()) + " of <" + node.name() + ">");
        for (const auto child : node.children()) {
            if (child.type() != pugi::node_element || has_namespace(child.name())) continue;
            if (!is_known(child.name(), known.children, "use_parent_model_frame") &&
                std::strcmp(child.name(), "plugin") != 0)
                report(child, "<" + std::string(child.name()) + "> in <" + node.name() + ">");
            else if (!is_among(child.name(), kElsewhere))
                visit(child);
        }
    }

  private:
    /// `old`: the name that went with SDFormat 1.7.
    bool is_known(const char* name, std::string_view names, const char* old) const {
        return has_namespace(name) || (is_among(name, names) && (is_old_ || std::strcmp(name, old) != 0));
    }

    void report(pugi::xml_node node, const std::string& what) const {
        diagnostics_.warning(source_.where(node), "unknown-element",
                             what + " is not known to SDFormat and is ignored",
                             "Check the spelling and the place.");
    }

    const SourceFile& source_;
    Diagnostics& diagnostics_;
    bool is_old_;
};

}  // namespace

void report_unknown_elements(const Element& element, Diagnostics& diagnostics) {
    ElementWalk(*element.source, diagnostics).visit(element.node);
}

}  // namespace roboss::sdf_import
