// CameraView: a camera at its place; and the rays of its pixels, a block of 4 x 2 pixels at a time.
#pragma once

#include <array>

#include "render/camera_scene.h"
#include "render/exact_hit.h"
#include "render/lens.h"
#include "sensor_kinds/image.h"

namespace roboss::render {

struct CameraView {
    Transform X_WC;  // camera in the world
    CameraOptics optics;
    CameraScene::Items housing;  // of which only outer sides are seen: those of the camera's own link
};

/// What the centre of a pixel shows.
struct Sighting {
    double depth = 0;  // m along the camera's axis
    std::uint32_t item = kNothing;
};

inline constexpr int kBlockColumns = 4, kBlockRows = 2;

/// Rays of a block; lane i is pixel (column + i % 4, row + i / 4).
struct Block {
    int column = 0, row = 0;
    RayPacket rays;
    std::array<Vec3, kPacket> d_C, d_W;  // as Lens::direction, and in world axes
    unsigned lit = 0;                    // bit i: the lens shows something there, within the image
};

/// The rays through (du, dv) of each pixel, both from 0 to 1.
void aim(const CameraView& view, const Lens& lens, int column, int row, double du, double dv, Block& block);

/// Whether lane i is a pixel of the image.
bool in_image(const CameraOptics& optics, const Block& block, std::size_t lane);
/// Its place in an image.
std::size_t pixel_of(const CameraOptics& optics, const Block& block, std::size_t lane);

/// A hit in the frame of its shape, measured.
ExactHit measure_hit(const CameraScene& scene, const CameraView& view, const Vec3& d_W, std::uint32_t item,
                     std::uint32_t triangle, double t_min);

/// What the centre of each pixel shows, from `near` to `far` m.
std::vector<Sighting> sight(const CameraScene& scene, const CameraView& view, double near, double far);

/// What the camera sees, in the light of the world.
Image<std::uint8_t> picture(const CameraScene& scene, const CameraView& view);

}  // namespace roboss::render
