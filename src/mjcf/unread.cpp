// The table has a row for each element that is read. Elements that MuJoCo knows and RoBOSS leaves out are in
// a second table. Anything else is reported as unknown.
#include "mjcf/unread.h"

#include <algorithm>
#include <span>
#include <string_view>

#include "core/number_text.h"
#include "core/similar.h"

namespace roboss::mjcf {
namespace {

/// Attributes by what becomes of them, names between spaces.
struct Row {
    const char* section;  // child of the root that it stands in; "": any
    const char* element;
    const char* read;    // they have an effect, or are names and looks
    const char* solver;  // numbers for MuJoCo's solver or viewer: a note
    const char* motion;  // motion depends on them in MuJoCo: a warning
};

constexpr const char* kContactSolver = "solref solimp solmix margin gap priority";
constexpr const char* kDriveRead =
    "name class group user joint jointinparent gear ctrlrange ctrllimited forcerange forcelimited armature "
    "damping "
    "lengthrange actearly nsample interp tendon slidersite cranksite site refsite body cranklength";

constexpr Row kRows[] = {
    {"", "compiler",
     "angle eulerseq meshdir texturedir assetdir strippath autolimits fitaabb inertiafromgeom "
     "inertiagrouprange "
     "boundmass boundinertia balanceinertia settotalmass coordinate usethread saveinertial conflict "
     "exactmeshinertia "
     "convexhull",
     "discardvisual fusestatic alignfree", ""},
    {"", "option", "timestep gravity magnetic wind density viscosity",
     "impratio tolerance ls_tolerance noslip_tolerance ccd_tolerance sleep_tolerance mpr_tolerance apirate "
     "integrator "
     "cone jacobian solver iterations ls_iterations noslip_iterations ccd_iterations mpr_iterations "
     "sdf_iterations "
     "sdf_initpoints o_margin o_solref o_solimp",
     "o_friction actuatorgroupdisable collision"},
    {"option", "flag",
     "constraint contact equality limit spring damper frictionloss actuation sleep gravity passive warmstart "
     "refsafe "
     "sensor midphase eulerdamp autoreset nativeccd island multiccd energy fwdinv invdiscrete diagexact "
     "sensornoise "
     "clampctrl",
     "", "filterparent override"},
    {"", "default", "class", "", ""},
    {"", "body", "name childclass pos quat axisangle xyaxes zaxis euler mocap gravcomp user simple", "sleep",
     ""},
    {"", "frame", "name childclass pos quat axisangle xyaxes zaxis euler", "", ""},
    {"", "replicate", "childclass count offset euler sep", "", ""},
    {"", "attach", "model body frame prefix", "", ""},
    {"asset", "model", "name file content_type", "", ""},
    {"", "worldbody", "name childclass", "", ""},
    {"", "inertial", "pos quat axisangle xyaxes zaxis euler mass diaginertia fullinertia", "", ""},
    {"equality", "joint", "name class active joint1 joint2 polycoef", "solref solimp", ""},
    {"", "joint",
     "name class group user type pos axis springdamper limited actuatorfrclimited stiffness range "
     "actuatorfrcrange ref "
     "springref armature damping frictionloss",
     "solreflimit solimplimit solreffriction solimpfriction margin", "actuatorgravcomp"},
    {"", "freejoint", "name group", "align", ""},
    {"", "geom",
     "name class type contype conaffinity condim group size material friction mass density shellinertia "
     "fromto pos quat "
     "axisangle xyaxes zaxis euler hfield mesh fitscale rgba user fluidcoef",
     kContactSolver, "fluidshape surfacevel adhesion"},
    {"", "site", "name class type group pos quat axisangle xyaxes zaxis euler material size fromto rgba user",
     "", ""},
    {"", "light",
     "name class directional type castshadow active pos dir bulbradius intensity range attenuation cutoff "
     "softness "
     "exponent ambient diffuse specular mode target texture",
     "", ""},
    {"", "mesh",
     "name class content_type file vertex normal texcoord face refpos refquat scale smoothnormal maxhullvert "
     "inertia "
     "builtin params material",
     "", ""},
    {"", "hfield", "name content_type file nrow ncol size elevation", "", ""},
    {"", "material",
     "name class texture texrepeat texuniform emission specular shininess reflectance metallic roughness "
     "rgba",
     "", ""},
    {"contact", "exclude", "name body1 body2", "", ""},
    {"", "pair", "name class geom1 geom2 friction condim", "solref solreffriction solimp gap margin",
     "adhesion"},
    {"", "equality", "active", "solref solimp", ""},
    {"", "connect", "name class active body1 body2 anchor site1 site2", "solref solimp", ""},
    {"", "weld", "name class active body1 body2 relpose anchor site1 site2 torquescale", "solref solimp", ""},
    {"", "general", kDriveRead, "actlimited actrange actdim", "delay input velrange ffrange"},
    {"", "motor", kDriveRead, "", "delay"},
    {"", "position", kDriveRead, "", "delay"},
    {"", "velocity", kDriveRead, "", "delay"},
    {"", "intvelocity", kDriveRead, "actlimited actrange", "delay"},
    {"", "damper", kDriveRead, "", "delay"},
    {"keyframe", "key", "name time qpos qvel act ctrl mpos mquat", "", ""},
};

/// What the kinds of actuators have beside kDriveRead.
constexpr std::pair<const char*, const char*> kGains[] = {
    {"general", "dyntype gaintype biastype dynprm gainprm biasprm"},
    {"position", "kp kv dampratio timeconst inheritrange"},
    {"velocity", "kv"},
    {"intvelocity", "kp kv dampratio timeconst inheritrange"},
    {"damper", "kv"},
};

struct LeftOut {
    const char* element;
    Severity severity;
    const char* why;
};

constexpr Severity kNote = Severity::kNote, kWarning = Severity::kWarning;

constexpr LeftOut kLeftOut[] = {
    {"size", kNote, "memory grows as it is needed"},
    {"statistic", kNote, "it scales MuJoCo's viewer"},
    {"visual", kNote, "it sets up MuJoCo's viewer"},
    {"custom", kNote, "it is for other programs"},
    {"texture", kNote, "surfaces are drawn in their colours"},
    {"skin", kNote, "skins are not drawn"},
    {"camera", kNote, "there are no cameras"},
    {"extension", kWarning, "plugins of MuJoCo are not run"},
    {"plugin", kWarning, "plugins of MuJoCo are not run"},
    {"deformable", kWarning, "bodies are rigid"},
    {"tendon", kWarning,
     "tendons, their springs and their limits are not simulated, but an actuator may drive a joint by a "
     "fixed one"},
    {"lengthrange", kNote, "it is for muscles"},
    {"muscle", kWarning, "muscles are not simulated"},
    {"flex", kWarning, "bodies are rigid"},
};

/// Elements that other parts of the importer tell about, or that stand in sections which they read by name.
constexpr std::string_view kElsewhere[] = {"asset",       "contact",  "actuator", "sensor",   "include",
                                           "composite",   "flexcomp", "layer",    "adhesion", "cylinder",
                                           "orientation", "pid",      "dcmotor",  "tendon",   "keyframe"};

bool has_word(std::string_view list, std::string_view word) {
    const auto words = xml::words_of(list);
    return std::ranges::find(words, word) != words.end();
}

const Row* row_of(std::string_view section, std::string_view element) {
    for (const Row& row : kRows)
        if (element == row.element && (*row.section == '\0' || section == row.section)) return &row;
    return nullptr;
}

bool is_gain(std::string_view element, std::string_view attribute) {
    return std::ranges::any_of(kGains, [&](const auto& gains) {
        return element == gains.first && has_word(gains.second, attribute);
    });
}

/// Nothing but zeros, or "false".
bool says_nothing(const char* value) {
    return std::ranges::all_of(xml::words_of(value), [](std::string_view word) {
        return word == "false" || word == "disable" || word == "none" || word == "auto" ||
               parse_number(word) == 0.0;
    });
}

class Walk {
  public:
    Walk(const Document& document, Diagnostics& diagnostics)
        : document_(document), diagnostics_(diagnostics) {}

    void run() {
        for (const Element& child : document_.children(document_.root())) visit(child, child.node.name());
    }

  private:
    void visit(const Element& element, const std::string& section) {
        const std::string name = element.node.name();
        if (section == "sensor" && name != section) return;  // the reader of sensors tells
        if (section == "custom" || section == "visual") {
            left_out(element, section);
            return;
        }
        if (section == "default" && name == "tendon") return;  // for tendons, which are told
        if (const Row* row = row_of(section, name)) {
            attributes(element, *row);
        } else if (left_out(element, name)) {
            return;
        } else if (std::ranges::find(kElsewhere, name) == std::end(kElsewhere)) {
            unknown(element);
            return;
        } else if (name == "composite" || name == "flexcomp") {
            return;
        }
        for (const Element& child : document_.children(element)) visit(child, section);
    }

    void attributes(const Element& element, const Row& row) {
        for (const auto attribute : element.node.attributes()) {
            const std::string name = attribute.name();
            if (has_word(row.read, name) || is_gain(row.element, name)) continue;
            const bool solver = has_word(row.solver, name), motion = has_word(row.motion, name);
            const std::string what = name + " of <" + row.element + ">";
            if (solver && !says_nothing(attribute.value()))
                diagnostics_.note(element.where(), "ignored-attribute",
                                  what + " has no effect: it is for MuJoCo's solver or viewer");
            else if (motion && !says_nothing(attribute.value()))
                diagnostics_.warning(element.where(), "ignored-attribute", what + " has no effect",
                                     "Leave it out, and check that the robot moves as you expect.");
            else if (!solver && !motion)
                diagnostics_.warning(element.where(), "unknown-attribute",
                                     what + " is not known and is ignored",
                                     did_you_mean(name, names_of(row), "Check the spelling."));
        }
    }

    static std::vector<std::string> names_of(const Row& row) {
        std::vector<std::string> names;
        for (const char* list : {row.read, row.solver, row.motion})
            for (const std::string_view word : xml::words_of(list)) names.emplace_back(word);
        return names;
    }

    /// false: it is none of them.
    bool left_out(const Element& element, const std::string& name) {
        const auto found =
            std::ranges::find_if(kLeftOut, [&](const LeftOut& left) { return name == left.element; });
        if (found == std::end(kLeftOut)) return false;
        const std::string message = "<" + name + "> has no effect: " + found->why;
        if (found->severity == kNote)
            diagnostics_.note(element.where(), "ignored-element", message);
        else
            diagnostics_.warning(element.where(), "ignored-element", message,
                                 "Leave it out, and check that the robot moves as you expect.");
        return true;
    }

    void unknown(const Element& element) {
        std::vector<std::string> names;
        for (const Row& row : kRows) names.emplace_back(row.element);
        const std::string name = element.node.name();
        diagnostics_.warning(
            element.where(), "unknown-element",
            "<" + name + "> in <" + element.node.parent().name() + "> is not known and is ignored",
            did_you_mean(name, names, "Check the spelling and the place."));
    }

    const Document& document_;
    Diagnostics& diagnostics_;
};

}  // namespace

void report_unread(const Document& document, Diagnostics& diagnostics) {
    Walk(document, diagnostics).run();
}

}  // namespace roboss::mjcf
