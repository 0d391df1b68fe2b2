// See compile_loops.h; the start configuration is settled in close_start.cpp.
#include "model/compile_loops.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "model/joint_motion.h"
#include "world/joint_type.h"

namespace roboss {
namespace {

constexpr double kHardStiffness = 1e8;  // SDF's default: as stiff as the solver allows
constexpr double kAligned = 1e-6;       // 1 - cosine of the angle between a gearbox' axis and its hinge's

const JointSpec* find_joint(const ModelSpec& spec, const std::string& name) {
    for (const JointSpec& joint : spec.joints)
        if (joint.name == name) return &joint;
    return nullptr;
}

std::string called(const JointSpec& joint, const ModelSpec& spec) {
    return "joint '" + joint.name + "' of model '" + spec.name + "'";
}

/// The hinge between a gearbox' reference link and one of its ends, and how its angle counts.
struct GearHinge {
    const JointSpec* joint = nullptr;
    double sign = 1;
};

std::optional<GearHinge> find_gear_hinge(const ModelSpec& spec, const JointSpec& gearbox, std::size_t axis,
                                         Diagnostics& diagnostics) {
    const std::string& end = axis == 0 ? gearbox.parent : gearbox.child;
    for (const JointSpec& hinge : spec.joints) {
        const bool forward = hinge.parent == gearbox.gearbox_reference && hinge.child == end;
        const bool backward = hinge.child == gearbox.gearbox_reference && hinge.parent == end;
        if (!joint_type(hinge.kind).is_hinge() || hinge.axes.empty() || !(forward || backward)) continue;
        const double cosine =
            dot(rotate(gearbox.X_MJ.q, gearbox.axes[axis].xyz), rotate(hinge.X_MJ.q, hinge.axes[0].xyz));
        if (1 - std::fabs(cosine) <= kAligned) return GearHinge{&hinge, (cosine > 0) == forward ? 1.0 : -1.0};
        diagnostics.error(gearbox.where, "gearbox-axis",
                          called(gearbox, spec) + ": its " + (axis == 0 ? "<axis>" : "<axis2>") +
                              " is not that of the hinge '" + hinge.name + "'",
                          "Give both the same direction.");
        return std::nullopt;
    }
    diagnostics.error(gearbox.where, "gearbox-hinge",
                      called(gearbox, spec) + ": no revolute or continuous joint connects '" + end +
                          "' with its reference body '" + gearbox.gearbox_reference + "'",
                      "Add the joint, or name the link that carries both as <gearbox_reference_body>.");
    return std::nullopt;
}

void find_gearbox(const ModelSpec& spec, const JointSpec& gearbox, std::vector<CouplingSpec>& found,
                  Diagnostics& diagnostics) {
    if (gearbox.axes.size() < 2) return;
    if (std::any_of(gearbox.axes.begin(), gearbox.axes.end(),
                    [](const AxisSpec& axis) { return axis.says_more(); }))
        diagnostics.warning(gearbox.where, "gearbox-axis",
                            called(gearbox, spec) +
                                ": limits, damping, friction, springs, initial position, motor and mimic of "
                                "a gearbox' axes are ignored",
                            "Write them at the hinges that it couples.");
    const auto first = find_gear_hinge(spec, gearbox, 0, diagnostics);
    const auto second = find_gear_hinge(spec, gearbox, 1, diagnostics);
    if (!first || !second) return;
    CouplingSpec coupling;
    coupling.follower = second->joint->name, coupling.leader = first->joint->name;
    coupling.multiplier = -gearbox.gearbox_ratio * first->sign * second->sign;
    coupling.where = gearbox.where;
    found.push_back(coupling);
}

/// The axis of the leader; nullopt: it has no such coordinate.
std::optional<std::size_t> leader_axis(const JointSpec& leader, const MimicSpec& mimic) {
    const JointType& type = joint_type(leader.kind);
    const auto by_number = static_cast<std::size_t>(mimic.axis);
    const std::size_t axis = type.find_axis(mimic.element).value_or(by_number);
    return !type.couples && axis < leader.axes.size() ? std::optional(axis) : std::nullopt;
}

void find_mimic(const ModelSpec& spec, const JointSpec& joint, std::size_t axis,
                std::vector<CouplingSpec>& found, Diagnostics& diagnostics) {
    const MimicSpec& mimic = *joint.axes[axis].mimic;
    const JointSpec* leader = find_joint(spec, mimic.joint);
    const auto led_by = leader != nullptr ? leader_axis(*leader, mimic) : std::nullopt;
    const bool itself = leader == &joint && led_by == axis;
    if (!led_by || itself) {
        diagnostics.error(joint.where, "mimic-leader",
                          called(joint, spec) + " mimics " +
                              (itself ? "itself"
                                      : (mimic.element.empty() ? "axis " + std::to_string(mimic.axis)
                                                               : "<" + mimic.element + ">") +
                                            " of '" + mimic.joint + "', which the model does not have"),
                          "Name another joint of the model and one of its axes.");
        return;
    }
    CouplingSpec coupling;
    coupling.follower = joint.name, coupling.leader = mimic.joint;
    coupling.follower_axis = static_cast<int>(axis), coupling.leader_axis = static_cast<int>(*led_by);
    coupling.multiplier = mimic.multiplier, coupling.where = joint.where;
    coupling.offset = mimic.is_linear() ? mimic.offset - mimic.multiplier * mimic.reference : mimic.offset;
    if (!mimic.is_linear()) coupling.reference = mimic.reference, coupling.higher = mimic.higher;
    found.push_back(coupling);
}

/// Index in RobotType::dofs; nullopt where the joint has no coordinate in the tree.
std::optional<int> dof_index(const RobotType& type, const Joint& joint, int axis) {
    if (joint.loop >= 0 || axis >= joint.nv || joint_type(joint.kind).is_isotropic()) return std::nullopt;
    return static_cast<int>(type.motor_index(joint, axis));
}

}  // namespace

Dof to_dof(const AxisSpec& axis, bool continuous) {
    Dof dof;
    dof.damping = axis.damping;
    dof.friction = axis.friction;
    dof.armature = axis.armature;
    if (!continuous && axis.lower > -kUnlimited) dof.lower = axis.lower;
    if (!continuous && axis.upper < kUnlimited) dof.upper = axis.upper;
    if (axis.max_effort >= 0 && axis.max_effort < kUnlimited) dof.max_effort = axis.max_effort;
    if (axis.max_velocity >= 0 && axis.max_velocity < kUnlimited) dof.max_velocity = axis.max_velocity;
    dof.spring_stiffness = axis.spring_stiffness;
    dof.spring_reference = axis.spring_reference;
    dof.position_gain = axis.position_gain;
    dof.velocity_gain = axis.velocity_gain;
    if (axis.limit_stiffness < kHardStiffness) {
        dof.limit_stiffness = axis.limit_stiffness;
        dof.limit_dissipation = axis.limit_dissipation;
    }
    return dof;
}

LoopJoint to_loop_joint(const JointSpec& spec, const Transform& X_MA, const Transform& X_MB) {
    LoopJoint loop;
    loop.kind = spec.kind;
    const Transform X_MJ = to_transform(spec.X_MJ);
    loop.X_AJ = inverse(X_MA) * X_MJ;
    loop.X_BJ = inverse(X_MB) * (spec.X_MJ_child ? to_transform(*spec.X_MJ_child) : X_MJ);
    if (!spec.axes.empty()) loop.axis_J = spec.axes[0].xyz;
    if (spec.axes.size() > 1) loop.axis2_J = spec.axes[1].xyz;
    const JointType& type = joint_type(spec.kind);
    for (const JointKind motion : type.motions)
        if (joint_traits(motion).has_pitch) loop.pitch = spec.screw_pitch;
    for (const AxisSpec& axis : spec.axes) loop.dofs.push_back(to_dof(axis, type.endless));
    if (type.is_isotropic()) loop.dofs.resize(3);
    for (Dof& dof : loop.dofs) dof.damping += spec.ball_damping;
    return loop;
}

void report_loop(const JointSpec& joint, const ModelSpec& model, Diagnostics& diagnostics) {
    const std::string name = "joint '" + joint.name + "' of model '" + model.name + "'";
    for (const LinkSpec& link : model.links)
        for (const SensorSpec& sensor : link.sensors)
            if (const auto read = joints_read(sensor); std::count(read.begin(), read.end(), joint.name) > 0)
                diagnostics.warning(joint.where, "loop-odometer",
                                    name + " closes a loop: sensor '" + sensor.name +
                                        "' reads its angle within (-pi, pi] only",
                                    "Let it read other joints of the loop, or leave one of them unread.");
    diagnostics.note(joint.where, "kinematic-loop",
                     name + " closes a kinematic loop: conditions between its two links keep it together");
    const JointType& type = joint_type(joint.kind);
    for (std::size_t k = 0; k < joint.axes.size() && k < type.motions.size(); ++k) {
        const AxisSpec& axis = joint.axes[k];
        const bool turns = joint_traits(type.motions[k]).turns && !type.endless;
        if (axis.initial_position != 0)
            diagnostics.warning(joint.where, "loop-start",
                                name + " closes a loop; its <initial_position> is ignored",
                                "Give the start of other joints of the loop.");
        if (axis.armature != 0)
            diagnostics.warning(joint.where, "loop-armature",
                                name + " closes a loop; its armature is ignored",
                                "Add the rotor's inertia to one of its links.");
        const bool beyond =
            (axis.lower < -kPi && axis.lower > -kUnlimited) || (axis.upper > kPi && axis.upper < kUnlimited);
        if (turns && beyond)
            diagnostics.warning(joint.where, "loop-limit",
                                name +
                                    " closes a loop: its angle is known within (-pi, pi] only, a limit "
                                    "beyond is never reached",
                                "Give another joint of the loop no limits, so that it is cut instead.");
    }
}

void report_immobile(const JointSpec& joint, const std::string& model, Diagnostics& diagnostics) {
    diagnostics.warning(joint.where, "immobile-joint",
                        "joint '" + joint.name + "' of model '" + model +
                            "' cannot move: fixed joints weld its two links together",
                        "Remove it, or one of the fixed joints.");
}

std::vector<CouplingSpec> find_couplings(const ModelSpec& spec, Diagnostics& diagnostics) {
    std::vector<CouplingSpec> found;
    for (const JointSpec& joint : spec.joints) {
        if (joint_type(joint.kind).couples) {
            find_gearbox(spec, joint, found, diagnostics);
            continue;
        }
        for (std::size_t a = 0; a < joint.axes.size(); ++a)
            if (joint.axes[a].mimic) find_mimic(spec, joint, a, found, diagnostics);
    }
    return found;
}

void add_couplings(const std::vector<CouplingSpec>& couplings, RobotType& type, Diagnostics& diagnostics) {
    for (const CouplingSpec& spec : couplings) {
        const auto follower = type.find_joint(spec.follower), leader = type.find_joint(spec.leader);
        if (!follower) continue;
        const std::string what =
            "joint '" + spec.follower + "' of model '" + type.name + "' follows '" + spec.leader + "', ";
        if (!leader) {
            diagnostics.error(
                spec.where, "coupling-apart",
                what + "which is part of another robot: no joint connects the two",
                "Connect both parts with a joint, or drive both joints from the control program.");
            continue;
        }
        const auto f = dof_index(type, type.joints[follower->index()], spec.follower_axis);
        const auto l = dof_index(type, type.joints[leader->index()], spec.leader_axis);
        if (!f || !l) {
            diagnostics.error(
                spec.where, "coupling-in-loop",
                what + "but one of them has no coordinate of its own: every joint of its loop is in use",
                "Leave one joint of the loop without mimic, gearbox and sensors.");
            continue;
        }
        CoordinateCoupling coupling;
        coupling.joint = *follower;
        coupling.follower = *f, coupling.leader = *l;
        coupling.multiplier = spec.multiplier, coupling.offset = spec.offset;
        coupling.reference = spec.reference, coupling.higher = spec.higher;
        type.couplings.push_back(coupling);
    }
}

}  // namespace roboss
