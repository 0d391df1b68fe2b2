// The outline of reading a URDF: repairs, parts by name, then each part as SDF.
#include "sdf/urdf.h"

#include <algorithm>
#include <string_view>

#include "sdf/urdf_control.h"
#include "sdf/urdf_parts.h"
#include "sdf/urdf_repairs.h"

namespace roboss::sdf_import {
namespace {

/// The elements of a transmission with their texts, but for the joints that it names.
void list_parts(pugi::xml_node parent, std::string& parts) {
    for (const auto node : parent.children()) {
        if (node.type() != pugi::node_element) continue;
        if (const std::string name = node.name(); name != "joint" && name != "actuator")
            parts += (parts.empty() ? "<" : ", <") + name + "> " + node.text().get();
        list_parts(node, parts);
    }
}

void report_transmissions(const SourceFile& urdf, Diagnostics& diagnostics) {
    for (const auto node : urdf.root().children("transmission")) {
        std::string joints, parts;
        for (const auto joint : node.children("joint"))
            joints += " '" + std::string(joint.attribute("name").value()) + "'";
        list_parts(node, parts);
        diagnostics.note(urdf.where(node), "transmission",
                         "transmission '" + std::string(node.attribute("name").value()) +
                             "' has no effect: motors act on the joint" + joints +
                             " itself, without gears and hardware interface. Ignored: " +
                             (parts.empty() ? "all of it" : parts),
                         "Give setpoints and limits at the joint; write a rotor's inertia, times the square "
                         "of the reduction, as <armature> of <roboss:motor> in SDFormat.");
    }
}

/// The first element that xacro would expand: one of its own, or one with ${...} or $(...) in an attribute.
pugi::xml_node find_xacro(pugi::xml_node parent) {
    for (const auto node : parent.children()) {
        if (std::string_view(node.name()).starts_with("xacro:")) return node;
        for (const auto attribute : node.attributes()) {
            const std::string_view value = attribute.value();
            if (value.find("${") != value.npos || value.find("$(") != value.npos) return node;
        }
        if (const auto found = find_xacro(node)) return found;
    }
    return {};
}

/// True, and an error, for a file that xacro has not expanded yet.
bool report_xacro(const SourceFile& urdf, Diagnostics& diagnostics) {
    const auto node = find_xacro(urdf.root());
    if (!node) return false;
    diagnostics.error(urdf.where(node), "xacro",
                      "the file holds xacro macros (<" + std::string(node.name()) +
                          ">), which are expanded before it is URDF",
                      "Run: xacro FILE > robot.urdf (of ROS, or pip install xacro), and give robot.urdf.");
    return true;
}

/// The world has no shapes of its own in SDF.
void report_world_shapes(const UrdfRobot& robot) {
    const auto world = robot.find_link("world");
    if (!world || is_bare(world)) return;
    robot.diagnostics.warning(robot.where(world), "world-link",
                              "link 'world' is the world itself: its mass and shapes have no effect",
                              "Put them into a link that a fixed joint holds on 'world'.");
}

/// Links without mass and shapes that a joint leaves free, or that have no joint at all. A parent of a
/// floating joint is the place that the joint starts from.
void report_left_out(const UrdfRobot& robot) {
    const auto is_parent = [&](const std::string& link) {
        return std::ranges::any_of(robot.joints,
                                   [&](const auto& joint) { return parent_of(joint.second) == link; });
    };
    for (const auto link : robot.robot.children("link")) {
        const std::string name = name_of(link);
        const auto carrier = robot.carrier_of(name);
        if (name == "world" || !robot.is_left_out(name) || is_parent(name)) continue;
        robot.diagnostics.warning(
            robot.where(link), "left-out-link",
            "link '" + name + "' has no mass, shape or sensor, and " +
                (carrier ? "joint '" + name_of(carrier) + "' of type 'floating' leaves it free"
                         : "no joint holds it") +
                ": it is left out",
            carrier ? "Give it an <inertial>, or its joint another type, such as \"fixed\"."
                    : "Give it an <inertial>, or a joint.");
    }
}

void write_robot(const UrdfRobot& robot, SdfText& out) {
    auto sdf = out.add({}, "sdf", robot.robot);
    sdf.append_attribute("version") = "1.9";
    sdf.append_attribute("xmlns:roboss") = "https://roboss.org/sdf";
    auto model = out.add(sdf, "model", robot.robot);
    model.append_attribute("name") = name_of(robot.robot).c_str();
    extend_model(robot, out, model);
    for (const auto part : robot.robot.children()) {
        if (std::string_view(part.name()) == "link" && !robot.is_left_out(name_of(part)))
            write_link(robot, part, out, model);
        if (std::string_view(part.name()) == "joint") write_joint(robot, part, out, model);
    }
    report_world_shapes(robot);
    report_left_out(robot);
}

}  // namespace

std::unique_ptr<SourceFile> urdf_to_sdf(const SourceFile& urdf, Diagnostics& diagnostics) {
    if (report_xacro(urdf, diagnostics)) return nullptr;
    UrdfRobot robot{urdf, diagnostics, urdf.root()};
    repair_urdf(robot.robot, urdf, diagnostics);
    if (!index_parts(robot) || !repair_roots(robot)) return nullptr;
    report_transmissions(urdf, diagnostics);
    robot.positions = read_ros2_control(robot.robot, urdf, diagnostics);
    SdfText out(urdf);
    write_robot(robot, out);
    return out.read(diagnostics);
}

}  // namespace roboss::sdf_import
