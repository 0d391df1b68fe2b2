// See bridged_topics.h.
#include "ros2/bridged_topics.h"

#include <map>
#include <utility>

#include "ros2/robot_names.h"
#include "ros2_types/cdr.h"

namespace roboss::ros2 {

BridgedTopics::BridgedTopics(const BridgeMatch& bridge, std::vector<Topic>& topics, const UsualTopic& usual)
    : is_named_(topics.size(), false) {
    const std::size_t before = topics.size();
    for (const BridgedTopic& bridged : bridge.topics) {
        if (bridged.topic.kind == GazeboTopic::Kind::kCommand) continue;
        if (const std::optional<std::size_t> place = usual(bridged.topic)) add(bridged, *place, topics);
    }
    std::set<std::string> taken = bridge.names;
    for (std::size_t t = RobotTopics::kTfStatic + 1; t < before; ++t)
        if (!is_named_[t]) topics[t].name = unique_name(topics[t].name, taken);
    wanted_.assign(topics.size(), true);
}

void BridgedTopics::add(const BridgedTopic& bridged, std::size_t usual, std::vector<Topic>& topics) {
    // The world's own topics, which have all frames and the clock, keep these names.
    const bool is_of_world = usual <= RobotTopics::kTfStatic;
    if (is_of_world && (bridged.name == "/clock" || bridged.name == "/tf" || bridged.name == "/tf_static"))
        return;
    const bool has_type = bridged.type == topics[usual].type;
    if (!is_of_world && has_type && !is_named_[usual]) {
        topics[usual].name = bridged.name;
        is_named_[usual] = true;
        return;
    }
    const RobotId robot = bridged.topic.robot;
    if (is_of_world && robot.valid())
        frames_.emplace_back(robot, topics.size());
    else if (has_type)
        copies_.push_back({usual, topics.size()});
    else
        forms_.push_back(
            {usual, topics.size(), robot, bridged.topic.number, bridged.type == &type_of<LaserScan>()});
    topics.push_back({bridged.name, bridged.type, topics[usual].is_latched, robot});
}

std::vector<bool> BridgedTopics::needed(std::vector<bool> wanted) {
    wanted_ = std::move(wanted);
    std::vector<bool> needed = wanted_;
    for (const auto& [usual, topic] : copies_)
        if (wanted_[topic]) needed[usual] = true;
    for (const Form& form : forms_)
        if (wanted_[form.topic]) needed[form.usual] = true;
    return needed;
}

void BridgedTopics::add_forms(const SensorPlace& place, RobotId robot, std::size_t sensor,
                              const Sample& sample, std::vector<RobotTopics::Message>& out) const {
    for (const Form& form : forms_) {
        if (form.robot != robot || form.sensor != sensor || !wanted_[form.topic]) continue;
        const auto& laser = *place.info.spec.as<LaserSpec>();
        const auto& reading = std::get<LaserReading>(sample);
        out.push_back({form.topic, form.is_scan ? to_cdr(sensor_messages::scan(laser, reading, place))
                                                : to_cdr(sensor_messages::cloud(laser, reading, place))});
    }
}

void BridgedTopics::finish(std::vector<RobotTopics::Message>& messages) const {
    std::map<std::size_t, std::string> usual;  // their messages
    for (const Copy& copy : copies_)
        if (wanted_[copy.topic]) usual[copy.usual];
    for (const RobotTopics::Message& message : messages)
        if (const auto found = usual.find(message.topic); found != usual.end()) found->second = message.bytes;
    for (const Copy& copy : copies_)
        if (wanted_[copy.topic] && !usual[copy.usual].empty())
            messages.push_back({copy.topic, usual[copy.usual]});
    std::erase_if(messages, [&](const RobotTopics::Message& message) { return !wanted_[message.topic]; });
}

}  // namespace roboss::ros2
