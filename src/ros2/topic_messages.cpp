// The messages of RobotTopics. See robot_topics.h.
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "ros2/bridged_topics.h"
#include "ros2/fleet_topics.h"
#include "ros2/robot_description.h"
#include "ros2/robot_messages.h"
#include "ros2/robot_topics.h"
#include "ros2/sensor_messages.h"
#include "ros2/stamps.h"
#include "ros2_types/cdr.h"

namespace roboss::ros2 {

std::vector<RobotTopics::Message> RobotTopics::latched(Tick tick) const {
    std::vector<Message> out;
    add_fixed_frames(tick, out);
    if (fleet_) fleet_->add_latched(wanted_, out);
    for (std::size_t r = 0; r < robots_.size(); ++r) {
        const RobotPart& part = robots_[r];
        if (wanted_[part.description])
            out.push_back(
                {part.description, to_cdr(String{urdf_of(*model_, RobotId(r), part.name, part.frames)})});
    }
    if (bridged_) bridged_->finish(out);
    return out;
}

void RobotTopics::add_fixed_frames(Tick tick, std::vector<Message>& out) const {
    const Time stamp = stamp_of(*model_, tick);
    std::map<std::size_t, TFMessage> fixed;  // by topic
    for (std::size_t r = 0; r < robots_.size(); ++r)
        for (const std::size_t topic : robots_[r].tf_static)
            add_fixed_links(model_->type_of(RobotId(r)), robots_[r].frames, stamp, fixed[topic]);
    std::set<std::string> odometry_frames;
    for (const Source& source : sources_) {
        const SensorInfo& info = model_->type_of(source.robot).sensors[source.sensor];
        const RobotPart& part = robots_[source.robot.index()];
        const auto add = [&](const std::string& parent, const std::string& child, const Transform& X) {
            for (const std::size_t topic : part.tf_static)
                fixed[topic].transforms.push_back(transform(stamp, parent, child, X));
        };
        if (part.is_link(source.frame)) continue;
        if (!source.frame.empty())
            add(part.frames[info.link.index()], source.frame, to_transform(info.spec.X_LS));
        if (const CameraOptics* optics = sensor_messages::optics_of(info.spec))
            add(source.frame, source.optical_frame, sensor_messages::X_optical(*optics));
        // With plain frames, others say where the odometry's frame is: a localization.
        if (sensor_messages::is_odometry(info.spec) && !part.is_plain &&
            odometry_frames.insert(source.odometry_frame).second)
            add("world", source.odometry_frame, source.X_WO);
    }
    for (const auto& [topic, frames] : fixed)
        if (wanted_[topic]) out.push_back({topic, to_cdr(frames)});
}

Result<> RobotTopics::add_moving_frames(Tick tick, std::span<const RobotState> states, const Measure& measure,
                                        std::vector<Message>& out) const {
    const Time stamp = stamp_of(*model_, tick);
    std::map<std::size_t, TFMessage> moving;  // by topic
    for (std::size_t r = 0; r < robots_.size(); ++r) {
        const RobotPart& part = robots_[r];
        if (std::ranges::none_of(part.tf, [&](std::size_t topic) { return wanted_[topic]; })) continue;
        std::optional<SeenBase> seen;
        const bool sees_base = part.is_plain && part.odometry != kNone;
        if (sees_base && !part.publishes_base) {
            seen.emplace();
        } else if (sees_base) {
            const Source& source = sources_[part.odometry];
            const Result<std::optional<Sample>> sample = measure(source.robot, source.sensor);
            if (!sample) return sample.error();
            if (!sample.value()) continue;
            seen = {source.odometry_frame, to_transform(sensor_messages::odometry_pose(*sample.value()))};
        }
        for (const std::size_t topic : part.tf)
            if (wanted_[topic])
                add_moving_links(model_->type_of(RobotId(r)), states[r], part.frames, seen, stamp,
                                 moving[topic]);
    }
    for (const auto& [topic, frames] : moving) out.push_back({topic, to_cdr(frames)});
    return Ok{};
}

void RobotTopics::add_robot_messages(Tick tick, RobotId robot, const RobotState& state,
                                     std::vector<Message>& out) const {
    const RobotPart& part = robots_[robot.index()];
    const Time stamp = stamp_of(*model_, tick);
    if (part.joint_states != 0 && wanted_[part.joint_states]) {
        JointStateMessage joints;
        joints.header.stamp = stamp;
        add_joint_states(*model_, robot, state, part.joints, "", joints);
        out.push_back({part.joint_states, to_cdr(joints)});
    }
    if (part.ground_truth != 0 && wanted_[part.ground_truth])
        out.push_back({part.ground_truth,
                       to_cdr(true_odometry(model_->type_of(robot), state, part.frames.front(), stamp))});
}

bool RobotTopics::is_due(const Source& source, Tick tick) const {
    const auto begin = wanted_.begin() + static_cast<std::ptrdiff_t>(source.first);
    if (std::find(begin, begin + static_cast<std::ptrdiff_t>(source.count), true) ==
        begin + static_cast<std::ptrdiff_t>(source.count))
        return false;
    return has_new_sample(model_->type_of(source.robot).sensors[source.sensor].spec, *model_, last_, tick);
}

void RobotTopics::add_readings(const Source& source, Tick tick, const Sample& sample,
                               std::vector<Message>& out) const {
    const SensorInfo& info = model_->type_of(source.robot).sensors[source.sensor];
    const SensorPlace place{*model_,
                            info,
                            source.frame,
                            robots_[source.robot.index()].frames[info.link.index()],
                            source.optical_frame,
                            robots_[source.robot.index()].frames.front(),
                            source.odometry_frame,
                            stamp_of(*model_, tick),
                            source.drive};
    std::size_t topic = source.first;
    publish(place, &sample, [&](const char*, const auto& message) {
        if (wanted_[topic]) out.push_back({topic, to_cdr(message)});
        ++topic;
    });
    if (bridged_) bridged_->add_forms(place, source.robot, source.sensor, sample, out);
}

Result<std::vector<RobotTopics::Message>> RobotTopics::messages(Tick tick, std::span<const RobotState> states,
                                                                const Measure& measure) {
    std::vector<Message> out;
    if (wanted_[kClock]) out.push_back({kClock, to_cdr(Clock{stamp_of(*model_, tick)})});
    if (Result<> added = add_moving_frames(tick, states, measure, out); !added) return added.error();
    for (std::size_t r = 0; r < robots_.size(); ++r) add_robot_messages(tick, RobotId(r), states[r], out);
    if (fleet_)
        if (Result<> added = fleet_->add_messages(tick, last_, states, wanted_, measure, out); !added)
            return added.error();
    for (const Source& source : sources_) {
        if (!is_due(source, tick)) continue;
        const Result<std::optional<Sample>> sample = measure(source.robot, source.sensor);
        if (!sample) return sample.error();
        if (sample.value()) add_readings(source, tick, *sample.value(), out);
    }
    if (bridged_) bridged_->finish(out);
    before_ = std::exchange(last_, tick);
    return out;
}

}  // namespace roboss::ros2
