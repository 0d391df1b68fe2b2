// See imu_frame.h.
#include "sensors/imu_frame.h"

#include "physics/dynamics/kinematics.h"
#include "sensors/geodesy.h"

namespace roboss {
namespace {

/// Columns: x, y and z of the frame.
Mat3 with_columns(const Vec3& x, const Vec3& y, const Vec3& z) {
    return transpose(Mat3{x, y, z});
}

/// East, north and up at the world's origin, in the world.
Mat3 east_north_up_W(const Model& model) {
    if (!model.spherical) return Mat3::identity();
    const SphericalCoordinates& origin = *model.spherical;
    return transpose(world_to_earth(origin)) * east_north_up(origin.latitude_rad, origin.longitude_rad);
}

/// A frame by its name in SDF, as it stands at the start of the world.
Result<Mat3> named_frame(const std::string& name, const SensorQuery& query) {
    if (name == "world") return Mat3::identity();
    const RobotState start = initial_state(query.model, query.robot);
    if (name.empty())
        return link_pose(query.type(), start, query.info().link).R * to_transform(query.info().spec.X_LS).R;
    std::optional<LinkId> link = query.type().find_link(name);
    const std::size_t scope = name.find("::");
    if (!link && scope != std::string::npos) link = query.type().find_link(name.substr(scope + 2));
    if (link) return link_pose(query.type(), start, *link).R;
    return Error{"the orientation of IMU '" + query.info().spec.name + "' refers to the link '" + name +
                     "', which its robot does not have",
                 "write the name of a link of the same robot, or world, as <... parent_frame>"};
}

/// z along `up`, x along the level part of `ahead`; both in the world.
Result<Mat3> upright(const Vec3& up, const Vec3& ahead, const SensorQuery& query) {
    constexpr double kLeast = 1e-9;  // of the lengths
    const double length = norm(up);
    const Vec3 z = length > 0 ? up / length : Vec3{};
    const Vec3 level = ahead - z * dot(ahead, z);
    if (length > 0 && norm(level) > kLeast * norm(ahead)) {
        const Vec3 x = normalized(level);
        return with_columns(x, cross(z, x), z);
    }
    return Error{"the <grav_dir_x> of IMU '" + query.info().spec.name +
                     "' is along gravity, or there is no gravity: it gives no direction",
                 "write a direction that is not along gravity, or another <localization>"};
}

}  // namespace

Result<Mat3> reference_frame_of(const ImuSpec& imu, const SensorQuery& query) {
    const Mat3 enu = east_north_up_W(query.model);
    const Vec3 east = enu.col(0), north = enu.col(1), up = enu.col(2);
    if (imu.localization == "ENU") return enu;
    if (imu.localization == "NED") return with_columns(north, east, -up);
    if (imu.localization == "NWU") return with_columns(north, -east, up);
    const bool custom = imu.localization == "CUSTOM";
    const Result<Mat3> parent = named_frame(custom ? imu.custom_rpy_frame : imu.gravity_x_frame, query);
    if (!parent) return parent.error();
    if (custom) {
        const Vec3& rpy = imu.custom_rpy;
        return parent.value() * to_matrix(from_rpy(rpy.x, rpy.y, rpy.z));
    }
    const Vec3 down = gravity_of(query.model, type_of(query.type(), query.state));
    return upright(imu.localization == "GRAV_UP" ? -down : down, parent.value() * imu.gravity_x, query);
}

}  // namespace roboss
