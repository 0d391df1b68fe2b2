// Orders as JSON lines, as orders_file.cpp reads them.
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/worlds/orders_file.h"
#include "core/hex.h"

namespace roboss {
namespace {

using nlohmann::json;

json list(const Vec3& v) {
    return {v.x, v.y, v.z};
}

/// The action as the value of its key.
struct ActionToJson {
    const Model& model;
    const RobotType& type;
    nlohmann::ordered_json& line;

    void operator()(const SetPose& a) const {
        line["set_pose"] = {{"position", list(a.X_WR.p)},
                            {"quat_wxyz", {a.X_WR.q.w, a.X_WR.q.x, a.X_WR.q.y, a.X_WR.q.z}}};
    }
    void operator()(const SetVelocity& a) const {
        line["set_velocity"] = {{"linear", list(a.linear)}, {"angular", list(a.angular)}};
    }
    void operator()(const ApplyWrench& a) const {
        line["wrench"] = {{"link", type.links[a.link.index()].name},
                          {"force", list(a.force)},
                          {"torque", list(a.torque)},
                          {"duration", static_cast<double>(a.duration) * model.dt_s}};
        if (a.replaces) line["wrench"]["replaces"] = true;
    }
    void operator()(const Pull& a) const {
        line["pull"] = {{"link", type.links[a.link.index()].name},
                        {"point", list(a.p_L)},
                        {"target", list(a.target_W)},
                        {"rate", a.rate},
                        {"max_force", a.max_force},
                        {"duration", static_cast<double>(a.duration) * model.dt_s}};
    }
    void operator()(const SetJoint& a) const {
        static constexpr const char* kModes[] = {"effort", "velocity", "position", "effort"};
        nlohmann::ordered_json joint{{"name", type.joints[a.joint.index()].name}};
        if (a.axis != 0) joint["axis"] = a.axis;
        const bool passive =
            a.mode == MotorMode::kPassive;  // not expressible in a line: an effort of 0 does the same
        joint[kModes[static_cast<std::size_t>(a.mode)]] = passive ? 0.0 : a.target;
        if (a.max_effort >= 0 && std::isfinite(a.max_effort)) joint["max_effort"] = a.max_effort;
        line["joint"] = joint;
    }
    void operator()(const SetJointState& a) const {
        nlohmann::ordered_json state{{"name", type.joints[a.joint.index()].name}};
        if (!a.position.empty()) state["position"] = a.position;
        if (!a.velocity.empty()) state["velocity"] = a.velocity;
        line["joint_state"] = state;
    }
    void operator()(const SetJointParameters& a) const {
        nlohmann::ordered_json numbers{{"name", type.joints[a.joint.index()].name}};
        if (a.axis != 0) numbers["axis"] = a.axis;
        if (a.reset) numbers["reset"] = true;
        for (const JointParameterValue& one : a.values)
            numbers[info_of(one.parameter).name] =
                std::isfinite(one.value) ? nlohmann::ordered_json(one.value) : nlohmann::ordered_json();
        line["joint_parameters"] = numbers;
    }
    void operator()(const SetLinkParameters& a) const {
        nlohmann::ordered_json numbers{{"name", type.links[a.link.index()].name}};
        if (a.reset) numbers["reset"] = true;
        for (const LinkParameterValue& one : a.values) numbers[info_of(one.parameter).name] = one.value;
        line["link_parameters"] = numbers;
    }
    void operator()(const SetSurroundings& a) const {
        nlohmann::ordered_json values = nlohmann::ordered_json::object();
        if (a.reset) values["reset"] = true;
        for (const SurroundingInfo& row : surroundings())
            if (const std::optional<Vec3>& value = a.values.*row.own) values[row.name] = list(*value);
        line["surroundings"] = values;
    }
    void operator()(const Command& a) const {
        line["command"] = {{"name", type.channels[a.channel].channel.name}, {"values", a.values}};
    }
    void operator()(const Attach& a) const {
        nlohmann::ordered_json attach{{"link", type.links[a.link.index()].name},
                                      {"robot", model.robots[a.other.index()].name},
                                      {"robot_link", model.type_of(a.other).links[a.other_link.index()].name},
                                      {"reach", a.reach}};
        if (std::isfinite(a.max_force)) attach["max_force"] = a.max_force;
        if (std::isfinite(a.max_torque)) attach["max_torque"] = a.max_torque;
        line["attach"] = attach;
    }
    void operator()(const Transmit& a) const {
        line["transmit"] = {{"radio", type.sensors[type.radios[a.radio]].spec.name},
                            {"hex", hexadecimal(a.payload)}};
        if (a.to.valid()) line["transmit"]["to"] = model.robots[a.to.index()].name;
    }
    void operator()(const Detach& a) const {
        line["detach"] = nlohmann::ordered_json::object();
        if (a.other.valid()) line["detach"]["robot"] = model.robots[a.other.index()].name;
    }
};

}  // namespace

std::string order_line(const Order& order, const Model& model) {
    nlohmann::ordered_json line{{"t", static_cast<double>(order.apply_at) * model.dt_s},
                                {"robot", model.robots[order.robot.index()].name}};
    std::visit(ActionToJson{model, model.type_of(order.robot), line}, order.action);
    return line.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace roboss
