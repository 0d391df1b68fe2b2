// Links of a URDF as SDF: mass, shapes to touch and to see.
#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <set>
#include <string_view>

#include "sdf/element_reader.h"
#include "sdf/urdf_parts.h"

namespace roboss::sdf_import {
namespace {

/// A moment that is missing is 0 in URDF, but 1 in SDF.
void write_moments(const UrdfRobot& robot, pugi::xml_node inertial, SdfText& out, pugi::xml_node to) {
    const auto inertia = inertial.child("inertia");
    auto written = out.add(to, "inertia", inertia ? inertia : inertial);
    std::string missing;
    for (const char* moment : {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}) {
        out.add(written, moment, inertia ? inertia : inertial, inertia.attribute(moment).as_string("0"));
        if (has_mass(inertial.parent()) && !inertia.attribute(moment))
            missing += (missing.empty() ? "" : ", ") + std::string(moment);
    }
    if (missing.empty()) return;
    robot.diagnostics.warning(robot.where(inertial), "missing-inertia",
                              "of an <inertial> are missing " + missing + "; they are taken as 0",
                              "Write its moments.");
}

/// A link without <inertial> has no mass.
void write_inertial(const UrdfRobot& robot, pugi::xml_node link, SdfText& out, pugi::xml_node to) {
    const auto inertial = link.child("inertial");
    auto written = out.add(to, "inertial", inertial ? inertial : link);
    if (robot.masses_follow && link.child("collision")) {
        written.append_attribute("auto") = "true";
        return;
    }
    write_origin(robot, inertial, out, written);
    const auto mass = inertial.child("mass");
    out.add(written, "mass", mass ? mass : link,
            robot.masses_follow ? "0" : mass.attribute("value").as_string("0"));
    write_moments(robot, inertial ? inertial : link, out, written);
}

/// A shape and its sizes, which are attributes in URDF and elements in SDF.
struct UrdfShape {
    std::string_view name;
    std::initializer_list<const char*> sizes;
};
const UrdfShape kShapes[] = {
    {"box", {"size"}},
    {"sphere", {"radius"}},
    {"cylinder", {"radius", "length"}},
    {"capsule", {"radius", "length"}},
    {"cone", {"radius", "length"}},
    {"ellipsoid", {"radii"}},
    {"mesh", {"filename"}},
};

void write_mesh(pugi::xml_node mesh, SdfText& out, pugi::xml_node to) {
    auto written = out.add(to, "mesh", mesh);
    out.add(written, "uri", mesh, mesh.attribute("filename").value());
    if (const auto scale = mesh.attribute("scale")) out.add(written, "scale", mesh, scale.value());
}

/// Writes a shape; or says why it is none: "it has no length".
std::string write_shape(pugi::xml_node shape, SdfText& out, pugi::xml_node to) {
    const auto known = std::ranges::find(kShapes, std::string_view(shape.name()), &UrdfShape::name);
    if (known == std::end(kShapes)) return "is not known";
    std::string missing;
    for (const char* size : known->sizes)
        if (!shape.attribute(size)) missing += (missing.empty() ? "has no " : " and no ") + std::string(size);
    if (!missing.empty()) return missing;
    if (known->name == "mesh") return write_mesh(shape, out, to), "";
    auto written = out.add(to, shape.name(), shape);
    for (const char* size : known->sizes) out.add(written, size, shape, shape.attribute(size).value());
    return {};
}

/// A <collision> that says what it shall be and cannot be that is an error: the robot would pass through
/// things.
void report_shape(const UrdfRobot& robot, pugi::xml_node part, const std::string& faults) {
    const std::string kind = part.name();
    const bool fails = !faults.empty() && kind == "collision";
    robot.diagnostics.add(
        {fails ? Severity::kError : Severity::kWarning, robot.where(part), "urdf-shape",
         "<" + kind + "> of link '" + name_of(part.parent()) + "'" +
             (faults.empty() ? " has no shape" : faults) + (fails ? "" : "; it is left out"),
         "Write <geometry> with a <box size=\"...\">, <sphere radius=\"...\">, <cylinder>, <capsule> or "
         "<cone "
         "radius=\"...\" length=\"...\">, <ellipsoid radii=\"...\">, or <mesh filename=\"...\">.",
         false});
}

/// False, and a finding: there is no shape that can be used.
bool write_geometry(const UrdfRobot& robot, pugi::xml_node part, SdfText& out, pugi::xml_node to) {
    auto geometry = out.add(to, "geometry", part.child("geometry") ? part.child("geometry") : part);
    std::string faults;
    for (const auto shape : part.child("geometry").children()) {
        if (shape.type() != pugi::node_element) continue;
        const std::string fault = write_shape(shape, out, geometry);
        if (fault.empty()) return true;
        faults += (faults.empty() ? ": <" : ", <") + std::string(shape.name()) + "> " + fault;
    }
    report_shape(robot, part, faults);
    return false;
}

void write_material(const UrdfRobot& robot, pugi::xml_node visual, SdfText& out, pugi::xml_node to) {
    auto material = visual.child("material");
    if (!material.child("color")) {
        const auto named = robot.materials.find(name_of(material));
        if (named != robot.materials.end()) material = named->second;
    }
    const auto colour = material.child("color").attribute("rgba");
    if (!colour) return;
    auto written = out.add(to, "material", material);
    for (const char* part : {"ambient", "diffuse"}) out.add(written, part, material, colour.value());
}

/// A <collision> or <visual>, named as Gazebo names it: LINK_collision, LINK_collision_1 ...
void write_part(const UrdfRobot& robot, pugi::xml_node part, std::set<std::string>& names, SdfText& out,
                pugi::xml_node to) {
    const std::string link = name_of(part.parent()), kind = part.name();
    const std::string base = name_of(part).empty() ? link + "_" + kind : name_of(part);
    std::string name = base;
    for (int k = 1; !names.insert(kind + " " + name).second; ++k) name = base + "_" + std::to_string(k);
    auto written = out.add(to, part.name(), part);
    written.append_attribute("name") = name.c_str();
    write_origin(robot, part, out, written);
    if (!write_geometry(robot, part, out, written)) {
        to.remove_child(written);
    } else if (kind == "collision") {
        extend_collision(robot, link, out, written);
    } else if (!extend_visual(robot, link, out, written)) {
        write_material(robot, part, out, written);
    }
}

/// Where the joint that carries it puts the link.
void place_link(const UrdfRobot& robot, pugi::xml_node link, SdfText& out, pugi::xml_node to) {
    const auto carrier = robot.carrier_of(name_of(link));
    if (!carrier) return;
    const std::string parent = parent_of(carrier);
    const bool stands = parent == "world" || !robot.find_link(parent) || robot.is_left_out(parent);
    if (type_of(carrier) == "floating" || std::string_view(to.name()) == "frame")
        return write_origin(robot, carrier, out, to, stands ? "__model__" : parent);
    auto pose = out.add(to, "pose", link, "0 0 0 0 0 0");
    pose.append_attribute("relative_to") = robot.sdf_name_of(carrier).c_str();
}

}  // namespace

void write_link(const UrdfRobot& robot, pugi::xml_node link, SdfText& out, pugi::xml_node model) {
    const std::string name = name_of(link);
    const bool is_frame = robot.is_frame(name);
    auto written = out.add(model, is_frame ? "frame" : "link", link);
    written.append_attribute("name") = name.c_str();
    if (is_frame) written.append_attribute("attached_to") = parent_of(robot.carrier_of(name)).c_str();
    place_link(robot, link, out, written);
    if (is_frame) return;
    write_inertial(robot, link, out, written);
    std::set<std::string> names;
    for (const auto part : link.children()) {
        const std::string_view kind = part.name();
        if (kind == "collision" || kind == "visual") write_part(robot, part, names, out, written);
    }
    extend_link(robot, name, out, written);
}

}  // namespace roboss::sdf_import
