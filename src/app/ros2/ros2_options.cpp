// See ros2_options.h.
#include "app/ros2/ros2_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <sstream>

#include "app/commands/numbers.h"

namespace roboss {
namespace {

constexpr std::uint32_t kDomainMost = 232;  // ports of greater ones do not exist

std::string or_environment(const std::string& given, const char* name) {
    const char* value = std::getenv(name);
    return !given.empty() || value == nullptr ? given : value;
}

Result<std::uint32_t> domain_of(const std::string& text) {
    std::uint32_t domain = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), domain);
    if (!text.empty() && (error != std::errc() || end != text.data() + text.size() || domain > kDomainMost))
        return Error{"the domain '" + text + "' is no number from 0 to " + std::to_string(kDomainMost),
                     "correct --domain or ROS_DOMAIN_ID", "bad-domain"};
    return domain;
}

Result<ros2::TransportOptions::Reach> reach_of(std::string text) {
    using Reach = ros2::TransportOptions::Reach;
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    if (text.empty() || text == "localhost" || text == "system_default") return Reach::kLocalhost;
    if (text == "subnet") return Reach::kSubnet;
    if (text == "off") return Reach::kOff;
    return Error{"discovery cannot reach '" + text + "'",
                 "give off, localhost or subnet (--reach, ROS_AUTOMATIC_DISCOVERY_RANGE)", "bad-reach"};
}

/// "localhost" where ROS_LOCALHOST_ONLY, which came before ROS_AUTOMATIC_DISCOVERY_RANGE, says so.
std::string reach_given(const Ros2Options& o) {
    if (!o.reach.empty()) return o.reach;
    if (or_environment("", "ROS_LOCALHOST_ONLY") == "1") return "localhost";
    return or_environment("", "ROS_AUTOMATIC_DISCOVERY_RANGE");
}

/// An option that takes a file, read at once.
template <class Content>
void add_file_option(CLI::App& command, const std::string& name,
                     Result<Content> (*read)(const std::filesystem::path&),
                     std::shared_ptr<const Content>& content, const std::string& help) {
    const auto take = [name, read, &content](const std::string& file) {
        Result<Content> found = read(file);
        if (!found) throw CLI::ValidationError(name, found.error().message + "; " + found.error().remedy);
        content = std::make_shared<const Content>(std::move(found).value());
    };
    command.add_option_function<std::string>(name, take, help)->type_name("FILE");
}

}  // namespace

void add_controllers_option(CLI::App& command, const std::string& name,
                            std::shared_ptr<const ros2::Controllers>& controllers) {
    add_file_option(command, name, ros2::read_controllers, controllers,
                    "YAML file of ros2_control: robots have its controllers of joints and wheels, by their "
                    "names");
}

void add_face_options(CLI::App& command, ros2::FaceOptions& face, const std::string& prefix) {
    command
        .add_option(prefix + "period", face.period_s,
                    "simulated time between two looks at the world, s (default: that of the fastest sensor, "
                    "at most 0.02)")
        ->check(positive_number());
    ros2::TopicOptions& topics = face.topics;
    command.add_flag(prefix + "stamped", topics.stamped,
                     "velocity commands are geometry_msgs/TwistStamped before a node publishes Twist");
    command.add_flag(
        prefix + "plain-frames", topics.plain_frames,
        "frames without the robot's name, tf and tf_static in its namespace, its base in odom, as "
        "Nav2 wants them");
    command
        .add_option(prefix + "root", topics.root,
                    "this robot has no namespace, and plain frames: /cmd_vel, /scan, /tf")
        ->type_name("ROBOT");
    command.add_flag(prefix + "ground-truth", topics.ground_truth,
                     "where each robot is, as /ROBOT/ground_truth (nav_msgs/Odometry)");
    command.add_flag(prefix + "fleet", topics.fleet,
                     "all robots in one message: /fleet/states, /fleet/scans, /fleet/cmd_vel ...");
    add_file_option(
        command, prefix + "bridge", ros2::read_bridge, topics.bridge,
        "YAML file of ros_gz_bridge: the topics of Gazebo that it names have its names and types");
    add_controllers_option(command, prefix + "controllers", topics.controllers);
    command
        .add_option(prefix + "services", face.services.simulation.prefix,
                    "what stands in front of the names of simulation_interfaces, e.g. /gzserver (default: "
                    "nothing)")
        ->type_name("PREFIX");
}

void add_ros2_options(CLI::App& command, Ros2Options& o, const std::string& prefix) {
    command
        .add_option(prefix + "lockstep", o.face.lockstep,
                    "the world waits in each period for a message of this topic, e.g. '/*/cmd_vel' (may be "
                    "repeated): the same nodes then give the same run, to the last bit")
        ->type_name("TOPIC");
    add_face_options(command, o.face, prefix);
    command.add_option(prefix + "distro", o.distro, "ROS 2 of the other nodes")
        ->check(CLI::IsMember({"humble", "jazzy", "kilted", "lyrical"}))
        ->capture_default_str();
    command.add_option(prefix + "domain", o.domain, "ROS domain, 0 to 232 (default: ROS_DOMAIN_ID, else 0)");
    command
        .add_option(prefix + "reach", o.reach,
                    "how far discovery reaches: off, localhost or subnet, for nodes on other computers "
                    "(default: ROS_AUTOMATIC_DISCOVERY_RANGE, else localhost)")
        ->check(CLI::IsMember({"off", "localhost", "subnet"}));
    command.add_option(prefix + "peer", o.peers,
                       "a host where other nodes are (may be repeated; default: ROS_STATIC_PEERS)");
    command.add_option(prefix + "discovery-server", o.discovery_server,
                       "HOST:PORT;... of discovery servers (default: ROS_DISCOVERY_SERVER)");
}

void add_face_arguments(std::vector<std::string>& words, const ros2::FaceOptions& face) {
    if (face.period_s > 0) words.insert(words.end(), {"--period", fmt::format("{}", face.period_s)});
    const ros2::TopicOptions& topics = face.topics;
    if (topics.stamped) words.emplace_back("--stamped");
    if (topics.plain_frames) words.emplace_back("--plain-frames");
    if (!topics.root.empty()) words.insert(words.end(), {"--root", topics.root});
    if (topics.ground_truth) words.emplace_back("--ground-truth");
    if (topics.fleet) words.emplace_back("--fleet");
    if (topics.bridge) words.insert(words.end(), {"--bridge", topics.bridge->file});
    if (topics.controllers) words.insert(words.end(), {"--controllers", topics.controllers->file});
    if (!face.services.simulation.prefix.empty())
        words.insert(words.end(), {"--services", face.services.simulation.prefix});
}

std::vector<std::string> ros2_arguments(const Ros2Options& o) {
    std::vector<std::string> words{"roboss", "ros2", "--distro", o.distro};
    const auto add = [&](const char* option, const std::string& value) {
        if (!value.empty()) words.insert(words.end(), {option, value});
    };
    add_face_arguments(words, o.face);
    for (const std::string& topic : o.face.lockstep) add("--lockstep", topic);
    for (const std::string& peer : o.peers) add("--peer", peer);
    add("--domain", o.domain);
    add("--reach", o.reach);
    add("--discovery-server", o.discovery_server);
    return words;
}

ros2::FaceOptions face_options(const Ros2Options& o) {
    ros2::FaceOptions options = o.face;
    const bool is_newest = o.distro == "lyrical";
    options.services.simulation.version = is_newest ? 2 : 1;
    options.services.older_feedback = !is_newest;
    return options;
}

Result<ros2::TransportOptions> transport_options(const Ros2Options& o) {
    const Result<std::uint32_t> domain = domain_of(or_environment(o.domain, "ROS_DOMAIN_ID"));
    if (!domain) return domain.error();
    const auto reach = reach_of(reach_given(o));
    if (!reach) return reach.error();
    ros2::TransportOptions options;
    options.domain = domain.value(), options.reach = reach.value();
    options.peers = o.peers;
    if (options.peers.empty()) {
        std::istringstream listed(or_environment("", "ROS_STATIC_PEERS"));
        for (std::string peer; std::getline(listed, peer, ';');)
            if (!peer.empty()) options.peers.push_back(peer);
    }
    options.discovery_server = or_environment(o.discovery_server, "ROS_DISCOVERY_SERVER");
    options.has_long_gids = o.distro == "humble";
    return options;
}

}  // namespace roboss
