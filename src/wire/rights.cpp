// See rights.h.
#include "wire/rights.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <variant>

#include "model/robot_names.h"

namespace roboss {
namespace {

constexpr std::array<const char*, kOrderKinds> kKindNames{"pose",      "velocity", "force",
                                                          "actuators", "bonds",    "radio"};
constexpr const char *kEverything = "everything", *kLookOnly = "look-only";
constexpr std::size_t kTextMost = 4'096;  // bytes of a certificate

Error bad(const std::string& what, const std::string& remedy) {
    return {what, remedy, "bad-rights"};
}

Error not_permitted(const Rights& rights, const std::string& what) {
    return {"the key '" + rights.key + "' does not permit " + what,
            "use what it permits (" + rights_text(rights) + "), or another key (`roboss keys add`)",
            "not-permitted"};
}

bool may_order(const Rights& rights, const std::string& robot) {
    return std::ranges::any_of(rights.robots,
                               [&](const std::string& pattern) { return fits_pattern(robot, pattern); });
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ",") + word;
    return text;
}

std::vector<std::string> split(std::string_view text, char mark) {
    std::vector<std::string> parts;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(mark), text.size());
        parts.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return parts;
}

std::vector<std::string> kinds_of(const Rights& rights) {
    std::vector<std::string> kinds;
    for (std::size_t i = 0; i < kOrderKinds; ++i)
        if (rights.orders.test(i)) kinds.emplace_back(kKindNames[i]);
    return kinds;
}

/// Every character of a pattern that stands for itself in the text of rights.
bool is_plain(char c) {
    return static_cast<unsigned char>(c) >= ' ' && c != '\x7f' && c != ',' && c != ';' && c != '=';
}

}  // namespace

const char* order_kind_name(OrderKind kind) {
    return kKindNames[static_cast<std::size_t>(kind)];
}

OrderKind kind_of(const Action& action) {
    using enum OrderKind;
    static constexpr OrderKind kKinds[] = {kPose,  kVelocity, kForce, kActuators, kActuators, kBonds, kBonds,
                                           kForce, kPose,     kRadio, kActuators, kActuators, kForce};
    static_assert(std::size(kKinds) == std::variant_size_v<Action>);
    return kKinds[action.index()];
}

bool Rights::everything() const {
    return steers && orders.all() && std::ranges::find(robots, "*") != robots.end();
}

Result<> permit(const Rights* rights, const Model& model, const Order& order) {
    if (rights == nullptr) return Ok{};
    const OrderKind kind = kind_of(order.action);
    if (!rights->orders.test(static_cast<std::size_t>(kind)))
        return not_permitted(*rights, std::string("orders of the kind '") + order_kind_name(kind) + "'");
    const auto* attach = std::get_if<Attach>(&order.action);
    for (const RobotId robot : {order.robot, attach != nullptr ? attach->other : order.robot})
        if (const std::string& name = model.robots[robot.index()].name; !may_order(*rights, name))
            return not_permitted(*rights, "orders to robot '" + name + "'");
    return Ok{};
}

Result<> permit(const Rights* rights, const ControlAction& request) {
    if (rights == nullptr || rights->steers || only_asks(request)) return Ok{};
    return not_permitted(*rights, std::string("to steer the run ('") + control_verb(request) + "')");
}

std::string rights_text(const Rights& rights) {
    if (rights.everything()) return kEverything;
    if (rights.look_only()) return kLookOnly;
    return "robots=" + joined(rights.robots) + ";orders=" + joined(kinds_of(rights)) +
           ";steer=" + (rights.steers ? "yes" : "no");
}

Result<Rights> rights_of(const std::string& text) {
    if (text == kEverything) return Rights{};
    if (text == kLookOnly) return make_rights({"*"}, {}, false);
    const std::vector<std::string> parts = split(text, ';');
    constexpr std::array<std::string_view, 3> kFields{"robots=", "orders=", "steer="};
    const auto fits = [](const std::string& part, std::string_view field) { return part.starts_with(field); };
    if (!std::ranges::equal(parts, kFields, fits) || (parts[2] != "steer=yes" && parts[2] != "steer=no"))
        return bad("'" + text + "' are no rights", "make the key with `roboss keys add`");
    return make_rights(split(std::string_view(parts[0]).substr(kFields[0].size()), ','),
                       split(std::string_view(parts[1]).substr(kFields[1].size()), ','),
                       parts[2] == "steer=yes");
}

Result<Rights> make_rights(const std::vector<std::string>& robots, const std::vector<std::string>& orders,
                           bool steers) {
    Rights rights;
    rights.robots = robots;
    rights.orders.reset();
    rights.steers = steers;
    for (const std::string& pattern : robots)
        if (pattern.empty() || !std::ranges::all_of(pattern, is_plain))
            return bad("'" + pattern + "' is no pattern of robots in rights",
                       "give names and patterns such as car_*; write ? for a comma, a semicolon or =");
    for (const std::string& kind : orders) {
        const auto found =
            std::ranges::find(kKindNames, kind, [](const char* name) { return std::string(name); });
        if (found == kKindNames.end())
            return bad("there is no kind of orders '" + kind + "'",
                       "give some of pose, velocity, force, actuators, bonds, radio");
        rights.orders.set(static_cast<std::size_t>(found - kKindNames.begin()));
    }
    if (rights_text(rights).size() > kTextMost)
        return bad("the rights have more than 4096 bytes", "use patterns instead of names");
    return rights;
}

}  // namespace roboss
