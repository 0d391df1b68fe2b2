// See shade.h.
#include "render/shade.h"

#include <algorithm>
#include <cmath>

namespace roboss::render {
namespace {

constexpr int kLayersMost = 4;  // of see-through surfaces behind each other

Vec3 times(const Vec3& a, const Vec3& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}

Vec3 squared(const Vec3& c) {
    return times(c, c);
}

Vec3 rotated(const double* R, const Vec3& v) {
    return {R[0] * v.x + R[1] * v.y + R[2] * v.z, R[3] * v.x + R[4] * v.y + R[5] * v.z,
            R[6] * v.x + R[7] * v.y + R[8] * v.z};
}

/// How much of a light's colour arrives along its ray, without shadows. `d`: m.
double strength(const CameraScene::Light& light, const Vec3& to_light, double d) {
    const LightSpec& spec = light.spec;
    if (spec.kind == LightKind::kDirectional) return 1;
    if (d > spec.range) return 0;
    const double fall = spec.constant + d * (spec.linear + d * spec.quadratic);
    double share = fall > 0 ? 1 / fall : 1;
    if (spec.kind == LightKind::kSpot) {
        const double inner = fixed_cos(0.5 * spec.inner_angle), outer = fixed_cos(0.5 * spec.outer_angle);
        const double along = -dot(to_light, light.direction_W);
        if (along <= outer) return 0;
        if (along < inner) {
            const double x = (along - outer) / std::max(inner - outer, 1e-9);
            share *= spec.falloff > 1e-9 && spec.falloff != 1 ? fixed_exp(spec.falloff * fixed_log(x)) : x;
        }
    }
    return share;
}

}  // namespace

Shader::Shader(const CameraScene& scene, const CameraView& view, const Lens& lens)
    : scene_(scene), view_(view), lens_(lens), tracer_(best_tracer()) {
    const SceneSpec& spec = scene.world().scene;
    ambient_ = squared(spec.ambient.value_or(Vec3{0.55, 0.55, 0.55}));
    background_ = squared(spec.background.value_or(Vec3{0.7, 0.7, 0.7}));
    has_sky_ = spec.sky || !scene.world().has_scene;
    shadows_ = spec.shadows;
}

Vec3 Shader::sky(const Vec3& d_W) const {
    if (!has_sky_) return background_;
    const Vec3 haze{0.80, 0.86, 0.90}, blue{0.22, 0.40, 0.68}, ground{0.42, 0.42, 0.40};  // linear
    const double height = d_W.z / norm(d_W);
    if (height < 0) return haze + (ground - haze) * std::min(1.0, -6 * height);
    const double share = std::min(1.0, 1.6 * height);
    return haze + (blue - haze) * (share * (2 - share));
}

Vec3 Shader::fogged(const Vec3& colour, double distance) const {
    const std::optional<FogSpec>& fog = scene_.world().scene.fog;
    if (!fog) return colour;
    const double share = (distance - fog->start) / std::max(fog->end - fog->start, 1e-6);
    const double thick = std::clamp(share, 0.0, 1.0) * std::clamp(fog->density, 0.0, 1.0);
    return colour * (1 - thick) + squared(fog->rgb) * thick;
}

void Shader::find(const Block& block, const PacketHits& hits, Surfaces& surfaces) const {
    for (std::size_t i = 0; i < kPacket; ++i) {
        Surface& to = surfaces[i];
        to.seen = (block.rays.active >> i & 1u) != 0 && hits.item[i] != kNothing;
        if (!to.seen) continue;
        const Vec3& d = block.d_W[i];
        const ExactHit hit = measure_hit(scene_, view_, d, hits.item[i], hits.triangle[i],
                                         static_cast<double>(block.rays.t_min[i]));
        const TraceItem& item = scene_.item(hits.item[i]);
        const Material& material = scene_.shape(hits.item[i]).material;
        const double length = norm(d);
        to.t = hit.t, to.distance = hit.t * length, to.offset = d * hit.t;
        to.towards_eye = d * (-1 / length);
        to.n_W = rotated(item.R_WS, hit.n_S), to.flat_W = rotated(item.R_WS, hit.flat_S);
        if (dot(to.flat_W, d) > 0) to.flat_W = -to.flat_W, to.n_W = -to.n_W;
        to.base = material.rgb, to.emissive = material.emissive;
        if (material.picture != nullptr) {
            const double steep = std::max(0.15, -dot(to.flat_W, d) / length);
            const double width = to.distance / lens_.fx() / steep * hit.uv_density;
            to.base = times(to.base, material.picture->at(hit.u, hit.v, width));
        }
        to.alpha = material.alpha, to.roughness = material.roughness, to.metalness = material.metalness;
    }
}

unsigned Shader::in_shadow(const Surfaces& surfaces, const std::array<Vec3, kPacket>& to_light,
                           const std::array<double, kPacket>& t_max, unsigned wanted) const {
    RayPacket rays;
    for (std::size_t k = 0; k < 3; ++k) rays.eye[k] = view_.X_WC.p[k];
    rays.active = wanted;
    for (std::size_t i = 0; i < kPacket; ++i) {
        const bool counts = (wanted >> i & 1u) != 0;
        const double lift = counts ? 1e-3 + 1e-5 * surfaces[i].distance : 0;
        const Vec3 from = counts ? surfaces[i].offset + surfaces[i].flat_W * lift : Vec3{};
        for (std::size_t k = 0; k < 3; ++k) {
            rays.origin[k][i] = static_cast<float>(from[k]);
            rays.direction[k][i] = counts ? static_cast<float>(to_light[i][k]) : 1.0F;
        }
        rays.t_min[i] = 0, rays.t_max[i] = counts ? static_cast<float>(t_max[i]) : 1.0F;
    }
    return tracer_.shadowed(scene_.trace(), rays);
}

void Shader::light_up(const Surfaces& surfaces, const CameraScene::Light& light,
                      std::array<Vec3, kPacket>& colours) const {
    constexpr double kFarAway = 1e4;  // m; what is farther from a surface throws no shadow on it
    const LightSpec& spec = light.spec;
    std::array<Vec3, kPacket> to_light{};
    std::array<double, kPacket> t_max{}, shares{};
    unsigned wanted = 0;
    for (std::size_t i = 0; i < kPacket; ++i) {
        const Surface& s = surfaces[i];
        if (!s.seen) continue;
        Vec3 way = -light.direction_W;
        double distance = kFarAway;
        if (spec.kind != LightKind::kDirectional) {
            way = light.position_W - (view_.X_WC.p + s.offset);
            distance = norm(way);
            if (!(distance > 1e-9)) continue;
            way = way / distance;
        }
        if (dot(s.n_W, way) <= 0 || dot(s.flat_W, way) <= 0) continue;
        const double share = strength(light, way, distance);
        if (!(share > 0)) continue;
        to_light[i] = way, t_max[i] = distance * (1 - 1e-4), shares[i] = share;
        wanted |= 1u << i;
    }
    if (wanted == 0) return;
    if (spec.cast_shadows && shadows_) wanted &= ~in_shadow(surfaces, to_light, t_max, wanted);
    const Vec3 diffuse = squared(spec.diffuse) * spec.intensity;
    for (std::size_t i = 0; i < kPacket; ++i) {
        if ((wanted >> i & 1u) == 0) continue;
        const Surface& s = surfaces[i];
        const Vec3& l = to_light[i];
        const double facing = dot(s.n_W, l);
        const Vec3 half_way = l + s.towards_eye, h = half_way / std::max(norm(half_way), 1e-9);
        const double nh = std::max(0.0, dot(s.n_W, h)), lh = std::max(0.0, dot(l, h));
        const double a = s.roughness * s.roughness, spread = nh * nh * (a * a - 1) + 1;
        const double glint = a * a / (spread * spread * std::max(0.1, lh * lh) * (4 * s.roughness + 2));
        const Vec3 mirror = Vec3{0.04, 0.04, 0.04} * (1 - s.metalness) + s.base * s.metalness;
        const Vec3 reflected = s.base * (1 - s.metalness) + mirror * std::min(glint, 20.0);
        colours[i] += times(reflected, diffuse) * (facing * shares[i]);
    }
}

void Shader::shade(Block& block, std::array<Vec3, kPacket>& colours) const {
    std::array<double, kPacket> left{};  // share of what is behind that still comes through
    for (std::size_t i = 0; i < kPacket; ++i) colours[i] = {}, left[i] = (block.lit >> i & 1u) != 0 ? 1 : 0;
    block.rays.active = block.lit;
    for (int layer = 0; layer < kLayersMost && block.rays.active != 0; ++layer) {
        PacketHits hits;
        tracer_.nearest(scene_.trace(), block.rays, hits);
        Surfaces surfaces;
        find(block, hits, surfaces);
        std::array<Vec3, kPacket> lit{};
        for (std::size_t i = 0; i < kPacket; ++i) {
            const Surface& s = surfaces[i];
            if (s.seen) lit[i] = s.emissive + times(s.base, ambient_) * (0.85 + 0.15 * s.n_W.z);
        }
        for (const CameraScene::Light& light : scene_.lights()) light_up(surfaces, light, lit);
        for (std::size_t i = 0; i < kPacket; ++i) {
            const unsigned bit = 1u << i;
            if ((block.rays.active & bit) == 0) continue;
            const Surface& s = surfaces[i];
            const double alpha = s.seen && layer + 1 < kLayersMost ? s.alpha : 1;
            colours[i] += (s.seen ? fogged(lit[i], s.distance) : sky(block.d_W[i])) * (left[i] * alpha);
            left[i] *= 1 - alpha;
            if (left[i] < 0.01) block.rays.active &= ~bit;
            block.rays.t_min[i] = static_cast<float>(s.t * (1 + 1e-5) + 1e-5);
        }
    }
}

Image<std::uint8_t> picture(const CameraScene& scene, const CameraView& view) {
    /// Places of rays in a pixel: spread in both directions, the same for all pixels.
    struct Place {
        double u, v;
    };
    static constexpr Place kOne[] = {{0.5, 0.5}}, kTwo[] = {{0.25, 0.25}, {0.75, 0.75}};
    static constexpr Place kFour[] = {{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}};
    static constexpr Place kEight[] = {{0.5625, 0.3125}, {0.4375, 0.6875}, {0.8125, 0.5625},
                                       {0.3125, 0.1875}, {0.1875, 0.8125}, {0.0625, 0.4375},
                                       {0.6875, 0.9375}, {0.9375, 0.0625}};
    const CameraOptics& optics = view.optics;
    const int wanted = optics.anti_aliasing;
    const std::span<const Place> places = wanted >= 8   ? std::span<const Place>(kEight)
                                          : wanted >= 4 ? std::span<const Place>(kFour)
                                          : wanted >= 2 ? std::span<const Place>(kTwo)
                                                        : std::span<const Place>(kOne);
    const Lens lens(optics);
    const Shader shader(scene, view, lens);
    Image<std::uint8_t> image(optics.height, optics.width, 3);
    const auto bands = static_cast<std::size_t>((optics.height + kBlockRows - 1) / kBlockRows);
    scene.share_out(bands, [&](std::size_t band) {
        const int row = static_cast<int>(band) * kBlockRows;
        Block block;
        std::array<Vec3, kPacket> colours;
        for (int column = 0; column < optics.width; column += kBlockColumns) {
            std::array<Vec3, kPacket> sums{};
            for (const Place& place : places) {
                aim(view, lens, column, row, place.u, place.v, block);
                shader.shade(block, colours);
                for (std::size_t i = 0; i < kPacket; ++i) sums[i] += colours[i];
            }
            for (std::size_t i = 0; i < kPacket; ++i) {
                if (!in_image(optics, block, i)) continue;
                for (std::size_t k = 0; k < 3; ++k) {
                    const double mean = sums[i][k] / static_cast<double>(places.size());
                    const double shown = std::sqrt(std::clamp(mean, 0.0, 1.0)) * 255 + 0.5;
                    image.samples[3 * pixel_of(optics, block, i) + k] = static_cast<std::uint8_t>(shown);
                }
            }
        }
    });
    return image;
}

}  // namespace roboss::render
