// See orientation.h.
#include "mjcf/orientation.h"

#include <cctype>
#include <cmath>

namespace roboss::mjcf {
namespace {

constexpr const char* kOrientations[] = {"quat", "axisangle", "xyaxes", "zaxis", "euler"};
constexpr double kLeastLength = 1e-10;  // of a direction's length

Quat from_xy_axes(const Attributes& attributes) {
    double v[6];
    if (!attributes.numbers("xyaxes", v)) return {};
    const Vec3 x{v[0], v[1], v[2]}, y{v[3], v[4], v[5]};
    if (norm(x) < kLeastLength || norm(cross(x, y)) < kLeastLength) {
        attributes.bad_value("xyaxes", "two directions that are not parallel");
        return {};
    }
    const Vec3 ux = x / norm(x);
    const Vec3 across = y - ux * dot(ux, y);
    const Vec3 uy = across / norm(across), uz = cross(ux, uy);
    return to_quat(transpose(Mat3{ux, uy, uz}));
}

Quat from_axis_angle(const Attributes& attributes, const Settings& settings) {
    double v[4];
    if (!attributes.numbers("axisangle", v)) return {};
    const Vec3 axis{v[0], v[1], v[2]};
    if (norm(axis) < kLeastLength) {
        attributes.bad_value("axisangle", "an axis with a length, and an angle");
        return {};
    }
    return axis_angle(axis / norm(axis), v[3] * settings.angle_unit);
}

Quat from_quat(const Attributes& attributes) {
    double v[4];
    if (!attributes.numbers("quat", v)) return {};
    const Quat q{v[0], v[1], v[2], v[3]};
    if (q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z < kLeastLength) {
        attributes.bad_value("quat", "four numbers, w first, that are not all 0");
        return {};
    }
    return normalized(q);
}

}  // namespace

Quat from_euler(const Vec3& angles, const std::string& sequence) {
    Quat q;
    for (std::size_t k = 0; k < 3; ++k) {
        const int letter = std::tolower(static_cast<unsigned char>(sequence[k]));
        Vec3 axis;
        axis[static_cast<std::size_t>(letter - 'x')] = 1;
        const Quat turn = axis_angle(axis, angles[k]);
        q = letter == sequence[k] ? q * turn : turn * q;
    }
    return normalized(q);
}

Quat from_z(const Vec3& direction) {
    const Vec3 z = direction / norm(direction);
    const Vec3 axis = cross(Vec3{0, 0, 1}, z);
    const double sine = norm(axis);
    if (sine < kLeastLength) return z.z > 0 ? Quat{} : Quat{0, 1, 0, 0};
    return axis_angle(axis / sine, fixed_atan2(sine, z.z));
}

Quat read_orientation(const Attributes& attributes, const Settings& settings) {
    const Element owner = attributes.owner(kOrientations);
    if (!owner) return {};
    const char* found = nullptr;
    for (const char* name : kOrientations) {
        if (!owner.node.attribute(name)) continue;
        if (found != nullptr)
            attributes.diagnostics().error(
                owner.where(), "two-orientations",
                "<" + std::string(owner.node.name()) + "> has both " + found + " and " + name,
                "Write one of them.");
        found = name;
    }
    const std::string name = found;
    if (name == "quat") return from_quat(attributes);
    if (name == "axisangle") return from_axis_angle(attributes, settings);
    if (name == "xyaxes") return from_xy_axes(attributes);
    if (name == "euler")
        return from_euler(attributes.vector("euler", {}) * settings.angle_unit, settings.euler_sequence);
    const Vec3 z = attributes.vector("zaxis", {0, 0, 1});
    if (norm(z) >= kLeastLength) return from_z(z);
    attributes.bad_value("zaxis", "a direction");
    return {};
}

Pose read_pose(const Attributes& attributes, const Settings& settings) {
    return {attributes.vector("pos", {}), read_orientation(attributes, settings)};
}

}  // namespace roboss::mjcf
