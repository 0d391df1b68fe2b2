// The logical camera: frames of models in a frustum, as gazebosim/gz-sensors tests them.
#include <algorithm>
#include <cmath>
#include <string>

#include "core/fixed_math.h"
#include "sensors/readings.h"

namespace roboss {
namespace {

/// A frustum along x, with its tip at the origin.
struct Frustum {
    explicit Frustum(const LogicalCameraSpec& spec) : near(spec.near), far(spec.far) {
        const SinCos half = fixed_sincos(0.5 * spec.horizontal_fov);
        side = half.sin / half.cos;
        height = side / spec.aspect_ratio;
    }
    /// Its faces belong to it.
    bool contains(const Vec3& p) const {
        return p.x >= near && p.x <= far && std::fabs(p.y) <= side * p.x && std::fabs(p.z) <= height * p.x;
    }
    double near, far,          // m
        side = 0, height = 0;  // half the width and height at 1 m
};

/// Adds models to a reading.
struct FrustumImage {
    Transform X_SW;
    Frustum frustum;
    LogicalCameraReading reading{};

    void look_at(const std::string& name, double model, const Transform& X_WM) {
        const Transform X_SM = X_SW * X_WM;
        if (!frustum.contains(X_SM.p)) return;
        const Quat q = to_quat(X_SM.R);
        reading.names.push_back(name), reading.models.push_back(model);
        reading.positions.insert(reading.positions.end(), {X_SM.p.x, X_SM.p.y, X_SM.p.z});
        reading.orientations.insert(reading.orientations.end(), {q.w, q.x, q.y, q.z});
    }
};

/// Whether Gazebo would list it: not further parts of a model whose joints do not hold it together, nor the
/// message board.
bool is_model(const Robot& robot, const RobotType& type) {
    const bool is_board = std::ranges::any_of(type.onboard, [](const OnboardInfo& info) {
        return std::holds_alternative<MessageBoardSpec>(info.spec.parameters);
    });
    return !is_board && robot.name.find("::") == std::string::npos;
}

}  // namespace

Result<LogicalCameraReading> read(const LogicalCameraSpec& spec, const SensorQuery& query) {
    const Transform X_WS = sensor_pose(query);
    FrustumImage image{inverse(X_WS), Frustum(spec)};
    for (std::size_t i = 0; i < query.model.robots.size(); ++i) {
        const RobotId id(i);
        const Robot& robot = query.model.robots[i];
        const RobotType& type = query.model.type_of(id);
        if (!is_model(robot, type)) continue;
        const Transform X_WB = to_transform(base_pose(query.sources.state_of(id)));
        image.look_at(robot.name, static_cast<double>(id.value), X_WB * inverse(type.X_RB));
    }
    for (std::size_t i = 0; i < spec.scenery.size(); ++i) {
        if ((i + 1) * LogicalCameraSpec::kPoseSize > spec.scenery_poses.size()) break;
        const double* x = &spec.scenery_poses[i * LogicalCameraSpec::kPoseSize];
        image.look_at(spec.scenery[i], -1, to_transform(Pose{{x[0], x[1], x[2]}, {x[3], x[4], x[5], x[6]}}));
    }
    return std::move(image.reading);
}

}  // namespace roboss
