// Unit quaternions (w, x, y, z), Hamilton product; q_AB turns vectors given in B into A: v_A = rotate(q_AB,
// v_B).
#pragma once

#include <cmath>

#include "core/fixed_math.h"
#include "math/vec3.h"

namespace roboss {

/// Quaternion w + xi + yj + zk; a new one is the identity. Rotations are unit quaternions.
template <class T>
struct QuatT {
    T w{1},   ///< real part
        x{},  ///< of i
        y{},  ///< of j
        z{};  ///< of k

    /// Hamilton product: q_AC = q_AB * q_BC.
    friend QuatT operator*(const QuatT& a, const QuatT& b) {
        return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
    }
    /// Compares all members.
    friend bool operator==(const QuatT&, const QuatT&) = default;
};

/// Inverse of a unit quaternion: q_BA from q_AB.
template <class T>
QuatT<T> conjugate(const QuatT<T>& q) {
    return {q.w, -q.x, -q.y, -q.z};
}

/// Unit quaternion; q must not be zero.
template <class T>
QuatT<T> normalized(const QuatT<T>& q) {
    using std::sqrt;
    const T s = T(1) / sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return {q.w * s, q.x * s, q.y * s, q.z * s};
}

/// v_A = rotate(q_AB, v_B); q is a unit quaternion.
template <class T>
Vec3T<T> rotate(const QuatT<T>& q, const Vec3T<T>& v) {
    const Vec3T<T> u{q.x, q.y, q.z};
    const Vec3T<T> t = cross(u, v) * T(2);
    return v + t * q.w + cross(u, t);
}

/// R_AB of the unit quaternion q_AB.
template <class T>
Mat3T<T> to_matrix(const QuatT<T>& q) {
    const T xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
    const T xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
    const T wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
    const T one(1), two(2);
    return {{one - two * (yy + zz), two * (xy - wz), two * (xz + wy)},
            {two * (xy + wz), one - two * (xx + zz), two * (yz - wx)},
            {two * (xz - wy), two * (yz + wx), one - two * (xx + yy)}};
}

using Quat = QuatT<double>;

/// Rotation by `angle` about the unit vector `axis`.
template <class T>
QuatT<T> axis_angle(const Vec3T<T>& axis, const T& angle) {
    const SinCosT<T> h = fixed_sincos(0.5 * angle);
    return {h.cos, axis.x * h.sin, axis.y * h.sin, axis.z * h.sin};
}

/// By lane: a where m holds, else b.
template <class T>
QuatT<T> select(const MaskOf<T>& m, const QuatT<T>& a, const QuatT<T>& b) {
    return {select(m, a.w, b.w), select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}

/// Rotation by the vector `rotation` (axis times angle).
template <class T>
QuatT<T> exponential(const Vec3T<T>& rotation) {
    const T angle = norm(rotation);
    return either(
        angle < T(1e-9),
        [&] {
            return normalized(QuatT<T>{T(1), 0.5 * rotation.x, 0.5 * rotation.y, 0.5 * rotation.z});
        },
        [&] { return axis_angle(rotation / angle, angle); });
}

/// The rotation vector (axis times angle, angle in [0, pi]) of a unit quaternion.
inline Vec3 logarithm(const Quat& q) {
    const double sign = q.w < 0.0 ? -1.0 : 1.0;
    const Vec3 u = Vec3{q.x, q.y, q.z} * sign;
    const double s = norm(u);
    if (s < 1e-12) return u * 2.0;
    return u * (2.0 * fixed_atan2(s, q.w * sign) / s);
}

/// Roll-pitch-yaw (rotations about fixed x, then y, then z), as in SDF and URDF.
inline Quat from_rpy(double roll, double pitch, double yaw) {
    return axis_angle({0, 0, 1}, yaw) * axis_angle({0, 1, 0}, pitch) * axis_angle({1, 0, 0}, roll);
}

/// Unit quaternion of a rotation matrix (Shepperd's method: divides by the largest component).
inline Quat to_quat(const Mat3& m) {
    const double trace = m(0, 0) + m(1, 1) + m(2, 2);
    Quat q;
    if (trace > 0.0) {
        q = {1.0 + trace, m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)};
    } else if (m(0, 0) >= m(1, 1) && m(0, 0) >= m(2, 2)) {
        q = {m(2, 1) - m(1, 2), 1.0 + m(0, 0) - m(1, 1) - m(2, 2), m(0, 1) + m(1, 0), m(0, 2) + m(2, 0)};
    } else if (m(1, 1) >= m(2, 2)) {
        q = {m(0, 2) - m(2, 0), m(0, 1) + m(1, 0), 1.0 + m(1, 1) - m(0, 0) - m(2, 2), m(1, 2) + m(2, 1)};
    } else {
        q = {m(1, 0) - m(0, 1), m(0, 2) + m(2, 0), m(1, 2) + m(2, 1), 1.0 + m(2, 2) - m(0, 0) - m(1, 1)};
    }
    return normalized(q);
}

}  // namespace roboss
