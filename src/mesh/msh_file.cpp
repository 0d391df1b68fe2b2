// Four counts (vertices, normals, texture coordinates, triangles), then the numbers of each in this order:
// floats by threes, threes and twos, vertices of triangles as 32-bit integers. Normals and texture
// coordinates are passed over.
#include "mesh/msh_file.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <vector>

namespace roboss {
namespace {

static_assert(std::endian::native == std::endian::little, "MSH files are little-endian");

constexpr std::int64_t kMost = 10'000'000;  // vertices, triangles

template <class T>
T at(const std::string& bytes, std::size_t word) {
    T value;
    std::memcpy(&value, bytes.data() + 4 * word, sizeof value);
    return value;
}

Error malformed(const std::string& why) {
    return {"is no MSH file of MuJoCo: " + why, "Save it anew, as STL or OBJ for instance."};
}

}  // namespace

Result<MeshSpec> read_msh(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    if (!stream) return Error{"cannot be read", "Check that it is a file and may be read."};
    std::ostringstream text;
    text << stream.rdbuf();
    const std::string bytes = std::move(text).str();
    if (bytes.size() < 16) return malformed("it is too short");
    std::array<std::int64_t, 4> counts{};
    for (std::size_t k = 0; k < 4; ++k) counts[k] = at<std::int32_t>(bytes, k);
    for (const std::int64_t count : counts)
        if (count < 0 || count > kMost) return malformed("its header has impossible counts");
    const std::int64_t words = 4 + 3 * (counts[0] + counts[1] + counts[3]) + 2 * counts[2];
    if (static_cast<std::int64_t>(bytes.size()) != 4 * words)
        return malformed("its size is not what its header says");
    MeshSpec mesh;
    mesh.source = path;
    std::size_t word = 4;
    for (std::int64_t v = 0; v < counts[0]; ++v) {
        Vec3& vertex = mesh.vertices.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) vertex[k] = static_cast<double>(at<float>(bytes, word++));
        if (!is_finite(vertex)) return malformed("a coordinate is not finite");
    }
    word += static_cast<std::size_t>(3 * counts[1] + 2 * counts[2]);
    for (std::int64_t t = 0; t < counts[3]; ++t) {
        auto& triangle = mesh.triangles.emplace_back();
        for (std::uint32_t& vertex : triangle) {
            const auto number = at<std::int32_t>(bytes, word++);
            if (number < 0 || number >= counts[0])
                return malformed("a triangle has a vertex that is not there");
            vertex = static_cast<std::uint32_t>(number);
        }
    }
    return mesh;
}

}  // namespace roboss
