// See placed_camera.h.
#include "sensors/placed_camera.h"

namespace roboss {

Result<const CameraScene*> SensorSources::camera_scene() {
    return Error{
        "cameras render the visuals of a world, and only its Model, which contains none, is available here",
        "read cameras in Python, in `roboss sense`, or in a control program of `roboss run` or `roboss "
        "client`",
        "no-look"};
}

Transform camera_pose(const CameraOptics& optics, const SensorQuery& query) {
    return sensor_pose(query) * to_transform(optics.X_SC);
}

Result<PlacedCamera> place_camera(const CameraOptics& optics, const SensorQuery& query) {
    const Result<const CameraScene*> found = query.sources.camera_scene();
    if (!found) return found.error();
    const CameraScene& scene = *found.value();
    return PlacedCamera{scene,
                        {camera_pose(optics, query), optics, scene.items_of(query.robot, query.info().link)}};
}

}  // namespace roboss
