// Visuals: geometry, colour and what lies over it. <pbr><metal> is read, of <specular> what both have.
#include <algorithm>

#include "sdf/conversion.h"
#include "sdf/plugin_conversion.h"

namespace roboss::sdf_import {
namespace {

/// <visibility_flags>, a whole number of 32 bits.
std::uint32_t flags_of(const Element& visual, const Import& import) {
    constexpr double kAll = 4294967295;
    const double flags = import.reader.number(visual, "visibility_flags", kAll);
    return static_cast<std::uint32_t>(std::clamp(flags, 0.0, kAll));
}

std::optional<Vec3> material_colour(const Element& material, const char* child) {
    const auto words = words_of(material.node.child(child).text().get());
    if (words.size() < 3) return std::nullopt;
    return Vec3{parse_number(words[0]).value_or(0), parse_number(words[1]).value_or(0),
                parse_number(words[2]).value_or(0)};
}

/// Highlights and glow, in any material.
void read_glow(const Element& material, VisualSpec& spec) {
    if (const auto specular = material_colour(material, "specular")) spec.specular = specular;
    if (const auto emissive = material_colour(material, "emissive")) spec.emissive = emissive;
}

/// What an OGRE script says; colours that the file writes itself come after it.
void read_script(const Element& material, const Import& import, VisualSpec& spec) {
    const auto ogre = import.looks.script_material(material, import.diagnostics());
    if (!ogre) return;
    const bool picture = !ogre->texture.empty();
    if (picture && !spec.finish.colour)
        spec.finish.colour = import.looks.picture_of_script(ogre->texture, material, import.diagnostics());
    const std::optional<Vec3> rgb = ogre->diffuse ? ogre->diffuse : picture ? std::nullopt : ogre->ambient;
    if (rgb) spec.rgb = *rgb;
    if (!rgb && picture) spec.rgb = {1, 1, 1};
    spec.alpha = ogre->alpha;
    spec.specular = ogre->specular;
    spec.emissive = ogre->emissive;
}

void read_colour(const Element& material, VisualSpec& spec) {
    for (const char* colour : {"diffuse", "ambient"}) {
        const auto words = words_of(material.node.child(colour).text().get());
        if (words.size() < 3) continue;
        spec.rgb = {parse_number(words[0]).value_or(spec.rgb.x), parse_number(words[1]).value_or(spec.rgb.y),
                    parse_number(words[2]).value_or(spec.rgb.z)};
        if (words.size() > 3) spec.alpha = parse_number(words[3]).value_or(1.0);
        return;
    }
    const bool scripted = static_cast<bool>(material.child("script"));
    if (spec.finish.colour && !scripted) spec.rgb = {1, 1, 1};  // the picture alone
}

FinishSpec read_finish(const Element& material, const Import& import) {
    FinishSpec finish;
    const Element pbr = material.child("pbr"), metal = pbr.child("metal");
    const Element flow = metal ? metal : pbr.child("specular");
    if (!flow) return finish;
    const auto picture = [&](const char* child) {
        return import.looks.picture(flow, child, import.diagnostics());
    };
    finish.colour = picture("albedo_map");
    finish.normal = picture("normal_map");
    if (!metal) return finish;
    constexpr double kDefault = 0.5;  // of SDFormat
    finish.roughness_map = picture("roughness_map");
    finish.metalness_map = picture("metalness_map");
    finish.roughness = std::clamp(import.reader.number(metal, "roughness", kDefault), 0.0, 1.0);
    finish.metalness = std::clamp(import.reader.number(metal, "metalness", kDefault), 0.0, 1.0);
    return finish;
}

/// The first <texture> of a heightmap; how they blend into each other is not read.
void read_heightmap_texture(const Element& heightmap, const Import& import, VisualSpec& spec) {
    const Element texture = heightmap.child("texture");
    if (!texture) return;
    spec.finish.colour = import.looks.picture(texture, "diffuse", import.diagnostics());
    spec.finish.normal = import.looks.picture(texture, "normal", import.diagnostics());
    spec.geometry.texture_size = std::max(0.0, import.reader.number(texture, "size", 10));
    if (const auto second = texture.node.next_sibling("texture"))
        import.diagnostics().note(Element{texture.source, second}.where(), "second-texture",
                                  "a second <texture> of a heightmap is left out: all is drawn in the first");
}

/// Each part of the mesh; where the visual has a material of its own, that one lies over all parts.
std::vector<VisualSpec> parts_of(const VisualSpec& visual, const Element& mesh, bool has_material,
                                 const Import& import) {
    std::vector<VisualSpec> parts;
    for (const MeshLook& look : import.looks.parts(mesh, visual.geometry, import.diagnostics())) {
        VisualSpec& part = parts.emplace_back(visual);
        part.geometry.mesh = look.mesh;
        if (has_material) continue;
        part.rgb = look.rgb.value_or(visual.rgb);
        part.alpha *= look.alpha;
        part.finish = look.finish;
    }
    if (parts.empty()) parts.push_back(visual);
    return parts;
}

/// What Gazebo's plugins Label and Thermal say of a visual. A picture of heat counts as its middle.
void read_marks(const Element& visual, const Import& import, VisualSpec& spec) {
    for (const auto node : visual.node.children("plugin")) {
        const Element plugin{visual.source, node};
        const PluginName name = plugin_name(plugin);
        if (is_named(name, "Label", "label-system")) spec.label = read_label(plugin, import);
        if (!is_named(name, "Thermal", "thermal-system")) continue;
        if (plugin.child("temperature")) spec.temperature = import.reader.number(plugin, "temperature", 0);
        if (plugin.child("heat_signature"))
            spec.temperature = 0.5 * (import.reader.number(plugin, "min_temp", 273.15) +
                                      import.reader.number(plugin, "max_temp", 310));
    }
}

}  // namespace

int read_label(const Element& plugin, const Import& import) {
    const int label = import.reader.integer(plugin, "label", 0);
    if (label >= 0 && label <= 255) return label;
    import.diagnostics().warning(plugin.where(), "label",
                                 "a <label> of " + std::to_string(label) + " has no effect",
                                 "Write a number from 1 to 255.");
    return 0;
}

std::vector<VisualSpec> convert_visual(const Element& visual, const Pose& X_LV, const Import& import) {
    VisualSpec spec;
    spec.name = visual.name();
    spec.X_LV = X_LV;
    const Element geometry = visual.child("geometry"), material = visual.child("material");
    if (const auto known = convert_geometry(geometry, GeometryUse::kSee, import, spec.X_LV))
        spec.geometry = *known;
    const bool is_heightmap = spec.geometry.kind == GeometryKind::kHeightmap;
    spec.finish = read_finish(material, import);
    if (is_heightmap && !spec.finish.colour)
        read_heightmap_texture(geometry.child("heightmap"), import, spec);
    read_script(material, import, spec);
    read_colour(material, spec);
    read_glow(material, spec);
    spec.cast_shadows = import.reader.boolean(visual, "cast_shadows", true);
    spec.visibility_flags = flags_of(visual, import);
    read_marks(visual, import, spec);
    spec.alpha *= 1.0 - import.reader.number(visual, "transparency", 0.0);
    if (spec.geometry.kind != GeometryKind::kMesh) return {spec};
    return parts_of(spec, geometry.child("mesh"), static_cast<bool>(material), import);
}

}  // namespace roboss::sdf_import
