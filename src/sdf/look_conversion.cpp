// Lights, the sky and the first camera.
#include "sdf/look_conversion.h"

#include <algorithm>
#include <cstring>

namespace roboss::sdf_import {
namespace {

/// Red, green, blue of an element's text; nullopt: not three numbers.
std::optional<Vec3> colour_in(const Element& parent, const char* child) {
    const auto words = words_of(parent.node.child(child).text().get());
    if (words.size() < 3) return std::nullopt;
    Vec3 rgb;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto number = parse_number(words[k]);
        if (!number) return std::nullopt;
        rgb[k] = std::clamp(*number, 0.0, 1.0);
    }
    return rgb;
}

std::optional<LightKind> kind_of(const std::string& type) {
    if (type == "point") return LightKind::kPoint;
    if (type == "spot") return LightKind::kSpot;
    if (type == "directional") return LightKind::kDirectional;
    return std::nullopt;
}

void read_attenuation(const Element& attenuation, const ElementReader& reader, LightSpec& spec) {
    spec.range = std::max(0.0, reader.number(attenuation, "range", 10, Finite::kInfinityAllowed));
    spec.constant = std::max(0.0, reader.number(attenuation, "constant", 1));
    spec.linear = std::max(0.0, reader.number(attenuation, "linear", attenuation ? 1 : 0));
    spec.quadratic = std::max(0.0, reader.number(attenuation, "quadratic", 0));
    if (!(spec.range <= 1e6)) spec.range = 1e6;
    if (spec.constant + spec.linear + spec.quadratic <= 0) spec.constant = 1;
}

void read_spot(const Element& spot, const ElementReader& reader, LightSpec& spec) {
    spec.outer_angle = std::clamp(reader.number(spot, "outer_angle", kPi / 2), 0.0, kPi);
    spec.inner_angle = std::clamp(reader.number(spot, "inner_angle", 0), 0.0, spec.outer_angle);
    spec.falloff = std::max(0.0, reader.number(spot, "falloff", 1));
}

void read_fog(const Element& fog, const ElementReader& reader, SceneSpec& scene) {
    if (!fog || fog.text("type") == "none") return;
    FogSpec spec;
    spec.rgb = colour_in(fog, "color").value_or(spec.rgb);
    spec.start = std::max(0.0, reader.number(fog, "start", spec.start));
    spec.end = std::max(spec.start, reader.number(fog, "end", spec.end));
    spec.density = std::clamp(reader.number(fog, "density", spec.density), 0.0, 1.0);
    scene.fog = spec;
}

void read_scene(const Element& scene, const Import& import, WorldLook& look) {
    if (!scene) return;
    SceneSpec spec;
    spec.ambient = colour_in(scene, "ambient");
    spec.background = colour_in(scene, "background");
    spec.sky = static_cast<bool>(scene.child("sky"));
    spec.shadows = import.reader.boolean(scene, "shadows", true);
    spec.grid = import.reader.boolean(scene, "grid", true);
    read_fog(scene.child("fog"), import.reader, spec);
    look.scene = spec;
}

/// The 3D view of Gazebo's own GUI: MinimalScene, or GzScene3D of earlier versions.
void read_scene_plugin(const Element& plugin, const Import& import, WorldLook& look) {
    if (const Element pose = plugin.child("camera_pose"); pose && !look.camera)
        look.camera = CameraSpec{"camera", import.reader.pose(pose), false, "", ""};
    const auto ambient = colour_in(plugin, "ambient_light"),
               background = colour_in(plugin, "background_color");
    if (!look.scene && (ambient || background || plugin.child("sky"))) look.scene = SceneSpec{};
    if (!look.scene) return;
    if (!look.scene->ambient) look.scene->ambient = ambient;
    if (!look.scene->background) look.scene->background = background;
    look.scene->sky = look.scene->sky || plugin.child("sky");
}

void read_gui(const Element& gui, const Import& import, WorldLook& look) {
    if (const Element camera = gui.child("camera")) {
        CameraSpec spec;
        spec.name = camera.name();
        spec.X_WC = import.reader.pose(camera.child("pose"));
        spec.orthographic = camera.text("projection_type") == "orthographic";
        spec.view = camera.text("view_controller");
        spec.track = camera.child("track_visual").text("name");
        look.camera = spec;
    }
    for (const auto node : gui.node.children("plugin")) {
        const Element plugin{gui.source, node};
        const std::string file = node.attribute("filename").value();
        if (file.find("MinimalScene") != std::string::npos || file.find("Scene3D") != std::string::npos)
            read_scene_plugin(plugin, import, look);
        const std::string target = plugin.text("follow_target");
        if (!target.empty() && look.camera && look.camera->track.empty()) look.camera->track = target;
    }
}

}  // namespace

std::optional<LightSpec> convert_light(const Element& light, const Pose& X_FL, const Import& import) {
    const ElementReader& reader = import.reader;
    const std::string type = light.node.attribute("type").as_string("point");
    const auto kind = kind_of(type);
    if (!kind) {
        import.diagnostics().warning(
            light.where(), "unknown-light",
            "light '" + light.name() + "' is of type '" + type + "'; it does not shine",
            "Write type=\"point\", \"spot\" or \"directional\".");
        return std::nullopt;
    }
    if (!reader.boolean(light, "light_on", true)) return std::nullopt;
    LightSpec spec;
    spec.name = light.name();
    spec.kind = *kind;
    spec.X_FL = X_FL;
    spec.diffuse = colour_in(light, "diffuse").value_or(spec.diffuse);
    spec.specular = colour_in(light, "specular").value_or(spec.specular);
    spec.intensity = std::clamp(reader.number(light, "intensity", 1), 0.0, 1e3);
    spec.direction = reader.vector(light, "direction", spec.direction);
    if (norm(spec.direction) < 1e-12) spec.direction = {0, 0, -1};
    spec.cast_shadows = reader.boolean(light, "cast_shadows", false);
    read_attenuation(light.child("attenuation"), reader, spec);
    if (*kind == LightKind::kSpot) read_spot(light.child("spot"), reader, spec);
    return spec;
}

void read_look(const Element& world, IncludeStore& includes,
               const std::function<Pose(const Element&)>& pose_of, const Import& import, WorldLook& look) {
    for (const auto node : world.node.children()) {
        const Element element{world.source, node};
        if (std::strcmp(node.name(), "light") == 0) {
            if (auto light = convert_light(element, pose_of(element), import))
                look.lights.push_back(std::move(*light));
        } else if (std::strcmp(node.name(), "include") == 0) {
            const SourceFile* file = includes.lights_of(element);
            if (file == nullptr) continue;
            for (const auto inner : file->root().children("light")) {
                const Element part{file, inner};
                const Pose X =
                    element.child("pose") ? pose_of(element) : import.reader.pose(part.child("pose"));
                if (auto light = convert_light(part, X, import)) look.lights.push_back(std::move(*light));
            }
        }
    }
    read_scene(world.child("scene"), import, look);
    read_gui(world.child("gui"), import, look);
}

}  // namespace roboss::sdf_import
