// What a reader of meshes gives, as bytes from one process to another of the same program.
#pragma once

#include <string>
#include <vector>

#include "mesh/mesh_file.h"

namespace roboss {

std::string mesh_to_bytes(const Result<MeshFile>& file);
std::string parts_to_bytes(const Result<std::vector<MeshPart>>& parts);

/// The bytes may be damaged: an Error then, as for a triangle whose vertices are not there.
Result<MeshFile> mesh_from_bytes(const std::string& bytes);
Result<std::vector<MeshPart>> parts_from_bytes(const std::string& bytes);

}  // namespace roboss
