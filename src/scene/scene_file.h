// A scene as a viewer gets it: JSON and meshes (docs/viewer-protocol.md), and both in one run of bytes, so
// that whoever serves a viewer elsewhere needs neither the World nor its files.
#pragma once

#include <span>

#include "core/result.h"
#include "scene/scene.h"

namespace roboss {

/// A picture as it goes to a browser.
struct TextureFile {
    std::uint64_t hash = 0;
    PictureKind kind = PictureKind::kPng;
    std::vector<std::uint8_t> bytes;
};

/// As it stands in an HTTP answer.
const char* mime_type(PictureKind kind);

struct SceneFile {
    std::uint64_t model_hash = 0;  // of the Model whose scene it is
    std::uint64_t seed = 0;        // of the run
    std::string json;              // an object, without the number of the scene
    std::vector<std::vector<std::uint8_t>> meshes;
    std::vector<TextureFile> textures;
};

SceneFile scene_file(const Scene& scene, const Model& model, std::uint64_t seed);
/// What `GET /scene` answers.
std::string numbered(const SceneFile& file, std::uint32_t scene);

std::vector<std::uint8_t> encode(const SceneFile& file);
/// Any bytes give a file or an Error.
Result<SceneFile> decode_scene_file(std::span<const std::uint8_t> bytes);

}  // namespace roboss
