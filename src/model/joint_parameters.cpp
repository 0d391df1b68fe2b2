// See joint_parameters.h.
#include "model/joint_parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/fixed_math.h"
#include "model/joint_parameter_texts.h"
#include "model/own_number_lists.h"
#include "model/robot_state.h"
#include "world/joint_type.h"

namespace roboss {
namespace {

/// The largest number of any: products of two with a tick stay numbers.
constexpr double kLargestParameter = 1e12;

constexpr std::array<JointParameterInfo, kJointParameters> kRows{{
    {"lower", "rad", "m", &Dof::lower, false, true, false},
    {"upper", "rad", "m", &Dof::upper, false, true, false},
    {"max_effort", "N m", "N", &Dof::max_effort, true, true},
    {"max_velocity", "rad/s", "m/s", &Dof::max_velocity, true, true},
    {"damping", "N m s/rad", "N s/m", &Dof::damping},
    {"friction", "N m", "N", &Dof::friction},
    {"spring_stiffness", "N m/rad", "N/m", &Dof::spring_stiffness, true, false, false},
    {"spring_reference", "rad", "m", &Dof::spring_reference, false, false, false},
    {"armature", "kg m^2", "kg", &Dof::armature},
    {"position_gain", "N m/rad", "N/m", &Dof::position_gain, true, false, false},
    {"velocity_gain", "N m s/rad", "N s/m", &Dof::velocity_gain},
    {"limit_stiffness", "N m/rad", "N/m", &Dof::limit_stiffness, true, true, false},
    {"limit_dissipation", "N m s/rad", "N s/m", &Dof::limit_dissipation, true, false, false},
}};

/// The fault of a number, whatever the type of the robot; nullopt: none.
std::optional<NumberFault> fault_of(JointParameter parameter, double value) {
    const JointParameterInfo& row = info_of(parameter);
    if (std::isnan(value) || (std::isinf(value) && !row.endless))
        return NumberFault{"", "give a finite number", "not-finite"};
    if (row.signless && value < 0)
        return NumberFault{"; it cannot be negative", "give a number of at least 0", "bad-parameter"};
    if (parameter == JointParameter::kLimitStiffness && value == 0)
        return NumberFault{"; a limit that does not push is none",
                           "give a stiffness above 0, or move the limits", "bad-parameter"};
    if (std::isfinite(value) && std::fabs(value) > kLargestParameter)
        return NumberFault{"; more than " + number_text(kLargestParameter) + " is no number of a joint",
                           "give at most that; docs/physics.md lists the limits of orders", "beyond-limit"};
    return std::nullopt;
}

bool are_within(const Dof& own, const Dof& of_type) {
    return own.lower <= own.upper && own.lower >= of_type.lower && own.upper <= of_type.upper;
}

bool is_rotor(JointParameter parameter) {
    return parameter == JointParameter::kArmature;
}

/// True if no order sets this number of a joint of this kind, unless to 0 of a rotor.
bool lacks(const RobotType& type, const Joint& joint, JointParameter parameter) {
    if (joint_type(joint.kind).is_isotropic() && !info_of(parameter).of_balls) return true;
    return is_rotor(parameter) && (joint.loop >= 0 || !type.elimination.empty());
}

constexpr auto kAxisOf = [](const OwnJointNumber& one) { return std::pair(one.joint, one.axis); };

bool has_number(const Dof& dof, const JointParameterValue& number) {
    return dof.*info_of(number.parameter).member == number.value;
}

/// Checks the numbers of one axis, and names what is wrong.
class AxisCheck {
  public:
    AxisCheck(const std::string& robot, const RobotType& type, const SetJointParameters& order)
        : type_(type), order_(order), joint_(type.joints[order.joint.index()]) {
        called_ = "joint '" + joint_.name + "' of robot '" + robot + "'";
    }

    Result<> run() const {
        if (Result<> fine = check_list(order_, called_, kJointParameters, joint_parameter_names()); !fine)
            return fine;
        for (const JointParameterValue& one : order_.values)
            if (Result<> fine = check(one); !fine) return fine;
        return check_axis_limits();
    }

  private:
    Result<> check(const JointParameterValue& one) const {
        const JointParameterInfo& row = info_of(one.parameter);
        if (Result<> fine = check_kind(one, row); !fine) return fine;
        return check_value(one, row);
    }

    /// Refuses a number that joints of this kind do not have.
    Result<> check_kind(const JointParameterValue& one, const JointParameterInfo& row) const {
        if (joint_type(joint_.kind).is_isotropic() && !row.of_balls)
            return Error{std::string("'") + row.name + "' of " + called_ + ": a ball joint has none",
                         "set its damping, friction, armature, velocity_gain, max_effort or max_velocity",
                         "no-position"};
        if (one.value == 0 || !lacks(type_, joint_, one.parameter)) return Ok{};
        if (joint_.loop >= 0)
            return Error{"'armature' of " + called_ + ": it closes a loop, and has no rotor inertia",
                         "give it to a joint that the loop is not cut at", "loop-joint"};
        if (!type_.elimination.empty())
            return Error{"'armature' of " + called_ + ": robots with this many loops have no rotor inertias",
                         "write it in the world file, for all robots of the type", "many-loops"};
        return Ok{};
    }

    Result<> check_value(const JointParameterValue& one, const JointParameterInfo& row) const {
        const std::optional<NumberFault> fault = fault_of(one.parameter, one.value);
        if (!fault) return Ok{};
        return Error{std::string("'") + row.name + "' of " + called_ + " is " + number_text(one.value) + " " +
                         unit_of(one.parameter, joint_, order_.axis) + fault->text,
                     fault->remedy, fault->code};
    }

    Result<> check_axis_limits() const {
        const auto lower = value_of(JointParameter::kLower), upper = value_of(JointParameter::kUpper);
        if (!lower && !upper) return Ok{};
        if (!lower || !upper)
            return Error{"order for " + called_ + " sets one of its two limits",
                         "give 'lower' and 'upper' together", "half-limits"};
        const std::string both = "[" + number_text(*lower) + ", " + number_text(*upper) + "]";
        if (!(*lower <= *upper))
            return Error{"limits " + both + " of " + called_ + ": the lower one is above the upper one",
                         "give the smaller number as 'lower'", "bad-parameter"};
        const Dof& of_type = type_.dof(joint_, order_.axis);
        if (*lower >= of_type.lower && *upper <= of_type.upper) return Ok{};
        return Error{"limits " + both + " of " + called_ + " are wider than those of its type, [" +
                         number_text(of_type.lower) + ", " + number_text(of_type.upper) + "]",
                     "stay within these, or write wider ones in the world file", "beyond-type"};
    }

    std::optional<double> value_of(JointParameter parameter) const {
        const auto found = std::ranges::find(order_.values, parameter, &JointParameterValue::parameter);
        if (found == order_.values.end()) return std::nullopt;
        return found->value;
    }

    const RobotType& type_;
    const SetJointParameters& order_;
    const Joint& joint_;
    std::string called_;
};

/// The motor of an axis whose numbers were others `before`.
void fit_motor(const Dof& before, const Dof& now, MotorSetpoint& motor) {
    const bool had_all = motor.max_effort == before.max_effort;
    motor.max_effort = had_all ? now.max_effort : fixed_min(motor.max_effort, now.max_effort);
    if (before.position_gain == now.position_gain && before.velocity_gain == now.velocity_gain) return;
    motor.impulse = motor.load = 0;  // a hard motor starts from them, a soft one does not
}

}  // namespace

std::span<const JointParameterInfo> joint_parameters() {
    return kRows;
}

const JointParameterInfo& info_of(JointParameter parameter) {
    return kRows[static_cast<std::size_t>(parameter)];
}

std::optional<JointParameter> find_joint_parameter(std::string_view name) {
    return find_row<JointParameter>(joint_parameters(), name);
}

std::string joint_parameter_names() {
    return names_of_rows(joint_parameters());
}

Result<> check_joint_parameters(const std::string& robot, const RobotType& type,
                                const SetJointParameters& order) {
    if (order.joint.index() >= type.joints.size())
        return Error{"order for the parameters of a joint that robot '" + robot + "' does not have",
                     "see `roboss check` for its joints", "no-joint"};
    const Joint& joint = type.joints[order.joint.index()];
    if (order.axis < 0 || order.axis >= joint.nv)
        return Error{"joint '" + joint.name + "' of robot '" + robot + "' has " + std::to_string(joint.nv) +
                         " degrees of freedom; axis " + std::to_string(order.axis) + " is not one of them",
                     joint.nv == 0 ? "fixed joints have no parameters" : "count axes from 0", "no-axis"};
    return AxisCheck(robot, type, order).run();
}

void apply_joint_parameters(const RobotType& type, const SetJointParameters& order, RobotState& state) {
    const Joint& joint = type.joints[order.joint.index()];
    const Dof before = dof_of(type, state, joint, order.axis);
    OwnNumbers own = state.own;
    const auto [first, last] = numbers_with(std::pair(order.joint, order.axis), kAxisOf, own.joints);
    std::vector<JointParameterValue> numbers;
    if (!order.reset)
        for (auto one = first; one != last; ++one) numbers.push_back(one->number);
    for (const JointParameterValue& one : order.values) put_number(one, numbers);
    std::erase_if(numbers, [&](const JointParameterValue& one) {
        return has_number(type.dof(joint, order.axis), one);
    });
    auto at = own.joints.erase(first, last);
    for (const JointParameterValue& one : numbers)
        at = own.joints.insert(at, {order.joint, order.axis, one}) + 1;
    set_own(type, std::move(own), state);
    fit_motor(before, dof_of(type, state, joint, order.axis),
              state.motors[type.motor_index(joint, order.axis)]);
}

bool may_own(const RobotType& type, std::span<const OwnJointNumber> own) {
    for (std::size_t i = 0; i < own.size();) {
        const auto axis = kAxisOf(own[i]);
        if (axis.first.index() >= type.joints.size()) return false;
        const Joint& joint = type.joints[axis.first.index()];
        if (axis.second < 0 || axis.second >= joint.nv || (i > 0 && kAxisOf(own[i - 1]) >= axis))
            return false;
        const Dof& of_type = type.dof(joint, axis.second);
        Dof with = of_type;
        for (std::size_t first = i; i < own.size() && kAxisOf(own[i]) == axis; ++i) {
            const JointParameterValue& number = own[i].number;
            const bool is_sorted = i == first || own[i - 1].number.parameter < number.parameter;
            if (!is_sorted || static_cast<std::size_t>(number.parameter) >= kJointParameters ||
                fault_of(number.parameter, number.value) || lacks(type, joint, number.parameter) ||
                has_number(of_type, number))
                return false;
            with.*info_of(number.parameter).member = number.value;
        }
        if (!are_within(with, of_type)) return false;
    }
    return true;
}

bool put_numbers(std::span<const OwnJointNumber> own, RobotType& type) {
    bool rotors = false;
    for (const auto& [id, axis, number] : own) {
        const Joint& joint = type.joints[id.index()];
        const auto index = type.motor_index(joint, axis);
        Dof& dof =
            joint.loop < 0
                ? type.dofs[index]
                : type.loops[static_cast<std::size_t>(joint.loop)].dofs[static_cast<std::size_t>(axis)];
        dof.*info_of(number.parameter).member = number.value;
        rotors |= number.parameter == JointParameter::kArmature;
    }
    return rotors;
}

}  // namespace roboss
