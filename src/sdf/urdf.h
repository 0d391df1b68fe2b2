// URDF becomes SDF, element by element; from there it takes the same way as every SDF file.
#pragma once

#include <memory>

#include "sdf/source_file.h"

namespace roboss::sdf_import {

/// The SDF of a URDF file; its lines are those of the URDF's elements. `urdf` is repaired in place. nullptr
/// with an error if it is none.
std::unique_ptr<SourceFile> urdf_to_sdf(const SourceFile& urdf, Diagnostics& diagnostics);

}  // namespace roboss::sdf_import
