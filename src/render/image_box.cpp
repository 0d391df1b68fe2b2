// See image_box.h.
#include "render/image_box.h"

namespace roboss::render {

std::array<Vec3, 8> corners_of(const Aabb& box) {
    std::array<Vec3, 8> corners;
    for (std::size_t k = 0; k < 8; ++k)
        corners[k] = {(k & 1) != 0 ? box.max.x : box.min.x, (k & 2) != 0 ? box.max.y : box.min.y,
                      (k & 4) != 0 ? box.max.z : box.min.z};
    return corners;
}

ImageBox image_of(const Lens& lens, double near, std::span<const Vec3> corners_C) {
    ImageBox box;
    const auto add = [&](const Vec3& p_C) {
        if (const auto at = lens.project(p_C)) box.include(at->first, at->second, at->first, at->second);
    };
    for (std::size_t first = 0; first < corners_C.size(); first += 8)
        for (std::size_t a = 0; a < 8; ++a) {
            const Vec3 p = corners_C[first + a];
            if (p.x >= near) add(p);
            for (const std::size_t bit : {1u, 2u, 4u}) {
                if ((a & bit) != 0) continue;
                const Vec3 q = corners_C[first + (a | bit)];
                if ((p.x < near) != (q.x < near)) add(p + (q - p) * ((near - p.x) / (q.x - p.x)));
            }
        }
    return box;
}

}  // namespace roboss::render
