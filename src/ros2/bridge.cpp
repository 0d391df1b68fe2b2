// See bridge.h.
#include "ros2/bridge.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "core/similar.h"
#include "ros2/file_line.h"
#include "ros2/robot_names.h"
#include "ros2_types/messages/sensor_messages.h"

namespace roboss::ros2 {

namespace {

constexpr std::size_t kUnknownMost = 20;  // entries without a topic that get a notice of their own
constexpr std::size_t kNearestMost = 3;

/// The names that are most like this one, as "/lidar, /lidar/points".
std::string nearest_topics(const std::string& wanted, std::span<const GazeboTopic> topics) {
    std::set<std::string> names;
    for (const GazeboTopic& topic : topics) names.insert(topic.name);
    std::string text;
    for (const std::string& name : most_alike(wanted, {names.begin(), names.end()}, kNearestMost))
        text += (text.empty() ? "" : ", ") + name;
    return text;
}

std::string type_names(const GazeboTopic& topic) {
    std::string text;
    for (const MessageType* type : topic.types) text += (text.empty() ? "" : " or ") + type->name;
    return text;
}

class BridgeMatcher {
  public:
    BridgeMatcher(const Bridge& bridge, const Model& model)
        : bridge_(bridge), topics_(gazebo_topics(model)), world_("/world/" + ros_name(model.name)) {
        for (std::size_t t = 0; t < topics_.size(); ++t) by_name_.emplace(topics_[t].name, t);
        types_ = {{"/clock", &type_of<Clock>()},
                  {"/tf", &type_of<TFMessage>()},
                  {"/tf_static", &type_of<TFMessage>()}};
    }

    BridgeMatch match_all() {
        result_.notices = bridge_.notices;
        for (const BridgeEntry& entry : bridge_.entries)
            entry.is_service ? match_service(entry) : match_topic(entry);
        if (unknown_ > kUnknownMost)
            result_.notices.push_back(bridge_.file + ": " + std::to_string(unknown_ - kUnknownMost) +
                                      " more entries name topics that this world does not have [bridge]");
        return std::move(result_);
    }

  private:
    void notice(const BridgeEntry& entry, const std::string& text) {
        result_.notices.push_back(at_line(bridge_.file, entry.line) + entry.gz_name + ": " + text +
                                  " [bridge]");
    }

    void match_service(const BridgeEntry& entry) {
        static constexpr std::array<std::pair<const char*, const char*>, 4> kServices{
            {{"/create", "SpawnEntity"},
             {"/remove", "DeleteEntity"},
             {"/set_pose", "SetEntityPose"},
             {"/control", "ControlWorld"}}};
        std::string all;
        for (const auto& [name, type] : kServices) {
            const std::string full_type = std::string("ros_gz_interfaces/srv/") + type;
            if (entry.ros_name == world_ + name) {
                if (entry.type != full_type) notice(entry, "the type of this service is " + full_type);
                return;
            }
            all += (all.empty() ? "" : ", ") + world_ + name;
        }
        notice(entry, "there is no such service; there are: " + all);
    }

    void match_topic(const BridgeEntry& entry) {
        const auto [begin, end] = by_name_.equal_range(entry.gz_name);
        if (begin == end) {
            if (++unknown_ <= kUnknownMost)
                notice(entry, "this world has no such topic; the nearest: " +
                                  nearest_topics(entry.gz_name, topics_));
            return;
        }
        std::vector<std::size_t> fitting;
        for (auto at = begin; at != end; ++at)
            if (fits(entry.direction, topics_[at->second])) fitting.push_back(at->second);
        std::ranges::sort(fitting);  // by robot
        const GazeboTopic& any = topics_[begin->second];
        if (fitting.empty())
            return notice(entry, any.kind == GazeboTopic::Kind::kCommand
                                     ? "it drives a robot, so GZ_TO_ROS has no effect; write ROS_TO_GZ"
                                     : "robots send on it, so ROS_TO_GZ has no effect; write GZ_TO_ROS");
        bool is_made = false;
        for (const std::size_t t : fitting) is_made |= add(entry, topics_[t]);
        if (!is_made)
            notice(entry, "it cannot be of the type " + entry.type + ", but of " +
                              type_names(topics_[fitting.front()]));
    }

    static bool fits(BridgeEntry::Direction direction, const GazeboTopic& topic) {
        if (direction == BridgeEntry::Direction::kBoth) return true;
        return (topic.kind == GazeboTopic::Kind::kCommand) ==
               (direction == BridgeEntry::Direction::kToGazebo);
    }

    /// False: the topic cannot have the type of the entry.
    bool add(const BridgeEntry& entry, const GazeboTopic& topic) {
        const auto type = std::ranges::find(topic.types, entry.type, &MessageType::name);
        if (type == topic.types.end()) return false;
        const auto [known, is_new] = types_.emplace(entry.ros_name, *type);
        if (!is_new && known->second != *type) {
            notice(entry, entry.ros_name + " has the type " + known->second->name +
                              " already, so it keeps its usual name; give another ros_topic_name");
            return true;
        }
        const auto key =
            std::tuple(entry.ros_name, *type, topic.kind, topic.robot, topic.number, topic.message);
        if (!added_.insert(key).second) return true;
        result_.names.insert(entry.ros_name);
        result_.topics.push_back({topic, entry.ros_name, *type});
        return true;
    }

    const Bridge& bridge_;
    const std::vector<GazeboTopic> topics_;
    const std::string world_;
    std::unordered_multimap<std::string, std::size_t> by_name_;  // in topics_
    std::map<std::string, const MessageType*> types_;            // by name in ROS 2
    std::set<
        std::tuple<std::string, const MessageType*, GazeboTopic::Kind, RobotId, std::size_t, std::size_t>>
        added_;
    std::size_t unknown_ = 0;
    BridgeMatch result_;
};

}  // namespace

BridgeMatch match_bridge(const Bridge& bridge, const Model& model) {
    return BridgeMatcher(bridge, model).match_all();
}

}  // namespace roboss::ros2
