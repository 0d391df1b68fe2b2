// See bridge_file.h. An entry is a map of plain values, so nothing here follows aliases further; the limits
// below bound the rest, also what is copied from them.
#include "ros2/bridge_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <map>
#include <optional>
#include <string_view>

#include "ros2/robot_names.h"
#include "ros2/yaml_file.h"
#include "ros2_types/type_description.h"

namespace roboss::ros2 {

namespace {

constexpr std::size_t kEntriesMost = 10'000, kKeysMost = 64;
constexpr std::size_t kValueMost = 1'000;             // characters: an alias makes many of one
constexpr std::size_t kQuoted = 60;                   // characters of a key that is not known
constexpr std::size_t kNoticesMost = 1'000;           // of a file
constexpr const char* kBridgeNode = "ros_gz_bridge";  // "~/scan" is "/ros_gz_bridge/scan"

constexpr std::array kBridgeKeys{"topic_name",
                                 "ros_topic_name",
                                 "gz_topic_name",
                                 "ign_topic_name",
                                 "ros_type_name",
                                 "gz_type_name",
                                 "ign_type_name",
                                 "direction",
                                 "publisher_queue",
                                 "subscriber_queue",
                                 "lazy",
                                 "qos_profile",
                                 "service_name",
                                 "gz_req_type_name",
                                 "gz_rep_type_name",
                                 "ign_req_type_name",
                                 "ign_rep_type_name"};

Error bad_bridge(const std::string& where, const std::string& what, const std::string& remedy) {
    return {where + what, remedy, "bad-bridge"};
}

/// The name as a node "/ros_gz_bridge" resolves it.
std::string absolute(const std::string& name) {
    if (name == "~" || name.starts_with("~/")) return "/" + std::string(kBridgeNode) + name.substr(1);
    return (name.starts_with('/') ? "" : "/") + name;
}

/// The text of a file with YAML, entry by entry.
class BridgeReader {
  public:
    explicit BridgeReader(std::string file) { bridge_.file = std::move(file); }

    Result<Bridge> read(const YAML::Node& all) {
        if (!all.IsSequence())
            return bad_bridge(bridge_.file + ": ", "it is no list of entries",
                              "begin each entry with '- ', as in '- topic_name: /clock'");
        if (all.size() > kEntriesMost)
            return bad_bridge(bridge_.file + ": ",
                              "it has more than " + std::to_string(kEntriesMost) + " entries",
                              "divide the world or the file");
        for (const YAML::Node& entry : all)
            if (Result<> added = add(entry); !added) return added.error();
        return std::move(bridge_);
    }

  private:
    using Values = std::map<std::string, std::string>;

    std::string where(const YAML::Node& node) const { return at_line(bridge_.file, node.Mark().line + 1); }

    /// The keys of an entry with their values. An Error: it has other things, or a key twice.
    Result<Values> values_of(const YAML::Node& entry) {
        if (!entry.IsMap() || entry.size() > kKeysMost)
            return bad_bridge(where(entry), "an entry is no map of keys to values",
                              "write 'topic_name: ...', 'ros_type_name: ...' and 'gz_type_name: ...'");
        static const std::string kNone;
        Values values;
        for (const auto& pair : entry) {
            const std::string& key = pair.first.IsScalar() ? pair.first.Scalar() : kNone;
            if (std::ranges::find(kBridgeKeys, std::string_view(key)) == kBridgeKeys.end()) {
                if (bridge_.notices.size() < kNoticesMost)
                    bridge_.notices.push_back(where(pair.first) + "the key '" + key.substr(0, kQuoted) +
                                              "' has no effect [bridge-key]");
                continue;
            }
            if (!pair.second.IsScalar())
                return bad_bridge(where(pair.first), key + " has no value that is a plain text",
                                  "write one, or leave the key out");
            if (pair.second.Scalar().size() > kValueMost)
                return bad_bridge(where(pair.first), key + " has more than 1000 characters",
                                  "give a shorter one");
            if (!values.emplace(key, pair.second.Scalar()).second)
                return bad_bridge(where(pair.first), key + " is there twice", "remove one of them");
        }
        return values;
    }

    Result<> add(const YAML::Node& node) {
        Result<Values> read = values_of(node);
        if (!read) return read.error();
        Values& values = read.value();
        for (const char* key : {"topic_name", "type_name"}) {
            const auto older = values.find(std::string("ign_") + key);
            if (older != values.end()) values.emplace(std::string("gz_") + key, older->second);
        }
        BridgeEntry entry;
        entry.line = node.Mark().line + 1;
        if (Result<> good = check_options(node, values, entry); !good) return good.error();
        Result<> named = values.contains("service_name") ? name_service(node, values, entry)
                                                         : name_topic(node, values, entry);
        if (!named) return named.error();
        if (const std::string problem = problem_of_name(entry.ros_name); !problem.empty())
            return bad_bridge(where(node), "the name '" + entry.ros_name + "' in ROS 2 " + problem,
                              "give another ros_topic_name");
        bridge_.entries.push_back(std::move(entry));
        return Ok{};
    }

    Result<> name_topic(const YAML::Node& node, Values& values, BridgeEntry& entry) {
        const std::string &both = values["topic_name"], &ros = values["ros_topic_name"],
                          &gazebo = values["gz_topic_name"];
        if (!both.empty() && !(ros.empty() && gazebo.empty()))
            return bad_bridge(where(node),
                              "topic_name and " + std::string(ros.empty() ? "gz" : "ros") +
                                  "_topic_name exclude each other",
                              "give topic_name alone, or ros_topic_name and gz_topic_name");
        if (both.empty() && ros.empty() && gazebo.empty())
            return bad_bridge(where(node), "an entry names no topic",
                              "give topic_name, or ros_topic_name and "
                              "gz_topic_name");
        if (values["ros_type_name"].empty() || values["gz_type_name"].empty())
            return bad_bridge(where(node), "ros_type_name or gz_type_name is missing",
                              "give both, as in 'ros_type_name: std_msgs/msg/String' and 'gz_type_name: "
                              "gz.msgs.StringMsg'");
        const auto first_of = [](const std::string& a, const std::string& b, const std::string& c) {
            return !a.empty() ? a : !b.empty() ? b : c;
        };
        entry.ros_name = absolute(first_of(both, ros, gazebo));
        entry.gz_name = gazebo_name(first_of(both, gazebo, ros));
        entry.type = full_type_name(values["ros_type_name"]);
        return Ok{};
    }

    Result<> name_service(const YAML::Node& node, Values& values, BridgeEntry& entry) {
        if (values["service_name"].empty() || values["ros_type_name"].empty())
            return bad_bridge(where(node), "service_name or ros_type_name is empty",
                              "give both, as in 'ros_type_name: ros_gz_interfaces/srv/ControlWorld'");
        entry.is_service = true;
        entry.ros_name = absolute(values["service_name"]),
        entry.gz_name = gazebo_name(values["service_name"]);
        entry.type = full_type_name(values["ros_type_name"], "srv");
        return Ok{};
    }

    /// The direction, and the form of values that have no effect here.
    Result<> check_options(const YAML::Node& node, const Values& values, BridgeEntry& entry) {
        using Direction = BridgeEntry::Direction;
        static const std::map<std::string_view, Direction> kDirections{{"BIDIRECTIONAL", Direction::kBoth},
                                                                       {"GZ_TO_ROS", Direction::kToRos},
                                                                       {"ROS_TO_GZ", Direction::kToGazebo},
                                                                       {"IGN_TO_ROS", Direction::kToRos},
                                                                       {"ROS_TO_IGN", Direction::kToGazebo}};
        for (const auto& [key, value] : values) {
            if (key == "direction") {
                const auto direction = kDirections.find(value);
                if (direction == kDirections.end())
                    return bad_bridge(where(node[key]), "there is no direction '" + value + "'",
                                      "write BIDIRECTIONAL, GZ_TO_ROS or ROS_TO_GZ");
                entry.direction = direction->second;
            }
            if (key == "publisher_queue" || key == "subscriber_queue") {
                std::size_t count = 0;
                const char* const end = value.data() + value.size();
                if (const auto read = std::from_chars(value.data(), end, count);
                    read.ec != std::errc() || read.ptr != end)
                    return bad_bridge(where(node[key]), key + " is '" + value + "'",
                                      "write a number of messages");
            }
            bool is_lazy = false;
            if (key == "lazy" && !YAML::convert<bool>::decode(node[key], is_lazy))
                return bad_bridge(where(node[key]), "lazy is '" + value + "'", "write true or false");
        }
        return Ok{};
    }

    Bridge bridge_;
};

}  // namespace

std::string gazebo_name(const std::string& name) {
    std::string result = name.starts_with('/') ? "" : "/";
    for (const char c : name) result += std::isspace(static_cast<unsigned char>(c)) ? '_' : c;
    while (result.size() > 1 && result.ends_with('/')) result.pop_back();
    return result;
}

Result<Bridge> parse_bridge(const std::string& file, const std::string& text) {
    return parse_yaml(file, text, "bad-bridge",
                      [&](const YAML::Node& all) { return BridgeReader(file).read(all); });
}

Result<Bridge> read_bridge(const std::filesystem::path& file) {
    const Result<std::string> text = read_yaml_text(file, "bad-bridge", "give a file of ros_gz_bridge");
    return text ? parse_bridge(file.string(), text.value()) : Result<Bridge>(text.error());
}

}  // namespace roboss::ros2
