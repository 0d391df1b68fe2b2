// Checks orders from outside and applies them to a robot's state.
#include "model/order.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <iterator>
#include <tuple>

#include "core/fixed_math.h"
#include "model/powerless_joints.h"
#include "world/joint_type.h"

namespace roboss {
namespace {

constexpr Tick kDurationMax = Tick{1} << 60;  // apply_at + duration must not overflow
constexpr std::size_t kCommandValuesMax = 100'000;
const char* const kFiniteRemedy = "every number of an order must be finite";

/// "robot 'car_7'" for messages.
std::string called(const Model& model, const Order& order) {
    return "robot '" + model.robots[order.robot.index()].name + "'";
}

std::string text(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%g", value);
    return buffer;
}

/// One number of an order and what it may be at most.
struct Bounded {
    const char* name;
    double value, limit;
    const char* unit;
};

/// `what` names order and robot.
Result<> check_limits(const std::string& what, std::initializer_list<Bounded> numbers) {
    for (const Bounded& n : numbers)
        if (std::fabs(n.value) > n.limit)
            return Error{what + ": a " + n.name + " of " + text(n.value) + " " + n.unit +
                             " is beyond the limit of " + text(n.limit) + " " + n.unit,
                         "give at most that; docs/physics.md lists the limits of orders", "beyond-limit"};
    return Ok{};
}

double largest(const Vec3& v) {
    const double sizes[] = {v.x, v.y, v.z};
    return *std::max_element(std::begin(sizes), std::end(sizes),
                             [](double a, double b) { return std::fabs(a) < std::fabs(b); });
}

/// Checks one action against the robot's type.
struct Check {
    const Model& model;
    const Order& order;
    const RobotType& type;

    Result<> operator()(const SetPose& a) const {
        if (!is_finite(a.X_WR))
            return Error{"set_pose of " + called(model, order) + " is not finite", kFiniteRemedy,
                         "not-finite"};
        if (type.is_static)
            return Error{"set_pose: " + called(model, order) + " is static",
                         "make the model movable (<static>false)", "static-model"};
        const Quat& q = a.X_WR.q;
        const double n = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
        if (std::fabs(n - 1.0) > 1e-6)
            return Error{"set_pose of " + called(model, order) + " has a quaternion of norm " +
                             std::to_string(std::sqrt(n)),
                         "give a unit quaternion [w, x, y, z]", "bad-rotation"};
        return check_limits("set_pose of " + called(model, order),
                            {{"position", largest(a.X_WR.p), kOrderLimits.position, "m"}});
    }
    Result<> operator()(const SetVelocity& a) const {
        if (!is_finite(a.linear) || !is_finite(a.angular))
            return Error{"set_velocity of " + called(model, order) + " is not finite", kFiniteRemedy,
                         "not-finite"};
        if (!type.free_base)
            return Error{"set_velocity: the base of " + called(model, order) + " is fixed to the world",
                         "order its joints instead", "fixed-base"};
        return check_limits("set_velocity of " + called(model, order),
                            {{"linear velocity", largest(a.linear), kOrderLimits.speed, "m/s"},
                             {"angular velocity", largest(a.angular), kOrderLimits.turn_rate, "rad/s"}});
    }
    Result<> operator()(const ApplyWrench& a) const {
        if (a.link.index() >= type.links.size())
            return Error{"wrench on a link that " + called(model, order) + " does not have",
                         "see `roboss check` for its links", "no-link"};
        if (!is_finite(a.force) || !is_finite(a.torque))
            return Error{"wrench on " + called(model, order) + " is not finite", kFiniteRemedy, "not-finite"};
        const std::string what = "wrench on " + called(model, order);
        if (Result<> lasts = check_duration(what, a.duration); !lasts) return lasts;
        return check_limits(what, {{"force", largest(a.force), kOrderLimits.force, "N"},
                                   {"torque", largest(a.torque), kOrderLimits.torque, "N m"}});
    }
    Result<> operator()(const Pull& a) const {
        const std::string what = "pull on " + called(model, order);
        if (a.link.index() >= type.links.size())
            return Error{what + " at a link that it does not have", "see `roboss check` for its links",
                         "no-link"};
        if (!is_finite(a.p_L) || !is_finite(a.target_W) || !std::isfinite(a.max_force) ||
            !std::isfinite(a.rate))
            return Error{what + " is not finite", kFiniteRemedy, "not-finite"};
        if (!(a.max_force >= 0) || !(a.rate > 0))
            return Error{what + " has a negative force, or a rate that is not above 0",
                         "give a greatest force in N and a rate in rad/s", "bad-value"};
        if (Result<> lasts = check_duration(what, a.duration); !lasts) return lasts;
        return check_limits(what, {{"position", largest(a.p_L), kOrderLimits.position, "m"},
                                   {"position", largest(a.target_W), kOrderLimits.position, "m"},
                                   {"force", a.max_force, kOrderLimits.force, "N"},
                                   {"rate", a.rate, kOrderLimits.rate, "rad/s"}});
    }
    Result<> operator()(const SetJoint& a) const {
        if (a.joint.index() >= type.joints.size())
            return Error{"order for a joint that " + called(model, order) + " does not have",
                         "see `roboss check` for its joints", "no-joint"};
        const Joint& joint = type.joints[a.joint.index()];
        if (a.axis < 0 || a.axis >= joint.nv)
            return Error{"joint '" + joint.name + "' of " + called(model, order) + " has " +
                             std::to_string(joint.nv) + " degrees of freedom; axis " +
                             std::to_string(a.axis) + " is not one of them",
                         joint.nv == 0 ? "fixed joints take no orders" : "count axes from 0", "no-axis"};
        if (joint_type(joint.kind).is_isotropic() && a.mode == MotorMode::kPosition)
            return Error{std::string(joint_type(joint.kind).name) + " joint '" + joint.name +
                             "' takes no position order per axis",
                         "order its velocity or effort", "no-position"};
        if (!std::isfinite(a.target) || std::isnan(a.max_effort))
            return Error{"order for joint '" + joint.name + "' of " + called(model, order) + " is not finite",
                         kFiniteRemedy, "not-finite"};
        const std::string what = "order for joint '" + joint.name + "' of " + called(model, order);
        const Dof& dof = type.dof(joint, a.axis);
        if (const ZeroLimit* limit = zero_limit(dof.max_effort, dof.max_velocity);
            limit != nullptr && a.mode != MotorMode::kPassive)
            return Error{what + ": its " + std::string(limit->name) + " is 0, so no motor can move it",
                         std::string(limit->remedy), std::string(limit->code)};
        return check_target(what, a);
    }
    Result<> operator()(const SetJointState& a) const {
        if (a.joint.index() >= type.joints.size())
            return Error{"state of a joint that " + called(model, order) + " does not have",
                         "see `roboss check` for its joints", "no-joint"};
        const Joint& joint = type.joints[a.joint.index()];
        const auto what = [&] { return "state of joint '" + joint.name + "' of " + called(model, order); };
        if (joint.loop >= 0)
            return Error{what() + ": it closes a loop, and follows from the other joints", "set those",
                         "loop-joint"};
        const auto axes = static_cast<std::size_t>(joint.nv);
        for (const auto* values : {&a.position, &a.velocity})
            if (!values->empty() && values->size() != axes)
                return Error{what() + " has " + std::to_string(values->size()) + " values; the joint has " +
                                 std::to_string(axes) + " axes",
                             "give one value for each axis, of a ball joint a rotation vector", "bad-values"};
        if (a.position.empty() && a.velocity.empty())
            return Error{what() + " has neither a position nor a velocity", "give one of them, or both",
                         "bad-values"};
        for (const double x : a.position)
            if (Result<> fine = check_state(what, "position", x, kOrderLimits.position, "rad or m"); !fine)
                return fine;
        for (const double x : a.velocity)
            if (Result<> fine = check_state(what, "velocity", x, kOrderLimits.speed, "rad/s or m/s"); !fine)
                return fine;
        return Ok{};
    }
    Result<> operator()(const Command& a) const {
        if (a.channel >= type.channels.size())
            return Error{"command number " + std::to_string(a.channel) + " of " + called(model, order) +
                             ", which takes " + std::to_string(type.channels.size()) + " commands",
                         "see `roboss check` for its commands", "no-command"};
        const Channel& channel = type.channels[a.channel].channel;
        const std::string what = "command '" + channel.name + "' of " + called(model, order);
        const std::size_t width = channel.values.size();
        const bool fits =
            channel.is_list ? width > 0 && a.values.size() % width == 0 : a.values.size() == width;
        if (!fits || a.values.size() > kCommandValuesMax)
            return Error{what + " has " + std::to_string(a.values.size()) + " values; it takes " +
                             std::to_string(width) + (channel.is_list ? " in each of its rows" : ""),
                         "give " + names_of(channel), "bad-values"};
        for (std::size_t i = 0; i < a.values.size(); ++i) {
            if (!std::isfinite(a.values[i]))
                return Error{what + " is not finite", kFiniteRemedy, "not-finite"};
            const ChannelValue& value = channel.values[i % width];
            if (auto ok =
                    check_limits(what, {{value.name.c_str(), a.values[i], kCommandMax, value.unit.c_str()}});
                !ok)
                return ok;
        }
        return Ok{};
    }
    Result<> operator()(const Attach& a) const {
        const std::string what = "attach order of " + called(model, order);
        if (a.other.index() >= model.robots.size() || a.other == order.robot)
            return Error{what + " names no other robot", "name the robot that shall be held", "no-robot"};
        if (a.link.index() >= type.links.size() ||
            a.other_link.index() >= model.type_of(a.other).links.size())
            return Error{what + " names a link that does not exist", "see `roboss check` for the links",
                         "no-link"};
        if (!(a.max_force > 0) || !(a.max_torque > 0))
            return Error{what + " holds with no force or no torque", "give a maximum above 0, or none",
                         "bad-value"};
        if (!(a.reach >= 0)) return Error{what + " has a negative reach", "give a reach in m", "bad-value"};
        return check_limits(what, {{"reach", a.reach, kOrderLimits.position, "m"}});
    }
    Result<> operator()(const Detach& a) const {
        if (!a.other.valid() || (a.other.index() < model.robots.size() && a.other != order.robot))
            return Ok{};
        return Error{"detach order of " + called(model, order) + " names no other robot",
                     "name the robot that is held, or none to let go of all", "no-robot"};
    }
    Result<> operator()(const SetJointParameters& a) const {
        return check_joint_parameters(model.robots[order.robot.index()].name, type, a);
    }
    Result<> operator()(const SetLinkParameters& a) const {
        return check_link_parameters(model.robots[order.robot.index()].name, type, a);
    }
    Result<> operator()(const SetSurroundings& a) const {
        return check_surroundings(model.robots[order.robot.index()].name, a);
    }
    Result<> operator()(const Transmit& a) const {
        const std::string what = "message of " + called(model, order);
        if (a.radio >= type.radios.size())
            return Error{what + " by radio number " + std::to_string(a.radio) + "; it has " +
                             std::to_string(type.radios.size()) + " radios",
                         "see `roboss check` for its sensors", "no-radio"};
        if (a.to.valid() && (a.to.index() >= model.robots.size() || a.to == order.robot))
            return Error{what + " is for no other robot", "name the robot that it is for, or none for all",
                         "no-robot"};
        if (a.payload.size() > RadioState::kMostPayload)
            return Error{what + " has " + std::to_string(a.payload.size()) + " bytes",
                         "send at most " + std::to_string(RadioState::kMostPayload) + " bytes in a message",
                         "long-message"};
        return Ok{};
    }
    template <class What>
    static Result<> check_state(const What& what, const char* name, double value, double limit,
                                const char* unit) {
        if (!std::isfinite(value)) return Error{what() + " is not finite", kFiniteRemedy, "not-finite"};
        if (std::fabs(value) <= limit) return Ok{};
        return check_limits(what(), {{name, value, limit, unit}});
    }
    static Result<> check_duration(const std::string& what, Tick duration) {
        if (duration > kDurationMax)
            return Error{what + " lasts longer than any run", "give a duration in ticks below 2^60",
                         "bad-duration"};
        if (duration < 1)
            return Error{what + " lasts less than one tick", "give a duration > 0", "bad-duration"};
        return Ok{};
    }
    static std::string names_of(const Channel& channel) {
        std::string names;
        for (const ChannelValue& value : channel.values) {
            names += (names.empty() ? "[" : ", ") + value.name;
            if (!value.unit.empty()) names += " in " + value.unit;
        }
        return names + "]";
    }
    static Result<> check_target(const std::string& what, const SetJoint& a) {
        switch (a.mode) {
            case MotorMode::kPassive:
                return Ok{};
            case MotorMode::kVelocity:
                return check_limits(what, {{"velocity", a.target, kOrderLimits.speed, "rad/s or m/s"}});
            case MotorMode::kPosition:
                return check_limits(what, {{"position", a.target, kOrderLimits.position, "rad or m"}});
            case MotorMode::kEffort:
                return check_limits(what, {{"effort", a.target, kOrderLimits.force, "N m or N"}});
        }
        return Error{what + " names a motor mode that does not exist",
                     "give passive, velocity, position or effort", "bad-mode"};
    }
};

/// Removes transmissions that are too old to be received.
void forget_old(RadioState& radio, double now_s) {
    std::size_t count = 0, bytes = 0;
    while (count < radio.sent.size() && radio.sent[count].end_s + RadioState::kKept_s < now_s)
        bytes += radio.sent[count++].size;
    radio.sent.erase(radio.sent.begin(), radio.sent.begin() + static_cast<std::ptrdiff_t>(count));
    radio.bytes.erase(radio.bytes.begin(), radio.bytes.begin() + static_cast<std::ptrdiff_t>(bytes));
}

/// Applies one checked action.
struct Apply {
    const Model& model;
    const Order& order;
    const RobotType& type;
    RobotState& state;

    void operator()(const SetPose& a) const {
        Pose X_WB = a.X_WR;
        if (type.free_base) X_WB = X_WB * Pose{type.X_RB.p, to_quat(type.X_RB.R)};
        X_WB.q = normalized(X_WB.q);
        set_base_pose(state, X_WB);
    }
    void operator()(const SetVelocity& a) const {
        const double numbers[] = {a.angular.x, a.angular.y, a.angular.z, a.linear.x, a.linear.y, a.linear.z};
        for (std::size_t i = 0; i < 6; ++i) state.v[i] = numbers[i];
    }
    void operator()(const ApplyWrench& a) const {
        if (a.replaces) std::erase_if(state.wrenches, [&](const TimedWrench& w) { return w.link == a.link; });
        state.wrenches.push_back({a.link, a.force, a.torque, order.apply_at + a.duration});
    }
    void operator()(const Pull& a) const {
        std::erase_if(state.pulls, [&](const TimedPull& p) { return p.link == a.link; });
        if (a.max_force > 0)
            state.pulls.push_back(
                {a.link, a.p_L, a.target_W, a.rate, a.max_force, order.apply_at + a.duration});
    }
    void operator()(const SetJoint& a) const {
        const Joint& joint = type.joints[a.joint.index()];
        const double bound = dof_of(type, state, joint, a.axis).max_effort;
        MotorSetpoint& motor = state.motors[type.motor_index(joint, a.axis)];
        if (motor.mode != a.mode) motor.impulse = motor.load = 0;
        motor.mode = a.mode, motor.target = a.target;
        motor.max_effort = a.max_effort < 0 ? bound : fixed_min(a.max_effort, bound);
    }
    void operator()(const SetJointState& a) const {
        const Joint& joint = type.joints[a.joint.index()];
        double* const q = &state.q[static_cast<std::size_t>(joint.q_index)];
        double* const v = &state.v[static_cast<std::size_t>(joint.v_index)];
        if (!a.position.empty() && joint_type(joint.kind).is_isotropic()) {
            const Quat turned = exponential(Vec3{a.position[0], a.position[1], a.position[2]});
            q[0] = turned.w, q[1] = turned.x, q[2] = turned.y, q[3] = turned.z;
        } else {
            for (std::size_t i = 0; i < a.position.size(); ++i)
                q[joint.axis_offset(static_cast<int>(i))] = a.position[i];
        }
        for (std::size_t i = 0; i < a.velocity.size(); ++i)
            v[joint.axis_offset(static_cast<int>(i))] = a.velocity[i];
    }
    void operator()(const Command& a) const {
        const ChannelInfo& channel = type.channels[a.channel];
        const auto at = static_cast<std::size_t>(channel.index);
        state.onboard[at] = static_cast<double>(order.apply_at);
        if (channel.channel.is_list)
            state.lists[static_cast<std::size_t>(channel.list_index)] = a.values;
        else
            std::copy(a.values.begin(), a.values.end(),
                      state.onboard.begin() + static_cast<std::ptrdiff_t>(at) + 1);
    }
    void operator()(const Attach& a) const {
        const auto is_held = [&](const Bond& bond) {
            return bond.phase != BondPhase::kLoosed && bond.link == a.link && bond.other == a.other.value &&
                   bond.other_link == a.other_link;
        };
        if (std::ranges::any_of(state.bonds, is_held)) return;
        Bond bond;
        bond.link = a.link, bond.other = a.other.value, bond.other_link = a.other_link;
        bond.reach = a.reach, bond.max_force = a.max_force, bond.max_torque = a.max_torque;
        state.bonds.push_back(bond);
    }
    void operator()(const Transmit& a) const {
        const auto& spec = *type.sensors[type.radios[a.radio]].spec.as<RadioSpec>();
        RadioState& radio = state.radios[a.radio];
        const double now_s = static_cast<double>(order.apply_at) * model.dt_s;
        forget_old(radio, now_s);
        if (radio.sent.size() >= RadioState::kMostKept ||
            radio.bytes.size() + a.payload.size() > RadioState::kMostBytes) {
            ++radio.dropped;
            return;
        }
        Transmission t;
        t.number = radio.count++, t.to = a.to.value, t.given = order.apply_at;
        t.size = static_cast<std::uint32_t>(a.payload.size());
        t.begin_s = radio.sent.empty() ? now_s : std::max(now_s, radio.sent.back().end_s);
        t.end_s = t.begin_s;
        if (!spec.is_perfect) t.end_s += 8.0 * static_cast<double>(t.size) / spec.bit_rate;
        t.X_WB = base_pose(state);
        radio.sent.push_back(t);
        radio.bytes.insert(radio.bytes.end(), a.payload.begin(), a.payload.end());
    }
    void operator()(const SetJointParameters& a) const { apply_joint_parameters(type, a, state); }
    void operator()(const SetLinkParameters& a) const { apply_link_parameters(type, a, state); }
    void operator()(const SetSurroundings& a) const { apply_surroundings(model, type, a, state); }
    void operator()(const Detach& a) const {
        for (Bond& bond : state.bonds)
            if (!a.other.valid() || bond.other == a.other.value) bond.phase = BondPhase::kLoosed;
    }
};

}  // namespace

bool comes_before(const Order& a, const Order& b) {
    return std::tie(a.apply_at, a.client, a.sequence) < std::tie(b.apply_at, b.client, b.sequence);
}

Result<> check_order(const Model& model, const Order& order) {
    if (order.robot.index() >= model.robots.size())
        return Error{"order for robot number " + std::to_string(order.robot.value) + ", but the world has " +
                         std::to_string(model.robots.size()) + " robots",
                     "see `roboss check` for their names", "no-robot"};
    return std::visit(Check{model, order, model.type_of(order.robot)}, order.action);
}

void apply_order(const Model& model, const Order& order, RobotState& state) {
    if (!std::holds_alternative<Transmit>(order.action)) state.rest = {};
    std::visit(Apply{model, order, model.type_of(order.robot), state}, order.action);
}

}  // namespace roboss
