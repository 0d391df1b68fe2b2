// An actuator's force law in the joint's own coordinate: kp and kv times gear^2, bounds times gear. Several
// actuators of a joint add up, as a position and a velocity servo often do. An actuator of a fixed tendon,
// whose length is a sum of coefficients times joint positions, drives a joint if an equality ties all of them
// to it, as in grippers: with q_i = r_i q + const the length is (sum c_i r_i) q + const.
#include "mjcf/actuators.h"

#include <algorithm>
#include <cmath>

#include "mjcf/drive.h"
#include "mjcf/reflected_inertia.h"

namespace roboss::mjcf {
namespace {

class ActuatorReader {
  public:
    ActuatorReader(Robots& robots, const Reading& reading) : robots_(robots), r_(reading) {}

    /// Finds what each actuator drives, and adds its rotor.
    void read() {
        for (const Element& element : r_.document.in_sections("actuator"))
            if (auto found = read_one(element)) driven_.push_back(std::move(*found));
        for (const Driven& d : driven_) d.axis->armature += d.drive.gear * d.drive.gear * d.drive.armature;
    }
    /// After all rotors, on which damping ratios depend.
    void set_motors() {
        for (const Driven& d : driven_) set_motor(d);
    }

  private:
    struct Driven {
        Attributes source;
        Drive drive;
        Tree::JointPlace place;
        AxisSpec* axis = nullptr;
    };

    /// The joint that a fixed tendon amounts to, and the tendon's length for each of its radians or metres.
    struct Transmission {
        Tree::JointPlace place;
        JointSpec* joint = nullptr;
        double gear = 0;
    };

    std::optional<Transmission> joint_behind(const std::string& tendon) {
        for (const Element& fixed : r_.document.in_sections("tendon"))
            if (std::string(fixed.node.name()) == "fixed" && fixed.name() == tendon)
                return joint_behind(fixed);
        return std::nullopt;
    }

    std::optional<Transmission> joint_behind(const Element& fixed) {
        std::vector<Transmission> parts;
        for (const Element& part : r_.document.children(fixed, "joint")) {
            const Attributes source({part}, r_.diagnostics);
            const auto place = robots_.tree().find_joint(r_.names.full(source.text("joint")));
            JointSpec* const joint = place ? robots_.joint_of(*place) : nullptr;
            if (joint == nullptr || joint->axes.size() != 1) return std::nullopt;
            if (!parts.empty() && !robots_.same_model(place->body, parts.front().place.body))
                return std::nullopt;
            parts.push_back({*place, joint, source.number("coef", 1)});
        }
        const auto leads = [](const Transmission& part) { return !part.joint->axes.front().mimic; };
        const auto leader = std::ranges::find_if(parts, leads);
        if (leader == parts.end()) return std::nullopt;
        double gear = 0;
        for (const Transmission& part : parts) {
            const auto& mimic = part.joint->axes.front().mimic;
            if ((mimic ? mimic->joint : part.joint->name) != leader->joint->name) return std::nullopt;
            if (mimic && !mimic->is_linear()) return std::nullopt;  // no one gear
            gear += part.gear * (mimic ? mimic->multiplier : 1);
        }
        if (gear == 0) return std::nullopt;
        return Transmission{leader->place, leader->joint, gear};
    }

    std::optional<Driven> read_one(const Element& element) {
        const Attributes source({element}, r_.diagnostics);
        if (element.node.attribute("tendon")) {
            const auto found = joint_behind(source.text("tendon"));
            if (!found)
                return no_effect(
                    source, "an actuator of a tendon that is not fixed, or whose joints no equality ties",
                    "Drive the joints themselves.");
            auto drive = drive_of(element, source);
            if (!drive) return std::nullopt;
            drive->gear *= found->gear;
            return Driven{source, *drive, found->place, found->joint->axes.data()};
        }
        if (!element.node.attribute("joint") && !element.node.attribute("jointinparent"))
            return no_effect(source, "an actuator that drives no joint (but a site, body or crank)",
                             "Drive the joints themselves.");
        const std::string name = source.text("joint", source.text("jointinparent"));
        const auto place = robots_.tree().find_joint(r_.names.full(name));
        if (!place) {
            r_.report_unknown(source.where(), {name}, "unknown-joint",
                              "an actuator names the joint '" + name + "', which the file does not have",
                              "Check the name.");
            return std::nullopt;
        }
        JointSpec* joint = robots_.joint_of(*place);
        if (joint == nullptr || joint->axes.empty())
            return no_effect(source, "an actuator of a ball or free joint", "Write several hinges instead.");
        const auto drive = drive_of(element, source);
        if (!drive) return std::nullopt;
        return Driven{source, *drive, *place, joint->axes.data()};
    }

    std::optional<Drive> drive_of(const Element& element, const Attributes& source) const {
        Drive drive;
        for (const Element& set : r_.defaults.actuator_defaults(element))
            drive.apply({{set}, r_.diagnostics});
        drive.known = true;
        drive.apply(source);
        if (!drive.known || (drive.gain_type != "fixed" && drive.gain_type != "affine") ||
            (drive.bias_type != "none" && drive.bias_type != "affine"))
            return no_effect(source, "an actuator that is no motor, position, velocity or affine general one",
                             "Use one of these.");
        return drive;
    }

    std::nullopt_t no_effect(const Attributes& source, const std::string& what,
                             const std::string& remedy) const {
        r_.warn(source.where(), "ignored-actuator", what + " has no effect", remedy);
        return std::nullopt;
    }

    void set_motor(const Driven& driven) {
        const Drive& drive = driven.drive;
        AxisSpec& axis = *driven.axis;
        const double gear = drive.gear, gear2 = gear * gear;
        if (r_.settings.dampers) axis.damping += gear2 * drive.damping;
        if (!r_.settings.actuation) return;
        report_rest(driven);
        const bool biased = drive.bias_type == "affine";
        double speed_gain = biased ? drive.bias[2] : 0;
        const double kp = biased ? -drive.bias[1] : 0;
        if (speed_gain > 0 && drive.gain[0] == kp)  // a damping ratio
            speed_gain = -speed_gain * 2 * std::sqrt(kp * reflected_inertia(robots_, driven.place) / gear2);
        axis.position_gain += std::max(0.0, kp) * gear2;
        axis.velocity_gain += std::max(0.0, -speed_gain) * gear2;
        set_bound(drive, kp > 0 || speed_gain < 0, axis);
    }

    /// The largest force at the joint.
    void set_bound(const Drive& drive, bool is_servo, AxisSpec& axis) const {
        double bound = -1;
        const auto take = [&](const double(&range)[2], double factor) {
            const double most = std::max(std::fabs(range[0]), std::fabs(range[1])) * std::fabs(factor);
            bound = bound < 0 ? most : std::min(bound, most);
        };
        if (drive.forces_limited(r_.settings.autolimits)) take(drive.force_range, drive.gear);
        if (!is_servo && drive.controls_limited(r_.settings.autolimits))
            take(drive.control_range, drive.gear * drive.gain[0]);
        if (bound < 0) return;
        axis.max_effort = axis.max_effort < 0 ? bound : std::min(axis.max_effort, bound);
    }

    void report_rest(const Driven& driven) const {
        const Drive& drive = driven.drive;
        const auto note = [&](const std::string& what) {
            if (r_.quiet) return;
            r_.diagnostics.note(driven.source.where(), "ignored-attribute",
                                what + " of an actuator has no effect", "Do it in the control program.");
        };
        if (drive.dynamics != "none") note("the filter or integrator (dyntype, timeconst)");
        if (drive.bias_type == "affine" && drive.bias[0] != 0) note("the constant force (biasprm)");
        if (drive.gain_type == "affine" && (drive.gain[1] != 0 || drive.gain[2] != 0))
            note("a gain that depends on position or velocity (gainprm)");
    }

    Robots& robots_;
    const Reading& r_;
    std::vector<Driven> driven_;
};

}  // namespace

void read_actuators(Robots& robots, std::span<const Reading> parts) {
    std::vector<ActuatorReader> readers;
    for (const Reading& part : parts) readers.emplace_back(robots, part);
    for (ActuatorReader& reader : readers) reader.read();
    for (ActuatorReader& reader : readers) reader.set_motors();
}

}  // namespace roboss::mjcf
