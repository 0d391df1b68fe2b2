// Works on the XML before libsdformat sees it. Findings are at the link, which the copy has in the same
// place.
#include "sdf/urdf_repairs.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sdf/element_reader.h"
#include "world/joint_type.h"

namespace roboss::sdf_import {
namespace {

/// As urdfdom wants it: the number alone. What has no number at its start stays, for urdfdom to refuse.
void mend_number(pugi::xml_attribute attribute, const SourceLocation& where, Diagnostics& diagnostics) {
    const std::string text = attribute.value();
    const auto words = words_of(std::string_view(text));
    if (words.empty() || parse_number(text)) return;
    if (!parse_number(words[0]) && !number_at_start(words[0])) return;
    const std::string_view word = words[0];
    std::size_t length = word.size();
    while (length > 0 && !parse_number(word.substr(0, length))) --length;
    attribute.set_value(std::string(word.substr(0, length)).c_str());
    diagnostics.warning(
        where, "trailing-text",
        std::string(attribute.name()) + "=\"" + text + "\" of an <inertial>: only the number counts",
        "Write the number alone.");
}

void mend_inertial(pugi::xml_node inertial, const SourceLocation& where, Diagnostics& diagnostics) {
    for (const auto child : {inertial.child("mass"), inertial.child("inertia")})
        for (const auto attribute : child.attributes()) mend_number(attribute, where, diagnostics);
    if (!inertial.child("mass")) return;
    auto inertia = inertial.child("inertia");
    if (!inertia) inertia = inertial.append_child("inertia");
    std::string missing;
    for (const char* moment : {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}) {
        if (inertia.attribute(moment)) continue;
        inertia.append_attribute(moment) = "0";
        missing += (missing.empty() ? "" : ", ") + std::string(moment);
    }
    if (missing.empty()) return;
    diagnostics.warning(where, "missing-inertia",
                        "of an <inertial> are missing " + missing + "; they are taken as 0",
                        "Write its moments.");
}

void mend_inertials(pugi::xml_node robot, const SourceFile& urdf, Diagnostics& diagnostics) {
    auto source = urdf.root().child("link");
    for (auto link = robot.child("link"); link; link = link.next_sibling("link")) {
        if (const auto inertial = link.child("inertial"))
            mend_inertial(inertial, urdf.where(source), diagnostics);
        source = source.next_sibling("link");
    }
}

void mend_limit(pugi::xml_node joint, const SourceLocation& where, Diagnostics& diagnostics) {
    const std::string type = joint.attribute("type").value(), name = joint.attribute("name").value();
    if (type != "revolute" && type != "prismatic" && type != "continuous") return;
    auto limit = joint.child("limit");
    if (!limit && type == "continuous") return;
    if (!limit) {
        limit = joint.append_child("limit");
        for (const char* bound : {"effort", "velocity"})
            limit.append_attribute(bound) = "-1";  // none, in SDFormat
        if (type == "revolute") joint.attribute("type").set_value("continuous");
        limit.append_attribute("lower") = "-1e16";  // none, in SDFormat
        limit.append_attribute("upper") = "1e16";
        diagnostics.warning(where, "missing-limit",
                            "joint '" + name + "' has no <limit>: it moves without limits",
                            "Write <limit lower=\"...\" upper=\"...\" effort=\"...\" velocity=\"...\"/>.");
        return;
    }
    for (const char* bound : {"effort", "velocity"}) {
        if (limit.attribute(bound)) continue;
        limit.append_attribute(bound) = "-1";
        diagnostics.warning(where, "missing-limit",
                            "<limit> of joint '" + name + "' has no " + bound + ": there is no bound on it",
                            "Write " + std::string(bound) + "=\"...\".");
    }
}

/// urdfdom refuses the file for what is missing.
void mend_limits(pugi::xml_node robot, const SourceFile& urdf, Diagnostics& diagnostics) {
    auto source = urdf.root().child("joint");
    for (auto joint = robot.child("joint"); joint; joint = joint.next_sibling("joint")) {
        mend_limit(joint, urdf.where(source), diagnostics);
        source = source.next_sibling("joint");
    }
}

/// libsdformat divides by the mass of links that it merges at fixed joints. One without mass says nothing
/// more than none.
void drop_empty_inertials(pugi::xml_node robot) {
    for (const auto joint : robot.children("joint")) {
        if (std::string_view(joint.attribute("type").value()) != "fixed") continue;
        auto link =
            robot.find_child_by_attribute("link", "name", joint.child("child").attribute("link").value());
        const auto mass = link.child("inertial").child("mass").attribute("value");
        if (mass && parse_number(mass.value()) == 0.0) link.remove_child("inertial");
    }
}

/// urdfdom refuses a version that is not of two numbers.
void mend_version(pugi::xml_node robot, const SourceFile& urdf, Diagnostics& diagnostics) {
    const auto version = robot.attribute("version");
    if (!version || std::string_view(version.value()) == "1.0") return;
    diagnostics.warning(urdf.where(urdf.root()), "urdf-version",
                        "version=\"" + std::string(version.value()) + "\" of <robot> is read as 1.0",
                        "Write version=\"1.0\", or none.");
    robot.remove_attribute("version");
}

/// urdfdom refuses a robot without a name.
void mend_name(pugi::xml_node robot, const SourceFile& urdf, Diagnostics& diagnostics) {
    if (robot.attribute("name").value()[0] != 0) return;
    std::string name = std::filesystem::path(urdf.path()).stem().string();
    if (name.empty()) name = "robot";
    robot.remove_attribute("name");
    robot.append_attribute("name") = name.c_str();
    diagnostics.warning(urdf.where(urdf.root()), "unnamed-robot",
                        "<robot> has no name; it gets that of its file: '" + name + "'", "Write its name.");
}

void rename_joints(pugi::xml_node robot, const SourceFile& urdf, Diagnostics& diagnostics) {
    std::set<std::string> taken;
    for (const auto part : robot.children()) taken.insert(part.attribute("name").value());
    auto source = urdf.root().child("joint");
    for (auto joint = robot.child("joint"); joint; joint = joint.next_sibling("joint")) {
        const std::string name = joint.attribute("name").value();
        if (robot.find_child_by_attribute("link", "name", name.c_str())) {
            std::string other = name + "_joint";
            while (!taken.insert(other).second) other += "_";
            joint.attribute("name").set_value(other.c_str());
            for (auto follower : robot.children("joint"))
                if (auto leader = follower.child("mimic").attribute("joint"); name == leader.value())
                    leader.set_value(other.c_str());
            diagnostics.warning(urdf.where(source), "renamed-joint",
                                "joint '" + name + "' has the name of a link; here it is '" + other + "'",
                                "Give it a name of its own.");
        }
        source = source.next_sibling("joint");
    }
}

/// Names of links and joints with "::", which SDFormat keeps for parts of parts, and what they become.
std::map<std::string, std::string> unscoped_names(pugi::xml_node robot) {
    std::set<std::string> taken;
    for (const auto part : robot.children()) taken.insert(part.attribute("name").value());
    std::map<std::string, std::string> names;
    for (const auto part : robot.children()) {
        const std::string name = part.attribute("name").value();
        if (name.find("::") == std::string::npos || names.contains(name)) continue;
        std::string other = name;
        for (std::size_t at = 0; (at = other.find("::", at)) != std::string::npos;)
            other.replace(at, 2, "__");
        while (!taken.insert(other).second) other += "_";
        names.emplace(name, other);
    }
    return names;
}

void rename_scoped(pugi::xml_node robot, const SourceFile& urdf, Diagnostics& diagnostics) {
    const std::pair<const char*, const char*> users[] = {{"link", "name"},   {"joint", "name"},
                                                         {"parent", "link"}, {"child", "link"},
                                                         {"mimic", "joint"}, {"gazebo", "reference"}};
    const std::map<std::string, std::string> names = unscoped_names(robot);
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
                        "names with '::' are written otherwise here ('" + first + "' is '" + other +
                            "'): SDFormat keeps '::' for nested models",
                        "Give links and joints names without '::'.");
}

bool is_visible(pugi::xml_node link) {
    return link.child("collision") || link.child("visual");
}

bool moves(pugi::xml_node joint) {
    return std::string_view(joint.attribute("type").value()) != "fixed";
}

bool has_mass(pugi::xml_node link) {
    const auto mass = link.child("inertial").child("mass").attribute("value");
    return mass && parse_number(mass.value()) != 0.0;
}

bool is_world(pugi::xml_node link) {
    return std::string_view(link.attribute("name").value()) == "world";
}

void give_unit_inertial(pugi::xml_node link) {
    link.remove_child("inertial");
    auto inertial = link.append_child("inertial");
    inertial.append_child("mass").append_attribute("value") = 1;
    auto inertia = inertial.append_child("inertia");
    for (const char* moment : {"ixx", "iyy", "izz"}) inertia.append_attribute(moment) = 1;
    for (const char* product : {"ixy", "ixz", "iyz"}) inertia.append_attribute(product) = 0;
}

/// Without a mass anywhere nothing moves: a table, a plane. PyBullet has them as scenery.
void make_scenery(pugi::xml_node robot, const SourceFile& urdf, Diagnostics& diagnostics) {
    const auto links = robot.children("link"), joints = robot.children("joint");
    if (std::any_of(joints.begin(), joints.end(), moves) ||
        std::any_of(links.begin(), links.end(), has_mass) ||
        std::none_of(links.begin(), links.end(), is_visible))
        return;
    for (auto link : links)
        if (!is_world(link)) give_unit_inertial(link);
    robot.append_child("gazebo").append_child("static").text() = "true";
    diagnostics.warning(urdf.where(urdf.root().child("link")), "no-inertial",
                        "no link has mass, and no joint moves: the model stands still, as scenery",
                        "Give each link an <inertial> with <mass> and <inertia> if it shall move.");
}

/// The link that is no child, if there is one such link.
pugi::xml_node root_of(pugi::xml_node robot) {
    pugi::xml_node root;
    for (const auto link : robot.children("link")) {
        const std::string_view name = link.attribute("name").value();
        const auto joints = robot.children("joint");
        if (std::any_of(joints.begin(), joints.end(),
                        [&](auto joint) { return name == joint.child("child").attribute("link").value(); }))
            continue;
        if (root) return {};
        root = link;
    }
    return root;
}

/// The link and what is fixed to it.
std::vector<pugi::xml_node> fixed_to(pugi::xml_node robot, pugi::xml_node link) {
    std::vector<pugi::xml_node> all{link};
    for (std::size_t k = 0; k < all.size(); ++k)
        for (const auto joint : robot.children("joint")) {
            const auto parent = joint.child("parent").attribute("link");
            if (moves(joint) || std::string_view(parent.value()) != all[k].attribute("name").value())
                continue;
            const char* name = joint.child("child").attribute("link").value();
            const auto child = robot.find_child_by_attribute("link", "name", name);
            if (child && std::ranges::find(all, child) == all.end()) all.push_back(child);
        }
    return all;
}

void ground_root(pugi::xml_node robot, const SourceFile& urdf, Diagnostics& diagnostics) {
    const auto links = robot.children("link");
    auto root = root_of(robot);
    if (!root || is_world(root) || std::none_of(links.begin(), links.end(), has_mass)) return;
    const std::vector<pugi::xml_node> base = fixed_to(robot, root);
    if (std::ranges::any_of(base, has_mass) || std::any_of(links.begin(), links.end(), is_world)) return;
    const std::string name = root.attribute("name").value();
    give_unit_inertial(root);
    robot.append_child("link").append_attribute("name") = "world";
    auto joint = robot.append_child("joint");
    joint.append_attribute("name") = (name + "_to_world").c_str();
    joint.append_attribute("type") = "fixed";
    joint.append_child("parent").append_attribute("link") = "world";
    joint.append_child("child").append_attribute("link") = name.c_str();
    const auto source = urdf.root().find_child_by_attribute("link", "name", name.c_str());
    diagnostics.warning(
        urdf.where(source), "no-inertial",
        "link '" + name + "', on which the robot stands, has no mass: it is fixed to the world",
        "Give it an <inertial> if it shall move.");
}

}  // namespace

void repair_urdf(pugi::xml_node robot, const SourceFile& urdf, Diagnostics& diagnostics) {
    mend_version(robot, urdf, diagnostics);
    mend_name(robot, urdf, diagnostics);
    make_scenery(robot, urdf, diagnostics);
    mend_inertials(robot, urdf, diagnostics);
    drop_empty_inertials(robot);
    mend_limits(robot, urdf, diagnostics);
    rename_scoped(robot, urdf, diagnostics);
    rename_joints(robot, urdf, diagnostics);
    ground_root(robot, urdf, diagnostics);
}

bool stand_in_for_masses(pugi::xml_node robot, const SourceFile& urdf, Diagnostics& diagnostics) {
    const auto links = robot.children("link"), joints = robot.children("joint");
    if (std::none_of(joints.begin(), joints.end(), moves) ||
        std::any_of(links.begin(), links.end(), has_mass) ||
        std::none_of(links.begin(), links.end(), is_visible))
        return false;
    for (const auto link : links)
        if (!is_world(link)) give_unit_inertial(link);
    diagnostics.warning(urdf.where(urdf.root().child("link")), "no-inertial",
                        "no link has mass: masses follow from the collisions, at 1000 kg/m^3 as in MuJoCo",
                        "Give each link an <inertial> with <mass> and <inertia>.");
    return true;
}

std::map<std::string, std::string> replace_joint_types(pugi::xml_node robot, const SourceFile& urdf,
                                                       Diagnostics& diagnostics) {
    std::map<std::string, std::string> types;
    auto source = urdf.root().child("joint");
    for (auto joint = robot.child("joint"); joint;
         joint = joint.next_sibling("joint"), source = source.next_sibling("joint")) {
        const std::string name = joint.attribute("name").value(), type = joint.attribute("type").value();
        const auto kind = find_joint_type(type);
        if (!kind || !joint_type(*kind).is_extension) continue;
        types[name] = type;
        joint.attribute("type").set_value("continuous");
        for (const char* element : {"limit", "dynamics", "mimic"}) {
            if (!joint.remove_child(element)) continue;
            diagnostics.warning(urdf.where(source), "unused-axis",
                                "joint '" + name + "' of type '" + type +
                                    "': URDF does not say which of its axes <" + element +
                                    "> means; it is ignored",
                                "Write the robot in SDFormat, with <roboss:joint type=\"" + type + "\">.");
        }
    }
    return types;
}

std::map<std::string, std::string> replace_narrow_views(pugi::xml_node robot) {
    constexpr double kLeast = 0.1;
    std::map<std::string, std::string> views;
    for (const auto gazebo : robot.children("gazebo"))
        for (const auto sensor : gazebo.children("sensor")) {
            auto view = sensor.child("camera").child("horizontal_fov").text();
            const std::optional<double> angle = parse_number(view.get());
            if (!angle || !(*angle > 0 && *angle < kLeast)) continue;
            views[sensor.attribute("name").value()] = view.get();
            view.set(kLeast);
        }
    return views;
}

}  // namespace roboss::sdf_import
