// Silhouette: which pixels show some shapes of a scene if nothing hides them.
#pragma once

#include <cstdint>
#include <span>

#include "render/view.h"

namespace roboss::render {

struct Silhouette {
    std::int64_t pixels = 0;                       // within the image
    int left = 0, top = 0, right = 0, bottom = 0;  // of their box; left >= right: there are none
};

/// Of these items of scene.trace(), from the near to the far plane.
Silhouette silhouette(const CameraScene& scene, const CameraView& view, std::span<const std::uint32_t> items);

}  // namespace roboss::render
