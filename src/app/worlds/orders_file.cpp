// JSON lines to checked orders. Unknown keys are refused: a misspelt key must not become a silent default.
#include "app/worlds/orders_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "app/worlds/line_faults.h"
#include "core/hex.h"
#include "core/similar.h"
#include "model/addressee.h"
#include "model/joint_parameter_texts.h"
#include "model/powerless_joints.h"
#include "model/robot_names.h"
#include "model/topics.h"

namespace roboss {
namespace {

using nlohmann::json;

void only_keys(const json& object, const char* what, std::initializer_list<const char*> keys) {
    if (!object.is_object())
        throw LineFault(std::string(what) + " is not a JSON object", "write {\"...\": ...}");
    for (const auto& [key, value] : object.items()) {
        bool known = false;
        std::string all;
        for (const char* k : keys) known |= key == k, all += std::string(all.empty() ? "" : ", ") + k;
        if (!known) throw LineFault("'" + key + "' is not a key of " + what, "known keys: " + all);
    }
}

double number(const json& object, const char* key) {
    if (!object.contains(key)) throw LineFault(std::string("'") + key + "' is missing", "add it");
    if (!object[key].is_number())
        throw LineFault(std::string("'") + key + "' is not a number", "give a finite number");
    return object[key].get<double>();
}

std::vector<double> numbers(const json& object, const char* key, std::size_t count) {
    if (!object.contains(key)) return {};
    const json& list = object[key];
    if (!list.is_array() || list.size() != count)
        throw LineFault(std::string("'") + key + "' is not a list of " + std::to_string(count) + " numbers",
                        "give all of them");
    std::vector<double> values;
    for (const json& x : list) {
        if (!x.is_number())
            throw LineFault(std::string("'") + key + "' holds something that is not a number",
                            "give finite numbers");
        values.push_back(x.get<double>());
    }
    return values;
}

Vec3 vector(const json& object, const char* key) {
    const std::vector<double> v = numbers(object, key, 3);
    return v.empty() ? Vec3{} : Vec3{v[0], v[1], v[2]};
}

std::string text(const json& object, const char* key) {
    if (!object.contains(key) || !object[key].is_string())
        throw LineFault(std::string("'") + key + "' is missing or not a text", "write it in quotes");
    return object[key].get<std::string>();
}

/// The quaternion, under the key that names its order; `orientation` is the older name of quat_wxyz.
Quat parse_quaternion(const json& o) {
    Quat q;
    int given = 0;
    for (const char* key : {"quat_xyzw", "quat_wxyz", "orientation"}) {
        const std::vector<double> v = numbers(o, key, 4);
        if (v.empty()) continue;
        const bool ends_in_w = key == std::string_view("quat_xyzw");
        q = ends_in_w ? Quat{v[3], v[0], v[1], v[2]} : Quat{v[0], v[1], v[2], v[3]};
        const double size = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
        if (!(std::fabs(size - 1.0) < 1e-3))
            throw LineFault("'" + std::string(key) + "' is not a unit quaternion (its norm is " +
                                std::to_string(size) + ")",
                            ends_in_w ? "give [x, y, z, w]" : "give [w, x, y, z]");
        ++given;
    }
    if (given > 1) throw LineFault("set_pose has several quaternions", "give quat_xyzw or quat_wxyz");
    return given == 0 ? q : normalized(q);
}

Action parse_pose(const json& o) {
    only_keys(o, "set_pose", {"position", "quat_xyzw", "quat_wxyz", "orientation"});
    if (!o.contains("position")) throw LineFault("set_pose has no 'position'", "give [x, y, z] in m");
    return SetPose{{vector(o, "position"), parse_quaternion(o)}};
}

Action parse_velocity(const json& o) {
    only_keys(o, "set_velocity", {"linear", "angular"});
    return SetVelocity{vector(o, "linear"), vector(o, "angular")};
}

LinkId named_link(const json& o, const char* key, const RobotType& type, const std::string& robot) {
    const std::string name = text(o, key);
    if (const auto link = type.find_link(name)) return *link;
    throw LineFault("robot '" + robot + "' has no link '" + name + "'",
                    "its first link is '" + type.links.front().name + "'");
}

/// The duration of a force; by default one tick.
Tick ticks_of(const json& o, const Model& model) {
    const double duration = o.contains("duration") ? number(o, "duration") : model.dt_s;
    if (!(duration > 0 && duration < 1e9))
        throw LineFault("'duration' is not in (0, 1e9) s", "give the duration of the force, in s");
    return std::max<Tick>(1, tick_at(duration, model.dt_s));
}

Action parse_wrench(const json& o, const Model& model, const RobotType& type, const std::string& robot) {
    only_keys(o, "wrench", {"link", "force", "torque", "duration", "replaces"});
    return ApplyWrench{named_link(o, "link", type, robot), vector(o, "force"), vector(o, "torque"),
                       ticks_of(o, model), o.contains("replaces") && o["replaces"] == true};
}

Action parse_pull(const json& o, const Model& model, const RobotType& type, const std::string& robot) {
    only_keys(o, "pull", {"link", "point", "target", "rate", "max_force", "duration"});
    Pull pull;
    pull.link = named_link(o, "link", type, robot);
    pull.p_L = vector(o, "point"), pull.target_W = vector(o, "target");
    if (o.contains("rate")) pull.rate = number(o, "rate");
    pull.max_force = number(o, "max_force");
    pull.duration = ticks_of(o, model);
    return pull;
}

JointId named_joint(const json& o, const RobotType& type, const std::string& robot) {
    const std::string name = text(o, "name");
    const auto joint = type.find_joint(name);
    if (!joint) {
        const std::string hint = type.joints.empty()
                                     ? "it has no joints"
                                     : "its first joint is '" + type.joints.front().name + "'";
        throw LineFault("robot '" + robot + "' has no joint '" + name + "'", hint);
    }
    return *joint;
}

/// A number, or a list with one for each axis.
std::vector<double> axis_values(const json& o, const char* key) {
    if (!o.contains(key)) return {};
    return o[key].is_array() ? numbers(o, key, o[key].size()) : std::vector<double>{number(o, key)};
}

Action parse_joint_state(const json& o, const RobotType& type, const std::string& robot) {
    only_keys(o, "joint_state", {"name", "position", "velocity"});
    return SetJointState{named_joint(o, type, robot), axis_values(o, "position"), axis_values(o, "velocity")};
}

Action parse_joint(const json& o, const RobotType& type, const std::string& robot) {
    only_keys(o, "joint", {"name", "axis", "velocity", "position", "effort", "max_effort"});
    SetJoint order;
    order.joint = named_joint(o, type, robot);
    int modes = 0;
    for (const auto& [key, mode] :
         {std::pair{"velocity", MotorMode::kVelocity}, std::pair{"position", MotorMode::kPosition},
          std::pair{"effort", MotorMode::kEffort}}) {
        if (!o.contains(key)) continue;
        order.mode = mode;
        order.target = number(o, key);
        ++modes;
    }
    if (modes != 1)
        throw LineFault("the joint order names " + std::to_string(modes) + " of velocity, position, effort",
                        "name exactly one");
    if (o.contains("max_effort")) {
        order.max_effort = number(o, "max_effort");
        if (order.max_effort < 0)
            throw LineFault("'max_effort' is negative", "give a bound >= 0, or leave it out");
    }
    if (o.contains("axis")) order.axis = static_cast<int>(number(o, "axis"));
    return order;
}

/// null: there is no bound.
double parameter_value(const json& o, const std::string& key, JointParameter parameter) {
    const std::optional<double> unbounded = value_of_null(parameter);
    return o[key].is_null() && unbounded ? *unbounded : number(o, key.c_str());
}

/// Reads "reset" and the numbers of an order that takes both; take(key) says false of a key that it does not
/// know. `known`: all keys but these two and "name".
template <class Order, class Take>
void read_numbers(const json& o, const std::string& what, const std::string& known, Order& order,
                  const Take& take) {
    if (!o.is_object()) throw LineFault(what + " is not a JSON object", "write {\"...\": ...}");
    for (const auto& [key, value] : o.items()) {
        if (key == "name") continue;
        if (key == "reset") {
            if (!value.is_boolean()) throw LineFault("'reset' is not true or false", "write true");
            order.reset = value.template get<bool>();
        } else if (!take(key)) {
            throw LineFault("'" + key + "' is not a key of " + what, "known keys: name, reset, " + known);
        }
    }
}

Action parse_joint_parameters(const json& o, const RobotType& type, const std::string& robot) {
    SetJointParameters order;
    read_numbers(o, "joint_parameters", "axis, " + joint_parameter_names(), order,
                 [&](const std::string& key) {
                     if (key == "axis") return order.axis = static_cast<int>(number(o, "axis")), true;
                     const auto parameter = find_joint_parameter(key);
                     if (parameter) order.values.push_back({*parameter, parameter_value(o, key, *parameter)});
                     return parameter.has_value();
                 });
    order.joint = named_joint(o, type, robot);
    return order;
}

Action parse_link_parameters(const json& o, const RobotType& type, const std::string& robot) {
    SetLinkParameters order;
    read_numbers(o, "link_parameters", link_parameter_names(), order, [&](const std::string& key) {
        const auto parameter = find_link_parameter(key);
        if (parameter) order.values.push_back({*parameter, number(o, key.c_str())});
        return parameter.has_value();
    });
    order.link = named_link(o, "name", type, robot);
    return order;
}

Action parse_surroundings(const json& o) {
    only_keys(o, "surroundings", {"gravity", "wind", "reset"});
    SetSurroundings order;
    for (const SurroundingInfo& row : surroundings())
        if (o.contains(row.name)) order.values.*row.own = vector(o, row.name);
    if (!o.contains("reset")) return order;
    if (!o["reset"].is_boolean()) throw LineFault("'reset' is not true or false", "write true");
    order.reset = o["reset"].get<bool>();
    return order;
}

/// For a command that the robot does not take.
std::string remedy_for(const std::string& command, const RobotType& type) {
    std::string all;
    std::vector<std::string> names;
    for (const ChannelInfo& c : type.channels) {
        names.push_back(c.channel.name);
        all += (all.empty() ? "" : ", ") + c.channel.name;
    }
    return did_you_mean(command, names, all.empty() ? "it takes no commands" : "it takes: " + all);
}

/// A value of a command: a number, a truth value, or one of the texts that it knows.
double command_value(const json& o, const ChannelValue& value) {
    const json& given = o[value.name];
    if (given.is_boolean()) return given.get<bool>() ? 1.0 : 0.0;
    if (value.words.empty() || !given.is_string()) return number(o, value.name.c_str());
    const auto found = std::ranges::find(value.words, given.get<std::string>());
    if (found == value.words.end())  // it is none of those that anything in the world waits for
        return static_cast<double>(value.words.size() + 1);
    return static_cast<double>(found - value.words.begin() + 1);
}

/// The values as a list, or each by its name; those that are left out are 0. `name`: the key of its name.
std::vector<double> command_values(const json& o, const Channel& channel, const char* name = "name") {
    std::vector<double> values;
    if (o.contains("values")) {
        if (!o["values"].is_array()) throw LineFault("'values' is not a list", "give a list of numbers");
        only_keys(o, "command", {name, "values"});
        return numbers(o, "values", o["values"].size());
    }
    std::vector<std::string> keys = {name, "values"};
    std::string all = std::string("known keys: ") + name + ", values";
    for (const ChannelValue& value : channel.values) {
        values.push_back(o.contains(value.name) ? command_value(o, value) : 0.0);
        keys.push_back(value.name);
        all += ", " + value.name;
    }
    for (const auto& [key, given] : o.items())
        if (std::ranges::find(keys, key) == keys.end())
            throw LineFault("'" + key + "' is no value of the command '" + channel.name + "'",
                            did_you_mean(key, keys, all));
    return values;
}

Action parse_command(const json& o, const RobotType& type, const std::string& robot) {
    if (!o.is_object()) throw LineFault("command is not a JSON object", "write {\"name\": ..., ...}");
    const std::string name = text(o, "name");
    const auto channel = type.find_command(name);
    if (!channel)
        throw LineFault("robot '" + robot + "' has no command '" + name + "'", remedy_for(name, type));
    return Command{static_cast<std::uint32_t>(*channel), command_values(o, type.channels[*channel].channel)};
}

/// Those with the name, or with names that fit it as a pattern; at least one, by RobotId.
std::vector<RobotId> robots_of(const json& o, const char* key, const Model& model) {
    const std::string name = text(o, key);
    std::vector<RobotId> robots = find_robots(model, name);
    if (robots.empty()) {
        const Error none = no_such_robot(model, name);
        throw LineFault(none.message, none.remedy);
    }
    return robots;
}

/// The one robot that the action of an order names.
RobotId other_robot(const json& o, const char* key, const Model& model) {
    const std::vector<RobotId> robots = robots_of(o, key, model);
    if (robots.size() > 1)
        throw LineFault("'" + text(o, key) + "' fits " + std::to_string(robots.size()) +
                            " robots, here one is named (they begin with '" +
                            model.robots[robots[0].index()].name + "' and '" +
                            model.robots[robots[1].index()].name + "')",
                        "name one of them");
    return robots.front();
}

/// The named link, or the first one.
LinkId link_of(const json& o, const char* key, const RobotType& type, const std::string& robot) {
    return o.contains(key) ? named_link(o, key, type, robot) : LinkId(std::size_t{0});
}

Action parse_attach(const json& o, const Model& model, const RobotType& type, const std::string& robot) {
    only_keys(o, "attach", {"link", "robot", "robot_link", "reach", "max_force", "max_torque"});
    Attach attach;
    attach.other = other_robot(o, "robot", model);
    attach.link = link_of(o, "link", type, robot);
    attach.other_link =
        link_of(o, "robot_link", model.type_of(attach.other), model.robots[attach.other.index()].name);
    if (o.contains("reach")) attach.reach = number(o, "reach");
    if (o.contains("max_force")) attach.max_force = number(o, "max_force");
    if (o.contains("max_torque")) attach.max_torque = number(o, "max_torque");
    return attach;
}

Action parse_detach(const json& o, const Model& model) {
    only_keys(o, "detach", {"robot"});
    return Detach{o.contains("robot") ? other_robot(o, "robot", model) : RobotId()};
}

std::vector<std::uint8_t> bytes_of(const std::string& digits) {
    std::vector<std::uint8_t> bytes;
    const auto value = [](char c) {
        if (c >= '0' && c <= '9') return c - '0';
        if (c >= 'a' && c <= 'f') return c - 'a' + 10;
        if (c >= 'A' && c <= 'F') return c - 'A' + 10;
        throw LineFault("'hex' has the character '" + std::string(1, c) + "'", "write hexadecimal digits");
    };
    if (digits.size() % 2 != 0)
        throw LineFault("'hex' has " + std::to_string(digits.size()) + " digits", "write two for each byte");
    for (std::size_t i = 0; i < digits.size(); i += 2)
        bytes.push_back(static_cast<std::uint8_t>(16 * value(digits[i]) + value(digits[i + 1])));
    return bytes;
}

Action parse_transmit(const json& o, const Model& model, RobotId robot) {
    only_keys(o, "transmit", {"radio", "to", "text", "hex"});
    const RobotType& type = model.type_of(robot);
    const std::string& name = model.robots[robot.index()].name;
    const std::string radio = text(o, "radio");
    const auto sensor = type.find_sensor(radio);
    if (!sensor)
        throw LineFault("robot '" + name + "' has no sensor '" + radio + "'",
                        "`roboss check WORLD --names` lists its sensors");
    const Result<std::uint32_t> number = radio_number(model, robot, *sensor);
    if (!number) throw LineFault(number.error().message, number.error().remedy);
    Transmit message{number.value(), {}, {}};
    if (o.contains("to")) {
        const auto to = find_addressee(model, text(o, "to"));
        if (!to && find_robots(model, text(o, "to")).empty())
            throw LineFault(
                "no robot of the world has the name or the address '" + text(o, "to") + "'",
                no_such_robot(model, text(o, "to")).remedy + "; leave 'to' out for all who hear it");
        message.to = to ? *to : other_robot(o, "to", model);
    }
    if (o.contains("text") == o.contains("hex"))
        throw LineFault("the message has both or none of 'text' and 'hex'", "give one of them");
    if (o.contains("hex")) {
        message.payload = bytes_of(text(o, "hex"));
    } else {
        const std::string content = text(o, "text");
        message.payload.assign(content.begin(), content.end());
    }
    return message;
}

json parse_json(const std::string& line) {
    try {
        return json::parse(line);
    } catch (const json::parse_error& error) {
        throw LineFault("not valid JSON at character " + std::to_string(error.byte) + " of the line",
                        "write one complete JSON object per line");
    } catch (const json::out_of_range&) {
        throw LineFault("a number of the line is too large", "give a finite number");
    }
}

Tick tick_of(const json& o, const Model& model) {
    const double time_s = number(o, "t");
    if (!(time_s >= 0 && time_s < 1e12))
        throw LineFault("'t' is not in [0, 1e12) s", "give the time of the order, in s");
    return tick_at(time_s, model.dt_s);
}

/// A message on a topic: a command to each robot and message board that takes it.
std::vector<Order> parse_publish(const json& o, const Model& model) {
    only_keys(o, "an order", {"t", "publish"});
    const json& message = o["publish"];
    if (!message.is_object()) throw LineFault("publish is not a JSON object", "write {\"topic\": ..., ...}");
    const std::string topic = text(message, "topic");
    std::vector<Order> orders;
    for (const TopicPlace& place : find_topic(model, topic)) {
        const Channel& channel = model.type_of(place.robot).channels[place.channel].channel;
        Order order;
        order.apply_at = tick_of(o, model);
        order.robot = place.robot;
        order.action = Command{place.channel, command_values(message, channel, "topic")};
        orders.push_back(std::move(order));
    }
    if (orders.empty())
        throw LineFault("no robot of the world takes messages at '" + topic + "'",
                        "`roboss check WORLD` lists the topics of all commands");
    return orders;
}

/// The order's action, for one of its robots.
Action parse_action(const json& o, const Model& model, RobotId id) {
    const RobotType& type = model.type_of(id);
    const std::string& robot = model.robots[id.index()].name;
    if (o.contains("set_pose")) return parse_pose(o["set_pose"]);
    if (o.contains("set_velocity")) return parse_velocity(o["set_velocity"]);
    if (o.contains("wrench")) return parse_wrench(o["wrench"], model, type, robot);
    if (o.contains("pull")) return parse_pull(o["pull"], model, type, robot);
    if (o.contains("joint")) return parse_joint(o["joint"], type, robot);
    if (o.contains("joint_state")) return parse_joint_state(o["joint_state"], type, robot);
    if (o.contains("joint_parameters")) return parse_joint_parameters(o["joint_parameters"], type, robot);
    if (o.contains("link_parameters")) return parse_link_parameters(o["link_parameters"], type, robot);
    if (o.contains("surroundings")) return parse_surroundings(o["surroundings"]);
    if (o.contains("command")) return parse_command(o["command"], type, robot);
    if (o.contains("attach")) return parse_attach(o["attach"], model, type, robot);
    if (o.contains("detach")) return parse_detach(o["detach"], model);
    return parse_transmit(o["transmit"], model, id);
}

/// Adds the order, or why it is refused.
void take(Order order, const Model& model, std::vector<Order>& orders, LineFaults& faults) {
    if (const Result<> checked = check_order(model, order); !checked) {
        // The fault of the robot's file, not of the order: exporters write limits of 0. The other orders run.
        const bool powerless = is_of_zero_limit(checked.error().code);
        faults.add({checked.error().message, checked.error().remedy,
                    powerless ? Severity::kWarning : Severity::kError},
                   model.robots[order.robot.index()].name);
        return;
    }
    orders.push_back(std::move(order));
}

/// One order for each robot that the line names.
void parse_order(const json& o, const Model& model, std::vector<Order>& orders, LineFaults& faults) {
    only_keys(o, "an order",
              {"t", "robot", "set_pose", "set_velocity", "wrench", "joint", "joint_state", "joint_parameters",
               "link_parameters", "surroundings", "command", "attach", "detach", "pull", "transmit"});
    const Tick tick = tick_of(o, model);
    const std::vector<RobotId> robots = robots_of(o, "robot", model);
    const int actions = static_cast<int>(o.size()) - 2;
    if (actions != 1)
        throw LineFault("the order has " + std::to_string(actions) + " actions",
                        "name one of set_pose, set_velocity, wrench, pull, joint, joint_state, "
                        "joint_parameters, link_parameters, surroundings, command, attach, detach, transmit, "
                        "or publish without a robot");
    for (const RobotId robot : robots) {
        Order order;
        order.apply_at = tick;
        order.robot = robot;
        try {
            order.action = parse_action(o, model, robot);
            take(std::move(order), model, orders, faults);
        } catch (const LineFault& fault) {
            faults.add(fault, model.robots[robot.index()].name);
        }
    }
}

std::vector<Order> parse_line(const std::string& line, const Model& model, LineFaults& faults) {
    std::vector<Order> orders;
    try {
        const json o = parse_json(line);
        if (o.is_object() && o.contains("publish"))
            for (Order& order : parse_publish(o, model)) take(std::move(order), model, orders, faults);
        else
            parse_order(o, model, orders, faults);
    } catch (const LineFault& fault) {
        faults.add(fault, {});
    }
    if (faults.refuse()) orders.clear();
    return orders;
}

}  // namespace

Tick tick_at(double time_s, double dt_s) {
    return static_cast<Tick>(std::floor(time_s / dt_s + 0.5));
}

std::vector<Order> parse_orders(std::string_view content, const std::string& file, const Model& model,
                                Diagnostics& diagnostics) {
    std::vector<Order> orders;
    std::istringstream lines{std::string(content)};
    std::string line;
    for (int at = 1; std::getline(lines, line); ++at) {
        const std::size_t start = line.find_first_not_of(" \t\r");
        if (start == std::string::npos || line[start] == '#') continue;
        LineFaults faults;
        std::uint64_t sequence = static_cast<std::uint64_t>(at);
        for (Order& order : parse_line(line, model, faults)) {
            order.sequence = sequence;
            orders.push_back(std::move(order));
            sequence += std::uint64_t{1} << 32;  // a line may give several; no two may be equal
        }
        faults.report({file, at}, diagnostics);
    }
    return orders;
}

std::vector<Order> load_orders(const std::string& file, const Model& model, Diagnostics& diagnostics) {
    std::ifstream in(file, std::ios::binary);
    std::stringstream content;
    if (!in || !(content << in.rdbuf() || in.peek() == EOF)) {
        diagnostics.error({file, 0}, "no-file", "cannot read the orders file",
                          "check the path after --orders");
        return {};
    }
    return parse_orders(content.str(), file, model, diagnostics);
}

}  // namespace roboss
