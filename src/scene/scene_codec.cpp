// One description of the Scene's fields, used by the encoder and by the decoder. Meshes and pictures come
// first, so that every index can be checked where it is read.
#include "scene/scene_codec.h"

#include <cmath>
#include <utility>

#include "core/archive.h"

namespace roboss {
namespace wire {
namespace {

constexpr std::uint32_t kSceneVersion = 1;

struct SceneWriter : Writer {
    void index(std::size_t value, std::size_t) { scalar(static_cast<std::uint32_t>(value)); }
    template <class Kind>
    void kind(const Kind& value, Kind) {
        scalar(value);
    }
};

struct SceneReader : Reader {
    using Reader::Reader;
    std::size_t meshes = 0, textures = 0;

    /// Where something stands in a list of `size`.
    void index(std::size_t& value, std::size_t size) {
        std::uint32_t read = 0;
        scalar(read);
        if (read >= size) fail("an index points to nothing");
        value = failed() ? 0 : read;
    }
    /// A kind from the first to `last`.
    template <class Kind>
    void kind(Kind& value, Kind last) {
        scalar(value);
        if (value < Kind{} || value > last) fail("something is of no known kind"), value = Kind{};
    }
};

template <class A, class... Fields>
void all(A& a, Fields&... values);

template <class T>
void field(SceneWriter& a, const std::optional<T>& value);
template <class T>
void field(SceneReader& a, std::optional<T>& value);
template <class T>
void field(SceneWriter& a, const std::vector<T>& values);
template <class T>
void field(SceneReader& a, std::vector<T>& values);

void number(SceneWriter& a, const double& value) {
    a.scalar(value);
}
void number(SceneReader& a, double& value) {
    a.scalar(value);
    if (!std::isfinite(value)) a.fail("a number is not finite"), value = 0;
}

// clang-format off
template <class A> void field(A& a, Of<A, Vec3>& m) { number(a, m.x), number(a, m.y), number(a, m.z); }
template <class A> void field(A& a, Of<A, Quat>& m) { number(a, m.w), number(a, m.x), number(a, m.y), number(a, m.z); }
template <class A> void field(A& a, Of<A, Pose>& m) { all(a, m.p, m.q); }
template <class A> void field(A& a, Of<A, SurfaceFlow>& m) { all(a, m.linear, m.angular, m.belt, m.at); }
template <class A> void field(A& a, Of<A, LightSpec>& m) {
    a.kind(m.kind, LightKind::kDirectional);
    all(a, m.name, m.X_FL, m.diffuse, m.specular, m.intensity, m.direction, m.range, m.constant, m.linear, m.quadratic,
        m.inner_angle, m.outer_angle, m.falloff, m.cast_shadows);
}
template <class A> void field(A& a, Of<A, FogSpec>& m) { all(a, m.rgb, m.start, m.end, m.density); }
template <class A> void field(A& a, Of<A, SceneSpec>& m) { all(a, m.ambient, m.background, m.sky, m.shadows, m.grid, m.fog); }
template <class A> void field(A& a, Of<A, CameraSpec>& m) { all(a, m.name, m.X_WC, m.orthographic, m.view, m.track); }
template <class A> void field(A& a, Of<A, WorldLook>& m) { all(a, m.lights, m.scene, m.camera); }
// clang-format on

/// A place among the pictures, or none.
void picture(SceneWriter& a, const std::optional<std::size_t>& place) {
    field(a, place.has_value());
    if (place) a.index(*place, 0);
}
void picture(SceneReader& a, std::optional<std::size_t>& place) {
    bool there = false;
    field(a, there);
    place.reset();
    if (there) a.index(place.emplace(), a.textures);
}

std::size_t meshes_of(const SceneWriter&) {
    return 0;  // nothing is checked
}
std::size_t meshes_of(const SceneReader& a) {
    return a.meshes;
}

template <class A>
void field(A& a, Of<A, SceneFinish>& m) {
    picture(a, m.colour), picture(a, m.normal), picture(a, m.roughness_map), picture(a, m.metalness_map);
    all(a, m.roughness, m.metalness, m.emissive);
}

template <class A>
void field(A& a, Of<A, SceneShape>& m) {
    a.kind(m.kind, SceneShapeKind::kCone);
    if (m.kind == SceneShapeKind::kMesh) a.index(m.mesh, meshes_of(a));
    all(a, m.name, m.size, m.radius, m.length, m.frame, m.rgb, m.alpha, m.casts, m.still, m.finish, m.label,
        m.labels_model, m.temperature);
}

template <class A>
void field(A& a, Of<A, SceneLink>& m) {
    all(a, m.visuals, m.collisions, m.lights);
}

template <class A>
void field(A& a, Of<A, SceneType>& m) {
    all(a, m.type, m.links);
}

template <class A>
void field(A& a, Of<A, SceneFlow>& m) {
    all(a, m.shape, m.motion, m.robot, m.link);
}

template <class A, class... Fields>
void all(A& a, Fields&... values) {
    (field(a, values), ...);
}

template <class T>
void field(SceneWriter& a, const std::optional<T>& value) {
    field(a, value.has_value());
    if (value) field(a, *value);
}
template <class T>
void field(SceneReader& a, std::optional<T>& value) {
    bool there = false;
    field(a, there);
    value.reset();
    if (there) field(a, value.emplace());
}

template <class T>
void field(SceneWriter& a, const std::vector<T>& values) {
    a.count(values.size());
    for (const T& value : values) field(a, value);
}
template <class T>
void field(SceneReader& a, std::vector<T>& values) {
    values.clear();
    const std::size_t n = a.count(1);
    for (std::size_t i = 0; i < n && !a.failed(); ++i) field(a, values.emplace_back());
}

/// Values that are bytes as they stand in memory.
template <class T>
void block(SceneWriter& a, const std::vector<T>& values) {
    a.count(values.size());
    a.raw(values.data(), values.size() * sizeof(T));
}
template <class T>
void block(SceneReader& a, std::vector<T>& values) {
    values.resize(a.count(sizeof(T)));
    a.raw(values.data(), values.size() * sizeof(T));
}

template <class A>
void mesh(A& a, Of<A, SceneMesh>& m) {
    block(a, m.vertices), block(a, m.triangles), block(a, m.uv);
}

template <class A>
void picture_file(A& a, Of<A, PictureSpec>& m) {
    a.kind(m.kind, PictureKind::kWebp);
    all(a, m.source, m.width, m.height);
    block(a, m.bytes);
}

template <class A>
void rest(A& a, Of<A, Scene>& m) {
    all(a, m.types, m.statics, m.flows, m.look);
}

bool is_sound(const SceneMesh& mesh) {
    for (const Vec3& v : mesh.vertices)
        if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) return false;
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle)
            if (corner >= mesh.vertices.size()) return false;
    for (const auto& uv : mesh.uv)
        if (!std::isfinite(uv[0]) || !std::isfinite(uv[1])) return false;
    return mesh.uv.empty() || mesh.uv.size() == mesh.vertices.size();
}

void read_files(SceneReader& a, Scene& scene) {
    const std::size_t meshes = a.count(1);
    for (std::size_t i = 0; i < meshes && !a.failed(); ++i) {
        mesh(a, scene.meshes.emplace_back());
        if (!is_sound(scene.meshes.back())) a.fail("a mesh is damaged");
    }
    const std::size_t textures = a.count(1);
    for (std::size_t i = 0; i < textures && !a.failed(); ++i) {
        SceneTexture& texture = scene.textures.emplace_back();
        a.scalar(texture.hash);
        auto spec = std::make_shared<PictureSpec>();
        picture_file(a, *spec);
        texture.picture = std::move(spec);
    }
    a.meshes = scene.meshes.size(), a.textures = scene.textures.size();
}

void write_files(SceneWriter& a, const Scene& scene) {
    a.count(scene.meshes.size());
    for (const SceneMesh& m : scene.meshes) mesh(a, m);
    a.count(scene.textures.size());
    for (const SceneTexture& texture : scene.textures) {
        a.scalar(texture.hash);
        picture_file(a, *texture.picture);
    }
}

/// Robots, types, links and flows are those of the Model.
bool fits(const Scene& scene, const Model& model) {
    if (scene.robots.size() != model.robots.size()) return false;
    for (const SceneType& type : scene.types)
        if (type.type.index() >= model.types.size() ||
            type.links.size() != model.types[type.type.index()].links.size())
            return false;
    for (std::size_t r = 0; r < scene.robots.size(); ++r)
        if (scene.types[scene.robots[r]].type != model.robots[r].type) return false;
    for (const SceneFlow& flow : scene.flows)
        if (flow.robot.valid() && (flow.robot.index() >= model.robots.size() ||
                                   flow.link.index() >= model.type_of(flow.robot).links.size()))
            return false;
    return true;
}

}  // namespace
}  // namespace wire

std::vector<std::uint8_t> encode_scene(const Scene& scene, const Model& model) {
    wire::SceneWriter a;
    a.scalar(wire::kSceneVersion);
    a.scalar(model.hash);
    wire::write_files(a, scene);
    wire::rest(a, scene);
    a.count(scene.robots.size());
    for (const std::size_t type : scene.robots) a.index(type, scene.types.size());
    return a.take();
}

Result<Scene> decode_scene(std::span<const std::uint8_t> bytes, const Model& model) {
    const auto damaged = [&](const std::string& why) {
        return Error{"damaged visuals of " + std::to_string(bytes.size()) + " bytes: " + why,
                     "run the same version of RoBOSS everywhere", "bad-scene"};
    };
    wire::SceneReader a(bytes);
    std::uint32_t version = 0;
    std::uint64_t hash = 0;
    a.scalar(version);
    a.scalar(hash);
    if (!a.failed() && version != wire::kSceneVersion)
        return damaged("they have version " + std::to_string(version));
    if (!a.failed() && hash != model.hash)
        return Error{"the visuals are those of another world", "fetch the Model again", "changed-world"};
    Scene scene;
    wire::read_files(a, scene);
    wire::rest(a, scene);
    scene.robots.resize(a.count(sizeof(std::uint32_t)));
    for (std::size_t& type : scene.robots) a.index(type, scene.types.size());
    if (a.left() > 0) a.fail("bytes are left over behind them");
    if (a.failed()) return damaged(a.failure());
    if (!wire::fits(scene, model)) return damaged("they do not fit the robots");
    return scene;
}

}  // namespace roboss
