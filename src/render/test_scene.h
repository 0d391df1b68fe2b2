// Small scenes without robots for the tests of cameras.
#pragma once

#include <memory>
#include <vector>

#include "core/noise.h"
#include "render/view.h"

namespace roboss::render_test {

inline SceneShape shape(SceneShapeKind kind, const Vec3& at) {
    SceneShape made;
    made.kind = kind;
    made.frame.p = at;
    return made;
}
inline SceneShape ball(const Vec3& at, double radius) {
    SceneShape made = shape(SceneShapeKind::kSphere, at);
    made.radius = radius;
    return made;
}
inline SceneShape box(const Vec3& at, const Vec3& size) {
    SceneShape made = shape(SceneShapeKind::kBox, at);
    made.size = size;
    return made;
}
inline SceneShape ground(double size) {
    SceneShape made = shape(SceneShapeKind::kPlane, {});
    made.size = {size, size, 0};
    return made;
}

/// All shapes of a scene that stands still, and a camera scene of it.
struct Room {
    explicit Room(Scene scene, unsigned threads = 1)
        : model(std::make_shared<const Model>()),
          world(
              std::make_shared<const render::VisualWorld>(scene, *model,
                                                          [](const PictureSpec&) -> Result<render::Picture> {
                                                              return Error{"none", ""};
                                                          })),
          cameras(model, world, threads) {
        cameras.update({});
    }
    std::shared_ptr<const Model> model;
    std::shared_ptr<const render::VisualWorld> world;
    CameraScene cameras;
};

inline Scene scene_of(std::vector<SceneShape> shapes) {
    Scene scene;
    scene.statics = std::move(shapes);
    return scene;
}

inline render::CameraView view(const Vec3& at, int width, int height, double fov) {
    CameraOptics optics;
    optics.width = width, optics.height = height, optics.horizontal_fov = fov;
    Transform X_WC;
    X_WC.p = at;
    return {X_WC, optics, {}};
}

/// Uniform numbers from a seed.
struct Dice {
    std::uint64_t seed;
    std::uint64_t next = 0;
    double roll(double low, double high) {
        return low + (high - low) * random_uniform({seed, 0, 0, 0}, next++);
    }
    Vec3 point(double reach) { return {roll(-reach, reach), roll(-reach, reach), roll(-reach, reach)}; }
};

/// A cloud of triangles about the origin.
inline SceneMesh cloud(std::uint64_t seed, std::size_t triangles) {
    Dice dice{seed};
    SceneMesh mesh;
    for (std::size_t i = 0; i < triangles; ++i) {
        const Vec3 corner = dice.point(2);
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (int k = 0; k < 3; ++k) mesh.vertices.push_back(corner + dice.point(0.4));
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

}  // namespace roboss::render_test
