// TrackController of Gazebo: the surface of a link runs around it like a belt. Tracks of vehicles, conveyors.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "math/vec3.h"
#include "onboard_kinds/kind.h"

namespace roboss {

/// The surface of the link runs about the y axis of the track's frame: on top along its x axis, below against
/// it. Before the first command it stands still.
struct TrackControllerSpec {
    LinkNames link;                  ///< whose collisions are the track
    Vec3 orientation;                ///< rad, roll, pitch and yaw of the track's frame in the link's
    std::string velocity_topic;      ///< of the command; empty: /model/NAME/link/LINK/track_cmd_vel
    std::string centre_topic;        ///< of the centre of rotation; empty: .../track_cmd_center_of_rotation
    double max_command_age = kNone;  ///< s: an older command counts as zero
    double min_velocity = -kNone,    ///< m/s
        max_velocity = kNone,        ///< m/s
        min_acceleration = -kNone,   ///< m/s^2
        max_acceleration = kNone,    ///< m/s^2
        min_jerk = -kNone,           ///< m/s^3
        max_jerk = kNone;            ///< m/s^3
    std::string odometry_topic;      ///< of the telemetry; empty: /model/NAME/link/LINK/odometry
    double odometry_publish_frequency = 50;  ///< Hz, of the telemetry

    static constexpr double kNone = std::numeric_limits<double>::infinity();  ///< no limit
    /// From here on a coordinate of the centre of rotation means that the track runs straight, m.
    static constexpr double kStraight = 1e8;

    /// Its elements of SDF that have no effect.
    static constexpr IgnoredElement kIgnored[] = {
        {"debug", "0|false", "nothing is drawn for it"},
    };
    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 40,
                                       .name = "track-controller",
                                       .phrase = "a track controller",
                                       .classes = "TrackController",
                                       .files = "track-controller-system",
                                       .ignored = kIgnored};
    /// Its memory: the speed of this tick, that of the tick before (m/s), the way that the belt has run (m).
    enum Memory { kSpeed, kSpeedBefore, kWay, kMemorySize };

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"link", "link"}, s.link);
        visit({"orientation", "track_orientation"}, s.orientation);
        visit({"velocity_topic", "velocity_topic"}, s.velocity_topic);
        visit({"centre_topic", "center_of_rotation_topic"}, s.centre_topic);
        visit({"max_command_age", "max_command_age", "s", true}, s.max_command_age);
        visit({"min_velocity", "min_velocity", "m/s", true}, s.min_velocity);
        visit({"max_velocity", "max_velocity", "m/s", true}, s.max_velocity);
        visit({"min_acceleration", "min_acceleration", "m/s^2", true}, s.min_acceleration);
        visit({"max_acceleration", "max_acceleration", "m/s^2", true}, s.max_acceleration);
        visit({"min_jerk", "min_jerk", "m/s^3", true}, s.min_jerk);
        visit({"max_jerk", "max_jerk", "m/s^3", true}, s.max_jerk);
        visit({"odometry_topic", "odometry_topic"}, s.odometry_topic);
        visit({"odometry_publish_frequency", "odometry_publish_frequency", "Hz"},
              s.odometry_publish_frequency);
    }
    /// The commands that it takes.
    std::vector<Channel> channels() const {
        const std::string place = "link/" + (link.empty() ? std::string() : link.front()) + "/";
        return {channel_of(velocity_topic, place + "track_cmd_vel", {{"velocity", "m/s"}}),
                channel_of(centre_topic, place + "track_cmd_center_of_rotation",
                           {{"x", "m"}, {"y", "m"}, {"z", "m"}})};
    }
    /// Links whose surfaces it moves.
    const LinkNames& surfaces() const { return link; }
    /// Its memory at the start.
    std::vector<double> memory() const { return std::vector<double>(kMemorySize, 0.0); }
    /// Whether it would change nothing while its robot is at rest.
    bool rests(std::span<const double> memory) const {
        return memory[kSpeed] == 0 && memory[kSpeedBefore] == 0;
    }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        if (link.size() != 1)
            problems.push_back({"names " + std::to_string(link.size()) + " links", "Write one <link>."});
        for (const auto& [low, high] :
             {std::pair{min_velocity, max_velocity}, std::pair{min_acceleration, max_acceleration},
              std::pair{min_jerk, max_jerk}})
            if (low > high)
                problems.push_back({"has a minimum above its maximum", "Write limits with min <= max."});
    }
    /// Compares all members.
    friend bool operator==(const TrackControllerSpec&, const TrackControllerSpec&) = default;
};

}  // namespace roboss
