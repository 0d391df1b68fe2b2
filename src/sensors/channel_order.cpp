// See channel_order.h.
#include "sensors/channel_order.h"

#include <string>
#include <utility>

namespace roboss {
namespace {

const std::string* format_of(const SensorSpec& sensor) {
    if (const auto* camera = sensor.as<ColorCameraSpec>()) return &camera->format;
    if (const auto* camera = sensor.as<RgbdCameraSpec>()) return &camera->format;
    return nullptr;
}

}  // namespace

void put_red_first(const SensorSpec& sensor, Image<std::uint8_t>& image) {
    const std::string* const format = format_of(sensor);
    if (image.channels != 3 || format == nullptr || !format->starts_with("B")) return;
    for (std::size_t i = 0; i + 2 < image.samples.size(); i += 3)
        std::swap(image.samples[i], image.samples[i + 2]);
}

void put_red_first(const SensorSpec& sensor, Sample& reading) {
    if (auto* camera = std::get_if<CameraReading>(&reading)) put_red_first(sensor, camera->color);
    if (auto* camera = std::get_if<RgbdCameraReading>(&reading)) put_red_first(sensor, camera->color);
}

}  // namespace roboss
