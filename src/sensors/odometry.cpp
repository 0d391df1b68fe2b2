// Where a model is and how it moves.
#include "core/fixed_math.h"
#include "physics/dynamics/kinematics.h"
#include "sensors/readings.h"
#include "sensors/sensor_noise.h"

namespace roboss {
namespace {

/// The frame that is observed.
struct Observed {
    Pose X_WO;
    Twist twist;  // at O, world axes
};

Observed observe(const OdometrySpec& spec, const SensorQuery& query) {
    const SensorInfo& info = query.info();
    const Pose X_WL = to_pose(link_pose(query.type(), query.state, info.link));
    const Twist of_link = link_twist(query.type(), query.state, info.link);
    const Pose X_WS = X_WL * info.spec.X_LS;
    const Quat turn = from_rpy(spec.rpy_offset.x, spec.rpy_offset.y, spec.rpy_offset.z);
    Observed o{X_WS * Pose{spec.xyz_offset, turn}, of_link};
    if (spec.world_axes) o.X_WO = {X_WS.p + spec.xyz_offset, turn * X_WS.q};
    const Vec3 moved_with = spec.world_axes ? X_WS.p : o.X_WO.p;
    o.twist.linear = of_link.linear + cross(of_link.angular, moved_with - X_WL.p);
    return o;
}

/// With this heading about z.
Quat heading_of(const Quat& q) {
    const double yaw = fixed_atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z));
    return from_rpy(0, 0, yaw);
}

Vec3 noisy(const Vec3& v, double stddev, const SensorQuery& query, std::uint64_t first) {
    if (stddev == 0) return v;
    NoiseSpec noise;
    noise.stddev = stddev;
    return {noisy_value(v.x, noise, query, first, first),
            noisy_value(v.y, noise, query, first + 1, first + 1),
            noisy_value(v.z, noise, query, first + 2, first + 2)};
}

}  // namespace

Result<OdometryReading> read(const OdometrySpec& spec, const SensorQuery& query) {
    const Observed o = observe(spec, query);
    OdometryReading reading;
    reading.position_W = o.X_WO.p, reading.orientation_W = o.X_WO.q;
    Quat axes = spec.world_axes ? Quat{} : conjugate(o.X_WO.q);
    if (spec.dimensions == 2) axes = conjugate(heading_of(o.X_WO.q)), reading.position_W.z = 0;
    reading.linear_velocity = noisy(rotate(axes, o.twist.linear), spec.gaussian_noise, query, 0);
    reading.angular_velocity = noisy(rotate(axes, o.twist.angular), spec.gaussian_noise, query, 3);
    if (spec.dimensions == 2)
        reading.linear_velocity.z = reading.angular_velocity.x = reading.angular_velocity.y = 0;
    return reading;
}

Result<LinkPosesReading> read(const LinkPosesSpec& spec, const SensorQuery& query) {
    const SensorInfo& info = query.info();
    const Pose X_WM = to_pose(link_pose(query.type(), query.state, info.link)) * info.spec.X_LS;
    LinkPosesReading reading;
    const auto add = [&](const Pose& X) {
        reading.positions.insert(reading.positions.end(), {X.p.x, X.p.y, X.p.z});
        reading.orientations.insert(reading.orientations.end(), {X.q.w, X.q.x, X.q.y, X.q.z});
    };
    if (spec.publish_model_pose || spec.publish_nested_model_pose) add(X_WM);
    if (!spec.publish_link_pose) return reading;
    const Transform X_MW = inverse(to_transform(X_WM));
    for (std::size_t l = 0; l < query.type().links.size(); ++l)
        add(to_pose(X_MW * link_pose(query.type(), query.state, LinkId(l))));
    return reading;
}

}  // namespace roboss
