// Reading JSON that anybody may have written.
#include "gateway/page_request.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "gateway/page_fields.h"
#include "model/joint_parameter_texts.h"
#include "wire/viewer_protocol.h"

namespace roboss {
namespace {

constexpr std::size_t kWordsMax = 1024;
constexpr int kDepthMax = 8;

ControlArguments control_of(PageFields& fields) {
    ControlArguments control;
    const nlohmann::json* words = fields.find("words");
    if (words == nullptr || !words->is_array() || words->empty() || words->size() > kWordsMax)
        return fields.fail("words", "a list of 1 to 1024 strings"), control;
    for (const nlohmann::json& word : *words) {
        if (!word.is_string()) return fields.fail("words", "a list of strings"), control;
        control.words.push_back(word.get<std::string>());
    }
    return control;
}

SetPose pose_of(PageFields& fields) {
    const std::vector<double> v = fields.numbers("pose", 7);
    const double norm_squared = v[3] * v[3] + v[4] * v[4] + v[5] * v[5] + v[6] * v[6];
    if (!(norm_squared > 1e-6 && norm_squared < 1e6))
        return fields.fail("pose", "a position and a quaternion"), SetPose{};
    return {{{v[0], v[1], v[2]}, normalized(Quat{v[3], v[4], v[5], v[6]})}};
}

bool flag_of(PageFields& fields, const char* name) {
    const nlohmann::json* value = fields.find(name);
    if (value != nullptr && !value->is_boolean()) fields.fail(name, "true or false");
    return value != nullptr && value->is_boolean() && value->get<bool>();
}

PagePull pull_of(PageFields& fields) {
    PagePull pull;
    pull.pull.link = LinkId(fields.index("link", 0u));
    pull.pull.p_L = fields.vec3("point");
    pull.pull.target_W = fields.vec3("target");
    pull.pull.rate = fields.number("rate", pull.pull.rate);
    pull.pull.max_force = fields.number("max_force");
    pull.duration_s = fields.number("duration", pull.duration_s);
    return pull;
}

/// More than any joint has is refused by number.
int axis_of(PageFields& fields) {
    return static_cast<int>(std::min(fields.index("axis", 0u), 1000u));
}

SetJoint joint_of(PageFields& fields) {
    SetJoint joint;
    joint.joint = JointId(fields.index("joint"));
    joint.axis = axis_of(fields);
    const std::string mode = fields.text("mode");
    joint.target = fields.number("target", 0.0);
    joint.max_effort = fields.number("max_effort", -1.0);
    if (mode == "passive") return joint.mode = MotorMode::kPassive, joint;
    if (mode == "velocity") return joint.mode = MotorMode::kVelocity, joint;
    if (mode == "position") return joint.mode = MotorMode::kPosition, joint;
    if (mode == "effort") return joint.mode = MotorMode::kEffort, joint;
    return fields.fail("mode", "passive, velocity, position or effort"), joint;
}

/// Calls take(name, value) for each member of "values", which may be left out; it says false of a wrong one.
template <class Take>
void take_values(PageFields& fields, const std::string& names, Take take) {
    const nlohmann::json* values = fields.find("values");
    if (values == nullptr) return;
    const std::string wanted = "an object of finite numbers; known names: " + names;
    if (!values->is_object()) return fields.fail("values", wanted);
    for (const auto& [name, value] : values->items())
        if (!take(name, value)) return fields.fail("values", wanted);
}

std::optional<double> number_of(const nlohmann::json& value) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) return std::nullopt;
    return value.get<double>();
}

SetJointParameters joint_parameters_of(PageFields& fields) {
    SetJointParameters order;
    order.joint = JointId(fields.index("joint"));
    order.axis = axis_of(fields);
    order.reset = flag_of(fields, "reset");
    take_values(fields, joint_parameter_names(), [&](const std::string& name, const nlohmann::json& value) {
        const auto parameter = find_joint_parameter(name);
        if (!parameter) return false;
        const auto number = value.is_null() ? value_of_null(*parameter) : number_of(value);
        if (number) order.values.push_back({*parameter, *number});
        return number.has_value();
    });
    return order;
}

SetLinkParameters link_parameters_of(PageFields& fields) {
    SetLinkParameters order;
    order.link = LinkId(fields.index("link"));
    order.reset = flag_of(fields, "reset");
    take_values(fields, link_parameter_names(), [&](const std::string& name, const nlohmann::json& value) {
        const auto parameter = find_link_parameter(name);
        const auto number = number_of(value);
        if (parameter && number) order.values.push_back({*parameter, *number});
        return parameter && number;
    });
    return order;
}

SetSurroundings surroundings_of(PageFields& fields) {
    SetSurroundings order;
    order.reset = flag_of(fields, "reset");
    for (const SurroundingInfo& row : surroundings())
        if (fields.find(row.name) != nullptr) order.values.*row.own = fields.vec3(row.name);
    return order;
}

PageCommand command_of(PageFields& fields) {
    PageCommand command;
    command.name = fields.text("name");
    command.values = fields.numbers("values");
    return command;
}

Attach attach_of(PageFields& fields) {
    const double unlimited = std::numeric_limits<double>::infinity();
    Attach attach;
    attach.link = LinkId(fields.index("link", 0u));
    attach.other = RobotId(fields.index("other"));
    attach.other_link = LinkId(fields.index("other_link", 0u));
    attach.reach = fields.number("reach", attach.reach);
    attach.max_force = fields.number("max_force", unlimited);
    attach.max_torque = fields.number("max_torque", unlimited);
    return attach;
}

PageOrder order_of(PageFields& fields) {
    PageOrder order;
    order.robot = RobotId(fields.index("robot"));
    const std::string action = fields.text("action");
    if (action == "pose") {
        order.action = pose_of(fields);
    } else if (action == "velocity") {
        order.action = SetVelocity{fields.vec3("linear"), fields.vec3("angular")};
    } else if (action == "wrench") {
        order.action =
            PageWrench{LinkId(fields.index("link", 0u)), fields.vec3("force"), fields.vec3("torque"),
                       fields.number("duration", 0.1), flag_of(fields, "replaces")};
    } else if (action == "pull") {
        order.action = pull_of(fields);
    } else if (action == "joint") {
        order.action = joint_of(fields);
    } else if (action == "joint_parameters") {
        order.action = joint_parameters_of(fields);
    } else if (action == "link_parameters") {
        order.action = link_parameters_of(fields);
    } else if (action == "surroundings") {
        order.action = surroundings_of(fields);
    } else if (action == "command") {
        order.action = command_of(fields);
    } else if (action == "attach") {
        order.action = attach_of(fields);
    } else if (action == "detach") {
        order.action = Detach{RobotId(fields.index("other", RobotId::kNone))};
    } else {
        fields.fail("action",
                    "pose, velocity, wrench, pull, joint, joint_parameters, link_parameters, "
                    "surroundings, command, attach or detach");
    }
    return order;
}

std::vector<PictureWish> cameras_of(PageFields& fields) {
    const nlohmann::json* list = fields.find("cameras");
    std::vector<PictureWish> wishes;
    if (list == nullptr) return wishes;
    if (!list->is_array() || list->size() > viewer_protocol::kWatchedCamerasMax)
        return fields.fail("cameras", "a list of at most 16 cameras"), wishes;
    for (const nlohmann::json& one : *list) {
        if (!one.is_object()) return fields.fail("cameras", "a list of objects"), wishes;
        PageFields camera(one);
        PictureWish wish;
        wish.robot = RobotId(camera.index("robot"));
        wish.sensor = camera.index("sensor");
        wish.columns = camera.index("columns", 0u);
        wish.depth = flag_of(camera, "depth");
        if (!camera.wrong().empty()) return fields.fail("cameras", "robot, sensor, columns, depth"), wishes;
        wishes.push_back(wish);
    }
    return wishes;
}

std::optional<NumbersWish> numbers_of(PageFields& fields) {
    const nlohmann::json* one = fields.find("numbers");
    if (one == nullptr) return std::nullopt;
    const char* wanted = "an object with robot and link, or robot, joint and axis";
    if (!one->is_object()) return fields.fail("numbers", wanted), std::nullopt;
    PageFields named(*one);
    NumbersWish wish;
    wish.robot = RobotId(named.index("robot"));
    if (named.find("link") != nullptr)
        wish.link = LinkId(named.index("link"));
    else
        wish.joint = JointId(named.index("joint")), wish.axis = axis_of(named);
    if (!named.wrong().empty()) fields.fail("numbers", wanted);
    return wish;
}

PageWatch watch_of(PageFields& fields) {
    PageWatch watch;
    const nlohmann::json none = nlohmann::json::array();
    const nlohmann::json* robots = fields.find("robots");
    if (robots == nullptr) robots = &none;
    if (!robots->is_array() || robots->size() > viewer_protocol::kWatchedRobotsMax)
        return fields.fail("robots", "a list of at most 8 robots"), watch;
    for (const nlohmann::json& robot : *robots) watch.robots.emplace_back(fields.index_of(robot, "robots"));
    const nlohmann::json* overlays = fields.find("overlays");
    if (overlays == nullptr) overlays = &none;
    if (!overlays->is_array() || overlays->size() > 16)
        return fields.fail("overlays", "a list of names"), watch;
    for (const nlohmann::json& overlay : *overlays) {
        watch.contacts = watch.contacts || overlay == "contacts";
        watch.radio = watch.radio || overlay == "radio";
        watch.bounds = watch.bounds || overlay == "bounds";
        watch.groups = watch.groups || overlay == "groups";
        watch.profile = watch.profile || overlay == "profile";
    }
    watch.rate = fields.number("rate", 30.0);
    if (!(watch.rate >= 0)) fields.fail("rate", "a number from 0 on");
    watch.rate = std::min(watch.rate, static_cast<double>(viewer_protocol::kRateMax));
    watch.cameras = cameras_of(fields);
    watch.numbers = numbers_of(fields);
    return watch;
}

PageDesk desk_of(PageFields& fields, PageDesk::Kind kind) {
    PageDesk desk;
    desk.kind = kind;
    if (kind == PageDesk::Kind::kKeep || (kind == PageDesk::Kind::kYield && fields.find("page") != nullptr))
        desk.page = fields.index("page");
    return desk;
}

/// Deep nesting costs a parser its stack: it is counted before anything is parsed.
bool too_deep(std::string_view text) {
    int depth = 0, deepest = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted && c == '\\') ++i;
        if (c == '"') quoted = !quoted;
        if (quoted) continue;
        if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
        if (c == ']' || c == '}') --depth;
    }
    return deepest > kDepthMax;
}

}  // namespace

Result<PageRequest> parse_page_request(std::string_view text) {
    const auto refused = [](const std::string& why) {
        return Error{"invalid message of a page: " + why, "see docs/viewer-protocol.md", "bad-message"};
    };
    if (too_deep(text)) return refused("it is nested too deeply");
    const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_object()) return refused("it is not a JSON object");
    PageFields fields(json);
    const std::string type = fields.text("type");
    PageRequest request;
    if (type != "watch" && type != "whole") request.id = static_cast<std::int64_t>(fields.index("id", 0u));
    if (type == "control") {
        request.what = control_of(fields);
    } else if (type == "order") {
        request.what = order_of(fields);
    } else if (type == "watch") {
        request.what = watch_of(fields);
    } else if (type == "whole") {
        request.what = PageWhole{};
    } else if (type == "ask") {
        request.what = desk_of(fields, PageDesk::Kind::kAsk);
    } else if (type == "yield") {
        request.what = desk_of(fields, PageDesk::Kind::kYield);
    } else if (type == "keep") {
        request.what = desk_of(fields, PageDesk::Kind::kKeep);
    } else {
        fields.fail("type", "control, order, watch, whole, ask, yield or keep");
    }
    if (!fields.wrong().empty()) return refused(fields.wrong());
    return request;
}

}  // namespace roboss
