// See events.h.
#include "client/events.h"

#include <cstdio>

#include "model/topics.h"

namespace roboss {
namespace {

std::string text_of(const ChannelValue& value, double number) {
    if (!value.words.empty()) {
        const auto word = static_cast<std::size_t>(number > 0 ? number : 0);
        return "\"" + (word >= 1 && word <= value.words.size() ? value.words[word - 1] : "") + "\"";
    }
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.9g", number);
    return buffer;
}

}  // namespace

std::vector<RobotEvent> events_on_board(const Model& model, RobotId board, const RobotState& state, Tick from,
                                        Tick to) {
    std::vector<RobotEvent> events;
    const RobotType& type = model.type_of(board);
    const MessageBoardSpec* spec = board_of(type);
    if (spec == nullptr) return events;
    for (const BoardTopic& topic : spec->topics) {
        const auto channel = type.find_channel(topic.name);
        if (!channel) continue;
        const ChannelInfo& info = type.channels[*channel];
        const auto at = static_cast<std::size_t>(info.index);
        const auto tick = static_cast<Tick>(state.onboard[at]);
        if (tick < from || tick >= to || tick < 0) continue;
        RobotEvent event;
        event.tick = tick, event.model = topic.model, event.topic = topic.topic;
        event.robot = model.find_robot(topic.model).value_or(RobotId());
        event.message = &info.channel;
        const auto first = state.onboard.begin() + static_cast<std::ptrdiff_t>(at) + 1;
        event.values.assign(first, first + static_cast<std::ptrdiff_t>(info.channel.values.size()));
        events.push_back(std::move(event));
    }
    return events;
}

std::string to_text(const RobotEvent& event) {
    std::string text = event.topic;
    for (std::size_t i = 0; i < event.values.size(); ++i)
        text +=
            " " + event.message->values[i].name + "=" + text_of(event.message->values[i], event.values[i]);
    return text;
}

}  // namespace roboss
