// Plugins and elements of other namespaces.
#include <cstring>

#include "sdf/actor_conversion.h"
#include "sdf/conversion.h"
#include "sdf/known_children.h"
#include "sdf/plugin_conversion.h"
#include "sdf/plugin_sensors.h"
#include "world/joint_type.h"

namespace roboss::sdf_import {
namespace {

constexpr const char* kMotor[] = {"position_gain", "velocity_gain", "armature", "max_effort", "max_velocity"};
constexpr const char* kDrag[] = {"coefficient", "area", "linear"};
constexpr const char* kRadio[] = {"pose",        "channel",         "address",    "bit_rate",
                                  "latency",     "range",           "tx_power",   "l0",
                                  "sigma",       "fading_exponent", "loss",       "capture",
                                  "noise_floor", "obstacle_loss",   "collisions", "update_rate"};
constexpr const char* kGripper[] = {"type", "pose", "reach", "max_force", "max_torque", "on"};

bool is_ours_here(const char* parent, const char* name) {
    const auto is = [](const char* a, const char* b) { return std::strcmp(a, b) == 0; };
    if (is(name, "roboss:sensor") || is(name, "roboss:radio") || is(name, "roboss:drag") ||
        is(name, "roboss:gripper"))
        return is(parent, "link");
    if (is(name, "roboss:joint")) return is(parent, "joint");
    if (is(name, "roboss:motor")) return is(parent, "joint") || is(parent, "axis") || is(parent, "axis2");
    if (is(name, "roboss:surface_velocity")) return is(parent, "link") || is(parent, "collision");
    if (is(name, "roboss:actor")) return is(parent, "model");
    if (is(name, "roboss:angles")) return is(parent, "horizontal") || is(parent, "vertical");
    if (is(name, "roboss:rolling_friction")) return is(parent, "collision") || is(parent, "surface");
    return false;
}

/// Its children are the axes of its type.
void report_joint(const Element& element, const Import& import) {
    const auto kind = find_joint_type(element.node.attribute("type").value());
    if (!kind) return;  // reported with the joint
    std::vector<const char*> axes;
    for (const std::string_view axis : joint_type(*kind).axes) axes.push_back(axis.data());
    report_unknown_children(element, axes, import.diagnostics());
}

void convert_extension(const Element& element, const std::string& scope, const Import& import,
                       ModelSpec& model) {
    const std::string name = element.node.name(), parent = element.node.parent().name();
    if (is_foreign(name)) return report_foreign(element, import.diagnostics());
    if (is_ours_here(parent.c_str(), name.c_str())) {
        if (name == "roboss:motor") report_unknown_children(element, kMotor, import.diagnostics());
        if (name == "roboss:joint") report_joint(element, import);
        if (name == "roboss:radio") report_unknown_children(element, kRadio, import.diagnostics());
        if (name == "roboss:gripper") report_unknown_children(element, kGripper, import.diagnostics());
        if (name == "roboss:surface_velocity") convert_surface_velocity(element, scope, import, model);
        if (name == "roboss:actor") convert_actor(element, import, model);
        if (name == "roboss:drag") report_unknown_children(element, kDrag, import.diagnostics());
        return;
    }
    import.diagnostics().warning(
        element.where(), "unknown-extension",
        "<" + name + "> in <" + parent + "> is not known and is ignored",
        "Known: <roboss:sensor>, <roboss:radio>, <roboss:drag> and <roboss:gripper> in a link, "
        "<roboss:joint> in a joint, "
        "<roboss:motor> in a joint or axis, <roboss:rolling_friction> in a collision or surface, "
        "<roboss:surface_velocity> in a link or collision, <roboss:angles> in <horizontal> or <vertical> of "
        "a lidar's "
        "<scan>.");
}

}  // namespace

void convert_extensions(const Element& parent, const std::string& scope, const Import& import,
                        ModelSpec& model, std::vector<PluginSensor>& sensors) {
    for (const auto node : parent.node.children()) {
        if (node.type() != pugi::node_element) continue;
        const Element element{parent.source, node};
        if (std::strcmp(node.name(), "plugin") == 0) {
            const std::size_t before = model.onboard.size();
            convert_plugin(element, scope, import, model.onboard, model.extensions);
            for (PluginSensor& sensor :
                 convert_plugin_sensors(element, scope, model.onboard, model.onboard.size() > before, import))
                sensors.push_back(std::move(sensor));
        } else if (std::strcmp(node.name(), "model") == 0 || std::strcmp(node.name(), "include") == 0) {
            continue;  // nested models and includes take their own turn
        } else if (std::strchr(node.name(), ':') != nullptr) {
            convert_extension(element, scope, import, model);
            if (std::strcmp(node.name(), "roboss:gripper") == 0 &&
                std::strcmp(parent.node.name(), "link") == 0)
                convert_gripper(element, parent, scope, import, model.onboard);
        } else {
            convert_extensions(element, scope, import, model, sensors);
        }
    }
}

}  // namespace roboss::sdf_import
