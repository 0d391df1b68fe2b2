// What URDF allows, or many files get slightly wrong, and what would cost the file a link or all of it: made
// into what libsdformat takes.
#pragma once

#include <pugixml.hpp>

#include "core/diagnostics.h"
#include "sdf/source_file.h"

namespace roboss::sdf_import {

/// In a copy of the <robot> of `urdf`, each with a warning:
/// - numbers of an <inertial> with white space or text behind them become those numbers;
/// - an inertial with a mass but without moments gets moments of 0, which compile() mends;
/// - a joint with the name of a link gets "_joint" behind it: SDFormat has one set of names for both.
void repair_urdf(pugi::xml_node robot, const SourceFile& urdf, Diagnostics& diagnostics);

}  // namespace roboss::sdf_import
