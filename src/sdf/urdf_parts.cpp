// See urdf_parts.h: names, and the tree that joints make of links.
#include "sdf/urdf_parts.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include "sdf/element_reader.h"

namespace roboss::sdf_import {
namespace {

/// Three finite numbers as written; of an attribute that is missing: zeros.
std::optional<std::string> three_numbers(pugi::xml_attribute attribute) {
    const std::string text = attribute.as_string("0 0 0");
    const auto words = words_of(std::string_view(text));
    const auto is_number = [](std::string_view word) {
        return parse_number(word).has_value() || !with_decimal_point(word).empty();
    };
    if (words.size() != 3 || !std::ranges::all_of(words, is_number)) return std::nullopt;
    return text;
}

void report_origin(const UrdfRobot& robot, pugi::xml_node origin) {
    robot.diagnostics.error(robot.where(origin), "bad-value",
                            "xyz and rpy of an <origin> are not 3 finite numbers each",
                            "Write <origin xyz=\"0 0 1.5\" rpy=\"0 0 0\"/>.");
}

/// Each joint has two links that the file has; the world needs no declaration.
bool check_ends(const UrdfRobot& robot) {
    bool good = true;
    for (const auto joint : robot.robot.children("joint"))
        for (const bool is_child : {false, true}) {
            const std::string link = is_child ? child_of(joint) : parent_of(joint);
            if (robot.find_link(link) || (link == "world" && !is_child)) continue;
            good = false;
            const std::string end = is_child ? "child" : "parent";
            robot.diagnostics.error(
                robot.where(joint), "joint-to-nowhere",
                "joint '" + name_of(joint) + "' has " +
                    (link.empty() ? "no <" + end + " link=\"...\"/>"
                                  : "the " + end + " '" + link + "', which is no link here"),
                "Write the name of a link of the robot.");
        }
    return good;
}

bool find_carriers(UrdfRobot& robot) {
    bool good = true;
    for (const auto joint : robot.robot.children("joint")) {
        const auto [known, is_new] = robot.carriers.emplace(child_of(joint), joint);
        if (is_new) continue;
        good = false;
        robot.diagnostics.error(robot.where(joint), "two-parents",
                                "link '" + child_of(joint) + "' is the child of joint '" +
                                    name_of(known->second) + "' and of joint '" + name_of(joint) + "'",
                                "Leave one of the joints out; loops can be written in SDFormat or MJCF.");
    }
    return good;
}

/// Follows each link towards its root, which is at most as far as there are links.
bool find_loops(const UrdfRobot& robot) {
    for (const auto& [name, link] : robot.links) {
        std::string at = name;
        for (std::size_t k = 0; k <= robot.links.size(); ++k) {
            const auto carrier = robot.carrier_of(at);
            if (!carrier) break;
            at = parent_of(carrier);
            if (k < robot.links.size()) continue;
            robot.diagnostics.error(robot.where(link), "joint-loop",
                                    "link '" + name + "' hangs on itself: its joints make a loop",
                                    "Let the joints lead from one root to all links.");
            return false;
        }
    }
    return true;
}

}  // namespace

std::string name_of(pugi::xml_node node) {
    return node.attribute("name").value();
}

std::string parent_of(pugi::xml_node joint) {
    return joint.child("parent").attribute("link").value();
}

std::string child_of(pugi::xml_node joint) {
    return joint.child("child").attribute("link").value();
}

std::string type_of(pugi::xml_node joint) {
    return joint.attribute("type").value();
}

bool moves(pugi::xml_node joint) {
    return type_of(joint) != "fixed";
}

bool has_mass(pugi::xml_node link) {
    const auto mass = link.child("inertial").child("mass").attribute("value");
    return mass && parse_number(mass.value()) != 0.0;
}

bool is_bare(pugi::xml_node link) {
    return !has_mass(link) && !link.child("collision") && !link.child("visual");
}

pugi::xml_node UrdfRobot::find_link(const std::string& name) const {
    const auto found = links.find(name);
    return found == links.end() ? pugi::xml_node() : found->second;
}

pugi::xml_node UrdfRobot::carrier_of(const std::string& link) const {
    const auto found = carriers.find(link);
    return found == carriers.end() ? pugi::xml_node() : found->second;
}

const std::vector<pugi::xml_node>& UrdfRobot::extensions_of(const std::string& name) const {
    static const std::vector<pugi::xml_node> kNone;
    const auto found = extensions.find(name);
    return found == extensions.end() ? kNone : found->second;
}

bool UrdfRobot::is_frame(const std::string& link) const {
    const auto node = find_link(link);
    const auto carrier = carrier_of(link);
    return node && is_bare(node) && carrier && !moves(carrier) && find_link(parent_of(carrier)) &&
           parent_of(carrier) != "world" && extensions_of(link).empty() &&
           extensions_of(name_of(carrier)).empty();
}

bool UrdfRobot::is_left_out(const std::string& link) const {
    if (link == "world") return true;
    const auto bears = [&](const auto& joint) {
        return type_of(joint.second) != "floating" &&
               (parent_of(joint.second) == link || child_of(joint.second) == link);
    };
    return is_bare(find_link(link)) && extensions_of(link).empty() && links.size() > 1 &&
           std::ranges::none_of(joints, bears);
}

std::string UrdfRobot::sdf_name_of(pugi::xml_node joint) const {
    std::string name = name_of(joint);
    if (!links.contains(name) && name != "world") return name;
    do name += "_joint";
    while (links.contains(name) || joints.contains(name));
    return name;
}

bool index_parts(UrdfRobot& robot) {
    for (const auto node : robot.robot.children("link")) robot.links.emplace(name_of(node), node);
    for (const auto node : robot.robot.children("joint")) robot.joints.emplace(name_of(node), node);
    for (const auto node : robot.robot.children("material")) robot.materials.emplace(name_of(node), node);
    for (const auto node : robot.robot.children("gazebo"))
        if (node.attribute("reference"))
            robot.extensions[node.attribute("reference").value()].push_back(node);
    return check_ends(robot) && find_carriers(robot) && find_loops(robot);
}

void write_origin(const UrdfRobot& robot, pugi::xml_node element, SdfText& out, pugi::xml_node to,
                  const std::string& relative_to) {
    const auto origin = element.child("origin");
    if (!origin && relative_to.empty()) return;
    const auto quaternion = origin.attribute("quat_xyzw");  // URDF 1.1
    const auto xyz = three_numbers(origin.attribute("xyz")), rpy = three_numbers(origin.attribute("rpy"));
    if (!xyz || !rpy) return report_origin(robot, origin);
    auto pose = out.add(to, "pose", origin ? origin : element,
                        *xyz + " " + (quaternion ? std::string(quaternion.value()) : *rpy));
    if (!relative_to.empty()) pose.append_attribute("relative_to") = relative_to.c_str();
    if (quaternion) pose.append_attribute("rotation_format") = "quat_xyzw";
}

}  // namespace roboss::sdf_import
