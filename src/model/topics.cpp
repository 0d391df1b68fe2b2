// See topics.h.
#include "model/topics.h"

namespace roboss {

std::string topic_of(const Model& model, const TopicPlace& place) {
    std::string topic = model.type_of(place.robot).channels[place.channel].channel.topic;
    constexpr std::string_view kModel = "{model}";
    if (const std::size_t at = topic.find(kModel); at != std::string::npos)
        topic.replace(at, kModel.size(), model.robots[place.robot.index()].name);
    return topic;
}

std::vector<TopicPlace> find_topic(const Model& model, const std::string& topic) {
    std::vector<TopicPlace> places;
    for (std::size_t r = 0; r < model.robots.size(); ++r) {
        const std::size_t channels = model.type_of(RobotId(r)).channels.size();
        for (std::uint32_t c = 0; c < channels; ++c)
            if (topic_of(model, {RobotId(r), c}) == topic) places.push_back({RobotId(r), c});
    }
    return places;
}

const MessageBoardSpec* board_of(const RobotType& type) {
    for (const OnboardInfo& info : type.onboard)
        if (const auto* board = std::get_if<MessageBoardSpec>(&info.spec.parameters)) return board;
    return nullptr;
}

Transform robot_pose(const RobotType& type, const Pose& X_WB) {
    return type.free_base ? to_transform(X_WB) * inverse(type.X_RB) : to_transform(X_WB);
}

}  // namespace roboss
