// Cameras that see labels: which labelled thing each pixel shows, and boxes around those things.
#include <algorithm>
#include <map>

#include "render/image_box.h"
#include "sensors/labelled_things.h"
#include "sensors/readings.h"

namespace roboss {
namespace {

using Thing = CameraScene::Thing;

/// The image of a thing, whatever hides it, cut at the edges of the image.
render::ImageBox full_box(const PlacedCamera& camera, const Thing& thing) {
    const Transform X_CW = inverse(camera.view.X_WC);
    std::vector<Vec3> corners = corners_of(camera.scene, thing);
    for (Vec3& corner : corners) corner = X_CW * corner;
    const CameraOptics& optics = camera.view.optics;
    return image_of(render::Lens(optics), optics.near, corners).cut(optics);
}

void add_3d(const ThingBox& box, BoxCameraReading& reading) {
    const auto& [centre, q] = box.X_CB;
    reading.positions.insert(reading.positions.end(), {centre.x, centre.y, centre.z});
    reading.orientations.insert(reading.orientations.end(), {q.w, q.x, q.y, q.z});
    reading.sizes.insert(reading.sizes.end(), {box.size.x, box.size.y, box.size.z});
}

}  // namespace

Result<SegmentationCameraReading> read(const SegmentationCameraSpec& camera, const SensorQuery& query) {
    const Result<PlacedCamera> placed = place_camera(camera.optics, query);
    if (!placed) return placed.error();
    const std::vector<std::uint32_t> things = things_seen(placed.value());
    SegmentationCameraReading reading;
    add_info(camera.optics, reading);
    reading.labels = Image<std::uint8_t>(camera.optics.height, camera.optics.width, 1);
    const bool counts = camera.type != "semantic";
    if (counts) reading.instances = Image<std::uint16_t>(camera.optics.height, camera.optics.width, 1);
    for (std::size_t i = 0; i < things.size(); ++i) {
        const std::uint32_t number = things[i];
        if (number == CameraScene::kNoThing) continue;
        const Thing& thing = placed.value().scene.things()[number];
        reading.labels.samples[i] = static_cast<std::uint8_t>(thing.label);
        if (counts) reading.instances.samples[i] = thing.of_label;
    }
    return reading;
}

Result<BoxCameraReading> read(const BoxCameraSpec& camera, const SensorQuery& query) {
    const Result<PlacedCamera> placed = place_camera(camera.optics, query);
    if (!placed) return placed.error();
    const std::vector<std::uint32_t> things = things_seen(placed.value());
    std::map<std::uint32_t, render::ImageBox> visible;
    const auto width = static_cast<std::size_t>(camera.optics.width);
    for (std::size_t i = 0; i < things.size(); ++i) {
        const std::uint32_t thing = things[i];
        const auto column = static_cast<double>(i % width), row = static_cast<double>(i / width);
        if (thing != CameraScene::kNoThing) visible[thing].include(column, row, column + 1, row + 1);
    }
    BoxCameraReading reading;
    add_info(camera.optics, reading);
    for (const auto& entry : visible) {
        const Thing& thing = placed.value().scene.things()[entry.first];
        reading.labels.push_back(thing.label);
        if (!camera.is_visible() && !camera.is_full()) {
            add_3d(box_of(placed.value(), thing, query), reading);
            continue;
        }
        const render::ImageBox box = camera.is_full() ? full_box(placed.value(), thing) : entry.second;
        reading.boxes.insert(reading.boxes.end(), {box.left, box.top, box.right, box.bottom});
    }
    return reading;
}

}  // namespace roboss
