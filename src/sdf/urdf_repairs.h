// What URDF allows, or many files get slightly wrong, and what would cost the file a link or all of it: made
// into what libsdformat takes.
#pragma once

#include <map>
#include <string>

#include "core/diagnostics.h"
#include "sdf/source_file.h"

namespace roboss::sdf_import {

/// In a copy of the <robot> of `urdf`, each with a warning:
/// - numbers of an <inertial> with white space or text behind them become those numbers;
/// - an inertial with a mass but without all moments gets moments of 0, which compile() mends;
/// - a joint with the name of a link gets "_joint" behind it: SDFormat has one set of names for both;
/// - "::" in names becomes "__": SDFormat keeps it for nested models;
/// - a limit without effort or velocity has none of these bounds, and a hinge or slide without <limit> has
/// none at
///   all, as in MuJoCo and PyBullet;
/// - a robot without mass and without a joint that moves becomes a static model;
/// - a robot of which joints move on a root without mass stands fixed in the world by it, as in MuJoCo:
/// libsdformat
///   would leave out all of it;
/// - a robot without a name gets that of its file.
void repair_urdf(pugi::xml_node robot, const SourceFile& urdf, Diagnostics& diagnostics);

/// True, and a warning, for a robot that has joints that move, collisions, and no mass anywhere: its masses
/// are to follow from the collisions, as in MuJoCo. In `robot` each link gets an inertial that stands for
/// them, so that libsdformat keeps the link.
bool stand_in_for_masses(pugi::xml_node robot, const SourceFile& urdf, Diagnostics& diagnostics);

/// Joints whose type SDFormat lacks (<roboss:joint>), by name. libsdformat would leave them out: in `robot`
/// they become continuous ones with the same axis.
std::map<std::string, std::string> replace_joint_types(pugi::xml_node robot, const SourceFile& urdf,
                                                       Diagnostics& diagnostics);

/// Cameras with a <horizontal_fov> below 0.1 rad, by the name of their sensor: libsdformat 12 refuses the
/// file for them, earlier releases and their Gazebo did not. In `robot` they get another one.
std::map<std::string, std::string> replace_narrow_views(pugi::xml_node robot);

}  // namespace roboss::sdf_import
