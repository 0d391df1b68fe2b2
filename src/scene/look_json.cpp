// Lights, sky and camera as JSON. Numbers are rounded: shorter, and no viewer shows the difference.
#include "scene/look_json.h"

#include <cmath>

namespace roboss {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(LightKind kind) {
    static constexpr const char* kNames[] = {"point", "spot", "directional"};
    return kNames[static_cast<std::size_t>(kind)];
}

Json json_of(const LightSpec& light) {
    Json o{{"name", light.name},
           {"kind", name_of(light.kind)},
           {"frame", json_of(light.X_FL)},
           {"rgb", json_of(light.diffuse)},
           {"intensity", tidy(light.intensity)},
           {"shadows", light.cast_shadows}};
    if (light.kind != LightKind::kPoint) o["direction"] = json_of(light.direction);
    if (light.kind == LightKind::kDirectional) return o;
    o["range"] = tidy(light.range);
    o["attenuation"] = {tidy(light.constant), tidy(light.linear), tidy(light.quadratic)};
    if (light.kind == LightKind::kSpot)
        o["spot"] = {tidy(light.inner_angle), tidy(light.outer_angle), tidy(light.falloff)};
    return o;
}

Json json_of(const SceneSpec& scene) {
    Json o{{"sky", scene.sky}, {"shadows", scene.shadows}, {"grid", scene.grid}};
    if (scene.ambient) o["ambient"] = json_of(*scene.ambient);
    if (scene.background) o["background"] = json_of(*scene.background);
    if (scene.fog)
        o["fog"] = {{"rgb", json_of(scene.fog->rgb)},
                    {"start", tidy(scene.fog->start)},
                    {"end", tidy(scene.fog->end)},
                    {"density", tidy(scene.fog->density)}};
    return o;
}

Json json_of(const CameraSpec& camera) {
    Json o{{"name", camera.name}, {"frame", json_of(camera.X_WC)}, {"orthographic", camera.orthographic}};
    if (!camera.view.empty()) o["view"] = camera.view;
    if (!camera.track.empty()) o["track"] = camera.track;
    return o;
}

}  // namespace

double tidy(double value) {
    constexpr double kSteps = 1e9;
    const double rounded = std::floor(value * kSteps + 0.5) / kSteps;
    return rounded == 0 ? 0 : rounded;  // no -0
}

Json json_of(const Vec3& v) {
    return {tidy(v.x), tidy(v.y), tidy(v.z)};
}

Json json_of(const Pose& X) {
    return {tidy(X.p.x), tidy(X.p.y), tidy(X.p.z), tidy(X.q.w), tidy(X.q.x), tidy(X.q.y), tidy(X.q.z)};
}

Json json_of(const std::vector<LightSpec>& lights) {
    Json list = Json::array();
    for (const LightSpec& light : lights) list.push_back(json_of(light));
    return list;
}

Json json_of(const WorldLook& look) {
    Json o;
    if (!look.lights.empty()) o["lights"] = json_of(look.lights);
    if (look.scene) o["scene"] = json_of(*look.scene);
    if (look.camera) o["camera"] = json_of(*look.camera);
    return o;
}

}  // namespace roboss
