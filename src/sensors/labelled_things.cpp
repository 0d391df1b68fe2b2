// See labelled_things.h.
#include "sensors/labelled_things.h"

#include "render/image_box.h"

namespace roboss {
namespace {

Transform place_of(const render::TraceItem& item) {
    Transform X;
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) X.R(r, c) = item.R_WS[3 * r + c];
        X.p[r] = item.p_WS[r];
    }
    return X;
}

}  // namespace

std::vector<std::uint32_t> things_seen(const PlacedCamera& camera) {
    const CameraOptics& optics = camera.view.optics;
    std::vector<std::uint32_t> things;
    for (const render::Sighting& one : sight(camera.scene, camera.view, optics.near, optics.far))
        things.push_back(one.item == render::kNothing ? CameraScene::kNoThing
                                                      : camera.scene.thing_of(one.item));
    return things;
}

std::vector<Vec3> corners_of(const CameraScene& scene, const CameraScene::Thing& thing) {
    std::vector<Vec3> corners;
    for (const std::uint32_t number : thing.items) {
        const Transform X_WS = place_of(scene.item(number));
        for (const Vec3& corner :
             render::corners_of(render::box_of(scene.item(number), scene.world().meshes)))
            corners.push_back(X_WS * corner);
    }
    return corners;
}

ThingBox box_of(const PlacedCamera& camera, const CameraScene::Thing& thing, const SensorQuery& query) {
    Transform X_WB = place_of(camera.scene.item(thing.items.front()));
    if (thing.robot) X_WB = to_transform(base_pose(query.sources.state_of(*thing.robot)));
    if (thing.robot) X_WB = X_WB * inverse(query.model.type_of(*thing.robot).X_RB);
    const Transform X_BW = inverse(X_WB);
    Aabb box;
    for (const Vec3& corner : corners_of(camera.scene, thing)) box.include(X_BW * corner);
    const Transform X_CB = inverse(camera.view.X_WC) * X_WB;
    return {{X_CB * box.centre(), to_quat(X_CB.R)}, box.max - box.min};
}

}  // namespace roboss
