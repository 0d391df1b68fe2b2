// MSH: MuJoCo's binary mesh files, single precision, little-endian.
#pragma once

#include <string>

#include "core/result.h"
#include "world/world.h"

namespace roboss {

/// The vertices and triangles of a file; without triangles it stands for the convex hull of its vertices.
/// Errors: no such file, another size than its header says, a coordinate that is not finite, a triangle of
/// vertices that are not there.
Result<MeshSpec> read_msh(const std::string& path);

}  // namespace roboss
