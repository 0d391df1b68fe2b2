// Reads <magnetic_field>, <wind>, <atmosphere>, <spherical_coordinates>; reports actors, world joints,
// plugins.
#include "sdf/world_settings.h"

#include <algorithm>
#include <cstring>

#include "sdf/known_children.h"
#include "sdf/physics_profile.h"
#include "sdf/plugin_conversion.h"
#include "sdf/world_fluids.h"

namespace roboss::sdf_import {
namespace {

/// Drawing, sound and bookkeeping: nothing that moves a robot.
constexpr const char* kSilent[] = {"light",          "gui",
                                   "scene",          "audio",
                                   "atmosphere",     "physics",
                                   "gravity",        "wind",
                                   "magnetic_field", "spherical_coordinates",
                                   "model",          "include",
                                   "population",     "frame",
                                   "state",          "roboss:accuracy",
                                   "roboss:sleep",   "roboss:precision"};

constexpr const char* kWind[] = {"linear_velocity"};
constexpr const char* kAtmosphere[] = {"temperature", "pressure", "temperature_gradient"};
constexpr const char* kSpherical[] = {"latitude_deg",
                                      "longitude_deg",
                                      "elevation",
                                      "heading_deg",
                                      "surface_model",
                                      "world_frame_orientation",
                                      "surface_axis_equatorial",
                                      "surface_axis_polar"};

void read_wind(const Element& wind, const Import& import, World& out) {
    out.wind = import.reader.vector(wind, "linear_velocity", {});
    report_unknown_children(wind, kWind, import.diagnostics());
}

/// Axes of SDFormat 1.10's CUSTOM_SURFACE.
void report_surface_axes(const Element& spherical, const Import& import) {
    for (const char* name : {"surface_axis_equatorial", "surface_axis_polar"})
        if (const Element axis = spherical.child(name))
            import.diagnostics().note(axis.where(), "surface-model",
                                      "<" + std::string(name) + "> has no effect: WGS84 is used");
}

void read_spherical(const Element& spherical, const Import& import, World& out) {
    if (!spherical) return;
    const ElementReader& reader = import.reader;
    const double unit = kPi / 180.0;
    SphericalCoordinates result;
    result.latitude_rad = reader.number(spherical, "latitude_deg", 0) * unit;
    result.longitude_rad = reader.number(spherical, "longitude_deg", 0) * unit;
    result.elevation_m = reader.number(spherical, "elevation", 0);
    result.heading_rad = reader.number(spherical, "heading_deg", 0) * unit;
    out.spherical = result;
    const std::string surface = spherical.text("surface_model");
    if (!surface.empty() && surface != "EARTH_WGS84") {
        import.diagnostics().warning(spherical.where(), "surface-model",
                                     "the surface model '" + surface + "' is not known; WGS84 is used",
                                     "Use EARTH_WGS84.");
    }
    const std::string orientation = spherical.text("world_frame_orientation");
    if (!orientation.empty() && orientation != "ENU") {
        import.diagnostics().warning(
            spherical.where(), "world-orientation",
            "the world frame orientation '" + orientation + "' is not supported; x is east, y north",
            "Use ENU.");
    }
    report_surface_axes(spherical, import);
    report_unknown_children(spherical, kSpherical, import.diagnostics());
}

/// Density of dry air at the temperature and pressure written, taken everywhere: the world is not that high.
void read_atmosphere(const Element& atmosphere, const Import& import, World& out) {
    constexpr double kGasConstant = 287.0578;  // J/(kg K), dry air
    const double temperature = positive_number(atmosphere, "temperature", 288.15, import);
    const double pressure = import.reader.number(atmosphere, "pressure", 101325.0);
    if (pressure >= 0) {
        out.air_density = pressure / (kGasConstant * temperature);
    } else {
        import.diagnostics().error(atmosphere.child("pressure").where(), "bad-value",
                                   "<pressure> of the air is negative", "Write it in Pa, 0 for no air.");
    }
    if (atmosphere.child("temperature_gradient"))
        import.diagnostics().note(
            atmosphere.child("temperature_gradient").where(), "temperature-gradient",
            "<temperature_gradient> has no effect: the air is equally dense everywhere");
    report_unknown_children(atmosphere, kAtmosphere, import.diagnostics());
}

void report_other(const Element& element, const Import& import) {
    const std::string name = element.node.name();
    if (name == "joint") {
        import.diagnostics().warning(
            element.where(), "world-joint",
            "joints between models of a world are still to come; '" + element.name() + "' is left out",
            "Put both models into one model and the joint with them.");
    } else if (name == "road") {
        import.diagnostics().note(element.where(), "road",
                                  "roads are only drawn in Gazebo; they are left out");
    } else if (is_foreign(name)) {
        report_foreign(element, import.diagnostics());
    } else {
        import.diagnostics().warning(
            element.where(), "unknown-element", "<" + name + "> in <world> is not known and is ignored",
            "Check the spelling and the place. Of RoBOSS in a world: <roboss:accuracy>, "
            "<roboss:sleep> and <roboss:precision>.");
    }
}

}  // namespace

void read_world_settings(const Element& world, const std::string& profile, Import& import, World& out,
                         std::vector<OnboardSpec>& plugins) {
    out.name = world.name();
    for (const auto node : world.node.children("roboss:accuracy"))
        out.accuracy.push_back(read_accuracy({world.source, node}, import));
    out.sleep = import.reader.boolean(world, "roboss:sleep", true);
    read_precision(world, import, out);
    read_physics(world, profile, import, out);
    out.magnetic_field_T = import.reader.vector(world, "magnetic_field", out.magnetic_field_T);
    if (const Element wind = world.child("wind")) read_wind(wind, import, out);
    if (const Element atmosphere = world.child("atmosphere")) read_atmosphere(atmosphere, import, out);
    read_spherical(world.child("spherical_coordinates"), import, out);
    for (const auto node : world.node.children()) {
        if (node.type() != pugi::node_element) continue;
        const bool silent = std::any_of(std::begin(kSilent), std::end(kSilent), [&](const char* name) {
            return std::strcmp(name, node.name()) == 0;
        });
        if (std::strcmp(node.name(), "plugin") == 0) {
            const Element plugin{world.source, node};
            if (!convert_fluid_plugin(plugin, import, out))
                convert_plugin(plugin, "", import, plugins, out.extensions);
        } else if (!silent) {
            report_other({world.source, node}, import);
        }
    }
}

}  // namespace roboss::sdf_import
