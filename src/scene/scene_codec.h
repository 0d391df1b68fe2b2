// A Scene as exact bytes and back, for cameras of Clients that have no world file: from the same Scene they
// compute the same images, bit for bit. (What a viewer gets is rounded: scene_file.h.) The decoder is total:
// any bytes give a Scene of this Model whose every index points to something, or an Error.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/result.h"
#include "scene/scene.h"

namespace roboss {

/// `scene` must be of `model`.
std::vector<std::uint8_t> encode_scene(const Scene& scene, const Model& model);
/// Errors: "changed-world", it is of another Model; "bad-scene", the bytes are damaged.
Result<Scene> decode_scene(std::span<const std::uint8_t> bytes, const Model& model);

}  // namespace roboss
