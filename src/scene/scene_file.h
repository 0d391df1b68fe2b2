// A scene as a viewer gets it: JSON and meshes (docs/viewer-protocol.md), and both in one run of bytes, so
// that whoever serves a viewer elsewhere needs neither the World nor its files.
#pragma once

#include <span>

#include "core/result.h"
#include "scene/scene.h"

namespace roboss {

/// A picture as it goes to a browser.
struct TextureFile {
    std::uint64_t hash = 0;                ///< of its bytes, by which visuals name it
    PictureKind kind = PictureKind::kPng;  ///< of its format
    std::vector<std::uint8_t> bytes;       ///< the file
};

/// As it stands in an HTTP answer.
const char* mime_type(PictureKind kind);

/// A scene in parts.
struct SceneFile {
    std::uint64_t model_hash = 0;                   ///< of the Model whose scene it is
    std::uint64_t seed = 0;                         ///< of the run
    std::string json;                               ///< an object, without the number of the scene
    std::vector<std::vector<std::uint8_t>> meshes;  ///< by number: corners, normals, triangles
    std::vector<TextureFile> textures;              ///< that visuals name
};

/// The parts of a scene of this Model.
SceneFile scene_file(const Scene& scene, const Model& model, std::uint64_t seed);
/// The JSON that `GET /scene` answers.
std::string numbered(const SceneFile& file, std::uint32_t scene);

/// All of it in one run of bytes.
std::vector<std::uint8_t> encode(const SceneFile& file);
/// Any bytes give a file or an Error.
Result<SceneFile> decode_scene_file(std::span<const std::uint8_t> bytes);

}  // namespace roboss
