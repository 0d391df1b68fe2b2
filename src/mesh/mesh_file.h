// Mesh files (STL, OBJ, DAE, glTF, FBX, PLY) to plain triangles. The only place that knows assimp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "world/world.h"

namespace roboss {

struct MeshRequest {
    std::string path;
    Vec3 scale{1, 1, 1};
    std::string submesh;          // name of one part; empty: all of the file
    bool centre_submesh = false;  // move that part's box to the origin before scaling
};

struct MeshFile {
    MeshSpec mesh;
    std::size_t dropped = 0;  // triangles without area
};

/// Corners with equal coordinates are joined, nodes' transforms and COLLADA's unit are applied, COLLADA's up
/// axis is not (as in Gazebo), nor are FBX's; glTF's axes are taken as they stand. Coordinates have the
/// digits of single precision, as assimp reads them. Errors: no such file, not a mesh, no triangles, a
/// coordinate that is not finite or beyond 1e6 m, more than two million triangles, no such part.
Result<MeshFile> read_mesh(const MeshRequest& request);

/// A picture that a mesh file names, or holds.
struct MeshPicture {
    std::string name;  // empty: none
    std::vector<std::uint8_t>
        bytes;  // a PNG or JPEG file inside the mesh file (glTF); empty: a file beside it
};

/// What the triangles of one material look like.
struct MeshPart {
    MeshSpec mesh;            // with uv where the file has them
    std::optional<Vec3> rgb;  // none: the file says nothing
    double alpha = 1;
    MeshPicture colour, normal;
};

/// The same triangles to be drawn, by material; the same Errors.
Result<std::vector<MeshPart>> read_mesh_parts(const MeshRequest& request);

}  // namespace roboss
