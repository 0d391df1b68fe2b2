// See seen_things.h.
#include "app/dataset/seen_things.h"

#include <algorithm>
#include <map>

#include "render/image_box.h"
#include "render/silhouette.h"
#include "sensors/labelled_things.h"

namespace roboss {
namespace {

/// Run lengths of the pixels of a thing, down the columns.
std::vector<std::uint32_t> run_lengths(const std::vector<std::uint32_t>& seen, std::uint32_t thing,
                                       const CameraOptics& optics) {
    std::vector<std::uint32_t> counts{0};
    bool inside = false;
    for (int u = 0; u < optics.width; ++u)
        for (int v = 0; v < optics.height; ++v) {
            const auto pixel = static_cast<std::size_t>(v) * static_cast<std::size_t>(optics.width) +
                               static_cast<std::size_t>(u);
            if ((seen[pixel] == thing) != inside) inside = !inside, counts.push_back(0);
            ++counts.back();
        }
    return counts;
}

/// The pixels of a thing.
struct Extent {
    int left = 0, top = 0, right = 0, bottom = 0;  // the last ones count
    std::int64_t area = 0;
};

/// By number of the thing.
std::map<std::uint32_t, Extent> extents_of(const std::vector<std::uint32_t>& seen, int width) {
    std::map<std::uint32_t, Extent> extents;
    for (std::size_t pixel = 0; pixel < seen.size(); ++pixel) {
        if (seen[pixel] == CameraScene::kNoThing) continue;
        const int u = static_cast<int>(pixel) % width, v = static_cast<int>(pixel) / width;
        Extent& extent = extents.try_emplace(seen[pixel], Extent{u, v, u, v}).first->second;
        extent.left = std::min(extent.left, u), extent.right = std::max(extent.right, u);
        extent.bottom = v;  // rows come from the top
        ++extent.area;
    }
    return extents;
}

}  // namespace

Result<std::vector<SeenThing>> seen_things(SensedStates& states, const CameraOptics& optics, RobotId robot,
                                           std::size_t sensor) {
    const SensorQuery query = states.query(robot, sensor, 0);
    const Result<PlacedCamera> camera = place_camera(optics, query);
    if (!camera) return camera.error();
    const CameraScene& scene = camera.value().scene;
    const std::vector<std::uint32_t> seen = things_seen(camera.value());
    std::vector<SeenThing> things;
    for (const auto& [number, extent] : extents_of(seen, optics.width)) {
        const CameraScene::Thing& one = scene.things()[number];
        const ThingBox box = box_of(camera.value(), one, query);
        SeenThing& thing = things.emplace_back();
        thing.label = one.label, thing.of_label = one.of_label;
        thing.name =
            one.robot ? states.model().robots[one.robot->index()].name : scene.shape(one.items.front()).model;
        thing.box = {extent.left, extent.top, extent.right - extent.left + 1, extent.bottom - extent.top + 1};
        thing.area = extent.area;
        thing.counts = run_lengths(seen, number, optics);
        const std::int64_t alone = silhouette(scene, camera.value().view, one.items).pixels;
        if (alone > 0) thing.visible = static_cast<double>(thing.area) / static_cast<double>(alone);
        thing.X_CB = box.X_CB, thing.size = box.size;
    }
    std::ranges::sort(things, {}, [](const SeenThing& t) { return std::pair(t.label, t.of_label); });
    return things;
}

double truncation(const SeenThing& thing, const CameraOptics& optics) {
    const Transform X_CB = to_transform(thing.X_CB);
    std::array<Vec3, 8> corners = render::corners_of({thing.size * -0.5, thing.size * 0.5});
    for (Vec3& corner : corners) corner = X_CB * corner;
    const render::ImageBox whole = image_of(render::Lens(optics), optics.near, corners);
    return whole.area() > 0 ? 1 - whole.cut(optics).area() / whole.area() : 0;
}

const CameraOptics* optics_of(const SensorSpec& sensor) {
    return std::visit(
        [](const auto& parameters) -> const CameraOptics* {
            if constexpr (requires { parameters.optics; })
                return &parameters.optics;
            else
                return nullptr;
        },
        sensor.parameters);
}

}  // namespace roboss
