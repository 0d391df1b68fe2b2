// Wavefront OBJ files without faces: points only, whose convex hull MuJoCo takes. assimp drops or refuses
// them.
#pragma once

#include <string>

#include "core/result.h"
#include "world/world.h"

namespace roboss {

/// The points of an OBJ file that has no faces, with the digits of single precision; no triangles. Errors:
/// the file cannot be read or is larger than 512 MiB, it has faces, fewer than four points, or a coordinate
/// that is no finite number.
Result<MeshSpec> read_obj_points(const std::string& path);

}  // namespace roboss
