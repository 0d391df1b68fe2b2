// assimp's own clean-up steps are left out: what counts here (joining corners, dropping slivers) is done in a
// written order, so the same file gives the same triangles on every machine.
#include "mesh/mesh_file.h"

#include <assimp/defs.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <dlfcn.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "math/aabb.h"
#include "mesh/check_collada.h"
#include "mesh/check_ply.h"
#include "mesh/collada_edit.h"
#include "mesh/mesh_bytes.h"
#include "mesh/run_apart.h"

namespace Assimp {

/// Stands in for the function of assimp, which ends the program (Debian's build has its asserts on): a file
/// that breaks an assertion is one that cannot be read.
ASSIMP_API void aiAssertViolation(const char* expression, const char* file, int line);

void aiAssertViolation(const char* expression, const char* /*file*/, int /*line*/) {
    throw std::runtime_error("it does not keep to its format (" + std::string(expression) + ")");
}

}  // namespace Assimp

namespace roboss {
namespace {

constexpr std::size_t kTrianglesMax = 2'000'000;
constexpr std::uintmax_t kBytesMax = 512u << 20;
constexpr std::size_t kNamesMax = 2000;  // characters of a list in a message
constexpr double kFar = 1e6;             // m
constexpr std::string_view kKinds[] = {".stl", ".obj", ".dae", ".glb", ".gltf", ".fbx", ".ply"};

std::string extension_of(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

struct Corner {
    Vec3 p;
    std::array<float, 2> uv{};
};

/// All triangles wanted of a file; corners by threes.
struct Triangles {
    std::vector<Corner> corners;
    std::vector<unsigned> materials;  // by triangle
    bool have_uv = false;
};

class Gatherer {
  public:
    explicit Gatherer(const MeshRequest& request) : request_(request) {}

    Result<Triangles> gather(const aiScene& scene) {
        if (scene.mRootNode != nullptr) visit(scene, *scene.mRootNode, aiMatrix4x4());
        if (!request_.submesh.empty() && !found_)
            return Error{"has no part named '" + request_.submesh + "'; its parts are: " + names_,
                         "Correct <submesh><name>."};
        std::vector<Corner>& corners = out_.corners;
        if (corners.empty()) return Error{"holds no triangles", "Export the mesh anew, with faces."};
        if (is_too_much())
            return Error{"has more than two million triangles", "Give a coarser mesh for the collision."};
        if (request_.centre_submesh) centre();
        for (Corner& corner : corners) {
            Vec3& p = corner.p;
            p = {p.x * request_.scale.x, p.y * request_.scale.y, p.z * request_.scale.z};
            if (!is_finite(p))
                return Error{"has a coordinate that is not a finite number", "Export it anew."};
            if (std::fabs(p.x) > kFar || std::fabs(p.y) > kFar || std::fabs(p.z) > kFar)
                return Error{"reaches beyond 1000 km",
                             "Correct its unit with <scale> (0.001 for millimetres)."};
        }
        return std::move(out_);
    }

  private:
    bool is_too_much() const { return out_.corners.size() > 3 * kTrianglesMax; }

    void visit(const aiScene& scene, const aiNode& node, const aiMatrix4x4& X_parent) {
        const aiMatrix4x4 X = X_parent * node.mTransformation;
        for (unsigned i = 0; i < node.mNumMeshes; ++i) {
            const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
            const std::string name = mesh.mName.C_Str();
            const bool wanted = request_.submesh.empty() || name == request_.submesh ||
                                request_.submesh == node.mName.C_Str();
            if (!wanted && names_.size() < kNamesMax)
                names_ += (names_.empty() ? "'" : ", '") +
                          (name.empty() ? std::string(node.mName.C_Str()) : name) + "'";
            if (!wanted) continue;
            found_ = true;
            // One mesh may stand in many nodes: what is too much is not gathered first.
            if (!is_too_much()) add(mesh, X);
        }
        for (unsigned i = 0; i < node.mNumChildren; ++i) visit(scene, *node.mChildren[i], X);
    }

    void add(const aiMesh& mesh, const aiMatrix4x4& X) {
        const aiVector3D* uv = mesh.mTextureCoords[0];
        out_.have_uv = out_.have_uv || uv != nullptr;
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            const aiFace& face = mesh.mFaces[f];
            if (face.mNumIndices != 3) continue;  // points and lines
            out_.materials.push_back(mesh.mMaterialIndex);
            for (unsigned k = 0; k < 3; ++k) {
                const unsigned i = face.mIndices[k];
                const aiVector3D p = X * mesh.mVertices[i];
                out_.corners.push_back(
                    {{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)}, {}});
                if (uv != nullptr && std::isfinite(uv[i].x) && std::isfinite(uv[i].y))
                    out_.corners.back().uv = {uv[i].x, uv[i].y};
            }
        }
    }

    void centre() {
        Aabb box;
        for (const Corner& corner : out_.corners) box.include(corner.p);
        for (Corner& corner : out_.corners) corner.p -= box.centre();
    }

    const MeshRequest& request_;
    bool found_ = false;
    std::string names_;
    Triangles out_;
};

/// One material's triangles with their uv, or all without.
MeshFile join(const Triangles& all, const MeshRequest& request, std::optional<unsigned> material) {
    MeshFile out;
    MeshSpec& mesh = out.mesh;
    mesh.source = request.path;
    const bool with_uv = material && all.have_uv;
    const auto before = [](const Corner& a, const Corner& b) {
        return std::tie(a.p.x, a.p.y, a.p.z, a.uv) < std::tie(b.p.x, b.p.y, b.p.z, b.uv);
    };
    std::map<Corner, std::uint32_t, decltype(before)> numbers(before);
    // A mirroring scale turns triangles inside out.
    const Vec3& s = request.scale;
    const bool mirrored = s.x * s.y * s.z < 0;
    for (std::size_t i = 0; i + 2 < all.corners.size(); i += 3) {
        if (material && all.materials[i / 3] != *material) continue;
        std::array<std::uint32_t, 3> t{};
        for (std::size_t k = 0; k < 3; ++k) {
            Corner corner = all.corners[i + k];
            corner.p = corner.p + Vec3{};  // -0 becomes 0
            if (!with_uv) corner.uv = {};
            t[k] = numbers.emplace(corner, static_cast<std::uint32_t>(numbers.size())).first->second;
            if (t[k] < mesh.vertices.size()) continue;
            mesh.vertices.push_back(corner.p);
            if (with_uv) mesh.uv.push_back(corner.uv);
        }
        if (mirrored) std::swap(t[1], t[2]);
        const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
        const double longest = std::max({norm_squared(b - a), norm_squared(c - b), norm_squared(a - c)});
        if (norm(cross(b - a, c - a)) > 1e-7 * longest)
            mesh.triangles.push_back(t);
        else
            ++out.dropped;
    }
    return out;
}

Error no_area() {
    return {"holds only triangles without area", "Export it anew, and check <scale>."};
}

MeshPicture picture_of(const aiScene& scene, const aiMaterial& material, aiTextureType type) {
    aiString path;
    if (material.GetTexture(type, 0, &path) != aiReturn_SUCCESS) return {};
    MeshPicture picture;
    picture.name = path.C_Str();
    std::replace(picture.name.begin(), picture.name.end(), '\\', '/');
    const aiTexture* inside = scene.GetEmbeddedTexture(path.C_Str());
    if (inside == nullptr) return picture;
    // Height 0: a whole PNG or JPEG file of mWidth bytes. Bare pixels are in no kind that is read here.
    if (inside->mHeight != 0) return {};
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(inside->pcData);
    picture.bytes.assign(bytes, bytes + inside->mWidth);
    return picture;
}

/// Where a picture gives the colour, COLLADA says none beside it (assimp makes up a grey), and some exporters
/// of OBJ say black.
void describe(const aiScene& scene, const aiMaterial& material, bool collada, MeshPart& part) {
    aiString name;
    aiColor3D diffuse;
    float opacity = 1;
    part.colour = picture_of(scene, material, aiTextureType_DIFFUSE);
    part.normal = picture_of(scene, material, aiTextureType_NORMALS);
    if (material.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS &&
        std::string_view(name.C_Str()) == AI_DEFAULT_MATERIAL_NAME)
        return;
    if (material.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse) == aiReturn_SUCCESS)
        part.rgb = Vec3{static_cast<double>(diffuse.r), static_cast<double>(diffuse.g),
                        static_cast<double>(diffuse.b)};
    if (!part.colour.name.empty() && (collada || !part.rgb || norm(*part.rgb) < 1e-6))
        part.rgb = Vec3{1, 1, 1};
    if (material.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS && opacity > 0 && opacity <= 1)
        part.alpha = static_cast<double>(opacity);
}

std::string text_of(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return std::move(text).str();
}

/// The same file without ".." on the way: assimp takes a folder of such a path for the missing .mtl of an OBJ
/// file.
std::string straight(const std::string& path) {
    const std::filesystem::path file(path);
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::canonical(
        file.has_parent_path() ? file.parent_path() : std::filesystem::path("."), error);
    return error ? path : (folder / file.filename()).string();
}

/// What to do about a file of a kind that is not read.
std::string remedy_for_kind(const std::string& extension) {
    const std::string kinds = "STL, OBJ, DAE (COLLADA), GLB (glTF), FBX or PLY";
    if (extension == ".wrl" || extension == ".vrml" || extension == ".x3d" || extension == ".x3dv")
        return "VRML and X3D are not read. Convert it to " + kinds +
               ": import and export it in Blender (X3D/VRML2), or `meshlabserver -i mesh" + extension +
               " -o mesh.dae`.";
    return "Convert it to " + kinds + ".";
}

Error unreadable(const std::string& why) {
    return {"is no mesh that can be read: " + why, "Export it anew."};
}

bool has_its_meshes(const aiScene& scene, const aiNode& node) {
    for (unsigned i = 0; i < node.mNumMeshes; ++i)
        if (node.mMeshes[i] >= scene.mNumMeshes) return false;
    for (unsigned i = 0; i < node.mNumChildren; ++i)
        if (!has_its_meshes(scene, *node.mChildren[i])) return false;
    return true;
}

/// assimp's own steps take the indices of faces as they are, and so would the readers below.
bool has_its_parts(const aiScene& scene) {
    if (scene.mRootNode == nullptr || !has_its_meshes(scene, *scene.mRootNode)) return false;
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        const aiMesh& mesh = *scene.mMeshes[m];
        for (unsigned f = 0; f < mesh.mNumFaces; ++f)
            for (unsigned k = 0; k < mesh.mFaces[f].mNumIndices; ++k)
                if (mesh.mFaces[f].mIndices[k] >= mesh.mNumVertices) return false;
    }
    return true;
}

Vec3 corner_of(const aiMesh& mesh, const aiFace& face, unsigned k) {
    const aiVector3D& p = mesh.mVertices[face.mIndices[k]];
    return {p.x, p.y, p.z};
}

/// True if the diagonal from the first corner lies inside the quadrangle: both triangles face one way.
bool splits_at_first(const aiMesh& mesh, const aiFace& face) {
    const Vec3 p = corner_of(mesh, face, 0), diagonal = corner_of(mesh, face, 2) - p;
    return dot(cross(corner_of(mesh, face, 1) - p, diagonal), cross(diagonal, corner_of(mesh, face, 3) - p)) >
           0;
}

/// Splits quadrangles of OBJ along the diagonal from their first corner, as MuJoCo does up to version 3:
/// where the corners are not in one plane, the volume depends on it. MuJoCo 4 takes the shorter diagonal,
/// assimp the other one.
void split_quadrangles(aiMesh& mesh) {
    std::vector<aiFace> faces;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        if (face.mNumIndices != 4 || !splits_at_first(mesh, face)) {
            faces.push_back(face);
            continue;
        }
        for (const unsigned k : {1U, 2U}) {
            aiFace& triangle = faces.emplace_back();
            triangle.mNumIndices = 3;
            triangle.mIndices = new unsigned[3]{face.mIndices[0], face.mIndices[k], face.mIndices[k + 1]};
        }
    }
    delete[] mesh.mFaces;
    mesh.mNumFaces = static_cast<unsigned>(faces.size());
    mesh.mFaces = new aiFace[faces.size()];
    std::ranges::copy(faces, mesh.mFaces);
    // assimp refuses a mesh that says that it has polygons, and has none.
    const auto is_polygon = [](const aiFace& face) { return face.mNumIndices > 3; };
    if (std::ranges::none_of(faces, is_polygon))
        mesh.mPrimitiveTypes &= ~static_cast<unsigned>(aiPrimitiveType_POLYGON);
    mesh.mPrimitiveTypes |= aiPrimitiveType_TRIANGLE;
}

Result<const aiScene*> triangulated(Assimp::Importer& importer) {
    if (!has_its_parts(*importer.GetScene()))
        return unreadable("a face has a vertex, or a node a mesh, that is not there");
    const aiScene* scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
    if (scene == nullptr) return unreadable(importer.GetErrorString());
    return scene;
}

Result<const aiScene*> open_collada(Assimp::Importer& importer, const std::string& path) {
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
    const auto file = checked_collada(path, text_of(path));
    if (!file) return file.error();
    const auto read = [&] {
        const std::string text = collada_text(*file.value());
        return importer.ReadFileFromMemory(text.data(), text.size(), 0, "dae") != nullptr;
    };
    if (read()) return triangulated(importer);
    const std::string why = importer.GetErrorString();
    drop_collada_pictures(file.value()->root());
    if (read()) return triangulated(importer);
    return unreadable(why);
}

Result<const aiScene*> open_scene(Assimp::Importer& importer, const std::string& given) {
    const std::string path = straight(given);
    std::error_code error;
    const auto bytes = std::filesystem::file_size(path, error);
    if (error) return Error{"cannot be read: " + error.message(), "Check that it is a file and may be read."};
    if (bytes == 0) return Error{"is empty", "Export the mesh anew."};
    if (bytes > kBytesMax) return Error{"is larger than 512 MiB", "Give a coarser mesh for the collision."};
    const std::string extension = extension_of(path);
    if (std::ranges::find(kKinds, extension) == std::end(kKinds))
        return Error{"is of a kind ('" + extension + "') that is not read", remedy_for_kind(extension)};
    if (extension == ".dae") return open_collada(importer, given);
    if (extension == ".ply")
        if (const Result<> good = check_ply(text_of(path)); !good) return good.error();
    if (importer.ReadFile(path, 0) == nullptr) return unreadable(importer.GetErrorString());
    // assimp from 5.3 on turns the root by the axes that the file names; it has no other transformation.
    if (extension == ".fbx" && importer.GetScene()->mRootNode != nullptr)
        importer.GetScene()->mRootNode->mTransformation = aiMatrix4x4();
    if (extension == ".obj" && has_its_parts(*importer.GetScene()))
        for (unsigned m = 0; m < importer.GetScene()->mNumMeshes; ++m)
            split_quadrangles(*importer.GetScene()->mMeshes[m]);
    return triangulated(importer);
}

Result<MeshFile> read_mesh_here(const MeshRequest& request) {
    Assimp::Importer importer;
    const Result<const aiScene*> scene = open_scene(importer, request.path);
    if (!scene) return scene.error();
    const Result<Triangles> triangles = Gatherer(request).gather(*scene.value());
    if (!triangles) return triangles.error();
    MeshFile file = join(triangles.value(), request, std::nullopt);
    if (file.mesh.triangles.empty()) return no_area();
    return file;
}

Result<std::vector<MeshPart>> read_mesh_parts_here(const MeshRequest& request) {
    Assimp::Importer importer;
    const Result<const aiScene*> scene = open_scene(importer, request.path);
    if (!scene) return scene.error();
    const Result<Triangles> triangles = Gatherer(request).gather(*scene.value());
    if (!triangles) return triangles.error();
    std::vector<MeshPart> parts;
    for (unsigned m = 0; m < scene.value()->mNumMaterials; ++m) {
        MeshPart part{join(triangles.value(), request, m).mesh, {}, 1, {}, {}};
        if (part.mesh.triangles.empty()) continue;
        describe(*scene.value(), *scene.value()->mMaterials[m], extension_of(request.path) == ".dae", part);
        parts.push_back(std::move(part));
    }
    if (parts.empty()) return no_area();
    return parts;
}

/// assimp takes every line of an OBJ file that begins with m for one that names its materials.
bool names_materials(const std::string& obj) {
    std::size_t at = 0;
    while (at < obj.size()) {
        at = obj.find_first_not_of(" \t\r\n", at);
        if (at == obj.npos) return false;
        if (obj[at] == 'm' || obj[at] == '\0') return true;
        at = obj.find_first_of("\r\n", at);
    }
    return false;
}

/// Whether the dynamic linker takes the function above in assimp, too. Where RoBOSS is in a library that
/// hides it, as Python's module, assimp has its own.
bool outlives_assertions() {
    const auto here = reinterpret_cast<void*>(&Assimp::aiAssertViolation);
    static const bool is_taken = dlsym(RTLD_DEFAULT, "_ZN6Assimp17aiAssertViolationEPKcS1_i") == here;
    return is_taken;
}

/// Damaged files of other kinds make assimp 5.2 write beyond its arrays, free twice, or not end: they are
/// read in a process of its own. COLLADA is checked before; STL, and OBJ without materials, have shown
/// nothing of the kind: with assertions that are errors, they are read here.
bool is_read_apart(const std::string& path) {
    if (!outlives_assertions()) return true;
    const std::string extension = extension_of(path);
    std::error_code error;
    if (extension == ".obj")
        return std::filesystem::file_size(path, error) <= kBytesMax && names_materials(text_of(path));
    return extension != ".dae" && extension != ".stl";
}

}  // namespace

Result<MeshFile> read_mesh(const MeshRequest& request) {
    if (!is_read_apart(request.path)) return read_mesh_here(request);
    const auto bytes = run_apart([&] { return mesh_to_bytes(read_mesh_here(request)); });
    if (!bytes) return bytes.error();
    return mesh_from_bytes(bytes.value());
}

Result<std::vector<MeshPart>> read_mesh_parts(const MeshRequest& request) {
    if (!is_read_apart(request.path)) return read_mesh_parts_here(request);
    const auto bytes = run_apart([&] { return parts_to_bytes(read_mesh_parts_here(request)); });
    if (!bytes) return bytes.error();
    return parts_from_bytes(bytes.value());
}

}  // namespace roboss
