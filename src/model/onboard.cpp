// On-board controllers of a robot type: which part of a model they belong to, what their names mean there,
// and where their commands and memory are in the state.
#include <algorithm>
#include <type_traits>

#include "model/compile_type.h"
#include "world/joint_type.h"

namespace roboss {
namespace {

/// Whether a joint of the tree has one axis that a controller can read and drive.
bool has_one_axis(const RobotType& type, const Joint& joint) {
    return joint.nv == 1 && joint.loop < 0 && joint.v_index >= type.base_nv();
}

AxisRef axis_of(const RobotType& type, JointId id) {
    const Joint& joint = type.joints[id.index()];
    return {id, static_cast<int>(type.motor_index(joint, 0)), joint.q_index, joint.v_index};
}

/// The joint of the tree whose child, as the file has it, is the link; nullopt: there is none with one axis.
std::optional<JointId> axle_of(const RobotType& type, LinkId wheel) {
    for (std::size_t l = 0; l < type.links.size(); ++l) {
        const Link& link = type.links[l];
        if (link.carrier < 0) continue;
        const JointId id(static_cast<std::size_t>(link.carrier));
        const Joint& joint = type.joints[id.index()];
        const int child = joint.reversed ? link.parent : static_cast<int>(l);
        if (child == static_cast<int>(wheel.index()) && has_one_axis(type, joint)) return id;
    }
    return std::nullopt;
}

/// The axles of wheels that slip; false: a wheel has none.
bool find_axles(const RobotType& type, OnboardInfo& info) {
    if (!std::holds_alternative<WheelSlipSpec>(info.spec.parameters)) return true;
    for (const LinkId link : info.links) {
        const std::optional<JointId> axle = axle_of(type, link);
        if (!axle) return false;
        info.axes.push_back(axis_of(type, *axle));
    }
    return true;
}

/// The axes and links that the controller names; false: one of them is not in this type.
bool resolve_names(const RobotType& type, OnboardInfo& info) {
    info.axes.clear(), info.links.clear();
    for (const std::string& name : joints_named(info.spec.parameters)) {
        const std::optional<JointId> id = type.find_joint(name);
        if (!id || !has_one_axis(type, type.joints[id->index()])) return false;
        info.axes.push_back(axis_of(type, *id));
    }
    for (const std::string& name : links_named(info.spec.parameters)) {
        const std::optional<LinkId> id = type.find_link(name);
        if (!id) return false;
        info.links.push_back(*id);
    }
    return find_axles(type, info);
}

/// Channel `wanted` of the type, which is added if there is none of its name.
int place_of_channel(RobotType& type, const Channel& wanted) {
    if (const auto known = type.find_channel(wanted.name)) return static_cast<int>(*known);
    ChannelInfo info;
    info.channel = wanted;
    info.index = type.onboard_size;
    type.onboard_size += 1;
    if (wanted.is_list)
        info.list_index = type.list_count++;
    else
        type.onboard_size += static_cast<int>(wanted.values.size());
    type.channels.push_back(std::move(info));
    return static_cast<int>(type.channels.size()) - 1;
}

/// A channel of this name that takes other values; nullptr: none.
const Channel* conflicting(const RobotType& type, const Channel& channel) {
    for (const ChannelInfo& info : type.channels)
        if (info.channel.name == channel.name &&
            (info.channel.values.size() != channel.values.size() || info.channel.is_list != channel.is_list))
            return &info.channel;
    return nullptr;
}

/// Why a name cannot be used in this type; empty: it can.
std::string fault_of_joint(const RobotType& type, const std::string& name) {
    const std::optional<JointId> id = type.find_joint(name);
    if (!id) return "names the joint '" + name + "', which is not in this robot";
    const Joint& joint = type.joints[id->index()];
    if (joint.loop >= 0) return "drives the joint '" + name + "', which closes a kinematic loop";
    if (!has_one_axis(type, joint))
        return "drives the joint '" + name + "', which has " + std::to_string(joint.nv) +
               " axes that can move; it needs one";
    return {};
}

/// Why a detachable joint has nothing to join: its child is a link of its own robot. Empty: it is not.
std::string fault_of_child(const std::string& model, const RobotType& type,
                           const DetachableJointSpec& joint) {
    if (joint.parent_link.empty()) return {};
    const std::string& parent = joint.parent_link.front();
    const std::size_t at = parent.rfind("::");
    const std::string scope = at == std::string::npos ? "" : parent.substr(0, at + 2);
    const bool own = joint.child_model == "__model__" || joint.child_model == model;
    const std::string link = own ? joint.child_link : joint.child_model + "::" + joint.child_link;
    if (!type.find_link(scope + link) && !type.find_link(link)) return {};
    return "holds the link '" + link + "' of its own robot, which joints connect with '" + parent +
           "' already";
}

std::string fault_of(const std::string& model, const RobotType& type, const OnboardSpec& spec) {
    for (const std::string& name : joints_named(spec.parameters))
        if (std::string fault = fault_of_joint(type, name); !fault.empty()) return fault;
    for (const std::string& name : links_named(spec.parameters))
        if (!type.find_link(name)) return "names the link '" + name + "', which is not in this robot";
    if (const auto* detachable = std::get_if<DetachableJointSpec>(&spec.parameters))
        if (std::string fault = fault_of_child(model, type, *detachable); !fault.empty()) return fault;
    if (std::holds_alternative<WheelSlipSpec>(spec.parameters))
        for (const std::string& name : links_named(spec.parameters))
            if (!axle_of(type, *type.find_link(name)))
                return "lets the link '" + name +
                       "' slip, which has no axle: no joint with one axis carries it";
    if (const auto* elevator = std::get_if<ElevatorSpec>(&spec.parameters))
        if (std::string fault = elevator->fault(); !fault.empty()) return fault;
    for (const Channel& channel : channels_of(spec.parameters))
        if (conflicting(type, channel) != nullptr)
            return "takes the command '" + channel.name +
                   "', which another controller of this robot takes with other values";
    return {};
}

/// Whether this part of a model is the one to run the controller: it has all that it names, or, where no part
/// has, it is the main one.
bool belongs_here(const ModelSpec& model, const OnboardSpec& spec, bool is_main, const RobotType& type) {
    if (std::holds_alternative<CrumbSpec>(spec.parameters)) return true;  // every part is stored
    const auto joints = joints_named(spec.parameters), links = links_named(spec.parameters);
    if (joints.empty() && links.empty()) return is_main;
    const auto here = [&](const std::string& joint) { return type.find_joint(joint).has_value(); };
    const auto here_link = [&](const std::string& link) { return type.find_link(link).has_value(); };
    if (!joints.empty() && here(joints.front())) return true;
    if (joints.empty() && here_link(links.front())) return true;
    if (!is_main) return false;
    const auto in_model = [](const auto& items, const std::string& name) {
        return std::ranges::any_of(items, [&](const auto& item) { return item.name == name; });
    };
    return joints.empty() ? !in_model(model.links, links.front()) : !in_model(model.joints, joints.front());
}

/// Whether what the controller does depends on the wind.
bool feels_wind(const OnboardParameters& p) {
    return std::holds_alternative<LiftDragSpec>(p) || std::holds_alternative<AdvancedLiftDragSpec>(p) ||
           std::holds_alternative<MotorModelSpec>(p) || std::holds_alternative<LighterThanAirSpec>(p);
}

/// Adds parameters to a hash, by name and value. Of a step: without names and topics.
struct ParameterHash {
    Hash& hash;
    bool of_step = false;

    template <class Value>
    static constexpr bool kIsText =
        std::is_same_v<Value, std::string> || std::is_base_of_v<std::vector<std::string>, Value>;

    void add(double value) const { hash.add(value); }
    void add(const std::string& value) const { hash.add(std::string_view(value)); }
    void add(const Vec3& value) const { hash.add(value.x), hash.add(value.y), hash.add(value.z); }
    void add(const Pose& value) const {
        add(value.p);
        for (const double x : {value.q.w, value.q.x, value.q.y, value.q.z}) hash.add(x);
    }
    template <class Value>
    void operator()(const Parameter& parameter, const Value& value) const {
        hash.add(std::string_view(parameter.name));
        if (of_step && kIsText<Value> && !parameter.choice) return;
        if constexpr (std::is_same_v<Value, int> || std::is_same_v<Value, bool>) {
            hash.add(static_cast<std::uint64_t>(static_cast<std::int64_t>(value)));
        } else if constexpr (requires { requires ParameterRecord<typename Value::value_type>; }) {
            hash.add(static_cast<std::uint64_t>(value.size()));
            for (const auto& record : value) record.parameters(*this, record);
        } else if constexpr (requires { value.begin(); } && !std::is_same_v<Value, std::string>) {
            hash.add(static_cast<std::uint64_t>(value.size()));
            for (const auto& item : value) add(item);
        } else {
            add(value);
        }
    }
};

}  // namespace

bool onboard_fits(const RobotType& type) {
    RobotType seen;  // only its channels are of use
    for (const OnboardInfo& info : type.onboard) {
        if (info.base.index() >= type.links.size() || !problems_of(info.spec).empty()) return false;
        OnboardInfo named;
        named.spec = info.spec;
        if (!resolve_names(type, named)) return false;
        for (const Channel& channel : channels_of(info.spec.parameters)) {
            if (conflicting(seen, channel) != nullptr) return false;
            place_of_channel(seen, channel);
        }
    }
    return true;
}

void lay_out_onboard(RobotType& type) {
    type.channels.clear();
    type.onboard_size = type.list_count = 0;
    type.wind_index = -1;
    type.has_slip = false;
    type.feels_flow = !type.fluids.empty();
    for (OnboardInfo& info : type.onboard) {
        resolve_names(type, info);
        info.channels.clear();
        for (const Channel& channel : channels_of(info.spec.parameters))
            info.channels.push_back(place_of_channel(type, channel));
        info.memory = memory_at_start(info.spec.parameters);
        info.memory_index = type.onboard_size;
        type.onboard_size += static_cast<int>(info.memory.size());
        type.feels_flow = type.feels_flow || is_force_law(info.spec.parameters);
        type.has_slip = type.has_slip || std::holds_alternative<WheelSlipSpec>(info.spec.parameters);
        if (std::holds_alternative<WindEffectsSpec>(info.spec.parameters))
            type.wind_index = info.memory_index + WindEffectsSpec::kWindX;
    }
    for (OnboardInfo& info : type.onboard) {
        info.commands.clear();
        for (const std::string& name : channels_commanded(info.spec.parameters)) {
            const auto found = type.find_channel(name);
            info.commands.push_back(found ? static_cast<int>(*found) : -1);
        }
    }
}

void add_onboard(const ModelSpec& spec, bool is_main, RobotType& type, Diagnostics& diagnostics) {
    for (const OnboardSpec& onboard : spec.onboard) {
        if (!belongs_here(spec, onboard, is_main, type)) continue;
        if (const std::string fault = fault_of(spec.name, type, onboard); !fault.empty()) {
            diagnostics.warning(
                onboard.where, "plugin-not-run",
                "plugin '" + onboard.name + "' of model '" + spec.name + "' " + fault + "; it is not run",
                "`roboss check` lists the joints and links of the model.");
            continue;
        }
        OnboardInfo info;
        info.spec = onboard;
        info.base = type.find_link(spec.canonical_link).value_or(LinkId(std::size_t{0}));
        type.onboard.push_back(std::move(info));
        lay_out_onboard(type);
    }
}

void add_wind(const WindEffectsSpec& wind, RobotType& type) {
    const bool carried = std::ranges::any_of(type.drags, &LinkDrag::wind);
    const bool flown = std::ranges::any_of(
        type.onboard, [](const OnboardInfo& info) { return feels_wind(info.spec.parameters); });
    if (!carried && !flown) return;
    OnboardInfo info;
    info.spec = {WindEffectsSpec::kKind.name, wind, {}};
    std::get<WindEffectsSpec>(info.spec.parameters).regions.clear();  // the Model has them
    info.base = LinkId(std::size_t{0});
    type.onboard.insert(type.onboard.begin(), std::move(info));  // before those that feel it
    lay_out_onboard(type);
}

void add_to_hash(Hash& hash, const OnboardInfo& onboard) {
    hash.add(static_cast<std::uint64_t>(onboard.spec.kind().number));
    hash.add(static_cast<std::uint64_t>(onboard.base.value));
    visit_parameters(onboard.spec.parameters, ParameterHash{hash});
}

void add_to_step_hash(Hash& hash, const OnboardInfo& onboard) {
    const auto add = [&](const auto&... numbers) {
        (hash.add(static_cast<std::uint64_t>(static_cast<std::int64_t>(numbers))), ...);
    };
    add(onboard.spec.kind().number, onboard.base.value, onboard.memory_index);
    for (const AxisRef& axis : onboard.axes) add(axis.joint.value, axis.motor_index);
    for (const LinkId link : onboard.links) add(link.value);
    for (const int channel : onboard.channels) add(channel);
    for (const int command : onboard.commands) add(command);
    hash.add(std::span<const double>(onboard.memory));
    OnboardParameters parameters = onboard.spec.parameters;
    const auto leave_out_telemetry = [](auto& p) {
        if constexpr (requires { p.output = OdometryOutput{}; }) p.output = OdometryOutput{};
    };
    std::visit(leave_out_telemetry, parameters);  // it says how odometry is published
    visit_parameters(parameters, ParameterHash{hash, true});
}

}  // namespace roboss
