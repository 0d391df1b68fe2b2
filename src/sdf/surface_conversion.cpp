// <surface> and <max_contacts> of a collision. What is written and has no effect is reported.
#include <limits>

#include "sdf/conversion.h"

namespace roboss::sdf_import {
namespace {

constexpr double kRigid = 1e12;  // N/m: SDFormat's default kp, which means rigid

bool has_number_other_than(const Element& parent, const char* child, double usual, const Import& import) {
    return parent && parent.child(child) &&
           import.reader.number(parent, child, usual, Finite::kInfinityAllowed) != usual;
}

void no_effect(const Element& parent, const char* child, const std::string& why, const Import& import) {
    import.diagnostics().note(parent.child(child).where(), "surface-element",
                              "<" + std::string(child) + "> has no effect: " + why);
}

/// A negative coefficient is one without bound, as in Gazebo Classic.
double coefficient_of_friction(const Element& ode, const char* child, double usual, const Import& import) {
    const double mu = import.reader.number(ode, child, usual, Finite::kInfinityAllowed);
    return mu < 0 ? std::numeric_limits<double>::infinity() : mu;
}

void read_ode_friction(const Element& ode, const Import& import, SurfaceSpec& spec) {
    const ElementReader& reader = import.reader;
    spec.mu = coefficient_of_friction(ode, "mu", 1.0, import);
    spec.mu2 = coefficient_of_friction(ode, "mu2", spec.mu, import);
    spec.fdir1 = reader.vector(ode, "fdir1", {});
    for (const char* attribute : {"gz:expressed_in", "ignition:expressed_in"})
        if (const auto link = ode.child("fdir1").node.attribute(attribute)) spec.fdir1_link = link.value();
    for (const char* slip : {"slip1", "slip2"})
        if (has_number_other_than(ode, slip, 0, import))
            no_effect(ode, slip, "friction is exact Coulomb, nothing slips below its bound", import);
    if (spec.mu != spec.mu2 && norm(spec.fdir1) == 0) {
        import.diagnostics().note(ode.where(), "anisotropic-friction",
                                  "<mu> and <mu2> differ, but no <fdir1> says along which direction: <mu> "
                                  "counts in all directions",
                                  "Write <fdir1>, the direction of <mu> in the collision's frame.");
    }
}

/// What is written for the Bullet engine and is not the same as what counts here.
void report_bullet_friction(const Element& bullet, const SurfaceSpec& spec, const Import& import) {
    const bool differs = has_number_other_than(bullet, "friction", spec.mu, import) ||
                         has_number_other_than(bullet, "friction2", spec.mu2, import) ||
                         has_number_other_than(bullet, "rolling_friction", 1.0, import) ||
                         (bullet.child("fdir1") && import.reader.vector(bullet, "fdir1", {}) != spec.fdir1);
    if (!differs) return;
    import.diagnostics().note(bullet.where(), "bullet-friction",
                              "friction for the Bullet engine is ignored: <bullet> differs from what counts",
                              "Use <friction><ode><mu> and <roboss:rolling_friction> (in metres).");
}

void read_friction(const Element& friction, const Import& import, SurfaceSpec& spec) {
    const ElementReader& reader = import.reader;
    const Element ode = friction.child("ode");
    if (ode) read_ode_friction(ode, import, spec);
    if (const Element torsional = friction.child("torsional")) {
        spec.torsional_mu = reader.number(torsional, "coefficient", 1.0);
        const bool patch = reader.boolean(torsional, "use_patch_radius", true);
        (patch ? spec.torsional_radius : spec.torsional_surface_radius) =
            reader.number(torsional, patch ? "patch_radius" : "surface_radius", 0.0);
        const char* other = patch ? "surface_radius" : "patch_radius";
        if (has_number_other_than(torsional, other, 0, import))
            no_effect(torsional, other,
                      patch ? "the patch radius counts unless <use_patch_radius> is false"
                            : "<use_patch_radius> is false",
                      import);
        if (has_number_other_than(torsional.child("ode"), "slip", 0, import))
            no_effect(torsional.child("ode"), "slip", "torsional friction does not slip below its bound",
                      import);
    }
    report_bullet_friction(friction.child("bullet"), spec, import);
}

std::optional<unsigned> read_bitmask(const Element& contact, const char* name, const Import& import) {
    if (!contact.child(name)) return std::nullopt;
    const std::string text = contact.text(name);
    char* end = nullptr;
    const unsigned long mask = std::strtoul(text.c_str(), &end, 0);
    if (!text.empty() && end != nullptr && *end == '\0' && mask <= 0xFFFFFFFFul)
        return static_cast<unsigned>(mask);
    import.diagnostics().error(
        contact.child(name).where(), "bad-value",
        "<" + std::string(name) + "> is '" + text + "', which is not a number from 0 to 0xffffffff",
        "Write for instance 65535 or 0xffff.");
    return std::nullopt;
}

/// <kp> and <kd>, or the spring and damper that <soft_cfm> and <soft_erp> mean at the world's step (ODE
/// manual, "ERP and CFM as spring and damping constants").
void read_softness(const Element& ode, const Import& import, SurfaceSpec& spec) {
    const ElementReader& reader = import.reader;
    const double kp = reader.number(ode, "kp", kRigid, Finite::kInfinityAllowed);
    const double kd = reader.number(ode, "kd", 1.0, Finite::kInfinityAllowed);
    const double cfm = reader.number(ode, "soft_cfm", 0.0), erp = reader.number(ode, "soft_erp", 0.2);
    const bool damped = ode.child("kd") && kd != 1.0;
    if (!(kp > 0) || !(kd >= 0) || !(cfm >= 0) || !(erp >= 0 && erp <= 1)) {
        import.diagnostics().error(ode.where(), "bad-value",
                                   "a contact needs <kp> above 0, <kd> and <soft_cfm> of at least 0 and "
                                   "<soft_erp> from 0 to 1",
                                   "Leave them out for a rigid contact.");
    } else if (kp < kRigid) {
        spec.stiffness = kp;
        spec.damping = kd;
    } else if (cfm > 0) {
        if (erp == 0)
            return no_effect(ode, "soft_cfm", "with a <soft_erp> of 0 the contact would bear no load",
                             import);
        spec.stiffness = erp / (import.dt_s * cfm);
        spec.damping = (1.0 - erp) / cfm;
    } else if (ode.child("soft_erp") && erp != 0.2) {
        no_effect(ode, "soft_erp", "without <soft_cfm> the contact is rigid", import);
    }
    if (damped && kp >= kRigid)
        no_effect(ode, "kd", "without a <kp> below 1e12 the contact is rigid", import);
}

void read_ode_contact(const Element& ode, const Import& import, SurfaceSpec& spec) {
    const ElementReader& reader = import.reader;
    read_softness(ode, import, spec);
    // SDF's default of 0.01 m/s is slower than any fall: only a written one counts.
    spec.max_vel = reader.number(ode, "max_vel", -1.0, Finite::kInfinityAllowed);
    spec.min_depth = reader.number(ode, "min_depth", 0.0);
    if (spec.min_depth < 0) {
        import.diagnostics().error(ode.child("min_depth").where(), "bad-value", "<min_depth> is negative",
                                   "Write the penetration in m that may stay.");
        spec.min_depth = 0;
    }
    if (spec.stiffness > 0 && ode.child("min_depth"))
        no_effect(ode, "min_depth", "the contact's own spring bears its penetration", import);
}

void read_contact(const Element& contact, const Import& import, SurfaceSpec& spec) {
    spec.collide_bitmask = read_bitmask(contact, "collide_bitmask", import).value_or(spec.collide_bitmask);
    spec.category_bitmask = read_bitmask(contact, "category_bitmask", import).value_or(spec.collide_bitmask);
    if (const Element ode = contact.child("ode")) read_ode_contact(ode, import, spec);
    for (const char* name : {"bullet", "poissons_ratio", "elastic_modulus"})
        if (contact.child(name))
            no_effect(contact, name, "softness is read from <contact><ode><kp> and <kd>", import);
    if (import.reader.boolean(contact, "collide_without_contact", false)) {
        import.diagnostics().warning(contact.where(), "collide-without-contact",
                                     "<collide_without_contact> is ignored: the shape does collide",
                                     "Give it a <collide_bitmask> of 0 to keep it from colliding.");
    }
}

}  // namespace

SurfaceSpec convert_surface(const Element& collision, const Import& import) {
    SurfaceSpec spec;
    const Element surface = collision.child("surface");
    if (surface.node.child("friction")) read_friction(surface.child("friction"), import, spec);
    if (const Element bounce = surface.child("bounce")) {
        spec.restitution = import.reader.number(bounce, "restitution_coefficient", 0.0);
        // SDF's default threshold (100000 m/s) would switch every bounce off; only a written one counts.
        const double threshold = import.reader.number(bounce, "threshold", spec.bounce_threshold);
        spec.bounce_threshold = threshold;
    }
    if (surface.node.child("contact")) read_contact(surface.child("contact"), import, spec);
    if (surface.node.child("soft_contact")) {
        import.diagnostics().note(
            surface.where(), "soft-body",
            "<soft_contact> is ignored: bodies are rigid, only their contact can be soft",
            "Write <contact><ode><kp> and <kd>.");
    }
    if (spec.stiffness > 0 && spec.restitution > 0)
        no_effect(surface, "bounce", "a soft contact gives back what its <kd> leaves", import);
    spec.max_contacts = import.reader.integer(collision, "max_contacts", import.max_contacts);
    spec.rolling_mu = import.reader.number(collision, "roboss:rolling_friction", 0.0);
    spec.rolling_mu = import.reader.number(surface, "roboss:rolling_friction", spec.rolling_mu);
    return spec;
}

}  // namespace roboss::sdf_import
