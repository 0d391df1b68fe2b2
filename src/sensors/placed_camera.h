// A camera in the scene that it renders: what all kinds of cameras begin their readings with.
#pragma once

#include "render/view.h"
#include "sensors/sensor_query.h"

namespace roboss {

struct PlacedCamera {
    const CameraScene& scene;
    render::CameraView view;
};

/// The camera's frame in the world.
Transform camera_pose(const CameraOptics& optics, const SensorQuery& query);

/// The camera where the query has its robot. An Error, "no-look": there are no visuals.
Result<PlacedCamera> place_camera(const CameraOptics& optics, const SensorQuery& query);

/// Sets the numbers of the lens, which other programs know as camera_info.
template <class Reading>
void add_info(const CameraOptics& optics, Reading& reading) {
    const render::Lens lens(optics);
    reading.intrinsics = {lens.fx(), lens.fy(), lens.cx(), lens.cy()};
    reading.distortion = {optics.k1, optics.k2, optics.p1, optics.p2, optics.k3};
}

}  // namespace roboss
