// Commands, surfaces and bonds of exact states, as JSON.
#include "gateway/onboard_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace roboss {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity.
Json parameter_json(double value) {
    return std::isfinite(value) ? Json(value) : Json();
}

Json parameter_json(const Vec3& v) {
    return {parameter_json(v.x), parameter_json(v.y), parameter_json(v.z)};
}

/// The last command of a channel; `tick` is -1 before the first.
Json channel_json(const ChannelInfo& info, const RobotState& state) {
    const auto first = static_cast<std::size_t>(info.index);
    Json values = Json::array();
    if (info.list_index >= 0) {
        for (const double value : state.lists[static_cast<std::size_t>(info.list_index)])
            values.push_back(parameter_json(value));
    } else {
        for (std::size_t i = 0; i < info.channel.values.size(); ++i)
            values.push_back(parameter_json(state.onboard[first + 1 + i]));
    }
    return {{"tick", parameter_json(state.onboard[first])}, {"values", std::move(values)}};
}

Json parameter_json(const SurfaceMotion& motion) {
    return {{"link", motion.link.value},
            {"linear", parameter_json(motion.linear_L)},
            {"angular", parameter_json(motion.angular_L)},
            {"belt", parameter_json(motion.belt_L)}};
}

Json parameter_json(const Bond& bond, double dt_s) {
    return {{"link", bond.link.value},
            {"other", bond.other == RobotId::kNone ? -1 : static_cast<std::int64_t>(bond.other)},
            {"other_link", bond.other == RobotId::kNone ? 0 : bond.other_link.value},
            {"force", parameter_json(norm(bond.force_impulse) / dt_s)},
            {"torque", parameter_json(norm(bond.torque_impulse) / dt_s)},
            {"max_force", parameter_json(bond.max_force)},
            {"max_torque", parameter_json(bond.max_torque)}};
}

/// Bonds of others that hold the robot: `other` is the holder.
Json held_by_json(RobotId robot, std::span<const std::optional<RobotState>> states, double dt_s) {
    Json list = Json::array();
    for (std::size_t holder = 0; holder < states.size(); ++holder) {
        if (!states[holder]) continue;
        for (const Bond& bond : states[holder]->bonds) {
            if (bond.phase != BondPhase::kHolds || bond.other != robot.value) continue;
            Json json = parameter_json(bond, dt_s);
            json["other"] = holder, json["link"] = bond.other_link.value,
            json["other_link"] = bond.link.value;
            list.push_back(std::move(json));
        }
    }
    return list;
}

void put(Json& out, const char* name, Json list) {
    if (!list.empty()) out[name] = std::move(list);
}

}  // namespace

void add_onboard(const Model& model, RobotId robot, std::span<const std::optional<RobotState>> states,
                 nlohmann::ordered_json& out) {
    const RobotState& state = *states[robot.index()];
    Json channels = Json::array(), surfaces = Json::array(), bonds = Json::array();
    for (const ChannelInfo& info : model.type_of(robot).channels)
        channels.push_back(channel_json(info, state));
    const bool kinematic = model.type_of(robot).kinematic;  // its surfaces go where it goes
    for (const SurfaceMotion& motion : state.surfaces)
        if (!kinematic) surfaces.push_back(parameter_json(motion));
    for (const Bond& bond : state.bonds)
        if (bond.phase == BondPhase::kHolds) bonds.push_back(parameter_json(bond, model.dt_s));
    put(out, "channels", std::move(channels));
    put(out, "surfaces", std::move(surfaces));
    put(out, "bonds", std::move(bonds));
    put(out, "held_by", held_by_json(robot, states, model.dt_s));
}

}  // namespace roboss
