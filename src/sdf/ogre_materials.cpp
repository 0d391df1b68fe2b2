// A reader of OGRE's material scripts: blocks in braces, one attribute a line. Only the lines that say how a
// surface looks are read, of all techniques and passes alike; the last one wins.
#include "sdf/ogre_materials.h"

#include <algorithm>
#include <vector>

#include "sdf/element_reader.h"

namespace roboss::sdf_import {
namespace {

/// Without // and /* */ comments; braces on lines of their own.
std::string tidied(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::string_view two = text.substr(i, 2);
        if (two == "//") {
            while (i < text.size() && text[i] != '\n') ++i;
            out += '\n';
        } else if (two == "/*") {
            const std::size_t end = text.find("*/", i + 2);
            i = end == std::string_view::npos ? text.size() : end + 1;
        } else if (text[i] == '{' || text[i] == '}') {
            out += '\n';
            out += text[i];
            out += '\n';
        } else {
            out += text[i];
        }
    }
    return out;
}

std::optional<Vec3> colour_of(const std::vector<std::string_view>& words, double* alpha) {
    if (words.size() < 4) return std::nullopt;
    Vec3 rgb;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto number = parse_number(words[k + 1]);
        if (!number) return std::nullopt;
        rgb[k] = std::clamp(*number, 0.0, 1.0);
    }
    if (alpha != nullptr && words.size() > 4)
        *alpha = std::clamp(parse_number(words[4]).value_or(1.0), 0.0, 1.0);
    return rgb;
}

/// "alpha_op_ex source1 src_manual src_current 0.5": the whole is that opaque.
void read_manual_alpha(const std::vector<std::string_view>& words, OgreMaterial& material) {
    if (words.size() > 4 && words[2] == "src_manual")
        material.alpha = std::clamp(parse_number(words.back()).value_or(1.0), 0.0, 1.0);
}

void read_line(const std::vector<std::string_view>& words, OgreMaterial& material) {
    const std::string_view key = words.front();
    const auto take = [&](std::optional<Vec3>& colour, double* alpha) {
        if (const auto rgb = colour_of(words, alpha)) colour = rgb;
    };
    if (key == "ambient") take(material.ambient, nullptr);
    if (key == "diffuse") take(material.diffuse, &material.alpha);
    if (key == "specular") take(material.specular, nullptr);
    if (key == "emissive") take(material.emissive, nullptr);
    if (key == "texture" && words.size() > 1) material.texture = words[1];
    if (key == "alpha_op_ex") read_manual_alpha(words, material);
}

/// What a material that inherits from `name` begins as.
OgreMaterial inherited(const std::string& name, const OgreMaterials& known) {
    if (const auto found = known.find(name); found != known.end()) return found->second;
    const OgreMaterial* gazebo = gazebo_material(name);
    return gazebo != nullptr ? *gazebo : OgreMaterial{};
}

std::vector<std::vector<std::string_view>> lines_of(std::string_view text) {
    std::vector<std::vector<std::string_view>> lines;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        auto words = words_of(text.substr(0, end));
        if (!words.empty()) lines.push_back(std::move(words));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    return lines;
}

}  // namespace

OgreMaterials parse_material_script(std::string_view text) {
    const std::string clean = tidied(text);
    OgreMaterials found;
    OgreMaterial* open = nullptr;
    int depth = 0;
    for (const auto& words : lines_of(clean)) {
        if (words.front() == "{") {
            ++depth;
        } else if (words.front() == "}") {
            depth = std::max(0, depth - 1);
            if (depth == 0) open = nullptr;
        } else if (depth == 0) {
            open = nullptr;
            if (words.front() != "material" || words.size() < 2) continue;
            const bool inherits = words.size() > 3 && words[2] == ":";
            OgreMaterial start = inherits ? inherited(std::string(words[3]), found) : OgreMaterial{};
            open = &found.insert_or_assign(std::string(words[1]), std::move(start)).first->second;
        } else if (open != nullptr) {
            read_line(words, *open);
        }
    }
    return found;
}

}  // namespace roboss::sdf_import
