// Inertials of URDF that urdfdom would leave out whole, with the link that they belong to, for one small
// slip.
#pragma once

#include <pugixml.hpp>

#include "core/diagnostics.h"
#include "sdf/source_file.h"

namespace roboss::sdf_import {

/// In a copy of the <robot> of `urdf`: numbers with white space or text behind them become those numbers, and
/// an inertial with a mass but without moments gets moments of 0, which compile() mends.
void mend_inertials(pugi::xml_node robot, const SourceFile& urdf, Diagnostics& diagnostics);

}  // namespace roboss::sdf_import
