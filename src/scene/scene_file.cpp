// The scene's JSON.
#include "scene/scene_file.h"

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/archive.h"
#include "core/hash.h"
#include "model/joint_motion.h"
#include "scene/look_json.h"
#include "wire/view_state.h"
#include "world/joint_type.h"

namespace roboss {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Transform& X) {
    return json_of(to_pose(X));
}

/// null: none.
Json bound_of(double value) {
    return std::isfinite(value) && std::abs(value) < 1e15 ? Json(tidy(value)) : Json();
}

const char* name_of(SceneShapeKind kind) {
    static constexpr const char* kNames[] = {"plane",   "box",       "sphere", "cylinder",
                                             "capsule", "ellipsoid", "mesh",   "cone"};
    return kNames[static_cast<std::size_t>(kind)];
}

/// Pictures by their hash; null: nothing lies over the colour.
Json json_of(const SceneFinish& finish, const Scene& scene) {
    Json o;
    const auto picture = [&](const char* name, const std::optional<std::size_t>& texture) {
        if (texture) o[name] = to_hex(scene.textures[*texture].hash);
    };
    picture("colour", finish.colour);
    picture("normal", finish.normal);
    picture("roughness_map", finish.roughness_map);
    picture("metalness_map", finish.metalness_map);
    if (finish.roughness) o["roughness"] = tidy(*finish.roughness);
    if (finish.emissive) o["emissive"] = json_of(*finish.emissive);
    if (finish.metalness) o["metalness"] = tidy(*finish.metalness);
    return o;
}

Json json_of(const SceneShape& shape, const Scene& scene) {
    Json o{{"name", shape.name}, {"shape", name_of(shape.kind)}};
    switch (shape.kind) {
        case SceneShapeKind::kBox:
            o["size"] = json_of(shape.size);
            break;
        case SceneShapeKind::kPlane:
            o["size"] = {tidy(shape.size.x), tidy(shape.size.y)};
            break;
        case SceneShapeKind::kEllipsoid:
            o["radii"] = json_of(shape.size);
            break;
        case SceneShapeKind::kMesh:
            o["mesh"] = shape.mesh;
            break;
        case SceneShapeKind::kCylinder:
        case SceneShapeKind::kCapsule:
        case SceneShapeKind::kCone:
            o["length"] = tidy(shape.length);
            [[fallthrough]];
        case SceneShapeKind::kSphere:
            o["radius"] = tidy(shape.radius);
    }
    o["frame"] = json_of(shape.frame);
    o["rgb"] = json_of(shape.rgb);
    o["alpha"] = tidy(shape.alpha);
    if (!shape.casts) o["casts"] = false;
    if (shape.still) o["still"] = true;
    if (Json finish = json_of(shape.finish, scene); !finish.is_null()) o["finish"] = std::move(finish);
    return o;
}

Json json_of(const std::vector<SceneShape>& shapes, const Scene& scene) {
    Json list = Json::array();
    for (const SceneShape& shape : shapes) list.push_back(json_of(shape, scene));
    return list;
}

Json json_of(const SceneFlow& flow, const Scene& scene) {
    Json o{{"shape", json_of(flow.shape, scene)}};
    if (flow.robot.valid()) {
        o["robot"] = flow.robot.value;
        o["link"] = flow.link.value;
        return o;
    }
    o["linear"] = json_of(flow.motion.linear);
    o["angular"] = json_of(flow.motion.angular);
    o["belt"] = json_of(flow.motion.belt);
    o["at"] = json_of(flow.motion.at);
    return o;
}

/// How the page interpolates a body's coordinates.
const char* course_of(const JointTraits& joint) {
    return joint.is_quaternion ? "quaternion" : joint.is_periodic ? "circle" : "line";
}

Json json_of(const Body& body) {
    const JointTraits& joint = joint_traits(body.joint);
    const bool base = body.joint == JointKind::kFree;
    return {{"parent", body.parent},
            {"joint", joint.name},
            {"frame", json_of(body.X_PJ)},
            {"axis", json_of(body.axis_J)},
            {"turn", joint.turns ? 1 : 0},
            {"slide", tidy(slide_of(body))},
            {"course", base ? "none" : course_of(joint)},
            {"q", base ? 0 : body.q_index - 7},
            {"width", base ? 0 : joint.nq}};
}

/// Of the position along each axis of the joint.
Json units_of(const JointType& type) {
    Json units = Json::array();
    for (const JointKind motion : type.motions)
        for (int k = 0; k < joint_traits(motion).nv; ++k) units.push_back(joint_traits(motion).unit);
    return units;
}

Json json_of(const RobotType& type, const Joint& joint) {
    Json lower = Json::array(), upper = Json::array(), effort = Json::array(), speed = Json::array();
    for (int axis = 0; axis < joint.nv; ++axis) {
        const Dof& dof = type.dof(joint, axis);
        lower.push_back(bound_of(dof.lower));
        upper.push_back(bound_of(dof.upper));
        effort.push_back(bound_of(dof.max_effort));
        speed.push_back(bound_of(dof.max_velocity));
    }
    return {{"name", joint.name},
            {"kind", joint_type(joint.kind).name},
            {"body", joint.body},
            {"axes", joint.nv},
            {"units", units_of(joint_type(joint.kind))},
            {"q", joint.q_index < 0 ? -1 : joint.q_index - 7},
            {"lower", std::move(lower)},
            {"upper", std::move(upper)},
            {"max_effort", std::move(effort)},
            {"max_velocity", std::move(speed)}};
}

/// Writes the parameters that a viewer draws by, not the noise and the tables.
struct ParameterWriter {
    Json& o;
    void operator()(const Parameter& p, double value) const { o[p.name] = bound_of(value); }
    void operator()(const Parameter& p, int value) const { o[p.name] = value; }
    void operator()(const Parameter& p, const JointNames& names) const { o[p.name] = names; }
    void operator()(const Parameter& p, bool value) const { o[p.name] = value; }
    void operator()(const Parameter& p, const Vec3& value) const { o[p.name] = json_of(value); }
    void operator()(const Parameter& p, const std::string& value) const { o[p.name] = value; }
    void operator()(const Parameter& p, const std::vector<std::string>& value) const { o[p.name] = value; }
    void operator()(const Parameter& p, const Pose& value) const { o[p.name] = json_of(value); }
    void operator()(const Parameter&, const NoiseSpec&) const {}
    void operator()(const Parameter&, const std::vector<double>&) const {}
};

/// The units of a sensor's readings by their names.
Json units_of(const SensorSpec& spec) {
    Json units = Json::object();
    Sample sample;
    if (!make_sample(spec.kind().number, sample)) return units;
    visit_fields(sample, [&](const ReadingField& field, const auto&) { units[field.name] = field.unit; });
    return units;
}

Json json_of(const SensorInfo& sensor) {
    const SensorSpec& spec = sensor.spec;
    Json o{{"name", spec.name},
           {"kind", spec.kind().name},
           {"link", sensor.link.value},
           {"frame", json_of(spec.X_LS)},
           {"units", units_of(spec)}};
    visit_parameters(spec.parameters, ParameterWriter{o});
    return o;
}

Json json_of(const ChannelInfo& info) {
    Json values = Json::array();
    for (const ChannelValue& value : info.channel.values)
        values.push_back({{"name", value.name}, {"unit", value.unit}});
    return {{"name", info.channel.name}, {"list", info.channel.is_list}, {"values", std::move(values)}};
}

/// Mass, centre of mass and inertia of a link in its own frame.
void add_inertia(Json& o, const Link& link) {
    if (!(link.mass > 0)) return;
    const Mat3 R_LB = transpose(link.X_BL.R);
    const Mat3 I = R_LB * link.inertia_C * link.X_BL.R;
    o["mass"] = tidy(link.mass);
    o["centre"] = json_of(inverse(link.X_BL) * link.p_BC);
    o["inertia"] = {tidy(I.r0.x), tidy(I.r1.y), tidy(I.r2.z), tidy(I.r0.y), tidy(I.r0.z), tidy(I.r1.z)};
}

Json json_of(const SceneType& scene_type, const Scene& scene, const Model& model) {
    const RobotType& type = model.types[scene_type.type.index()];
    Json bodies = Json::array(), links = Json::array(), joints = Json::array(), sensors = Json::array();
    for (const Body& body : type.bodies) bodies.push_back(json_of(body));
    for (std::size_t l = 0; l < type.links.size(); ++l) {
        const Link& link = type.links[l];
        links.push_back({{"name", link.name},
                         {"body", link.body},
                         {"frame", json_of(link.X_BL)},
                         {"visuals", json_of(scene_type.links[l].visuals, scene)},
                         {"collisions", json_of(scene_type.links[l].collisions, scene)}});
        if (Json lights = json_of(scene_type.links[l].lights); !lights.empty())
            links.back()["lights"] = std::move(lights);
        add_inertia(links.back(), link);
    }
    for (const Joint& joint : type.joints) joints.push_back(json_of(type, joint));
    for (const SensorInfo& sensor : type.sensors) sensors.push_back(json_of(sensor));
    Json o{{"name", type.name},
           {"like", type.like.value},
           {"free_base", type.free_base},
           {"mass", tidy(type.mass)},
           {"reach", bound_of(type.reach)},
           {"origin", json_of(inverse(type.X_RB))},
           {"ranges", view_ranges(type)},
           {"bodies", std::move(bodies)},
           {"links", std::move(links)},
           {"joints", std::move(joints)},
           {"sensors", std::move(sensors)}};
    if (type.is_static) o["static"] = true;
    for (const ChannelInfo& info : type.channels) o["channels"].push_back(json_of(info));
    return o;
}

std::vector<std::uint8_t> bytes_of(const SceneMesh& mesh) {
    std::vector<std::uint8_t> bytes;
    const auto put = [&](const void* data, std::size_t size) {
        const auto* first = static_cast<const std::uint8_t*>(data);
        bytes.insert(bytes.end(), first, first + size);
    };
    const std::uint32_t counts[] = {static_cast<std::uint32_t>(mesh.vertices.size()),
                                    static_cast<std::uint32_t>(mesh.triangles.size())};
    put(counts, sizeof(counts));
    for (const Vec3& v : mesh.vertices) {
        const float xyz[] = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
        put(xyz, sizeof(xyz));
    }
    for (const auto& triangle : mesh.triangles) put(triangle.data(), sizeof(triangle));
    for (const auto& uv : mesh.uv) put(uv.data(), sizeof(uv));
    return bytes;
}

}  // namespace

const char* mime_type(PictureKind kind) {
    static constexpr const char* kTypes[] = {"image/png", "image/jpeg", "image/webp"};
    return kTypes[static_cast<std::size_t>(kind)];
}

SceneFile scene_file(const Scene& scene, const Model& model, std::uint64_t seed) {
    constexpr std::size_t kGroupsMax = 12;
    Json types = Json::array(), robots = Json::array();
    for (const SceneType& type : scene.types) types.push_back(json_of(type, scene, model));
    for (std::size_t r = 0; r < model.robots.size(); ++r)
        robots.push_back({{"name", model.robots[r].name}, {"type", scene.robots[r]}});
    Json o{{"world", model.name},
           {"dt", model.dt_s},
           {"gravity", json_of(model.gravity)},
           {"seed", seed},
           {"types", std::move(types)},
           {"robots", std::move(robots)},
           {"statics", json_of(scene.statics, scene)},
           {"groups_max", kGroupsMax}};
    if (model.wind != Vec3{}) o["wind"] = json_of(model.wind);
    if (Json look = json_of(scene.look); !look.is_null()) o["look"] = std::move(look);
    for (const SceneFlow& flow : scene.flows) o["flows"].push_back(json_of(flow, scene));
    SceneFile file{model.hash, seed, o.dump(-1, ' ', false, Json::error_handler_t::replace), {}, {}};
    for (const SceneMesh& mesh : scene.meshes) file.meshes.push_back(bytes_of(mesh));
    for (const SceneTexture& texture : scene.textures)
        file.textures.push_back({texture.hash, texture.picture->kind, texture.picture->bytes});
    return file;
}

std::string numbered(const SceneFile& file, std::uint32_t scene) {
    return "{\"scene\":" + std::to_string(scene) + "," + file.json.substr(1);
}

std::vector<std::uint8_t> encode(const SceneFile& file) {
    wire::Writer a;
    a.scalar(file.model_hash);
    a.scalar(file.seed);
    field(a, file.json);
    a.count(file.meshes.size());
    for (const auto& mesh : file.meshes) {
        a.count(mesh.size());
        a.raw(mesh.data(), mesh.size());
    }
    a.count(file.textures.size());
    for (const TextureFile& texture : file.textures) {
        a.scalar(texture.hash);
        a.scalar(texture.kind);
        a.count(texture.bytes.size());
        a.raw(texture.bytes.data(), texture.bytes.size());
    }
    return a.take();
}

Result<SceneFile> decode_scene_file(std::span<const std::uint8_t> bytes) {
    wire::Reader a(bytes);
    SceneFile file;
    a.scalar(file.model_hash);
    a.scalar(file.seed);
    field(a, file.json);
    file.meshes.resize(a.count(sizeof(std::uint32_t)));
    for (auto& mesh : file.meshes) {
        mesh.resize(a.count(1));
        a.raw(mesh.data(), mesh.size());
    }
    file.textures.resize(a.count(sizeof(std::uint64_t)));
    for (TextureFile& texture : file.textures) {
        a.scalar(texture.hash);
        a.scalar(texture.kind);
        if (texture.kind < PictureKind::kPng || texture.kind > PictureKind::kWebp)
            a.fail("a picture is of no known kind");
        texture.bytes.resize(a.count(1));
        a.raw(texture.bytes.data(), texture.bytes.size());
    }
    if (a.left() > 0) a.fail("bytes are left over behind it");
    if (!a.failed() && (file.json.size() < 2 || file.json.front() != '{')) a.fail("it holds no object");
    if (a.failed())
        return Error{"a damaged scene of " + std::to_string(bytes.size()) + " bytes: " + a.failure(),
                     "run the same version of RoBOSS everywhere"};
    return file;
}

}  // namespace roboss
