// assimp's own clean-up steps are left out: what counts here (joining corners, dropping slivers) is done in a
// written order, so the same file gives the same triangles on every machine.
#include "mesh/mesh_file.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <tuple>

#include "math/aabb.h"

namespace roboss {
namespace {

constexpr std::size_t kTrianglesMax = 2'000'000;
constexpr std::uintmax_t kBytesMax = 512u << 20;
constexpr double kFar = 1e6;  // m

std::string extension_of(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

class Gatherer {
  public:
    explicit Gatherer(const MeshRequest& request) : request_(request) {}

    Result<MeshFile> gather(const aiScene& scene) {
        if (scene.mRootNode != nullptr) visit(scene, *scene.mRootNode, aiMatrix4x4());
        if (!request_.submesh.empty() && !found_)
            return Error{"has no part named '" + request_.submesh + "'; its parts are: " + names_,
                         "Correct <submesh><name>."};
        if (corners_.empty()) return Error{"holds no triangles", "Export the mesh anew, with faces."};
        if (corners_.size() > 3 * kTrianglesMax)
            return Error{"has more than two million triangles", "Give a coarser mesh for the collision."};
        if (request_.centre_submesh) centre();
        for (Vec3& p : corners_) {
            p = {p.x * request_.scale.x, p.y * request_.scale.y, p.z * request_.scale.z};
            if (!is_finite(p))
                return Error{"has a coordinate that is not a finite number", "Export it anew."};
            if (std::fabs(p.x) > kFar || std::fabs(p.y) > kFar || std::fabs(p.z) > kFar)
                return Error{"reaches beyond 1000 km",
                             "Correct its unit with <scale> (0.001 for millimetres)."};
        }
        return join();
    }

  private:
    void visit(const aiScene& scene, const aiNode& node, const aiMatrix4x4& X_parent) {
        const aiMatrix4x4 X = X_parent * node.mTransformation;
        for (unsigned i = 0; i < node.mNumMeshes; ++i) {
            const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
            const std::string name = mesh.mName.C_Str();
            const bool wanted = request_.submesh.empty() || name == request_.submesh ||
                                request_.submesh == node.mName.C_Str();
            names_ += (names_.empty() ? "'" : ", '") +
                      (name.empty() ? std::string(node.mName.C_Str()) : name) + "'";
            if (!wanted) continue;
            found_ = true;
            add(mesh, X);
        }
        for (unsigned i = 0; i < node.mNumChildren; ++i) visit(scene, *node.mChildren[i], X);
    }

    void add(const aiMesh& mesh, const aiMatrix4x4& X) {
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            const aiFace& face = mesh.mFaces[f];
            if (face.mNumIndices != 3) continue;  // points and lines
            for (unsigned k = 0; k < 3; ++k) {
                const aiVector3D p = X * mesh.mVertices[face.mIndices[k]];
                corners_.push_back(
                    {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
            }
        }
    }

    void centre() {
        Aabb box;
        for (const Vec3& p : corners_) box.include(p);
        for (Vec3& p : corners_) p -= box.centre();
    }

    Result<MeshFile> join() {
        MeshFile out;
        out.mesh.source = request_.path;
        const auto before = [](const Vec3& a, const Vec3& b) {
            return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        };
        std::map<Vec3, std::uint32_t, decltype(before)> numbers(before);
        // A mirroring scale turns triangles inside out.
        const Vec3& s = request_.scale;
        const bool mirrored = s.x * s.y * s.z < 0;
        for (std::size_t i = 0; i + 2 < corners_.size(); i += 3) {
            std::array<std::uint32_t, 3> t{};
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 p = corners_[i + k] + Vec3{};  // -0 becomes 0
                t[k] = numbers.emplace(p, static_cast<std::uint32_t>(numbers.size())).first->second;
                if (t[k] == out.mesh.vertices.size()) out.mesh.vertices.push_back(p);
            }
            if (mirrored) std::swap(t[1], t[2]);
            const Vec3 &a = out.mesh.vertices[t[0]], &b = out.mesh.vertices[t[1]],
                       &c = out.mesh.vertices[t[2]];
            const double longest = std::max({norm_squared(b - a), norm_squared(c - b), norm_squared(a - c)});
            if (norm(cross(b - a, c - a)) > 1e-7 * longest)
                out.mesh.triangles.push_back(t);
            else
                ++out.dropped;
        }
        if (out.mesh.triangles.empty())
            return Error{"holds only triangles without area", "Export it anew, and check <scale>."};
        return out;
    }

    const MeshRequest& request_;
    bool found_ = false;
    std::string names_;
    std::vector<Vec3> corners_;
};

}  // namespace

Result<MeshFile> read_mesh(const MeshRequest& request) {
    std::error_code error;
    const auto bytes = std::filesystem::file_size(request.path, error);
    if (error) return Error{"cannot be read: " + error.message(), "Check that it is a file and may be read."};
    if (bytes == 0) return Error{"is empty", "Export the mesh anew."};
    if (bytes > kBytesMax) return Error{"is larger than 512 MiB", "Give a coarser mesh for the collision."};
    const std::string extension = extension_of(request.path);
    if (extension != ".stl" && extension != ".obj" && extension != ".dae")
        return Error{"is of a kind ('" + extension + "') that is not read",
                     "Convert it to STL, OBJ or DAE (COLLADA)."};
    Assimp::Importer importer;
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
    const aiScene* scene = importer.ReadFile(request.path, aiProcess_Triangulate);
    if (scene == nullptr)
        return Error{"is no mesh that can be read: " + std::string(importer.GetErrorString()),
                     "Export it anew."};
    return Gatherer(request).gather(*scene);
}

}  // namespace roboss
