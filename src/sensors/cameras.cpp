// Cameras of all kinds: rays against the visuals (src/render), then clip planes, noise and formats.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sensors/infinity.h"
#include "sensors/placed_camera.h"
#include "sensors/readings.h"
#include "sensors/sensor_noise.h"

namespace roboss {
namespace {

using render::CameraView;
using render::Sighting;

bool is_noisy(const NoiseSpec& noise) {
    return !(noise == NoiseSpec{});
}

/// As the format orders channels: B8G8R8 blue first, L8 one of grey (ITU-R BT.601).
Image<std::uint8_t> in_format(Image<std::uint8_t> rgb, const std::string& format) {
    if (format.starts_with("B8G8R8") || format.starts_with("BGR"))
        for (std::size_t i = 0; i + 2 < rgb.samples.size(); i += 3)
            std::swap(rgb.samples[i], rgb.samples[i + 2]);
    if (!format.starts_with("L8") && !format.starts_with("L_")) return rgb;
    Image<std::uint8_t> grey(rgb.rows, rgb.columns, 1);
    for (std::size_t i = 0; i < grey.samples.size(); ++i) {
        const unsigned r = rgb.samples[3 * i], g = rgb.samples[3 * i + 1], b = rgb.samples[3 * i + 2];
        grey.samples[i] = static_cast<std::uint8_t>((299 * r + 587 * g + 114 * b + 500) / 1000);
    }
    return grey;
}

void add_noise(Image<std::uint8_t>& image, const NoiseSpec& noise, const SensorQuery& query) {
    if (!is_noisy(noise)) return;
    for (std::size_t i = 0; i < image.samples.size(); ++i) {
        const double noisy = noisy_value(image.samples[i] / 255.0, noise, query, 0, i);
        image.samples[i] = static_cast<std::uint8_t>(std::clamp(noisy, 0.0, 1.0) * 255 + 0.5);
    }
}

/// What is before the near plane is seen too, and told as -infinity.
Image<float> depth_image(const CameraScene& scene, const CameraView& view, double near, double far,
                         const NoiseSpec& noise, const SensorQuery& query) {
    constexpr double kNearest = 1e-4;  // m
    const std::vector<Sighting> seen = sight(scene, view, std::min(kNearest, near), far);
    Image<float> depth(view.optics.height, view.optics.width, 1, std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (seen[i].item == render::kNothing) continue;
        const double measured = seen[i].depth;
        if (measured < near)
            depth.samples[i] = -std::numeric_limits<float>::infinity();
        else if (measured <= far)
            depth.samples[i] = static_cast<float>(
                is_noisy(noise) ? std::clamp(noisy_value(measured, noise, query, 0, i), near, far)
                                : measured);
    }
    return depth;
}

}  // namespace

Result<CameraReading> read(const ColorCameraSpec& camera, const SensorQuery& query) {
    const Result<PlacedCamera> placed = place_camera(camera.optics, query);
    if (!placed) return placed.error();
    const auto& [scene, view] = placed.value();
    CameraReading reading;
    add_info(camera.optics, reading);
    reading.color = in_format(picture(scene, view), camera.format);
    add_noise(reading.color, camera.noise, query);
    return reading;
}

Result<DepthCameraReading> read(const DepthCameraSpec& camera, const SensorQuery& query) {
    const Result<PlacedCamera> placed = place_camera(camera.optics, query);
    if (!placed) return placed.error();
    const auto& [scene, view] = placed.value();
    DepthCameraReading reading;
    add_info(camera.optics, reading);
    reading.depth = depth_image(scene, view, camera.optics.near, camera.optics.far, camera.noise, query);
    return reading;
}

Result<RgbdCameraReading> read(const RgbdCameraSpec& camera, const SensorQuery& query) {
    const Result<PlacedCamera> placed = place_camera(camera.optics, query);
    if (!placed) return placed.error();
    const auto& [scene, view] = placed.value();
    RgbdCameraReading reading;
    add_info(camera.optics, reading);
    reading.color = in_format(picture(scene, view), camera.format);
    const double near = camera.depth_near > 0 ? camera.depth_near : camera.optics.near;
    const double far = camera.depth_far > 0 ? camera.depth_far : camera.optics.far;
    reading.depth = depth_image(scene, view, near, far, camera.noise, query);
    return reading;
}

Result<ThermalCameraReading> read(const ThermalCameraSpec& camera, const SensorQuery& query) {
    const Result<PlacedCamera> placed = place_camera(camera.optics, query);
    if (!placed) return placed.error();
    const auto& [scene, view] = placed.value();
    const std::vector<Sighting> seen = sight(scene, view, camera.optics.near, camera.optics.far);
    ThermalCameraReading reading;
    add_info(camera.optics, reading);
    reading.temperature = Image<float>(camera.optics.height, camera.optics.width, 1);
    for (std::size_t i = 0; i < seen.size(); ++i) {
        double kelvin = camera.ambient;
        if (seen[i].item != render::kNothing) {
            const double own = scene.shape(seen[i].item).temperature;
            if (own >= 0) kelvin = own;
        }
        kelvin = rounded_to(std::clamp(kelvin, camera.min, camera.max), camera.resolution);
        reading.temperature.samples[i] = static_cast<float>(noisy_value(kelvin, camera.noise, query, 0, i));
    }
    return reading;
}

}  // namespace roboss
