// Cameras that see labels: which labelled thing each pixel shows, and boxes around those things.
#include <algorithm>
#include <map>

#include "sensors/placed_camera.h"
#include "sensors/readings.h"

namespace roboss {
namespace {

using Thing = CameraScene::Thing;

/// By pixel the number of the thing that it shows, or CameraScene::kNoThing.
std::vector<std::uint32_t> things_seen(const PlacedCamera& camera) {
    const CameraOptics& optics = camera.view.optics;
    std::vector<std::uint32_t> things;
    for (const render::Sighting& one : sight(camera.scene, camera.view, optics.near, optics.far))
        things.push_back(one.item == render::kNothing ? CameraScene::kNoThing
                                                      : camera.scene.thing_of(one.item));
    return things;
}

Transform place_of(const render::TraceItem& item) {
    Transform X;
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) X.R(r, c) = item.R_WS[3 * r + c];
        X.p[r] = item.p_WS[r];
    }
    return X;
}

/// Corners of the boxes of a thing's visuals, in the world.
std::vector<Vec3> corners_of(const CameraScene& scene, const Thing& thing) {
    std::vector<Vec3> corners;
    for (const std::uint32_t number : thing.items) {
        const Aabb box = render::box_of(scene.item(number), scene.world().meshes);
        const Transform X_WS = place_of(scene.item(number));
        for (int k = 0; k < 8; ++k)
            corners.push_back(X_WS * Vec3{(k & 1) != 0 ? box.max.x : box.min.x,
                                          (k & 2) != 0 ? box.max.y : box.min.y,
                                          (k & 4) != 0 ? box.max.z : box.min.z});
    }
    return corners;
}

/// Left, top, right, bottom; empty while left is beyond right.
struct Rectangle {
    double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;
    void include(double l, double t, double r, double b) {
        left = std::min(left, l), top = std::min(top, t);
        right = std::max(right, r), bottom = std::max(bottom, b);
    }
};

/// The image of a thing, whatever hides it, cut at the edges of the image. The edges of its boxes are cut at
/// the near plane first.
Rectangle full_box(const PlacedCamera& camera, const Thing& thing) {
    const render::Lens lens(camera.view.optics);
    const Transform X_CW = inverse(camera.view.X_WC);
    const double near = camera.view.optics.near;
    Rectangle box;
    const auto add = [&](const Vec3& p_C) {
        if (const auto at = lens.project(p_C)) box.include(at->first, at->second, at->first, at->second);
    };
    const std::vector<Vec3> corners = corners_of(camera.scene, thing);
    for (std::size_t first = 0; first < corners.size(); first += 8)
        for (std::size_t a = 0; a < 8; ++a) {
            const Vec3 p = X_CW * corners[first + a];
            if (p.x >= near) add(p);
            for (const std::size_t bit : {1u, 2u, 4u}) {
                if ((a & bit) != 0) continue;
                const Vec3 q = X_CW * corners[first + (a | bit)];
                if ((p.x < near) == (q.x < near)) continue;
                const double share = (near - p.x) / (q.x - p.x);
                add(p + (q - p) * share);
            }
        }
    box.left = std::max(box.left, 0.0), box.top = std::max(box.top, 0.0);
    box.right = std::min(box.right, static_cast<double>(camera.view.optics.width));
    box.bottom = std::min(box.bottom, static_cast<double>(camera.view.optics.height));
    return box;
}

void add_3d(const PlacedCamera& camera, const Thing& thing, const SensorQuery& query,
            BoxCameraReading& reading) {
    Transform X_WB = place_of(camera.scene.item(thing.items.front()));
    if (thing.robot) X_WB = to_transform(base_pose(query.sources.state_of(*thing.robot)));
    if (thing.robot) X_WB = X_WB * inverse(query.model.type_of(*thing.robot).X_RB);
    const Transform X_BW = inverse(X_WB);
    Aabb box;
    for (const Vec3& corner : corners_of(camera.scene, thing)) box.include(X_BW * corner);
    const Transform X_CB = inverse(camera.view.X_WC) * X_WB;
    const Vec3 centre = X_CB * box.centre(), size = box.max - box.min;
    const Quat q = to_quat(X_CB.R);
    reading.positions.insert(reading.positions.end(), {centre.x, centre.y, centre.z});
    reading.orientations.insert(reading.orientations.end(), {q.w, q.x, q.y, q.z});
    reading.sizes.insert(reading.sizes.end(), {size.x, size.y, size.z});
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
    std::map<std::uint32_t, Rectangle> visible;
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
            add_3d(placed.value(), thing, query, reading);
            continue;
        }
        const Rectangle box = camera.is_full() ? full_box(placed.value(), thing) : entry.second;
        reading.boxes.insert(reading.boxes.end(), {box.left, box.top, box.right, box.bottom});
    }
    return reading;
}

}  // namespace roboss
