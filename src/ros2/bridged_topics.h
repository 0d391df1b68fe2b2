// Gives the topics of RobotTopics the names and types of a bridge's file. Where an entry cannot take the
// place of a usual topic, since it wants another form of its messages, or since another entry has it, there
// is a topic more, made from the messages of the usual one.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ros2/bridge.h"
#include "ros2/robot_topics.h"
#include "ros2/sensor_messages.h"

namespace roboss::ros2 {

/// See the top of the file.
class BridgedTopics {
  public:
    /// The number of the usual topic of a thing; none: it has none here.
    using UsualTopic = std::function<std::optional<std::size_t>(const GazeboTopic&)>;

    /// Renames `topics`, but for those of the world, and adds others behind them.
    BridgedTopics(const BridgeMatch& bridge, std::vector<Topic>& topics, const UsualTopic& usual);

    /// Topics that were added for the frames of one robot alone.
    const std::vector<std::pair<RobotId, std::size_t>>& frames_of_robots() const { return frames_; }

    /// The topics whose messages must be made so that the wanted ones have theirs.
    std::vector<bool> needed(std::vector<bool> wanted);
    /// Adds the messages of a sensor in other forms.
    void add_forms(const SensorPlace& place, RobotId robot, std::size_t sensor, const Sample& sample,
                   std::vector<RobotTopics::Message>& out) const;
    /// Adds the other messages of topics of its own, and removes those that are not wanted.
    void finish(std::vector<RobotTopics::Message>& messages) const;

  private:
    /// A topic with the messages of a usual one.
    struct Copy {
        std::size_t usual = 0, topic = 0;
    };
    /// A topic with the readings of a laser in another form.
    struct Form {
        std::size_t usual = 0, topic = 0;
        RobotId robot;
        std::size_t sensor = 0;
        bool is_scan = false;  // else a cloud
    };

    void add(const BridgedTopic& bridged, std::size_t usual, std::vector<Topic>& topics);

    std::vector<bool> wanted_, is_named_;
    std::vector<Copy> copies_;
    std::vector<Form> forms_;
    std::vector<std::pair<RobotId, std::size_t>> frames_;
};

}  // namespace roboss::ros2
