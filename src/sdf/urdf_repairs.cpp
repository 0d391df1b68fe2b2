// Works on the XML, before it becomes SDF.
#include "sdf/urdf_repairs.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sdf/element_reader.h"

namespace roboss::sdf_import {
namespace {

void mend_name(pugi::xml_node robot, const SourceFile& urdf, Diagnostics& diagnostics) {
    if (robot.attribute("name").value()[0] != 0) return;
    std::string name = std::filesystem::path(urdf.path()).stem().string();
    if (name.empty()) name = "robot";
    robot.remove_attribute("name");
    robot.append_attribute("name") = name.c_str();
    diagnostics.warning(urdf.where(urdf.root()), "unnamed-robot",
                        "<robot> has no name; it gets that of its file: '" + name + "'", "Write its name.");
}

/// The name without "::", which SDFormat keeps for parts of parts, and without the "__" before and after it
/// that SDFormat keeps for frames of its own.
std::string allowed(std::string name) {
    for (std::size_t at = 0; (at = name.find("::", at)) != std::string::npos;) name.replace(at, 2, "__");
    if (name.size() > 4 && name.starts_with("__") && name.ends_with("__"))
        name = name.substr(2, name.size() - 4);
    return name;
}

/// Names of links and joints that SDFormat does not allow, and what they become.
std::map<std::string, std::string> forbidden_names(pugi::xml_node robot) {
    std::set<std::string> taken;
    for (const auto part : robot.children()) taken.insert(part.attribute("name").value());
    std::map<std::string, std::string> names;
    for (const auto part : robot.children()) {
        const std::string_view kind = part.name();
        if (kind != "link" && kind != "joint") continue;
        const std::string name = part.attribute("name").value();
        std::string other = allowed(name);
        if (other == name || names.contains(name)) continue;
        while (!taken.insert(other).second) other += "_";
        names.emplace(name, other);
    }
    return names;
}

void rename_forbidden(pugi::xml_node robot, const SourceFile& urdf, Diagnostics& diagnostics) {
    const std::pair<const char*, const char*> users[] = {{"link", "name"},   {"joint", "name"},
                                                         {"parent", "link"}, {"child", "link"},
                                                         {"mimic", "joint"}, {"gazebo", "reference"}};
    const std::map<std::string, std::string> names = forbidden_names(robot);
    if (names.empty()) return;
    const auto rename = [&](pugi::xml_node node) {
        for (const auto& [element, attribute] : users) {
            if (std::string_view(node.name()) != element) continue;
            const auto found = names.find(node.attribute(attribute).value());
            if (found != names.end()) node.attribute(attribute).set_value(found->second.c_str());
        }
    };
    for (const auto part : robot.children()) {
        rename(part);
        for (const auto inner : part.children()) rename(inner);
    }
    const auto& [first, other] = *names.begin();
    diagnostics.warning(urdf.where(urdf.root()), "renamed",
                        "names with '::', or with '__' at both ends, are written otherwise here ('" + first +
                            "' is '" + other + "'): SDFormat keeps them for itself",
                        "Give links and joints other names.");
}

/// The link and what is fixed to it.
std::vector<std::string> fixed_to(const UrdfRobot& robot, const std::string& link) {
    std::vector<std::string> all{link};
    for (std::size_t k = 0; k < all.size(); ++k)
        for (const auto& [name, joint] : robot.joints)
            if (!moves(joint) && parent_of(joint) == all[k]) all.push_back(child_of(joint));
    return all;
}

/// Nothing that carries a link without mass could tell how it moves.
bool needs_ground(const UrdfRobot& robot, const std::string& root) {
    const std::vector<std::string> base = fixed_to(robot, root);
    const auto has = [&](const auto& property) {
        return std::ranges::any_of(base, [&](const std::string& name) {
            const auto link = robot.find_link(name);
            return link && property(link);
        });
    };
    if (has(has_mass)) return false;
    const bool holds = std::ranges::any_of(robot.joints, [&](const auto& joint) {
        return moves(joint.second) && type_of(joint.second) != "floating" &&
               std::ranges::find(base, parent_of(joint.second)) != base.end();
    });
    return holds || has([](pugi::xml_node link) { return !is_bare(link); });
}

/// As a fixed joint on a link "world" of the file would.
void fix_to_world(UrdfRobot& robot, const std::string& root) {
    if (!robot.find_link("world")) {
        auto world = robot.robot.append_child("link");
        world.append_attribute("name") = "world";
        robot.links.emplace("world", world);
    }
    auto joint = robot.robot.append_child("joint");
    joint.append_attribute("name") = (root + "_to_world").c_str();
    joint.append_attribute("type") = "fixed";
    joint.append_child("parent").append_attribute("link") = "world";
    joint.append_child("child").append_attribute("link") = root.c_str();
    robot.joints.emplace(name_of(joint), joint);
    robot.carriers.emplace(root, joint);
    robot.diagnostics.warning(
        robot.where(robot.find_link(root)), "no-inertial",
        "link '" + root + "', on which the robot stands, has no mass: it is fixed to the world",
        "Give it an <inertial> if it shall move.");
}

/// "'a', 'b' and 10 more".
std::string first_names(const UrdfRobot& robot) {
    constexpr std::size_t kShown = 5;
    std::string text;
    std::size_t count = 0;
    for (const auto link : robot.robot.children("link"))
        if (++count <= kShown) text += (count == 1 ? "'" : ", '") + name_of(link) + "'";
    return count <= kShown ? text : text + " and " + std::to_string(count - kShown) + " more";
}

/// No link has mass.
bool repair_massless(UrdfRobot& robot) {
    const auto first = robot.robot.child("link");
    const auto visible = [](const auto& link) { return !is_bare(link.second); };
    if (std::ranges::none_of(robot.links, visible)) {
        robot.diagnostics.error(robot.where(first), "no-inertial",
                                "<inertial> is missing in all links, which have no shapes either: " +
                                    first_names(robot) + "; nothing is there that could be simulated",
                                "Give each link an <inertial> with <mass> and <inertia>.");
        return false;
    }
    const auto is_moving = [](const auto& joint) { return moves(joint.second); };
    robot.masses_follow = std::ranges::any_of(robot.joints, is_moving);
    if (!robot.masses_follow) robot.robot.append_child("gazebo").append_child("static").text() = "true";
    robot.diagnostics.warning(
        robot.where(first), "no-inertial",
        robot.masses_follow
            ? "no link has mass: masses follow from the collisions, at 1000 kg/m^3 as in MuJoCo"
            : "no link has mass, and no joint moves: the model stands still, as scenery",
        "Give each link an <inertial> with <mass> and <inertia>.");
    return true;
}

}  // namespace

void repair_urdf(pugi::xml_node robot, const SourceFile& urdf, Diagnostics& diagnostics) {
    mend_name(robot, urdf, diagnostics);
    rename_forbidden(robot, urdf, diagnostics);
}

bool repair_roots(UrdfRobot& robot) {
    if (robot.links.empty()) {
        robot.diagnostics.error(robot.where(robot.robot), "no-links", "<robot> has no <link>", "Add one.");
        return false;
    }
    const auto heavy = [](const auto& link) { return has_mass(link.second); };
    if (std::ranges::none_of(robot.links, heavy)) return repair_massless(robot);
    std::vector<std::string> roots;
    for (const auto& [name, link] : robot.links)
        if (name != "world" && !robot.carrier_of(name) && needs_ground(robot, name)) roots.push_back(name);
    for (const std::string& root : roots) fix_to_world(robot, root);
    return true;
}

}  // namespace roboss::sdf_import
