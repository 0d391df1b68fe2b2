// <gazebo> in URDF: what Gazebo reads of it, as SDF. Elements that have no name of their own here are SDF,
// and are copied to where the reference leads.
#include <algorithm>
#include <string_view>

#include "sdf/element_reader.h"
#include "sdf/urdf_parts.h"

namespace roboss::sdf_import {
namespace {

bool is_any(std::string_view name, std::initializer_list<std::string_view> names) {
    return std::ranges::find(names, name) != names.end();
}

/// <mu1>0.5</mu1>, or <mu1 value="0.5"/>.
std::string value_of(pugi::xml_node node) {
    return node.attribute("value") ? node.attribute("value").value() : trimmed(node.text().get());
}

bool is_true(pugi::xml_node node) {
    return is_any(value_of(node), {"true", "True", "TRUE", "yes", "1"});
}

/// The last child of this name in the extensions, which is the one that counts; null: none has it.
pugi::xml_node last_of(const std::vector<pugi::xml_node>& extensions,
                       std::initializer_list<std::string_view> names) {
    pugi::xml_node found;
    for (const auto extension : extensions)
        for (const auto node : extension.children())
            if (is_any(node.name(), names)) found = node;
    return found;
}

/// The child, made if it is not there.
pugi::xml_node need(SdfText& out, pugi::xml_node parent, const char* name, pugi::xml_node from) {
    const auto known = parent.child(name);
    return known ? known : out.add(parent, name, from);
}

/// An element that is written for a link, and where SDF has it in a collision.
struct SurfaceValue {
    std::initializer_list<std::string_view> names;
    std::initializer_list<const char*> path;
};
const SurfaceValue kSurface[] = {
    {{"mu1", "mu"}, {"surface", "friction", "ode", "mu"}},
    {{"mu2"}, {"surface", "friction", "ode", "mu2"}},
    {{"fdir1"}, {"surface", "friction", "ode", "fdir1"}},
    {{"kp"}, {"surface", "contact", "ode", "kp"}},
    {{"kd"}, {"surface", "contact", "ode", "kd"}},
    {{"maxVel"}, {"surface", "contact", "ode", "max_vel"}},
    {{"minDepth"}, {"surface", "contact", "ode", "min_depth"}},
    {{"maxContacts", "max_contacts"}, {"max_contacts"}},
    {{"laserRetro"}, {"laser_retro"}},
};

bool is_surface_value(std::string_view name) {
    return std::ranges::any_of(kSurface,
                               [&](const SurfaceValue& value) { return is_any(name, value.names); });
}

/// <collision> and <visual> of an extension count for all of the link; their geometry is the URDF's.
void copy_children(const std::vector<pugi::xml_node>& extensions, std::string_view part, SdfText& out,
                   pugi::xml_node to) {
    for (const auto extension : extensions)
        for (const auto node : extension.children()) {
            if (node.name() != part) continue;
            for (const auto child : node.children())
                if (child.type() == pugi::node_element &&
                    !is_any(child.name(), {"geometry", "pose", "origin"}))
                    out.copy(to, child);
        }
}

void write_decay(pugi::xml_node damping, SdfText& out, pugi::xml_node to) {
    auto decay = out.add(to, "velocity_decay", damping);
    for (const char* part : {"linear", "angular"}) out.add(decay, part, damping, value_of(damping));
}

/// An element of an extension of a link that is for the link itself.
void extend_link_by(pugi::xml_node node, SdfText& out, pugi::xml_node to) {
    const std::string_view name = node.name();
    if (name == "selfCollide") {
        out.add(to, "self_collide", node, is_true(node) ? "true" : "false");
    } else if (name == "turnGravityOff") {
        out.add(to, "gravity", node, is_true(node) ? "false" : "true");
    } else if (name == "dampingFactor") {
        write_decay(node, out, to);
    } else if (name == "static") {
        if (is_true(node) && !to.parent().child("static")) out.add(to.parent(), "static", node, "true");
    } else if (!is_any(name, {"material", "visual", "collision", "preserveFixedJoint",
                              "disableFixedJointLumping", "provideFeedback", "canonicalBody"}) &&
               !is_surface_value(name)) {
        out.copy(to, node);
    }
}

/// Elements of a joint for solvers of another kind: a note says so where <physics> is read.
bool is_for_solvers(std::string_view name) {
    return is_any(name, {"stopCfm", "stopErp", "stopKp", "stopKd", "fudgeFactor", "cfmDamping",
                         "implicitSpringDamper"});
}

bool is_force_torque(pugi::xml_node node) {
    return std::string_view(node.name()) == "sensor" &&
           std::string_view(node.attribute("type").value()) == "force_torque";
}

/// A reference that is the name of a link and of a joint: force-torque sensors and springs are the joint's.
bool is_for_joint(const UrdfRobot& robot, const std::string& reference, pugi::xml_node node) {
    if (!robot.joints.contains(reference)) return false;
    if (!robot.links.contains(reference)) return true;
    return is_force_torque(node) || is_for_solvers(node.name()) ||
           is_any(node.name(), {"springReference", "springStiffness", "initialJointPosition"});
}

void extend_joint_by(pugi::xml_node node, SdfText& out, pugi::xml_node to) {
    const std::string_view name = node.name();
    auto axis = to.child("axis");
    const auto in_axis = [&](const char* block, const char* element) {
        if (!axis) return;
        auto place = *block != 0 ? need(out, axis, block, node) : axis;
        place.remove_child(element);
        out.add(place, element, node, value_of(node));
    };
    if (name == "springReference") {
        in_axis("dynamics", "spring_reference");
    } else if (name == "springStiffness") {
        in_axis("dynamics", "spring_stiffness");
    } else if (name == "initialJointPosition") {
        in_axis("", "initial_position");
    } else if (is_for_solvers(name)) {
        need(out, to, "physics", node);
    } else if (!is_any(name, {"preserveFixedJoint", "disableFixedJointLumping", "provideFeedback"})) {
        out.copy(to, node);
    }
}

/// "<mu1>, <sensor> 'imu'", of what an extension holds.
std::string held_in(pugi::xml_node extension) {
    std::string parts;
    for (const auto node : extension.children()) {
        if (node.type() != pugi::node_element) continue;
        parts += (parts.empty() ? "<" : ", <") + std::string(node.name()) + ">";
        if (const std::string name = name_of(node); !name.empty()) parts += " '" + name + "'";
    }
    return parts;
}

/// A warning: Gazebo ignores such an extension.
void report_reference(const UrdfRobot& robot, pugi::xml_node extension) {
    const std::string content = held_in(extension);
    robot.diagnostics.warning(robot.where(extension), "gazebo-reference",
                              "<gazebo reference=\"" + std::string(extension.attribute("reference").value()) +
                                  "\"> names neither a link nor a joint; it has no effect" +
                                  (content.empty() ? "" : ": left out " + content),
                              "Write the name of a link or joint, or no reference for the model.");
}

}  // namespace

void extend_collision(const UrdfRobot& robot, const std::string& link, SdfText& out,
                      pugi::xml_node collision) {
    const auto& extensions = robot.extensions_of(link);
    copy_children(extensions, "collision", out, collision);
    for (const SurfaceValue& value : kSurface) {
        const auto node = last_of(extensions, value.names);
        if (!node) continue;
        auto at = collision;
        for (const char* step : value.path) at = need(out, at, step, node);
        at.text() = value_of(node).c_str();
    }
}

bool extend_visual(const UrdfRobot& robot, const std::string& link, SdfText& out, pugi::xml_node visual) {
    const auto& extensions = robot.extensions_of(link);
    copy_children(extensions, "visual", out, visual);
    const auto material = last_of(extensions, {"material"});
    if (visual.child("material") || !material) return static_cast<bool>(visual.child("material"));
    if (std::ranges::any_of(material.children(),
                            [](pugi::xml_node child) { return child.type() == pugi::node_element; })) {
        out.copy(visual, material);
        return true;
    }
    if (value_of(material).empty()) return false;
    auto script = out.add(out.add(visual, "material", material), "script", material);
    out.add(script, "name", material, value_of(material));
    out.add(script, "uri", material, "file://media/materials/scripts/gazebo.material");
    return true;
}

void extend_link(const UrdfRobot& robot, const std::string& link, SdfText& out, pugi::xml_node to) {
    for (const auto extension : robot.extensions_of(link))
        for (const auto node : extension.children())
            if (node.type() == pugi::node_element && !is_for_joint(robot, link, node))
                extend_link_by(node, out, to);
}

void extend_joint(const UrdfRobot& robot, pugi::xml_node joint, SdfText& out, pugi::xml_node to) {
    for (const auto extension : robot.extensions_of(name_of(joint)))
        for (const auto node : extension.children())
            if (node.type() == pugi::node_element && is_for_joint(robot, name_of(joint), node))
                extend_joint_by(node, out, to);
}

void extend_model(const UrdfRobot& robot, SdfText& out, pugi::xml_node model) {
    for (const auto extension : robot.robot.children("gazebo")) {
        const std::string reference = extension.attribute("reference").value();
        if (reference.empty()) {
            for (const auto node : extension.children())
                if (node.type() == pugi::node_element) out.copy(model, node);
        } else if (!robot.links.contains(reference) && !robot.joints.contains(reference)) {
            report_reference(robot, extension);
        }
    }
}

}  // namespace roboss::sdf_import
