// Later sections of a kind overwrite earlier ones, attribute by attribute, as in MuJoCo.
#include "mjcf/settings.h"

#include <algorithm>
#include <cmath>

#include "mjcf/attributes.h"

namespace roboss::mjcf {
namespace {

void read_angles(const Attributes& compiler, Settings& settings) {
    const std::string angle = compiler.text("angle");
    if (angle == "radian") settings.angle_unit = 1.0;
    if (angle == "degree") settings.angle_unit = kPi / 180.0;
    if (compiler.has("angle") && angle != "radian" && angle != "degree")
        compiler.bad_value("angle", "radian or degree");
    const std::string sequence = compiler.text("eulerseq", settings.euler_sequence);
    if (sequence.size() != 3 || sequence.find_first_not_of("xyzXYZ") != std::string::npos)
        compiler.bad_value("eulerseq", "three letters of x, y, z, X, Y, Z");
    else
        settings.euler_sequence = sequence;
}

void read_inertias(const Attributes& compiler, Settings& settings) {
    const std::string source = compiler.text("inertiafromgeom");
    if (source == "true") settings.inertia_from_geom = InertiaFromGeom::kAlways;
    if (source == "false") settings.inertia_from_geom = InertiaFromGeom::kNever;
    if (source == "auto") settings.inertia_from_geom = InertiaFromGeom::kAuto;
    double groups[2];
    if (compiler.numbers("inertiagrouprange", groups)) {
        settings.inertia_group_first = static_cast<int>(groups[0]);
        settings.inertia_group_last = static_cast<int>(groups[1]);
    }
    settings.least_mass = compiler.number("boundmass", settings.least_mass);
    settings.least_inertia = compiler.number("boundinertia", settings.least_inertia);
    settings.balance_inertia = compiler.boolean("balanceinertia", settings.balance_inertia);
    settings.total_mass = compiler.number("settotalmass", settings.total_mass);
}

void read_compiler(const Attributes& compiler, Settings& settings) {
    read_angles(compiler, settings);
    read_inertias(compiler, settings);
    settings.mesh_folder = compiler.text("assetdir", settings.mesh_folder);
    settings.texture_folder = compiler.text("assetdir", settings.texture_folder);
    settings.mesh_folder = compiler.text("meshdir", settings.mesh_folder);
    settings.texture_folder = compiler.text("texturedir", settings.texture_folder);
    settings.strip_path = compiler.boolean("strippath", settings.strip_path);
    settings.autolimits = compiler.boolean("autolimits", settings.autolimits);
    settings.fit_aabb = compiler.boolean("fitaabb", settings.fit_aabb);
    if (compiler.text("coordinate") == "global")
        compiler.diagnostics().error(compiler.where(), "global-coordinates",
                                     "coordinate=\"global\" is a format that MuJoCo does not read any more",
                                     "Load the file in MuJoCo 2.3.3 or older and save it.");
}

void read_flags(const Attributes& flag, Settings& settings) {
    if (!flag.boolean("constraint", true))
        settings.contacts = settings.equalities = settings.limits = settings.friction_loss = false;
    settings.contacts = flag.boolean("contact", settings.contacts);
    settings.equalities = flag.boolean("equality", settings.equalities);
    settings.limits = flag.boolean("limit", settings.limits);
    settings.springs = flag.boolean("spring", settings.springs);
    settings.dampers = flag.boolean("damper", settings.dampers);
    settings.friction_loss = flag.boolean("frictionloss", settings.friction_loss);
    settings.actuation = flag.boolean("actuation", settings.actuation);
    settings.sleep = flag.boolean("sleep", settings.sleep);
    if (!flag.boolean("gravity", true)) settings.gravity = {};
}

void read_option(const Attributes& option, Settings& settings) {
    settings.timestep = option.number("timestep", settings.timestep);
    settings.gravity = option.vector("gravity", settings.gravity);
    settings.magnetic = option.vector("magnetic", settings.magnetic);
    const bool fluid = option.vector("wind", {}) != Vec3{} || option.number("density", 0) != 0 ||
                       option.number("viscosity", 0) != 0;
    if (fluid)
        option.diagnostics().warning(
            option.where(), "ignored-attribute",
            "wind, density and viscosity of <option> have no effect: bodies move through "
            "a vacuum",
            "Set all three to 0, or write the world as SDFormat with <roboss:drag>.");
}

}  // namespace

Settings read_settings(const Document& document, Diagnostics& diagnostics) {
    Settings settings;
    for (const Element& element : document.children(document.root(), "compiler"))
        read_compiler({{element}, diagnostics}, settings);
    for (const Element& element : document.children(document.root(), "option"))
        read_option({{element}, diagnostics}, settings);
    for (const Element& element : document.children(document.root(), "option"))
        for (const Element& flag : document.children(element, "flag"))
            read_flags({{flag}, diagnostics}, settings);
    return settings;
}

}  // namespace roboss::mjcf
