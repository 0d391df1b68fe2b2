// A line "v x y z" is a point, a line "f ..." a face; everything else is passed over.
#include "mesh/obj_points.h"

#include <filesystem>
#include <fstream>
#include <sstream>

namespace roboss {
namespace {

constexpr std::uintmax_t kBytesMost = 512u << 20;

}  // namespace

Result<MeshSpec> read_obj_points(const std::string& path) {
    std::error_code error;
    const auto bytes = std::filesystem::file_size(path, error);
    std::ifstream file(path);
    if (error || !file) return Error{"cannot be read", "Check that it is a file and may be read."};
    if (bytes > kBytesMost) return Error{"is larger than 512 MiB", "Give a coarser mesh."};
    MeshSpec mesh;
    mesh.source = path;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "f") return Error{"has faces", "Read it as a mesh."};
        if (kind != "v") continue;
        float x = 0, y = 0, z = 0;
        const bool read = static_cast<bool>(words >> x >> y >> z);
        const Vec3 point{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
        if (!read || !is_finite(point))
            return Error{"has a coordinate that is not a finite number", "Export it anew."};
        mesh.vertices.push_back(point);
    }
    if (mesh.vertices.size() < 4)
        return Error{"holds fewer than four points and no triangles", "Export the mesh anew, with faces."};
    return mesh;
}

}  // namespace roboss
