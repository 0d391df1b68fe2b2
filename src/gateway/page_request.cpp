// Reading JSON that anybody may have written.
#include "gateway/page_request.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "wire/viewer_protocol.h"

namespace roboss {
namespace {

constexpr std::size_t kWordsMax = 1024;
constexpr int kDepthMax = 8;

/// Fields of one object; the first that is wrong is remembered.
class Fields {
  public:
    explicit Fields(const nlohmann::json& object) : object_(object) {}

    const nlohmann::json* find(const char* name) const {
        const auto found = object_.find(name);
        return found == object_.end() ? nullptr : &*found;
    }
    std::string text(const char* name) {
        const nlohmann::json* value = find(name);
        if (value != nullptr && value->is_string()) return value->get<std::string>();
        return fail(name, "a string"), std::string();
    }
    double number(const char* name, std::optional<double> otherwise = {}) {
        const nlohmann::json* value = find(name);
        if (value == nullptr && otherwise) return *otherwise;
        if (value != nullptr && value->is_number() && std::isfinite(value->get<double>()))
            return value->get<double>();
        return fail(name, "a finite number"), 0;
    }
    std::uint32_t index(const char* name, std::optional<std::uint32_t> otherwise = {}) {
        const nlohmann::json* value = find(name);
        if (value == nullptr && otherwise) return *otherwise;
        return value == nullptr ? (fail(name, "a number from 0 on"), 0) : index_of(*value, name);
    }
    std::vector<double> numbers(const char* name, std::size_t count) {
        std::vector<double> values;
        const nlohmann::json* list = find(name);
        if (list != nullptr && list->is_array() && list->size() == count)
            for (const nlohmann::json& value : *list)
                if (value.is_number() && std::isfinite(value.get<double>())) values.push_back(value);
        if (values.size() != count) fail(name, "a list of " + std::to_string(count) + " finite numbers");
        values.resize(count);
        return values;
    }
    std::vector<double> numbers(const char* name) {
        const nlohmann::json* list = find(name);
        if (list != nullptr && list->is_array()) return numbers(name, list->size());
        return fail(name, "a list of finite numbers"), std::vector<double>();
    }
    Vec3 vec3(const char* name) {
        const std::vector<double> v = numbers(name, 3);
        return {v[0], v[1], v[2]};
    }
    std::uint32_t index_of(const nlohmann::json& value, const char* name) {
        if (value.is_number_unsigned() && value.get<std::uint64_t>() < RobotId::kNone)
            return value.get<std::uint32_t>();
        return fail(name, "a number from 0 on"), 0;
    }
    void fail(const std::string& name, const std::string& wanted) {
        if (wrong_.empty()) wrong_ = "\"" + name + "\" is not " + wanted;
    }
    const std::string& wrong() const { return wrong_; }

  private:
    const nlohmann::json& object_;
    std::string wrong_;
};

ControlArguments control_of(Fields& fields) {
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

SetPose pose_of(Fields& fields) {
    const std::vector<double> v = fields.numbers("pose", 7);
    const double norm_squared = v[3] * v[3] + v[4] * v[4] + v[5] * v[5] + v[6] * v[6];
    if (!(norm_squared > 1e-6 && norm_squared < 1e6))
        return fields.fail("pose", "a position and a quaternion"), SetPose{};
    return {{{v[0], v[1], v[2]}, normalized(Quat{v[3], v[4], v[5], v[6]})}};
}

bool flag_of(Fields& fields, const char* name) {
    const nlohmann::json* value = fields.find(name);
    if (value != nullptr && !value->is_boolean()) fields.fail(name, "true or false");
    return value != nullptr && value->is_boolean() && value->get<bool>();
}

PagePull pull_of(Fields& fields) {
    PagePull pull;
    pull.pull.link = LinkId(fields.index("link", 0u));
    pull.pull.p_L = fields.vec3("point");
    pull.pull.target_W = fields.vec3("target");
    pull.pull.rate = fields.number("rate", pull.pull.rate);
    pull.pull.max_force = fields.number("max_force");
    pull.duration_s = fields.number("duration", pull.duration_s);
    return pull;
}

SetJoint joint_of(Fields& fields) {
    SetJoint joint;
    joint.joint = JointId(fields.index("joint"));
    joint.axis = static_cast<int>(fields.index("axis", 0u) % 8);
    const std::string mode = fields.text("mode");
    joint.target = fields.number("target", 0.0);
    joint.max_effort = fields.number("max_effort", -1.0);
    if (mode == "passive") return joint.mode = MotorMode::kPassive, joint;
    if (mode == "velocity") return joint.mode = MotorMode::kVelocity, joint;
    if (mode == "position") return joint.mode = MotorMode::kPosition, joint;
    if (mode == "effort") return joint.mode = MotorMode::kEffort, joint;
    return fields.fail("mode", "passive, velocity, position or effort"), joint;
}

PageCommand command_of(Fields& fields) {
    PageCommand command;
    command.name = fields.text("name");
    command.values = fields.numbers("values");
    return command;
}

Attach attach_of(Fields& fields) {
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

PageOrder order_of(Fields& fields) {
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
    } else if (action == "command") {
        order.action = command_of(fields);
    } else if (action == "attach") {
        order.action = attach_of(fields);
    } else if (action == "detach") {
        order.action = Detach{RobotId(fields.index("other", RobotId::kNone))};
    } else {
        fields.fail("action", "pose, velocity, wrench, pull, joint, command, attach or detach");
    }
    return order;
}

std::vector<PictureWish> cameras_of(Fields& fields) {
    const nlohmann::json* list = fields.find("cameras");
    std::vector<PictureWish> wishes;
    if (list == nullptr) return wishes;
    if (!list->is_array() || list->size() > viewer_protocol::kWatchedCamerasMax)
        return fields.fail("cameras", "a list of at most 16 cameras"), wishes;
    for (const nlohmann::json& one : *list) {
        if (!one.is_object()) return fields.fail("cameras", "a list of objects"), wishes;
        Fields camera(one);
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

PageWatch watch_of(Fields& fields) {
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
    return watch;
}

PageDesk desk_of(Fields& fields, PageDesk::Kind kind) {
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
    Fields fields(json);
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
