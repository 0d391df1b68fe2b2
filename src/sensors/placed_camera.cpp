// See placed_camera.h.
#include "sensors/placed_camera.h"

#include "physics/dynamics/kinematics.h"

namespace roboss {

Result<const CameraScene*> SensorSources::camera_scene() {
    return Error{
        "cameras render the visuals of a world, and only its Model, which contains none, is available here",
        "read cameras in Python, in `roboss sense`, or in a control program of `roboss run` or `roboss "
        "client`",
        "no-look"};
}

Result<PlacedCamera> place_camera(const CameraOptics& optics, const SensorQuery& query) {
    const Result<const CameraScene*> found = query.sources.camera_scene();
    if (!found) return found.error();
    const CameraScene& scene = *found.value();
    const SensorInfo& info = query.info();
    const Transform X_WL = link_pose(query.type(), query.state, info.link);
    return PlacedCamera{scene,
                        {X_WL * to_transform(info.spec.X_LS) * to_transform(optics.X_SC), optics,
                         scene.items_of(query.robot, info.link)}};
}

}  // namespace roboss
