// See bridged_commands.h.
#include "ros2/bridged_commands.h"

#include <algorithm>
#include <map>
#include <utility>

#include "ros2/robot_names.h"
#include "ros2_types/messages/command_messages.h"

namespace roboss::ros2 {

void name_commands(const BridgeMatch& bridge, const Model& model, std::vector<CommandTopic>& topics) {
    const std::size_t usual = topics.size();
    std::map<std::pair<RobotId, std::uint32_t>, std::size_t> places;
    for (std::size_t t = 0; t < usual; ++t)
        if (topics[t].kind != CommandTopic::Kind::kSetpoints)
            places[{topics[t].robot, topics[t].channel}] = t;
    std::vector<bool> is_named(usual, false);
    for (const BridgedTopic& bridged : bridge.topics) {
        if (bridged.topic.kind != GazeboTopic::Kind::kCommand) continue;
        const auto channel = static_cast<std::uint32_t>(bridged.topic.number);
        const std::size_t place = places.at({bridged.topic.robot, channel});
        CommandTopic topic = topics[place];
        const bool stamped = bridged.type == &type_of<TwistStamped>();
        std::tie(topic.kind, topic.type) =
            message_of(model.type_of(topic.robot).channels[channel].channel, stamped);
        topic.name = bridged.name;
        if (is_named[place])
            topics.push_back(std::move(topic));
        else
            topics[place] = std::move(topic), is_named[place] = true;
    }
    std::set<std::string> taken = bridge.names;
    for (std::size_t t = 0; t < usual; ++t)
        if (!is_named[t]) topics[t].name = unique_name(topics[t].name, taken);
    std::ranges::stable_sort(topics, {}, &CommandTopic::robot);
}

}  // namespace roboss::ros2
