// See message_board.h.
#include "onboard_kinds/message_board.h"

namespace roboss {

std::vector<Channel> MessageBoardSpec::channels() const {
    std::vector<std::string> texts;
    for (const BoardWord& word : words) texts.push_back(word.text);
    std::vector<Channel> channels;
    for (const BoardTopic& topic : topics) {
        Channel channel;
        channel.name = topic.name, channel.topic = topic.topic;
        for (const BoardValue& value : topic.values)
            channel.values.push_back({value.name, "", value.is_text ? texts : std::vector<std::string>{}});
        channels.push_back(std::move(channel));
    }
    return channels;
}

}  // namespace roboss
