// See joint_conversion.h.
#include "sdf/joint_conversion.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "sdf/known_children.h"
#include "world/joint_type.h"

namespace roboss::sdf_import {
namespace {

/// A type that SDFormat lacks: <roboss:joint type="...">, within a joint of some other type for other
/// programs.
std::optional<JointSpecKind> kind_of_extension(const Element& extension, const Import& import) {
    const std::string name = extension.node.attribute("type").value();
    const auto kind = find_joint_type(name);
    if (kind && joint_type(*kind).is_extension) return kind;
    std::string known;
    for (const JointType& type : joint_types())
        if (type.is_extension) known += (known.empty() ? "\"" : ", \"") + std::string(type.name) + "\"";
    import.diagnostics().error(extension.where(), "joint-type",
                               "<roboss:joint> has the type '" + name + "', which is not known",
                               "Known: " + known + "; write SDFormat's own types in the <joint>.");
    return std::nullopt;
}

/// Upper and lower case are the same, as in Gazebo.
std::optional<JointSpecKind> kind_of(const Element& source, const Import& import) {
    const std::string written = source.node.attribute("type").value();
    std::string name = written;
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto kind = find_joint_type(name);
    if (kind && !joint_type(*kind).is_extension) {
        const Element extension = source.child("roboss:joint");
        return extension ? kind_of_extension(extension, import) : kind;
    }
    std::string known;
    for (const JointType& type : joint_types())
        if (!type.is_extension) known += (known.empty() ? "\"" : ", \"") + std::string(type.name) + "\"";
    import.diagnostics().error(
        source.where(), "joint-type",
        "joint '" + source.name() + "' has the type '" + written + "', which is not known",
        "Known: " + known + ".");
    return std::nullopt;
}

constexpr const char* kAxisChildren[] = {"limit", "dynamics", "initial_position", "mimic", "roboss:motor"};

/// Of the <joint> itself, else of <roboss:joint>.
bool is_sdf_axis(std::string_view name) {
    return name == "axis" || name == "axis2";
}

bool has_stiffness(const AxisSpec& spec) {
    return spec.limit_stiffness < AxisSpec{}.limit_stiffness;
}

bool has_dissipation(const AxisSpec& spec) {
    return spec.limit_dissipation != AxisSpec{}.limit_dissipation;
}

/// Negative or infinite: unlimited, as in SDF.
double bound(double written) {
    return written >= 0 && std::isfinite(written) ? written : -1.0;
}

void read_limit(const Element& limit, const ElementReader& reader, AxisSpec& spec) {
    if (!limit) return;
    constexpr auto kAny = Finite::kInfinityAllowed;
    spec.lower = reader.number(limit, "lower", spec.lower, kAny);
    spec.upper = reader.number(limit, "upper", spec.upper, kAny);
    spec.max_effort = bound(reader.number(limit, "effort", -1, kAny));
    spec.max_velocity = bound(reader.number(limit, "velocity", -1, kAny));
    spec.limit_stiffness = reader.number(limit, "stiffness", spec.limit_stiffness, kAny);
    spec.limit_dissipation = reader.number(limit, "dissipation", spec.limit_dissipation, kAny);
}

/// <stiffness> and <dissipation> are those of <lower> and <upper>, and <dissipation> only of soft ones.
void report_softness(const Element& limit, const AxisSpec& spec, const Import& import) {
    const auto report = [&](const char* name, const std::string& why, const std::string& remedy) {
        import.diagnostics().note(limit.child(name).where(), "axis-element",
                                  "<" + std::string(name) + "> has no effect: " + why,
                                  "Write " + remedy + ", or leave <" + name + "> out.");
    };
    const char* kNoLimits = "the axis has no limits";
    if (has_stiffness(spec) && !spec.has_limits()) report("stiffness", kNoLimits, "<lower> and <upper>");
    if (!has_dissipation(spec)) return;
    if (!spec.has_limits()) return report("dissipation", kNoLimits, "<lower> and <upper>");
    if (!has_stiffness(spec))
        report("dissipation", "a limit without <stiffness> below 1e8 is hard", "<stiffness>");
}

/// A continuous joint turns without end.
void drop_limits(const TreePart& joint, const Element& limit, AxisSpec& spec, const Import& import) {
    if (spec.has_limits() || has_stiffness(spec) || has_dissipation(spec))
        import.diagnostics().warning(
            limit.where(), "unused-limit",
            "joint '" + joint.name +
                "' is continuous and has no limits: <lower>, <upper>, <stiffness> and <dissipation> of its "
                "<limit> are ignored",
            "Write type=\"revolute\", or leave them out.");
    spec.lower = -std::numeric_limits<double>::infinity();
    spec.upper = std::numeric_limits<double>::infinity();
}

void read_dynamics(const Element& dynamics, const ElementReader& reader, AxisSpec& spec) {
    if (!dynamics) return;
    spec.damping = reader.number(dynamics, "damping", 0);
    spec.friction = reader.number(dynamics, "friction", 0);
    spec.spring_stiffness = reader.number(dynamics, "spring_stiffness", 0);
    spec.spring_reference = reader.number(dynamics, "spring_reference", 0);
    if (spec.spring_reference != 0 && spec.spring_stiffness == 0)
        reader.diagnostics().note(dynamics.child("spring_reference").where(), "axis-element",
                                  "<spring_reference> has no effect: there is no spring",
                                  "Write <spring_stiffness>.");
}

/// <roboss:motor>: gains, bounds and the rotor's inertia.
void read_motor(const Element& motor, const ElementReader& reader, AxisSpec& spec) {
    if (!motor) return;
    constexpr auto kAny = Finite::kInfinityAllowed;
    spec.position_gain = reader.number(motor, "position_gain", spec.position_gain);
    spec.velocity_gain = reader.number(motor, "velocity_gain", spec.velocity_gain);
    spec.armature = reader.number(motor, "armature", spec.armature);
    if (motor.child("max_effort")) spec.max_effort = bound(reader.number(motor, "max_effort", -1, kAny));
    if (motor.child("max_velocity"))
        spec.max_velocity = bound(reader.number(motor, "max_velocity", -1, kAny));
}

/// <mimic> of SDFormat 1.11; names of joints are those of the scope.
std::optional<MimicSpec> read_mimic(const Element& mimic, const std::string& scope,
                                    const ElementReader& reader) {
    if (!mimic) return std::nullopt;
    MimicSpec spec;
    spec.joint = scope + mimic.node.attribute("joint").value();
    const std::string axis = mimic.node.attribute("axis").value();
    spec.axis = axis == "axis2" ? 1 : 0;
    spec.element = axis.empty() ? "axis" : axis;
    spec.multiplier = reader.number(mimic, "multiplier", 1);
    spec.offset = reader.number(mimic, "offset", 0);
    spec.reference = reader.number(mimic, "reference", 0);
    return spec;
}

bool is_locked(const AxisSpec& spec) {
    return spec.has_limits() && !(spec.lower < spec.upper);
}

/// An axis without direction. Gazebo minds it only where the joint could move along it.
void check_direction(const TreePart& joint, const Element& axis, bool moves, const Import& import) {
    const Element xyz = axis.child("xyz");
    const auto words = words_of(std::string_view(xyz.node.text().get()));
    if (words.size() != 3 ||
        std::ranges::any_of(words, [](std::string_view word) { return parse_number(word) != 0.0; }))
        return;
    const std::string what = "the axis of joint '" + joint.name + "' is 0 0 0";
    if (moves)
        import.diagnostics().error(xyz.where(), "zero-axis", what + ": it has no direction to move in",
                                   "Write a direction, for instance 0 0 1, or type=\"fixed\".");
    else
        import.diagnostics().warning(xyz.where(), "zero-axis", what + "; it does not matter, it cannot move",
                                     "Write type=\"fixed\" and no <axis>.");
}

/// Axes of <roboss:joint> have no <xyz>: they are at right angles to <axis> and to each other, right-handed.
/// The first is the coordinate axis of the joint frame that follows <axis> (x follows z), or lies as near to
/// it as it can.
void direct_axes(const JointType& type, JointSpec& spec) {
    const auto given = type.find_axis("axis");
    if (!given) return;
    const Vec3 normal = spec.axes[*given].xyz;
    std::size_t largest = 0;
    for (const std::size_t k : {1, 2})
        if (std::fabs(normal[k]) >= std::fabs(normal[largest])) largest = k;
    Vec3 across;
    across[(largest + 1) % 3] = 1;
    across = normalized(across - normal * dot(across, normal));
    for (std::size_t k = 0; k < type.axes.size(); ++k) {
        if (is_sdf_axis(type.axes[k])) continue;
        spec.axes[k].xyz = across;
        across = cross(normal, across);
    }
}

AxisSpec read_axis(const TreePart& joint, const ModelTree& model, const std::string& name,
                   const JointType& type, const std::string& scope, const Import& import) {
    const Element& source = joint.source;
    const bool of_extension = !is_sdf_axis(name);
    const Element axis = (of_extension ? source.child("roboss:joint") : source).child(name.c_str());
    AxisSpec spec;
    if (of_extension) {
        if (axis) report_unknown_children(axis, kAxisChildren, import.diagnostics());
    } else if (!axis) {
        import.diagnostics().warning(
            source.where(), "missing-axis",
            "joint '" + joint.name + "' has no <" + name + ">; z of its frame is used",
            "Add it, with <xyz>.");
    } else {
        spec.xyz = model.direction_of(joint, axis, import.reader);
    }
    read_limit(axis.child("limit"), import.reader, spec);
    read_dynamics(axis.child("dynamics"), import.reader, spec);
    spec.initial_position = import.reader.number(axis, "initial_position", 0);
    read_motor(source.child("roboss:motor"), import.reader, spec);
    read_motor(axis.child("roboss:motor"), import.reader, spec);
    spec.mimic = read_mimic(axis.child("mimic"), scope, import.reader);
    if (axis && !of_extension) check_direction(joint, axis, type.endless || !is_locked(spec), import);
    if (type.endless)
        drop_limits(joint, axis.child("limit"), spec, import);
    else
        report_softness(axis.child("limit"), spec, import);
    return spec;
}

/// Metres a radian. <screw_thread_pitch> (1.10): metres a turn. <thread_pitch>: Gazebo's -radians a metre.
double screw_pitch(const Element& source, const Import& import) {
    if (source.child("screw_thread_pitch"))
        return import.reader.number(source, "screw_thread_pitch", 1) / (2.0 * kPi);
    const double radians_a_metre = import.reader.number(source, "thread_pitch", 1);
    return radians_a_metre != 0 ? -1.0 / radians_a_metre : 0.0;
}

/// An axis that this kind of joint does not have, but that says something.
void report_unused_axis(JointSpec& spec, const Element& source, const char* name, const Import& import) {
    const Element axis = source.child(name);
    if (!axis) return;
    AxisSpec says;
    read_limit(axis.child("limit"), import.reader, says);
    read_dynamics(axis.child("dynamics"), import.reader, says);
    says.initial_position = import.reader.number(axis, "initial_position", 0);
    // A ball joint has no axis to turn about, but damping can be the same in all directions.
    const bool is_isotropic = joint_type(spec.kind).is_isotropic();
    if (is_isotropic) std::swap(spec.ball_damping, says.damping);
    const bool soft = has_stiffness(says) || has_dissipation(says);
    const bool moved = axis.child("roboss:motor") || axis.child("mimic");
    if (!says.says_more() && !soft && !moved) return;
    import.diagnostics().warning(axis.where(), "unused-axis",
                                 "joint '" + std::string(source.name()) + "' of type '" +
                                     source.node.attribute("type").value() + "' has no <" + name +
                                     ">: its limits, " + (is_isotropic ? "" : "damping, ") +
                                     "friction, springs, initial position, motor and mimic are ignored",
                                 "Use a joint with that axis, or several hinges in a row.");
}

void report_unused(const TreePart& joint, JointSpec& spec, const Import& import) {
    const Element& source = joint.source;
    const JointType& type = joint_type(spec.kind);
    for (const char* name : {"axis", "axis2"}) {
        if (type.find_axis(name)) continue;
        report_unused_axis(spec, source, name, import);
        check_direction(joint, source.child(name), false, import);
    }
    if (const Element motor = source.child("roboss:motor"); motor && type.axes.empty()) {
        import.diagnostics().warning(motor.where(), "unused-motor",
                                     "joint '" + spec.name + "' of type '" +
                                         source.node.attribute("type").value() +
                                         "' has no axis to drive: its <roboss:motor> is ignored",
                                     "Use a joint with an axis, or several hinges in a row.");
    }
    if (const Element physics = source.child("physics")) {
        import.diagnostics().note(
            physics.where(), "joint-physics",
            "joint '" + spec.name + "': <physics> holds numbers for other engines; they are ignored",
            "Soft limits: <limit><stiffness> and <dissipation>.");
    }
}

/// Two axes along one line are one: often both were left out, so both are z.
void turn_parallel_axis(JointSpec& spec, const Import& import) {
    const Vec3& first = spec.axes[0].xyz;
    if (norm(cross(first, spec.axes[1].xyz)) > 1e-6) return;
    const Vec3 other = std::fabs(first.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    spec.axes[1].xyz = normalized(other - first * dot(other, first));
    import.diagnostics().warning(
        spec.where, "parallel-axes",
        "the two axes of joint '" + spec.name +
            "' are parallel; the second is turned to be at right angles to the first",
        "Write <axis2><xyz>.");
}

/// false: it couples nothing.
bool read_gearbox(const Element& source, const std::string& scope, const Import& import, JointSpec& spec) {
    spec.gearbox_ratio = import.reader.number(source, "gearbox_ratio", 1);
    const std::string reference = source.child("gearbox_reference_body").node.text().get();
    spec.gearbox_reference = reference == "world" ? reference : scope + reference;
    if (reference.empty()) {
        import.diagnostics().warning(
            source.where(), "gearbox-reference",
            "gearbox '" + spec.name + "' has no <gearbox_reference_body>; it is left out, as in Gazebo",
            "Name the link that carries the hinges of both wheels.");
    }
    return !reference.empty();
}

std::string in_scope(const std::string& link, const std::string& scope) {
    return link == "world" ? link : scope + link;
}

}  // namespace

std::optional<JointSpec> convert_joint(const TreePart& joint, const ModelTree& model, const Pose& X_MJ,
                                       const std::string& scope, const Import& import) {
    const Element& source = joint.source;
    const auto kind = kind_of(source, import);
    if (!kind) return std::nullopt;
    const JointType& type = joint_type(*kind);
    JointSpec spec;
    const bool renamed = static_cast<bool>(source.node.attribute(kJointName));
    spec.name = scope + (renamed ? name_of_joint(source.node) : joint.name);
    spec.kind = *kind;
    spec.where = source.where();
    spec.X_MJ = X_MJ;
    spec.parent = in_scope(joint.parent, scope);
    spec.child = in_scope(joint.body, scope);
    for (const std::string_view axis : type.axes)
        spec.axes.push_back(read_axis(joint, model, std::string(axis), type, scope, import));
    direct_axes(type, spec);
    if (type.count(JointKind::kRevolute) == 2) turn_parallel_axis(spec, import);
    if (type.count(JointKind::kScrew) > 0) spec.screw_pitch = screw_pitch(source, import);
    if (type.couples && !read_gearbox(source, scope, import, spec)) return std::nullopt;
    report_unused(joint, spec, import);
    return spec;
}

}  // namespace roboss::sdf_import
