// The poses of a robot's links, as PosePublisher of Gazebo publishes them.
#pragma once

#include <vector>

#include "core/types.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// Poses in the model's frame, that of the model itself in the world.
struct LinkPosesReading {
    std::vector<double> positions,  ///< m, x y z of each pose, one behind the other
        orientations;               ///< w x y z of each pose, one behind the other
    Tick tick = 0;                  ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"positions", "m"}, r.positions);
        visit({"orientations"}, r.orientations);
    }
};

/// The pose of the model, if it is wanted, then those of all links in their order.
struct LinkPosesSpec {
    using Reading = LinkPosesReading;  ///< what it measures

    bool publish_link_pose = true;           ///< one for each link
    bool publish_model_pose = false;         ///< of the model
    bool publish_nested_model_pose = false;  ///< of the model too, where publish_model_pose is not written

    /// Its elements that have no effect.
    static constexpr IgnoredElement kIgnored[] = {
        {"publish_visual_pose", "false|0", "poses of visuals are fixed in their links"},
        {"publish_collision_pose", "false|0", "poses of collisions are fixed in their links"},
        {"publish_sensor_pose", "false|0", "poses of sensors are fixed in their links"},
        {"static_publisher", "false|0", "a reading has all poses"},
        {"static_update_frequency", "", "a reading has all poses"},
        {"use_pose_vector_msg", "", "a reading has all poses"},
    };
    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 22,
                                      .name = "link poses",
                                      .phrase = "a sensor of link poses",
                                      .sdf_types = "",
                                      .ours = true,
                                      .ignored = kIgnored,
                                      .plugin = {.classes = "PosePublisher",
                                                 .files = "pose-publisher-system",
                                                 .usual_topic = "pose",
                                                 .rate = "update_frequency"}};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"publish_link_pose", "publish_link_pose"}, s.publish_link_pose);
        visit({"publish_model_pose", "publish_model_pose"}, s.publish_model_pose);
        visit({"publish_nested_model_pose", "publish_nested_model_pose"}, s.publish_nested_model_pose);
    }

    /// Compares all members.
    friend bool operator==(const LinkPosesSpec&, const LinkPosesSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>&) const {}
};

}  // namespace roboss
