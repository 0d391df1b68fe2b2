// Joints of a body. Angles of hinges are in the file's unit of angle; stiffness and damping are per radian
// always.
#include <algorithm>
#include <cmath>

#include "mjcf/tree.h"

namespace roboss::mjcf {
namespace {

JointMotion motion_of(const Attributes& joint) {
    if (std::string(joint.element().node.name()) == "freejoint") return JointMotion::kFree;
    const std::string type = joint.text("type", "hinge");
    if (type == "free") return JointMotion::kFree;
    if (type == "ball") return JointMotion::kBall;
    if (type == "slide") return JointMotion::kSlide;
    if (type != "hinge") joint.bad_value("type", "free, ball, slide or hinge");
    return JointMotion::kHinge;
}

/// The first number; MuJoCo takes further ones as coefficients of higher powers of the velocity or
/// displacement.
double first_of(const Attributes& joint, const char* attribute) {
    double values[3] = {};
    joint.overlay(attribute, values);
    if (values[1] != 0 || values[2] != 0)
        joint.diagnostics().warning(
            joint.where(), "ignored-attribute",
            std::string(attribute) + " of a joint is linear here: its further numbers have no effect",
            "Write one number.");
    return values[0];
}

Vec3 read_axis(const Attributes& joint, const Scope& scope) {
    const Vec3 axis = joint.vector("axis", {0, 0, 1});
    const double length = norm(axis);
    if (length > 1e-10) return rotate(scope.X_BF.q, axis / length);
    joint.bad_value("axis", "a direction");
    return {0, 0, 1};
}

void read_limits(const Attributes& joint, double unit, const Settings& settings, AxisSpec& axis) {
    double range[2] = {0, 0};
    if (settings.limits && joint.limited("limited", "range", settings.autolimits) &&
        joint.numbers("range", range)) {
        if (range[0] > range[1]) joint.bad_value("range", "a lower and an upper limit");
        axis.lower = std::min(range[0], range[1]) * unit, axis.upper = range[1] * unit;
    }
    double force[2] = {0, 0};
    if (joint.limited("actuatorfrclimited", "actuatorfrcrange", settings.autolimits) &&
        joint.numbers("actuatorfrcrange", force))
        axis.max_effort = std::max(std::fabs(force[0]), std::fabs(force[1]));
}

void report_no_effect(const Attributes& joint, const std::string& what, const std::string& remedy) {
    joint.diagnostics().warning(joint.where(), "ignored-attribute", what + " has no effect", remedy);
}

/// Springs, friction, limits and rotors of joints without an axis.
void report_without_axis(const Attributes& joint, const Settings& settings, bool is_free) {
    const std::string of = is_free ? " of a free joint" : " of a ball joint";
    const std::string remedy = "Write several hinges instead.";
    for (const char* name : {"stiffness", "frictionloss"}) {
        double value[3] = {};
        joint.overlay(name, value);
        if (value[0] != 0)
            report_no_effect(joint, name + of, is_free ? "Set it to 0 for this joint." : remedy);
    }
    if (!is_free && settings.limits && joint.limited("limited", "range", settings.autolimits))
        report_no_effect(joint, "range" + of, remedy);
    for (const char* name : {"damping", "armature"}) {
        double value[3] = {};
        joint.overlay(name, value);
        if (is_free && value[0] != 0) report_no_effect(joint, name + of, "Set it to 0 for this joint.");
    }
}

}  // namespace

JointPart read_joint(const Attributes& joint, const Scope& scope, const Reading& reading) {
    const Settings& settings = reading.settings;
    JointPart part;
    part.name = scope.names.full(joint.name());
    part.where = joint.where();
    part.motion = motion_of(joint);
    if (std::string(joint.element().node.name()) == "freejoint") return part;
    part.pos = scope.X_BF * joint.vector("pos", {});
    if (joint.has("springdamper"))
        report_no_effect(joint, "springdamper of a joint", "Write its stiffness and damping.");
    if (part.motion == JointMotion::kFree || part.motion == JointMotion::kBall) {
        report_without_axis(joint, settings, part.motion == JointMotion::kFree);
        part.ball_armature = joint.number("armature", 0);
        part.ball_damping = settings.dampers ? first_of(joint, "damping") : 0;
        return part;
    }
    const double unit = part.motion == JointMotion::kHinge ? settings.angle_unit : 1.0;
    part.ref = joint.number("ref", 0) * unit;
    AxisSpec& axis = part.axis;
    axis.xyz = read_axis(joint, scope);
    read_limits(joint, unit, settings, axis);
    axis.armature = joint.number("armature", 0);
    axis.damping = settings.dampers ? first_of(joint, "damping") : 0;
    axis.friction = settings.friction_loss ? joint.number("frictionloss", 0) : 0;
    axis.spring_stiffness = settings.springs ? first_of(joint, "stiffness") : 0;
    axis.spring_reference = joint.number("springref", 0) * unit;
    axis.initial_position = part.ref;
    return part;
}

}  // namespace roboss::mjcf
