// Shader: the colours of a block of pixels. Light adds up linearly: an even ambient light, a little brighter
// from above; of each light a diffuse part (Lambert) and a highlight (GGX, as mobile renderers shorten it,
// Karis 2014), unless something stands in between. Then fog, and the sky behind it all.
#pragma once

#include "render/view.h"

namespace roboss::render {

class Shader {
  public:
    Shader(const CameraScene& scene, const CameraView& view, const Lens& lens);

    /// Linear colours of the rays of a block; black where the lens shows nothing.
    void shade(Block& block, std::array<Vec3, kPacket>& colours) const;

  private:
    struct Surface {
        bool seen = false;
        double t = 0, distance = 0;  // along d_W, and m
        Vec3 offset, n_W, flat_W;    // from the eye; both normals towards it
        Vec3 towards_eye, base, emissive;
        double alpha = 1, roughness = 1, metalness = 0;
    };
    using Surfaces = std::array<Surface, kPacket>;

    void find(const Block& block, const PacketHits& hits, Surfaces& surfaces) const;
    void light_up(const Surfaces& surfaces, const CameraScene::Light& light,
                  std::array<Vec3, kPacket>& colours) const;
    unsigned in_shadow(const Surfaces& surfaces, const std::array<Vec3, kPacket>& to_light,
                       const std::array<double, kPacket>& t_max, unsigned wanted) const;
    Vec3 sky(const Vec3& d_W) const;
    Vec3 fogged(const Vec3& colour, double distance) const;

    const CameraScene& scene_;
    const CameraView& view_;
    const Lens& lens_;
    const Tracer& tracer_;
    Vec3 ambient_, background_;
    bool has_sky_ = false, shadows_ = true;
};

}  // namespace roboss::render
