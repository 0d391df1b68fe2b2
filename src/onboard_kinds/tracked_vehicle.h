// TrackedVehicle of Gazebo: commands the speeds of the tracks (TrackController) of a vehicle so that it
// follows a commanded velocity.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "onboard_kinds/kind.h"
#include "onboard_kinds/speed_limits.h"
#include "onboard_kinds/twist.h"

namespace roboss {

/// One track of a vehicle: the link whose surface moves.
struct TrackSpec {
    LinkNames link;              ///< one link
    std::string velocity_topic,  ///< empty: /model/NAME/link/LINK/track_cmd_vel
        center_topic;            ///< empty: /model/NAME/link/LINK/track_cmd_center_of_rotation

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"link", "link"}, s.link);
        visit({"velocity_topic", "velocity_topic"}, s.velocity_topic);
        visit({"center_topic", "center_of_rotation_topic"}, s.center_topic);
    }
    /// Compares all members.
    friend bool operator==(const TrackSpec&, const TrackSpec&) = default;
};

/// The speeds are given when a command comes or the limits still change them, as in Gazebo; the centre of
/// rotation moves with the vehicle.
struct TrackedVehicleSpec {
    std::vector<TrackSpec> left,  ///< tracks of the left side
        right;                    ///< tracks of the right side
    LinkNames body;               ///< its origin is the centre, its y axis points left; empty: canonical link
    double tracks_separation = 1.0,  ///< m
        steering_efficiency = 0.5;   ///< turn of the vehicle over that of the tracks; a command changes it
    SpeedLimits linear,              ///< m/s
        angular;                     ///< rad/s
    std::string topic,               ///< of the command; empty: /model/NAME/cmd_vel
        efficiency_topic;            ///< of steering_efficiency; empty: /model/NAME/steering_efficiency
    OdometryOutput output;           ///< of the odometry

    /// Elements of Gazebo's without effect.
    static constexpr IgnoredElement kIgnored[] = {
        {"track_height", "", "the tracks' speeds do not depend on it"},
        {"tracks_height", "", "the tracks' speeds do not depend on it"},
        {"debug", "0|false", "it draws markers"}};
    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 13,
                                       .name = "tracked-vehicle",
                                       .phrase = "a tracked vehicle",
                                       .classes = "TrackedVehicle",
                                       .files = "tracked-vehicle-system",
                                       .ignored = kIgnored,
                                       .odometry = 0};
    /// Names and elements of its limits.
    static constexpr SpeedLimitElements kLinear{
        {{"min_linear_velocity", "linear_velocity/min_velocity", "m/s", true},
         {"max_linear_velocity", "linear_velocity/max_velocity", "m/s", true},
         {"min_linear_acceleration", "linear_velocity/min_acceleration", "m/s^2", true},
         {"max_linear_acceleration", "linear_velocity/max_acceleration", "m/s^2", true},
         {"min_linear_jerk", "linear_velocity/min_jerk", "m/s^3", true},
         {"max_linear_jerk", "linear_velocity/max_jerk", "m/s^3", true}}};
    /// The same of the turn.
    static constexpr SpeedLimitElements kAngular{
        {{"min_angular_velocity", "angular_velocity/min_velocity", "rad/s", true},
         {"max_angular_velocity", "angular_velocity/max_velocity", "rad/s", true},
         {"min_angular_acceleration", "angular_velocity/min_acceleration", "rad/s^2", true},
         {"max_angular_acceleration", "angular_velocity/max_acceleration", "rad/s^2", true},
         {"min_angular_jerk", "angular_velocity/min_jerk", "rad/s^3", true},
         {"max_angular_jerk", "angular_velocity/max_jerk", "rad/s^3", true}}};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"left", "left_track"}, s.left);
        visit({"right", "right_track"}, s.right);
        visit({"body", "body_link"}, s.body);
        visit({"tracks_separation", "tracks_separation", "m"}, s.tracks_separation);
        visit({"steering_efficiency", "steering_efficiency"}, s.steering_efficiency);
        visit_limits(visit, s.linear, kLinear);
        visit_limits(visit, s.angular, kAngular);
        visit({"topic", "topic"}, s.topic);
        visit({"efficiency_topic", "steering_efficiency_topic"}, s.efficiency_topic);
        visit_odometry(visit, s.output);
    }
    /// The commands that it takes.
    std::vector<Channel> channels() const {
        return {twist_channel(topic, "cmd_vel"),
                channel_of(efficiency_topic, "steering_efficiency", {{"efficiency", ""}})};
    }
    /// The commands that it gives: speed and centre of rotation of each track, left ones first.
    std::vector<std::string> commands() const {
        std::vector<std::string> names;
        for (const std::vector<TrackSpec>* side : {&left, &right})
            for (const TrackSpec& track : *side) {
                const std::string link = "link/" + (track.link.empty() ? "" : track.link.front());
                names.push_back(channel_of(track.velocity_topic, link + "/track_cmd_vel", {}).name);
                names.push_back(
                    channel_of(track.center_topic, link + "/track_cmd_center_of_rotation", {}).name);
            }
        return names;
    }
    /// Places in its memory; it begins with the odometry (OnboardKind::odometry).
    enum Memory : std::size_t {
        kOdometry = 0,
        kSpeed = 5,            ///< m/s, the last two commands after the limits
        kTurnRate = 7,         ///< rad/s, likewise
        kSeenCommand = 9,      ///< tick of the last velocity command that was passed on
        kSeenEfficiency = 10,  ///< tick of the last efficiency that was passed on
        kMemorySize = 11
    };
    /// Its memory at the start.
    std::vector<double> memory() const {
        std::vector<double> start(kMemorySize, 0.0);
        start[kSeenCommand] = start[kSeenEfficiency] = -1;
        return start;
    }
    /// Whether it would change nothing while its robot is at rest.
    bool rests(std::span<const double> m) const {
        return m[kSpeed] == 0 && m[kSpeed + 1] == 0 && m[kTurnRate] == 0 && m[kTurnRate + 1] == 0;
    }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        bool has_links = !left.empty() && !right.empty();
        for (const std::vector<TrackSpec>* side : {&left, &right})
            for (const TrackSpec& track : *side) has_links = has_links && track.link.size() == 1;
        if (!has_links)
            problems.push_back(
                {"has a side without a track, or a track without a link", "Name the link of each track."});
        expect_positive("tracks_separation", tracks_separation, problems);
        expect_positive("steering_efficiency", steering_efficiency, problems);
    }
    /// Compares all members.
    friend bool operator==(const TrackedVehicleSpec&, const TrackedVehicleSpec&) = default;
};

}  // namespace roboss
