// See urdf_control.h. The elements are those of ros2_control (control.ros.org, "hardware components").
#include "sdf/urdf_control.h"

#include <string_view>

#include "sdf/element_reader.h"

namespace roboss::sdf_import {
namespace {

/// The text of <param name="..."> in an element; empty: it has none.
std::string parameter(pugi::xml_node parent, const char* name) {
    return trimmed(parent.find_child_by_attribute("param", "name", name).text().get());
}

bool may_stand_at(pugi::xml_node joint, double position) {
    const std::string_view type = joint.attribute("type").value();
    if (type != "revolute" && type != "prismatic") return true;
    const auto limit = joint.child("limit");
    return position >= parse_number(limit.attribute("lower").as_string("0")).value_or(0) &&
           position <= parse_number(limit.attribute("upper").as_string("0")).value_or(0);
}

void add_mimic(pugi::xml_node interface, pugi::xml_node joint) {
    const std::string leader = parameter(interface, "mimic"), multiplier = parameter(interface, "multiplier");
    if (leader.empty() || joint.child("mimic")) return;
    auto mimic = joint.append_child("mimic");
    mimic.append_attribute("joint") = leader.c_str();
    if (parse_number(multiplier)) mimic.append_attribute("multiplier") = multiplier.c_str();
}

}  // namespace

std::map<std::string, std::string> read_ros2_control(pugi::xml_node robot, const SourceFile& urdf,
                                                     Diagnostics& diagnostics) {
    std::map<std::string, std::string> positions;
    for (const auto control : urdf.root().children("ros2_control")) {
        diagnostics.note(
            urdf.where(control), "ros2-control",
            "of <ros2_control> '" + std::string(control.attribute("name").value()) +
                "' only initial positions and mimic joints count",
            "Give setpoints to the joints, from a control program or by orders; nodes of ROS 2 get "
            "the controllers of a YAML file by --ros2-controllers.");
        for (const auto interface : control.children("joint")) {
            const std::string name = interface.attribute("name").value();
            auto joint = robot.find_child_by_attribute("joint", "name", name.c_str());
            if (!joint) continue;
            add_mimic(interface, joint);
            const std::string value = parameter(
                interface.find_child_by_attribute("state_interface", "name", "position"), "initial_value");
            if (value.empty()) continue;
            const auto position = parse_number(value);
            if (position && may_stand_at(joint, *position)) {
                positions[name] = value;
                continue;
            }
            diagnostics.warning(
                urdf.where(interface), "initial-position",
                "joint '" + name + "' cannot start at the initial_value '" + value + "' of <ros2_control>",
                "Write a number within the joint's limits.");
        }
    }
    return positions;
}

}  // namespace roboss::sdf_import
