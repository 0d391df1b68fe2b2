// Settings: what <compiler> and <option> say, and what each number of them does to the rest of the file.
#pragma once

#include <array>
#include <string>

#include "mjcf/document.h"
#include "world/world.h"

namespace roboss::mjcf {

/// Where a body's mass comes from.
enum class InertiaFromGeom {
    kNever,   ///< from <inertial> only
    kAlways,  ///< from the geoms, whatever <inertial> says
    kAuto     ///< from the geoms where there is no <inertial>
};

struct Settings {
    // <compiler>
    double angle_unit = kPi / 180.0;  ///< rad in a unit of angle
    std::string euler_sequence = "xyz";
    std::string mesh_folder, texture_folder;  ///< from the folder of the main file
    bool strip_path = false;
    bool autolimits = true;
    bool fit_aabb = false;
    InertiaFromGeom inertia_from_geom = InertiaFromGeom::kAuto;
    int inertia_group_first = 0, inertia_group_last = 5;
    double least_mass = 0, least_inertia = 0;  ///< kg, kg m^2
    bool balance_inertia = false;
    double total_mass = -1;  ///< kg; not above 0: as the bodies say
    // <option>
    double timestep = 0.002;  ///< s
    Vec3 gravity{0, 0, -9.81};
    Vec3 magnetic{0, -0.5, 0};
    bool contacts = true, equalities = true, limits = true, springs = true, dampers = true,
         friction_loss = true, actuation = true, sleep = false;
};

Settings read_settings(const Document& document, Diagnostics& diagnostics);

}  // namespace roboss::mjcf
