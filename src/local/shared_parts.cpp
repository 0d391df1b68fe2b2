// See shared_parts.h.
#include "local/shared_parts.h"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>

#include "world/joint_type.h"

namespace roboss {
namespace {

/// A list of parts of one kind: how to find one in a RobotType, and which two are the same but for their
/// names.
struct PartList {
    bool is_stepped = true;  // robots of one type have the same ones in the same order
    std::function<std::vector<std::string>(const RobotType&)> names;
    std::function<std::optional<std::size_t>(const RobotType&, const std::string&)> find;
    std::function<bool(const RobotType&, std::size_t, const RobotType&, std::size_t)> same_kind;
};

std::optional<std::size_t> place_in(const std::vector<std::string>& names, const std::string& name) {
    const auto found = std::ranges::find(names, name);
    return found == names.end() ? std::nullopt
                                : std::optional(static_cast<std::size_t>(found - names.begin()));
}

template <class Items, class NameOf>
std::vector<std::string> names_of(const Items& items, NameOf name_of) {
    std::vector<std::string> names;
    for (const auto& item : items) names.push_back(name_of(item));
    return names;
}

bool are_same(const PartList& list, const RobotType& a, std::size_t i, const RobotType& b, std::size_t k) {
    return (list.is_stepped && a.like == b.like && i == k) || list.same_kind(a, i, b, k);
}

/// The parts of types[0] in each type, by name; nullopt: a type has none of one of the names, or another kind
/// of it.
std::optional<std::vector<std::size_t>> by_name(const PartList& list, std::span<const RobotType* const> types,
                                                std::size_t part, const std::string& name) {
    std::vector<std::size_t> of;
    for (const RobotType* type : types) {
        const auto found = list.find(*type, name);
        if (!found || !are_same(list, *types[0], part, *type, *found)) return std::nullopt;
        of.push_back(*found);
    }
    return of[0] == part ? std::optional(of) : std::nullopt;
}

/// True if both have parts of the same kinds in the same order.
bool same_layout(const PartList& list, const RobotType& a, const RobotType& b) {
    const std::size_t count = list.names(a).size();
    if (a.like != b.like || list.names(b).size() != count) return false;
    for (std::size_t i = 0; i < count; ++i)
        if (!are_same(list, a, i, b, i)) return false;
    return true;
}

/// True if the type has one of these names at another place: then places do not tell which part is meant.
bool has_elsewhere(const PartList& list, const RobotType& type, const std::vector<std::string>& names) {
    const std::vector<std::string> own = list.names(type);
    for (std::size_t i = 0; i < names.size(); ++i)
        if (const auto place = place_in(own, names[i]); place && *place != i && own[i] != names[i])
            return true;
    return false;
}

/// `name`, then its last parts: "a/b/c", "b/c", "c".
std::vector<std::string> with_shorter(std::string name) {
    std::vector<std::string> all{name};
    for (std::size_t at; (at = name.find('/')) != std::string::npos;)
        if (name = name.substr(at + 1); !name.empty()) all.push_back(name);
    return all;
}

std::vector<SharedPart> shared(const PartList& list, std::span<const RobotType* const> types) {
    if (types.empty()) return {};
    const std::vector<std::string> names = list.names(*types[0]);
    const auto is_alike = [&](const RobotType* type) { return same_layout(list, *types[0], *type); };
    const auto has_names = [&](const RobotType* type) { return list.names(*type) == names; };
    const bool alike = std::ranges::all_of(types, is_alike);
    std::vector<SharedPart> parts;
    const bool named_alike = alike && std::ranges::all_of(types, has_names);
    for (std::size_t i = 0; i < names.size() && !named_alike; ++i) {
        for (const std::string& name : with_shorter(names[i]))
            if (auto of = by_name(list, types, i, name)) {
                parts.push_back({name, *std::move(of)});
                break;
            }
    }
    const bool by_place = alike && std::ranges::none_of(types, [&](const RobotType* t) {
                              return has_elsewhere(list, *t, names);
                          });
    if (!by_place || parts.size() == names.size()) return parts;
    parts.clear();
    for (std::size_t i = 0; i < names.size(); ++i) parts.push_back({names[i], std::vector(types.size(), i)});
    return parts;
}

JointKind motion_of(const RobotType& type, const JointAxis& axis) {
    const std::span<const JointKind> motions = joint_type(type.joints[axis.joint.index()].kind).motions;
    return motions[std::min(static_cast<std::size_t>(axis.axis), motions.size() - 1)];
}

PartList joint_axes() {
    const auto names = [](const RobotType& type) {
        return names_of(axes_of_joints(type), [](const JointAxis& axis) { return axis.name; });
    };
    return {true, names,
            [names](const RobotType& type, const std::string& name) { return place_in(names(type), name); },
            [](const RobotType& a, std::size_t i, const RobotType& b, std::size_t k) {
                const JointAxis x = axes_of_joints(a)[i], y = axes_of_joints(b)[k];
                const bool loops = a.joints[x.joint.index()].loop >= 0,
                           loops_too = b.joints[y.joint.index()].loop >= 0;
                return motion_of(a, x) == motion_of(b, y) && loops == loops_too;
            }};
}

PartList all_links() {
    return {true,
            [](const RobotType& type) {
                return names_of(type.links, [](const Link& link) { return link.name; });
            },
            [](const RobotType& type, const std::string& name) -> std::optional<std::size_t> {
                const auto link = type.find_link(name);
                return link ? std::optional(link->index()) : std::nullopt;
            },
            [](const RobotType&, std::size_t, const RobotType&, std::size_t) { return true; }};
}

PartList all_sensors() {
    return {false,
            [](const RobotType& type) {
                return names_of(type.sensors, [](const SensorInfo& sensor) { return sensor.spec.name; });
            },
            [](const RobotType& type, const std::string& name) { return type.find_sensor(name); },
            [](const RobotType& a, std::size_t i, const RobotType& b, std::size_t k) {
                return a.sensors[i].spec.kind().number == b.sensors[k].spec.kind().number;
            }};
}

PartList all_commands() {
    return {true,
            [](const RobotType& type) {
                return names_of(type.channels, [](const ChannelInfo& info) { return info.channel.name; });
            },
            [](const RobotType& type, const std::string& name) { return type.find_command(name); },
            [](const RobotType& a, std::size_t i, const RobotType& b, std::size_t k) {
                const Channel &x = a.channels[i].channel, &y = b.channels[k].channel;
                return x.is_list == y.is_list && x.values == y.values;
            }};
}

}  // namespace

SharedParts::SharedParts(const Model& model, std::span<const RobotId> robots) {
    std::map<TypeId, std::uint32_t> known;
    for (const RobotId robot : robots) {
        ROBOSS_CHECK(robot.index() < model.robots.size(), "robot " + std::to_string(robot.value));
        const TypeId id = model.robots[robot.index()].type;
        const auto [entry, is_new] = known.try_emplace(id, static_cast<std::uint32_t>(types.size()));
        if (is_new) types.push_back(&model.types[id.index()]);
        type_of_row.push_back(entry->second);
    }
    one_type =
        std::ranges::all_of(types, [&](const RobotType* type) { return type->like == types[0]->like; });
    axes = shared(joint_axes(), types);
    links = shared(all_links(), types);
    sensors = shared(all_sensors(), types);
    commands = shared(all_commands(), types);
    for (std::size_t t = 0; t < types.size(); ++t) {
        const std::vector<JointAxis> all = axes_of_joints(*types[t]);
        axes_of_types.emplace_back();
        for (const SharedPart& axis : axes) axes_of_types.back().push_back(all[axis.of[t]]);
    }
}

}  // namespace roboss
