// Names in ROS 2 that a file gives to a sensor: its topic and the frame of its messages. They stand in the
// sensor (<topic>, <gz_frame_id>), or in the plugin of gazebo_ros_pkgs below it (<ros><namespace>,
// <remapping>, <frame_name>; ROS 1: <topicName>, <frameName>, <robotNamespace>).
#include <array>
#include <string>
#include <string_view>

#include "sdf/conversion.h"
#include "sdf/sensor_names.h"

namespace roboss::sdf_import {

namespace {

/// The text of the first of these children that has one.
template <std::size_t n>
std::string first_text(const pugi::xml_node& parent, const std::array<const char*, n>& names) {
    for (const char* name : names)
        if (const std::string text = parent.child(name).text().as_string(); !text.empty()) return text;
    return {};
}

/// Where "~/out:=scan" leads: "scan". The first remapping counts that is not of the camera's calibration.
std::string remapped(const pugi::xml_node& ros) {
    constexpr std::string_view kArrow = ":=";
    for (const pugi::xml_node rule : ros.children("remapping")) {
        const std::string text = rule.text().as_string();
        const std::size_t arrow = text.find(kArrow);
        if (arrow == std::string::npos || text.find("camera_info") < arrow) continue;
        return text.substr(arrow + kArrow.size());
    }
    return {};
}

std::string without_slash_in_front(std::string name) {
    while (name.starts_with('/')) name.erase(0, 1);
    return name;
}

/// A name in a namespace: names that begin with a slash are in none.
std::string placed(const std::string& space, const std::string& name) {
    if (space.empty() || name.empty() || name.starts_with('/')) return name;
    return "/" + without_slash_in_front(space) + (space.ends_with('/') ? "" : "/") + name;
}

}  // namespace

void read_ros_names(const Element& sensor, SensorSpec& spec) {
    spec.ros_topic = spec.topic;
    spec.ros_frame = first_text(sensor.node, std::array{"gz_frame_id", "ignition_frame_id", "frame_id"});
    for (const pugi::xml_node plugin : sensor.node.children("plugin")) {
        const pugi::xml_node ros = plugin.child("ros");
        std::string name = remapped(ros);
        if (name.empty()) name = first_text(plugin, std::array{"topicName", "imageTopicName"});
        const std::string space = ros ? std::string(ros.child("namespace").text().as_string())
                                      : first_text(plugin, std::array{"robotNamespace"});
        if (!name.empty()) spec.ros_topic = placed(space, name);
        const std::string frame = first_text(plugin, std::array{"frame_name", "frameName"});
        if (!frame.empty()) spec.ros_frame = frame;
    }
}

}  // namespace roboss::sdf_import
