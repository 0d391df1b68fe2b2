// See world_names.h.
#include "app/worlds/world_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>
#include <utility>

#include "model/topics.h"
#include "world/joint_type.h"

namespace roboss {
namespace {

constexpr std::size_t kLongestListed = 4;  // of consecutive numbers

TypeNames type_names(const RobotType& type) {
    TypeNames names;
    names.type = type.name;
    for (const Link& link : type.links) names.links.push_back(link.name);
    for (const Joint& joint : type.joints)
        names.joints.push_back({joint.name, std::string(joint_type(joint.kind).name)});
    for (const SensorInfo& sensor : type.sensors)
        names.sensors.push_back({sensor.spec.name, sensor.spec.kind().name});
    for (const ChannelInfo& info : type.channels) names.commands.push_back(info.channel.name);
    return names;
}

/// The frames of the robot's model that are fixed to one of the robot's links.
std::vector<NamedFrame> frames_of(const World& world, const Robot& robot, const TypeNames& names) {
    std::vector<NamedFrame> frames;
    if (robot.family >= world.instances.size()) return frames;
    for (const FrameSpec& frame : world.prototypes[world.instances[robot.family].prototype].frames)
        if (std::ranges::find(names.links, frame.link) != names.links.end())
            frames.push_back({frame.name, frame.link});
    return frames;
}

/// "car_7" as "car_" and 7; nullopt: it does not end in a number that is written without leading zeros.
std::optional<std::pair<std::string, long>> split_number(const std::string& name) {
    std::size_t digits = name.size();
    while (digits > 0 && name[digits - 1] >= '0' && name[digits - 1] <= '9') --digits;
    long number = 0;
    const char* end = name.data() + name.size();
    const auto [stop, error] = std::from_chars(name.data() + digits, end, number);
    if (digits == name.size() || error != std::errc() || stop != end) return std::nullopt;
    if (name[digits] == '0' && name.size() > digits + 1) return std::nullopt;
    return std::pair{name.substr(0, digits), number};
}

/// How many names from `first` on have consecutive numbers.
std::size_t run_length(const std::vector<std::string>& names, std::size_t first) {
    const auto begin = split_number(names[first]);
    if (!begin) return 1;
    std::size_t length = 1;
    while (first + length < names.size() &&
           split_number(names[first + length]) ==
               std::pair{begin->first, begin->second + static_cast<long>(length)})
        ++length;
    return length;
}

void add_line(std::string& text, const char* what, const std::string& list) {
    if (!list.empty()) text += fmt::format("    {:9} {}\n", what, list);
}

std::string listed(const std::vector<NamedThing>& things) {
    std::string list;
    for (const NamedThing& thing : things)
        list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", thing.name, thing.kind);
    return list;
}

std::string listed(const std::vector<NamedFrame>& frames) {
    std::string list;
    for (const NamedFrame& frame : frames)
        list += fmt::format("{}{} (on {})", list.empty() ? "" : ", ", frame.name, frame.link);
    return list;
}

nlohmann::json frames_to_json(const std::vector<NamedFrame>& frames) {
    nlohmann::json list = nlohmann::json::array();
    for (const NamedFrame& frame : frames) list.push_back({{"name", frame.name}, {"link", frame.link}});
    return list;
}

nlohmann::json things_to_json(const std::vector<NamedThing>& things) {
    nlohmann::json list = nlohmann::json::array();
    for (const NamedThing& thing : things) list.push_back({{"name", thing.name}, {"kind", thing.kind}});
    return list;
}

/// The place of what has these names, at the end if nothing has them yet: types that differ in what has no
/// name here, such as their topics, are listed together.
std::size_t place_in(std::vector<TypeNames>& all, TypeNames names) {
    const auto is_alike = [&](const TypeNames& other) {
        return std::tie(other.links, other.joints, other.sensors, other.frames, other.commands) ==
               std::tie(names.links, names.joints, names.sensors, names.frames, names.commands);
    };
    const auto found = std::ranges::find_if(all, is_alike);
    if (found != all.end()) return static_cast<std::size_t>(found - all.begin());
    all.push_back(std::move(names));
    return all.size() - 1;
}

}  // namespace

std::vector<TypeNames> list_names(const Model& model, const World& world) {
    std::vector<std::size_t> places(model.types.size(), model.types.size());  // in `all`
    std::vector<TypeNames> all;
    for (const Robot& robot : model.robots) {
        const RobotType& type = model.types[robot.type.index()];
        if (board_of(type) != nullptr) continue;
        std::size_t& place = places[robot.type.index()];
        if (place == model.types.size()) {
            TypeNames names = type_names(type);
            names.frames = frames_of(world, robot, names);
            place = place_in(all, std::move(names));
        }
        all[place].robots.push_back(robot.name);
    }
    return all;
}

std::string shortened(const std::vector<std::string>& names) {
    std::string list;
    for (std::size_t i = 0; i < names.size();) {
        const std::size_t length = run_length(names, i);
        const std::size_t shown = length > kLongestListed ? 1 : length;
        for (std::size_t k = 0; k < shown; ++k) list += (list.empty() ? "" : ", ") + names[i + k];
        if (shown < length) list += fmt::format(" ... {} ({})", names[i + length - 1], length);
        i += length;
    }
    return list;
}

std::string to_text(const std::vector<TypeNames>& types) {
    std::string text;
    for (const TypeNames& type : types) {
        text += fmt::format("names of       {}\n", shortened(type.robots));
        add_line(text, "links", shortened(type.links));
        add_line(text, "joints", listed(type.joints));
        add_line(text, "sensors", listed(type.sensors));
        add_line(text, "frames", listed(type.frames));
        add_line(text, "commands", shortened(type.commands));
    }
    return text;
}

nlohmann::json to_json(const std::vector<TypeNames>& types) {
    nlohmann::json list = nlohmann::json::array();
    for (const TypeNames& type : types)
        list.push_back({{"type", type.type},
                        {"robots", type.robots},
                        {"links", type.links},
                        {"joints", things_to_json(type.joints)},
                        {"sensors", things_to_json(type.sensors)},
                        {"frames", frames_to_json(type.frames)},
                        {"commands", type.commands}});
    return list;
}

}  // namespace roboss
