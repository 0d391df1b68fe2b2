// What many URDF files get slightly wrong, and what would cost the file a link or all of it.
#pragma once

#include "core/diagnostics.h"
#include "sdf/urdf_parts.h"

namespace roboss::sdf_import {

/// In the <robot> of `urdf`, each with a warning:
/// - a robot without a name gets that of its file;
/// - "::" in names becomes "__", and "__" before and after a link's name goes: SDFormat keeps both for
/// itself.
void repair_urdf(pugi::xml_node robot, const SourceFile& urdf, Diagnostics& diagnostics);

/// Links that stand or move where masses are missing, each with a warning:
/// - a robot without mass and without a joint that moves becomes a static model, as in PyBullet;
/// - a robot without mass of which joints move gets its masses from its collisions, as in MuJoCo;
/// - a root without mass is fixed to the world, as in MuJoCo.
/// False, and an error: nothing is there that could be simulated.
bool repair_roots(UrdfRobot& robot);

}  // namespace roboss::sdf_import
