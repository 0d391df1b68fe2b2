// See silhouette.h.
#include "render/silhouette.h"

#include <algorithm>

namespace roboss::render {
Silhouette silhouette(const CameraScene& scene, const CameraView& view,
                      std::span<const std::uint32_t> items) {
    std::vector<Aabb> boxes;
    for (const std::uint32_t item : items) boxes.push_back(scene.box_W(item));
    const double* const c = scene.trace().centre;
    BoxTree tree = make_box_tree(boxes, 2, {c[0], c[1], c[2]});
    for (std::uint32_t& place : tree.order) place = items[place];
    TraceWorld alone = scene.trace();
    alone.trees[0] = {tree.nodes.data(), tree.order.data(), 0};
    alone.trees[1] = {};

    const CameraOptics& optics = view.optics;
    const Lens lens(optics);
    Silhouette all{0, optics.width, optics.height, 0, 0};
    Block block;
    PacketHits hits;
    for (int row = 0; row < optics.height; row += kBlockRows)
        for (int column = 0; column < optics.width; column += kBlockColumns) {
            aim(view, lens, column, row, 0.5, 0.5, block);
            if (block.lit == 0) continue;
            best_tracer().nearest(alone, block.rays, hits);
            for (std::size_t i = 0; i < kPacket; ++i) {
                if ((block.lit >> i & 1u) == 0 || hits.item[i] == kNothing) continue;
                const int u = column + static_cast<int>(i) % kBlockColumns,
                          v = row + static_cast<int>(i) / kBlockColumns;
                ++all.pixels;
                all.left = std::min(all.left, u), all.right = std::max(all.right, u + 1);
                all.top = std::min(all.top, v), all.bottom = std::max(all.bottom, v + 1);
            }
        }
    return all;
}

}  // namespace roboss::render
