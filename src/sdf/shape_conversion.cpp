// Geometry, surfaces, collisions and visuals.
#include <cstring>

#include "sdf/conversion.h"

namespace roboss::sdf_import {
namespace {

/// The shortest rotation that turns z into the unit vector n.
Quat from_z_to(const Vec3& n) {
    if (n.z < -1.0 + 1e-12) return {0, 1, 0, 0};
    return normalized(Quat{1.0 + n.z, -n.y, n.x, 0.0});
}

void read_plane(const Element& plane, const Import& import, GeometrySpec& spec, Pose& X) {
    const Vec3 normal = import.reader.vector(plane, "normal", {0, 0, 1});
    const double length = norm(normal);
    if (length < 1e-12) {
        import.diagnostics().error(plane.where(), "bad-value", "the <normal> of a plane has no length",
                                   "Write a direction, for instance 0 0 1.");
    } else {
        X.q = X.q * from_z_to(normal / length);
    }
    const auto words = words_of(plane.node.child("size").text().get());
    const auto x = words.size() == 2 ? parse_number(words[0]) : std::nullopt;
    const auto y = words.size() == 2 ? parse_number(words[1]) : std::nullopt;
    spec.size = {x.value_or(1), y.value_or(1), 0};
}

/// The file behind <uri>; a missing one is reported with the places searched.
void read_file(const Element& shape, const Import& import, GeometrySpec& spec) {
    const std::string uri = shape.text("uri");
    const Resolved found = import.paths.resolve(uri, shape.source->folder());
    spec.uri = found.path.value_or(uri);
    if (found.path) return;
    import.diagnostics().warning(
        shape.where(), "file-not-found",
        "the " + std::string(shape.node.name()) + " '" + uri + "' was not found; searched: " +
            (found.remote ? "Fuel's cache (nothing is fetched)" : list_of(found.searched)),
        "Give the folder that holds it with --path, or in GZ_SIM_RESOURCE_PATH.");
}

bool read_shape(const Element& shape, const Import& import, GeometrySpec& spec, Pose& X) {
    const ElementReader& reader = import.reader;
    const std::string kind = shape.node.name();
    spec.radius = reader.number(shape, "radius", 1);
    spec.length = reader.number(shape, "length", 1);
    if (kind == "box") {
        spec.kind = GeometryKind::kBox;
        spec.size = reader.vector(shape, "size", {1, 1, 1});
    } else if (kind == "sphere") {
        spec.kind = GeometryKind::kSphere;
    } else if (kind == "cylinder") {
        spec.kind = GeometryKind::kCylinder;
    } else if (kind == "capsule") {
        spec.kind = GeometryKind::kCapsule;
    } else if (kind == "ellipsoid") {
        spec.kind = GeometryKind::kEllipsoid;
        spec.size = reader.vector(shape, "radii", {1, 1, 1});
    } else if (kind == "plane") {
        spec.kind = GeometryKind::kPlane;
        read_plane(shape, import, spec, X);
    } else if (kind == "mesh") {
        spec.kind = GeometryKind::kMesh;
        spec.scale = reader.vector(shape, "scale", {1, 1, 1});
        read_file(shape, import, spec);
    } else if (kind == "heightmap") {
        spec.kind = GeometryKind::kHeightmap;
        spec.size = reader.vector(shape, "size", {1, 1, 1});
        read_file(shape, import, spec);
    } else if (kind == "polyline") {
        spec.kind = GeometryKind::kPolyline;
        spec.length = reader.number(shape, "height", 1);
    } else {
        return false;
    }
    return true;
}

bool collides(GeometryKind kind) {
    switch (kind) {
        case GeometryKind::kPlane:
        case GeometryKind::kBox:
        case GeometryKind::kSphere:
        case GeometryKind::kCylinder:
        case GeometryKind::kCapsule:
            return true;
        default:
            return false;
    }
}

/// The shape element of a <geometry>: its first child that is not of another namespace.
Element shape_of(const Element& geometry) {
    for (const auto node : geometry.node.children()) {
        if (node.type() == pugi::node_element && std::strchr(node.name(), ':') == nullptr)
            return {geometry.source, node};
    }
    return {};
}

void does_not_collide(const Element& shape, const Import& import) {
    import.diagnostics().warning(shape.where(), "shape-to-come",
                                 "shapes of kind <" + std::string(shape.node.name()) + "> do not collide yet",
                                 "Build the collision from planes, boxes, spheres, cylinders and capsules.");
}

bool has_number_other_than(const Element& parent, const char* child, double usual, const Import& import) {
    return parent && parent.child(child) &&
           import.reader.number(parent, child, usual, Finite::kInfinityAllowed) != usual;
}

void read_friction(const Element& friction, const Import& import, SurfaceSpec& spec) {
    const ElementReader& reader = import.reader;
    const Element ode = friction.child("ode");
    if (ode) {
        spec.mu = reader.number(ode, "mu", 1.0, Finite::kInfinityAllowed);
        spec.mu2 = reader.number(ode, "mu2", spec.mu, Finite::kInfinityAllowed);
        spec.fdir1 = reader.vector(ode, "fdir1", {});
        if (has_number_other_than(ode, "slip1", 0, import) ||
            has_number_other_than(ode, "slip2", 0, import)) {
            import.diagnostics().note(ode.where(), "slip",
                                      "<slip1> and <slip2> are ignored: friction is exact Coulomb");
        }
        if (spec.mu != spec.mu2) {
            import.diagnostics().note(
                ode.where(), "anisotropic-friction",
                "<mu> and <mu2> differ; friction that depends on the direction is still to come",
                "Give both the same value to say which one is meant.");
        }
    }
    const Element torsional = friction.child("torsional");
    if (torsional) {
        spec.torsional_mu = reader.number(torsional, "coefficient", 1.0);
        const double patch = reader.number(torsional, "patch_radius", 0.0);
        const double surface = reader.number(torsional, "surface_radius", 0.0);
        spec.torsional_radius = reader.boolean(torsional, "use_patch_radius", true) ? patch : surface;
    }
    const Element bullet = friction.child("bullet");
    if (has_number_other_than(bullet, "rolling_friction", 1.0, import) && !ode) {
        import.diagnostics().note(bullet.where(), "bullet-friction",
                                  "friction for the Bullet engine is ignored",
                                  "Use <friction><ode><mu> and <roboss:rolling_friction> (in metres).");
    }
}

void read_contact(const Element& contact, const Import& import, SurfaceSpec& spec) {
    if (contact.child("collide_bitmask")) {
        const std::string text = contact.text("collide_bitmask");
        char* end = nullptr;
        const unsigned long mask = std::strtoul(text.c_str(), &end, 0);
        if (text.empty() || end == nullptr || *end != '\0' || mask > 0xFFFFul) {
            import.diagnostics().error(
                contact.child("collide_bitmask").where(), "bad-value",
                "<collide_bitmask> is '" + text + "', which is not a number from 0 to 65535",
                "Write for instance 65535 or 0xffff.");
        } else {
            spec.collide_bitmask = static_cast<unsigned>(mask);
        }
    }
    const Element ode = contact.child("ode");
    if (has_number_other_than(ode, "kp", 1e12, import) || has_number_other_than(ode, "soft_cfm", 0, import)) {
        import.diagnostics().note(
            ode.where(), "softness",
            "soft contacts (<kp>, <kd>, <soft_cfm>) are still to come; contacts are rigid");
    }
    if (import.reader.boolean(contact, "collide_without_contact", false)) {
        import.diagnostics().warning(contact.where(), "collide-without-contact",
                                     "<collide_without_contact> is ignored: the shape does collide",
                                     "Give it a <collide_bitmask> of 0 to keep it from colliding.");
    }
}

}  // namespace

std::optional<GeometrySpec> convert_geometry(const Element& geometry, const Import& import, Pose& X) {
    const Element shape = shape_of(geometry);
    GeometrySpec spec;
    if (!shape || !read_shape(shape, import, spec, X)) return std::nullopt;
    return spec;
}

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
        import.diagnostics().note(surface.where(), "softness",
                                  "<soft_contact> is still to come; contacts are rigid");
    }
    spec.rolling_mu = import.reader.number(collision, "roboss:rolling_friction", 0.0);
    spec.rolling_mu = import.reader.number(surface, "roboss:rolling_friction", spec.rolling_mu);
    return spec;
}

std::optional<CollisionSpec> convert_collision(const Element& collision, const Pose& X_LS,
                                               const Import& import) {
    CollisionSpec spec;
    spec.name = collision.name();
    spec.where = collision.where();
    spec.X_LS = X_LS;
    const Element geometry = collision.child("geometry");
    const Element shape = shape_of(geometry);
    const auto known = convert_geometry(geometry, import, spec.X_LS);
    if (!known) {
        if (!shape) {
            import.diagnostics().warning(collision.where(), "no-geometry",
                                         "collision '" + spec.name + "' has no shape",
                                         "Give it a <geometry>, or remove it.");
        } else if (std::strcmp(shape.node.name(), "empty") != 0) {
            does_not_collide(shape, import);
        }
        return std::nullopt;
    }
    spec.geometry = *known;
    if (!collides(known->kind)) does_not_collide(shape, import);
    spec.surface = convert_surface(collision, import);
    return spec;
}

VisualSpec convert_visual(const Element& visual, const Pose& X_LV, const Import& import) {
    VisualSpec spec;
    spec.name = visual.name();
    spec.X_LV = X_LV;
    if (const auto known = convert_geometry(visual.child("geometry"), import, spec.X_LV))
        spec.geometry = *known;
    const Element material = visual.child("material");
    for (const char* colour : {"diffuse", "ambient"}) {
        const auto words = words_of(material.node.child(colour).text().get());
        if (words.size() < 3) continue;
        spec.rgb = {parse_number(words[0]).value_or(spec.rgb.x), parse_number(words[1]).value_or(spec.rgb.y),
                    parse_number(words[2]).value_or(spec.rgb.z)};
        if (words.size() > 3) spec.alpha = parse_number(words[3]).value_or(1.0);
        break;
    }
    spec.alpha *= 1.0 - import.reader.number(visual, "transparency", 0.0);
    return spec;
}

}  // namespace roboss::sdf_import
