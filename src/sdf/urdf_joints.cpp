// Joints of a URDF as SDF.
#include "sdf/element_reader.h"
#include "sdf/urdf_parts.h"
#include "world/joint_type.h"

namespace roboss::sdf_import {
namespace {

/// SDF's type for that of a URDF joint; empty: it is not known. URDF's "spherical" is PyBullet's and
/// MuJoCo's.
std::string sdf_type_of(const std::string& type) {
    if (type == "spherical") return "ball";
    const auto kind = find_joint_type(type);
    if (!kind) return {};
    return joint_type(*kind).is_extension ? "continuous" : type;
}

bool has_one_axis(const std::string& type) {
    return type == "revolute" || type == "continuous" || type == "prismatic";
}

void write_limit(const UrdfRobot& robot, pugi::xml_node joint, SdfText& out, pugi::xml_node axis) {
    const auto limit = joint.child("limit");
    const std::string name = name_of(joint), type = type_of(joint);
    if (!limit && type == "continuous") return;
    if (!limit) {
        robot.diagnostics.warning(
            robot.where(joint), "missing-limit",
            "joint '" + name + "' has no <limit>: it moves without limits",
            "Write <limit lower=\"...\" upper=\"...\" effort=\"...\" velocity=\"...\"/>.");
        return;
    }
    auto written = out.add(axis, "limit", limit);
    if (type != "continuous")
        for (const char* bound : {"lower", "upper"})
            out.add(written, bound, limit, limit.attribute(bound).as_string("0"));
    for (const char* bound : {"effort", "velocity"}) {
        if (limit.attribute(bound)) {
            out.add(written, bound, limit, limit.attribute(bound).value());
            continue;
        }
        robot.diagnostics.warning(
            robot.where(joint), "missing-limit",
            "<limit> of joint '" + name + "' has no " + bound + ": there is no bound on it",
            "Write " + std::string(bound) + "=\"...\".");
    }
}

/// Attributes of an element as elements.
void write_attributes(pugi::xml_node from, std::initializer_list<const char*> names, SdfText& out,
                      pugi::xml_node to) {
    for (const char* name : names)
        if (const auto attribute = from.attribute(name)) out.add(to, name, from, attribute.value());
}

void write_mimic(pugi::xml_node mimic, SdfText& out, pugi::xml_node axis) {
    if (!mimic) return;
    auto written = out.add(axis, "mimic", mimic);
    written.append_attribute("joint") = mimic.attribute("joint").value();
    written.append_attribute("axis") = "axis";
    write_attributes(mimic, {"multiplier", "offset"}, out, written);
}

void report_ignored(const UrdfRobot& robot, pugi::xml_node joint) {
    for (const char* element : {"limit", "dynamics", "mimic"}) {
        if (!joint.child(element)) continue;
        robot.diagnostics.warning(robot.where(joint), "unused-axis",
                                  "joint '" + name_of(joint) + "' of type '" + type_of(joint) +
                                      "': URDF does not say which of its axes <" + element +
                                      "> means; it is ignored",
                                  "Write the robot in SDFormat or MJCF.");
    }
}

void write_axis(const UrdfRobot& robot, pugi::xml_node joint, SdfText& out, pugi::xml_node to) {
    const auto given = joint.child("axis");
    auto axis = out.add(to, "axis", given ? given : joint);
    out.add(axis, "xyz", given ? given : joint, given.attribute("xyz").as_string("1 0 0"));
    if (!has_one_axis(type_of(joint))) return report_ignored(robot, joint);
    write_limit(robot, joint, out, axis);
    if (const auto dynamics = joint.child("dynamics"))
        write_attributes(dynamics, {"damping", "friction"}, out, out.add(axis, "dynamics", dynamics));
    if (const auto start = robot.positions.find(name_of(joint)); start != robot.positions.end())
        out.add(axis, "initial_position", joint, start->second);
    write_mimic(joint.child("mimic"), out, axis);
}

void report_type(const UrdfRobot& robot, pugi::xml_node joint) {
    robot.diagnostics.error(
        robot.where(joint), "joint-type",
        "joint '" + name_of(joint) + "' has the type '" + type_of(joint) + "', which is not known",
        "Write type=\"revolute\", \"continuous\", \"prismatic\", \"fixed\", \"floating\", \"planar\" or "
        "\"spherical\".");
}

}  // namespace

void write_joint(const UrdfRobot& robot, pugi::xml_node joint, SdfText& out, pugi::xml_node model) {
    const std::string type = type_of(joint), name = robot.sdf_name_of(joint), parent = parent_of(joint);
    if (type == "floating") return report_ignored(robot, joint);  // nothing joins the two links
    if (sdf_type_of(type).empty()) return report_type(robot, joint);
    if (robot.is_frame(child_of(joint))) return;
    const bool on_world = parent == "world";
    auto written = out.add(model, "joint", joint);
    written.append_attribute("name") = name.c_str();
    written.append_attribute("type") = sdf_type_of(type).c_str();
    if (name != name_of(joint)) written.append_attribute(kJointName) = name_of(joint).c_str();
    write_origin(robot, joint, out, written, on_world ? "__model__" : parent);
    out.add(written, "parent", joint, parent);
    out.add(written, "child", joint, child_of(joint));
    if (moves(joint) && type != "spherical") write_axis(robot, joint, out, written);
    if (type == "spherical") report_ignored(robot, joint);
    if (type == "planar") out.add(written, "roboss:joint", joint).append_attribute("type") = "planar";
    extend_joint(robot, joint, out, written);
    if (on_world && !robot.find_link("world"))
        robot.diagnostics.warning(
            robot.where(joint), "undeclared-world",
            "joint '" + name_of(joint) +
                "' has the parent 'world', which the file does not declare: it stands in "
                "the world",
            "Write <link name=\"world\"/>.");
}

}  // namespace roboss::sdf_import
