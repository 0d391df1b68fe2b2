// See drive.h. The kinds follow mjs_setToMotor, mjs_setToPosition and mjs_setToVelocity of MuJoCo.
#include "mjcf/drive.h"

#include <cmath>

namespace roboss::mjcf {
namespace {

void apply_position(const Attributes& element, Drive& drive) {
    const double kp = element.number("kp", drive.gain[0]);
    drive.gain[0] = kp, drive.bias[1] = -kp;
    if (element.has("kv")) drive.bias[2] = -element.number("kv", 0);
    if (element.has("dampratio")) drive.bias[2] = element.number("dampratio", 0);  // positive: a ratio
    if (element.number("timeconst", 0) > 0) drive.dynamics = "filterexact";
    drive.gain_type = "fixed", drive.bias_type = "affine";
}

void apply_velocity(const Attributes& element, Drive& drive) {
    const double kv = element.number("kv", drive.gain[0]);
    drive.gain = {kv, 0, 0}, drive.bias = {0, 0, -kv};
    drive.gain_type = "fixed", drive.bias_type = "affine", drive.dynamics = "none";
}

void apply_damper(const Attributes& element, Drive& drive) {
    drive.gain = {0, 0, -element.number("kv", 1)}, drive.bias = {};
    drive.gain_type = "affine", drive.bias_type = "none", drive.dynamics = "none";
}

bool limited(const std::string& text, const double (&range)[2], bool autolimits) {
    if (text == "true") return true;
    return text == "auto" && autolimits && (range[0] != 0 || range[1] != 0);
}

}  // namespace

void Drive::apply(const Attributes& element) {
    double gears[6] = {gear, 0, 0, 0, 0, 0};
    element.overlay("gear", gears);
    gear = gears[0];
    element.numbers("ctrlrange", control_range);
    element.numbers("forcerange", force_range);
    control_limited = element.text("ctrllimited", control_limited);
    force_limited = element.text("forcelimited", force_limited);
    armature = element.number("armature", armature);
    double dampings[3] = {damping, 0, 0};
    element.overlay("damping", dampings);
    damping = dampings[0];
    const std::string kind = element.element().node.name();
    if (kind == "general") {
        gain_type = element.text("gaintype", gain_type);
        bias_type = element.text("biastype", bias_type);
        dynamics = element.text("dyntype", dynamics);
        element.overlay("gainprm", gain);
        element.overlay("biasprm", bias);
    } else if (kind == "motor") {
        gain = {1, 0, 0}, bias = {};
        gain_type = "fixed", bias_type = "none", dynamics = "none";
    } else if (kind == "position" || kind == "intvelocity") {
        apply_position(element, *this);
        if (kind == "intvelocity") dynamics = "integrator";
    } else if (kind == "velocity") {
        apply_velocity(element, *this);
    } else if (kind == "damper") {
        apply_damper(element, *this);
    } else {
        known = false;
    }
}

bool Drive::controls_limited(bool autolimits) const {
    return limited(control_limited, control_range, autolimits);
}

bool Drive::forces_limited(bool autolimits) const {
    return limited(force_limited, force_range, autolimits);
}

}  // namespace roboss::mjcf
