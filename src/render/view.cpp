// See view.h.
#include "render/view.h"

#include <algorithm>
#include <cmath>

#include "render/shape_rays.h"

namespace roboss::render {

bool in_image(const CameraOptics& optics, const Block& block, std::size_t lane) {
    const int column = block.column + static_cast<int>(lane) % kBlockColumns;
    const int row = block.row + static_cast<int>(lane) / kBlockColumns;
    return column < optics.width && row < optics.height;
}

std::size_t pixel_of(const CameraOptics& optics, const Block& block, std::size_t lane) {
    const int column = block.column + static_cast<int>(lane) % kBlockColumns;
    const int row = block.row + static_cast<int>(lane) / kBlockColumns;
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(optics.width) +
           static_cast<std::size_t>(column);
}

void aim(const CameraView& view, const Lens& lens, int column, int row, double du, double dv, Block& block) {
    block.column = column, block.row = row, block.lit = 0;
    RayPacket& rays = block.rays;
    for (std::size_t k = 0; k < 3; ++k) rays.eye[k] = view.X_WC.p[k];
    rays.mask = static_cast<std::uint32_t>(view.optics.visibility_mask);
    rays.hollow_first = view.housing.first, rays.hollow_last = view.housing.last;
    constexpr double kFarthest = 1e9;
    const auto near = static_cast<float>(view.optics.near);
    const auto far = static_cast<float>(std::min(view.optics.far, kFarthest));
    for (std::size_t i = 0; i < kPacket; ++i) {
        const double u = column + static_cast<int>(i) % kBlockColumns + du;
        const double v = row + static_cast<int>(i) / kBlockColumns + dv;
        const auto direction = lens.direction(u, v);
        if (direction && in_image(view.optics, block, i)) block.lit |= 1u << i;
        block.d_C[i] = direction.value_or(Vec3{1, 0, 0});
        block.d_W[i] = view.X_WC.R * block.d_C[i];
        for (std::size_t k = 0; k < 3; ++k) {
            rays.origin[k][i] = 0;
            rays.direction[k][i] = static_cast<float>(block.d_W[i][k]);
        }
        rays.t_min[i] = near, rays.t_max[i] = far;
    }
    rays.active = block.lit;
}

ExactHit measure_hit(const CameraScene& scene, const CameraView& view, const Vec3& d_W, std::uint32_t number,
                     std::uint32_t triangle, double t_min) {
    const TraceItem& item = scene.item(number);
    const double* R = item.R_WS;
    const Vec3 w{view.X_WC.p.x - item.p_WS[0], view.X_WC.p.y - item.p_WS[1], view.X_WC.p.z - item.p_WS[2]};
    Vec3 o, d;
    for (std::size_t k = 0; k < 3; ++k) {
        o[k] = R[k] * w.x + R[3 + k] * w.y + R[6 + k] * w.z;
        d[k] = R[k] * d_W.x + R[3 + k] * d_W.y + R[6 + k] * d_W.z;
    }
    const bool hollow = number >= view.housing.first && number < view.housing.last;
    const VisualMesh* mesh = item.kind == TraceKind::kMesh ? scene.world().meshes[item.mesh].get() : nullptr;
    return exact_hit(item, mesh, triangle, o, d, t_min, hollow);
}

std::vector<Sighting> sight(const CameraScene& scene, const CameraView& view, double near, double far) {
    const CameraOptics& optics = view.optics;
    CameraView from = view;
    from.optics.near = near, from.optics.far = far;
    const Lens lens(optics);
    const Tracer& tracer = best_tracer();
    std::vector<Sighting> seen(static_cast<std::size_t>(optics.width) *
                               static_cast<std::size_t>(optics.height));
    const auto bands = static_cast<std::size_t>((optics.height + kBlockRows - 1) / kBlockRows);
    scene.share_out(bands, [&](std::size_t band) {
        const int row = static_cast<int>(band) * kBlockRows;
        Block block;
        PacketHits hits;
        for (int column = 0; column < optics.width; column += kBlockColumns) {
            aim(from, lens, column, row, 0.5, 0.5, block);
            if (block.lit != 0) tracer.nearest(scene.trace(), block.rays, hits);
            for (std::size_t i = 0; i < kPacket; ++i) {
                if ((block.lit >> i & 1u) == 0 || hits.item[i] == kNothing) continue;
                const ExactHit hit =
                    measure_hit(scene, from, block.d_W[i], hits.item[i], hits.triangle[i], near);
                seen[pixel_of(optics, block, i)] = {hit.t * block.d_C[i].x, hits.item[i]};
            }
        }
    });
    return seen;
}

}  // namespace roboss::render
