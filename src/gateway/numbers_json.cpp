// Numbers of joints and links, of a robot and of its type, as JSON.
#include "gateway/numbers_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "model/joint_parameter_texts.h"
#include "model/link_value.h"
#include "world/joint_type.h"

namespace roboss {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity: null is no bound, as in orders.
Json bound_json(double value) {
    return std::isfinite(value) ? Json(value) : Json();
}

/// Lists own numbers by axis or link, as orders give them: the names of each stand in its "values". `place`:
/// the JSON that says where a number is, by which they are in order.
template <class Own, class Place>
Json grouped(const std::vector<Own>& own, Place place) {
    Json list = Json::array();
    Json before;
    for (const Own& one : own) {
        const Json here = place(one);
        if (here != before) list.push_back(here), before = here;
        list.back()["values"][info_of(one.number.parameter).name] = bound_json(one.number.value);
    }
    return list;
}

/// `of_type`: stands there only where it differs.
Json row_json(const char* name, const char* unit, double value, double of_type) {
    Json row{{"name", name}, {"unit", unit}, {"value", bound_json(value)}};
    if (value != of_type) row["file"] = bound_json(of_type);
    return row;
}

Json axis_numbers(const RobotType& type, const RobotState& state, const NumbersWish& wish) {
    const Joint& joint = type.joints[wish.joint.index()];
    const bool is_ball = joint_type(joint.kind).is_isotropic();
    const Dof &of_type = type.dof(joint, wish.axis), &own = dof_of(type, state, joint, wish.axis);
    Json list = Json::array();
    for (std::size_t i = 0; i < kJointParameters; ++i) {
        const auto parameter = static_cast<JointParameter>(i);
        const JointParameterInfo& row = info_of(parameter);
        if (is_ball && !row.of_balls) continue;
        list.push_back(
            row_json(row.name, unit_of(parameter, joint, wish.axis), own.*row.member, of_type.*row.member));
        if (row.endless) list.back()["endless"] = true;
    }
    return list;
}

Json link_numbers(const RobotType& type, const RobotState& state, LinkId link) {
    Json list = Json::array();
    for (std::size_t i = 0; i < kLinkParameters; ++i) {
        const auto parameter = static_cast<LinkParameter>(i);
        const std::optional<double> of_type = link_number(type, link, parameter);
        if (!of_type) continue;
        const LinkParameterInfo& row = info_of(parameter);
        const double value = link_value(type, state, link, parameter).value_or(*of_type);
        list.push_back(row_json(row.name, row.unit, value, *of_type));
    }
    return list;
}

}  // namespace

void add_own(const OwnNumbers& own, Json& out) {
    if (own.empty()) return;
    Json json = Json::object();
    if (!own.joints.empty())
        json["joints"] = grouped(own.joints, [](const OwnJointNumber& one) {
            return Json::object({{"joint", one.joint.value}, {"axis", one.axis}});
        });
    if (!own.links.empty())
        json["links"] = grouped(own.links, [](const OwnLinkNumber& one) {
            return Json::object({{"link", one.link.value}});
        });
    for (const SurroundingInfo& row : surroundings())
        if (const std::optional<Vec3>& value = own.around.*row.own)
            json[row.name] = {value->x, value->y, value->z};
    out["own"] = std::move(json);
}

bool has_numbers(const RobotType& type, const NumbersWish& wish) {
    if (wish.link.valid()) return wish.link.index() < type.links.size();
    return wish.joint.valid() && wish.joint.index() < type.joints.size() &&
           wish.axis < type.joints[wish.joint.index()].nv;
}

void add_numbers(const RobotType& type, const RobotState& state, const NumbersWish& wish, Json& out) {
    const bool of_link = wish.link.valid();
    if (of_link)
        out["link"] = wish.link.value;
    else
        out["joint"] = wish.joint.value, out["axis"] = wish.axis;
    out["numbers"] = of_link ? link_numbers(type, state, wish.link) : axis_numbers(type, state, wish);
}

}  // namespace roboss
