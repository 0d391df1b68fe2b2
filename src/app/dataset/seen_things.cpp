// See seen_things.h.
#include "app/dataset/seen_things.h"

#include <algorithm>
#include <map>
#include <optional>

#include "physics/dynamics/kinematics.h"
#include "render/lens.h"
#include "render/silhouette.h"
#include "sensors/placed_camera.h"

namespace roboss {
namespace {

/// Run lengths of the pixels for which `is_in(pixel)`, down the columns.
template <class IsIn>
std::vector<std::uint32_t> run_lengths(int rows, int columns, IsIn&& is_in) {
    std::vector<std::uint32_t> counts{0};
    bool inside = false;
    for (int u = 0; u < columns; ++u)
        for (int v = 0; v < rows; ++v) {
            if (is_in(static_cast<std::size_t>(v) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(u)) != inside)
                inside = !inside, counts.push_back(0);
            ++counts.back();
        }
    return counts;
}

/// The things of an image with their pixels, in the order of (label, number).
std::vector<SeenThing> masks_of(const SegmentationCameraReading& reading) {
    std::map<std::pair<int, int>, std::array<int, 4>> boxes;  // left, top, right, bottom
    std::map<std::pair<int, int>, std::int64_t> areas;
    const int rows = reading.labels.rows, columns = reading.labels.columns;
    for (int v = 0; v < rows; ++v)
        for (int u = 0; u < columns; ++u) {
            const auto pixel =
                static_cast<std::size_t>(v) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(u);
            if (reading.labels.samples[pixel] == 0) continue;
            const std::pair<int, int> key{reading.labels.samples[pixel], reading.instances.samples[pixel]};
            std::array<int, 4>& box = boxes.try_emplace(key, std::array{u, v, u, v}).first->second;
            box = {std::min(box[0], u), std::min(box[1], v), std::max(box[2], u), std::max(box[3], v)};
            ++areas[key];
        }
    std::vector<SeenThing> things;
    for (const auto& [key, box] : boxes) {
        SeenThing thing;
        thing.label = key.first, thing.of_label = key.second;
        thing.box = {box[0], box[1], box[2] - box[0] + 1, box[3] - box[1] + 1};
        thing.area = areas[key];
        const std::pair<int, int> wanted = key;
        thing.counts = run_lengths(rows, columns, [&](std::size_t pixel) {
            return reading.labels.samples[pixel] == wanted.first &&
                   reading.instances.samples[pixel] == wanted.second;
        });
        things.push_back(std::move(thing));
    }
    return things;
}

/// Corners of the box about the origin of its frame.
std::array<Vec3, 8> corners_of(const SeenThing& thing) {
    std::array<Vec3, 8> corners;
    const Transform X_CB = to_transform(thing.X_CB);
    for (unsigned k = 0; k < 8; ++k)
        corners[k] = X_CB * Vec3{((k & 1) != 0 ? 0.5 : -0.5) * thing.size.x,
                                 ((k & 2) != 0 ? 0.5 : -0.5) * thing.size.y,
                                 ((k & 4) != 0 ? 0.5 : -0.5) * thing.size.z};
    return corners;
}

/// Adds the boxes in space, which a box camera has in the same order.
Result<> add_boxes(const CameraOptics& optics, const SensorQuery& query,
                   const std::vector<SeenThing*>& things) {
    const Result<BoxCameraReading> space = roboss::read(BoxCameraSpec{optics, "3d"}, query);
    if (!space) return space.error();
    const BoxCameraReading& s = space.value();
    for (std::size_t i = 0; i < things.size() && i < s.labels.size(); ++i) {
        SeenThing& thing = *things[i];
        const double *p = &s.positions[3 * i], *q = &s.orientations[4 * i], *size = &s.sizes[3 * i];
        thing.X_CB = {{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
        thing.size = {size[0], size[1], size[2]};
    }
    return Ok{};
}

}  // namespace

Result<std::vector<SeenThing>> seen_things(SensedStates& states, const CameraOptics& optics, RobotId robot,
                                           std::size_t sensor) {
    const SensorQuery query = states.query(robot, sensor, 0);
    const Result<SegmentationCameraReading> labels =
        roboss::read(SegmentationCameraSpec{optics, "instance"}, query);
    if (!labels) return labels.error();
    const Result<PlacedCamera> camera = place_camera(optics, query);
    if (!camera) return camera.error();
    std::vector<SeenThing> things = masks_of(labels.value());
    const CameraScene& scene = camera.value().scene;
    std::vector<SeenThing*> in_order;  // in that of the scene, as box cameras have them
    for (const CameraScene::Thing& one : scene.things()) {
        const auto found = std::find_if(things.begin(), things.end(), [&](const SeenThing& thing) {
            return thing.label == one.label && thing.of_label == one.of_label;
        });
        if (found == things.end()) continue;
        found->name =
            one.robot ? states.model().robots[one.robot->index()].name : scene.shape(one.items.front()).model;
        const std::int64_t alone = silhouette(scene, camera.value().view, one.items).pixels;
        if (alone > 0) found->visible = static_cast<double>(found->area) / static_cast<double>(alone);
        in_order.push_back(&*found);
    }
    if (const Result<> added = add_boxes(optics, query, in_order); !added) return added.error();
    return things;
}

double truncation(const SeenThing& thing, const CameraOptics& optics) {
    const render::Lens lens(optics);
    std::optional<std::array<double, 4>> whole;
    const auto add = [&](const Vec3& p_C) {
        const auto at = lens.project(p_C);
        if (!at) return;
        if (!whole) whole = {at->first, at->second, at->first, at->second};
        std::array<double, 4>& w = *whole;
        w = {std::min(w[0], at->first), std::min(w[1], at->second), std::max(w[2], at->first),
             std::max(w[3], at->second)};
    };
    const std::array<Vec3, 8> corners = corners_of(thing);
    for (unsigned a = 0; a < 8; ++a) {
        if (corners[a].x >= optics.near) add(corners[a]);
        for (const unsigned bit : {1u, 2u, 4u}) {  // edges are cut at the near plane
            const Vec3 p = corners[a], q = corners[a | bit];
            if ((a & bit) == 0 && (p.x < optics.near) != (q.x < optics.near))
                add(p + (q - p) * ((optics.near - p.x) / (q.x - p.x)));
        }
    }
    if (!whole) return 0;
    const auto area = [](double left, double top, double right, double bottom) {
        return std::max(0.0, right - left) * std::max(0.0, bottom - top);
    };
    const std::array<double, 4>& w = *whole;
    const double all = area(w[0], w[1], w[2], w[3]);
    const double inside =
        area(std::max(w[0], 0.0), std::max(w[1], 0.0), std::min(w[2], static_cast<double>(optics.width)),
             std::min(w[3], static_cast<double>(optics.height)));
    return all > 0 ? 1 - inside / all : 0;
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

Transform sensor_frame(SensedStates& states, RobotId robot, std::size_t sensor) {
    const SensorQuery query = states.query(robot, sensor, 0);
    return link_pose(query.type(), query.state, query.info().link) * to_transform(query.info().spec.X_LS);
}

Transform camera_frame(SensedStates& states, const CameraOptics& optics, RobotId robot, std::size_t sensor) {
    return sensor_frame(states, robot, sensor) * to_transform(optics.X_SC);
}

}  // namespace roboss
