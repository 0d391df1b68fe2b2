// Where a model is and how it moves, as plugins publish it: OdometryPublisher of Gazebo, p3d of gazebo_ros.
#pragma once

#include <string>

#include "core/types.h"
#include "math/quat.h"
#include "math/vec3.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// Pose and velocity of the observed frame O: the model's frame, or the link's that p3d names, at its offset.
struct OdometryReading {
    Vec3 position_W;       ///< m; of two dimensions, z is 0
    Quat orientation_W;    ///< from O to the world
    Vec3 linear_velocity,  ///< m/s, axes of O (p3d: of the world); of two dimensions, x and y
        angular_velocity;  ///< rad/s, the same axes; of two dimensions, z
    Tick tick = 0;         ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"position", "m"}, r.position_W);
        visit({"orientation"}, r.orientation_W);
        visit({"linear_velocity", "m/s"}, r.linear_velocity);
        visit({"angular_velocity", "rad/s"}, r.angular_velocity);
    }
};

/// Position and orientation are exact. Noise of a standard deviation of `gaussian_noise` is added to each
/// component of the velocities.
struct OdometrySpec {
    using Reading = OdometryReading;  ///< what it measures

    int dimensions = 2;            ///< 2 or 3
    Vec3 xyz_offset;               ///< m, of O in the model's axes (p3d: in the world's)
    Vec3 rpy_offset;               ///< rad, of O against the model (p3d: turns it in the world)
    double gaussian_noise = 0;     ///< m/s and rad/s, standard deviation
    bool world_axes = false;       ///< velocities and offset in the world's axes
    std::string odom_frame;        ///< name of the world's frame, for others
    std::string robot_base_frame;  ///< name of O, for others

    /// Its elements that have no effect.
    static constexpr IgnoredElement kIgnored[] = {
        {"odom_covariance_topic", "", "the covariance of a velocity is gaussian_noise squared"},
        {"tf_topic", "", "readings go to Clients, not to topics"},
        {"frame_name", "world|map|/map", "poses are those in the world"},
        {"frameName", "world|map|/map", "poses are those in the world"},
    };
    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 20,
                                      .name = "odometry",
                                      .phrase = "an odometry",
                                      .sdf_types = "",
                                      .ours = true,
                                      .ignored = kIgnored,
                                      .plugin = {.classes = "OdometryPublisher",
                                                 .files = "odometry-publisher-system|gazebo_ros_p3d",
                                                 .topic = "odom_topic|topicName",
                                                 .usual_topic = "odometry",
                                                 .rate = "odom_publish_frequency|update_rate|updateRate",
                                                 .usual_rate_hz = 50}};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"dimensions", "dimensions"}, s.dimensions);
        visit({"xyz_offset", "xyz_offset|xyz_offsets|xyzOffset", "m"}, s.xyz_offset);
        visit({"rpy_offset", "rpy_offset|rpy_offsets|rpyOffset", "rad"}, s.rpy_offset);
        visit({"gaussian_noise", "gaussian_noise|gaussianNoise"}, s.gaussian_noise);
        visit({"world_axes", "world_axes"}, s.world_axes);
        visit({"odom_frame", "odom_frame"}, s.odom_frame);
        visit({"robot_base_frame", "robot_base_frame"}, s.robot_base_frame);
    }
    /// p3d has three dimensions and the world's axes.
    void use_plugin(const PluginFacts& plugin) {
        if (plugin.file == "gazebo_ros_p3d") dimensions = 3, world_axes = true;
    }

    /// Compares all members.
    friend bool operator==(const OdometrySpec&, const OdometrySpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>& problems) const {
        if (dimensions != 2 && dimensions != 3)
            problems.push_back(
                {"has " + std::to_string(dimensions) + " dimensions", "Write <dimensions> as 2 or 3."});
        if (!(gaussian_noise >= 0))
            problems.push_back({"has noise with a negative standard deviation (gaussian_noise)",
                                "Write a standard deviation of at least 0."});
    }
};

}  // namespace roboss
