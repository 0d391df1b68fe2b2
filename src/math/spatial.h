// Spatial vectors (Featherstone, Rigid Body Dynamics Algorithms, 2008) in world axes about one common
// reference point O, so that the links of a robot add up without transforms: a motion is (angular, linear
// velocity of the body point at O), a force is (moment about O, force).
#pragma once

#include "math/vec3.h"

namespace roboss {

/// A motion (rad/s, m/s) or a force (N m, N).
template <class T>
struct SpatialT {
    Vec3T<T> angular,  ///< angular velocity, or moment about O
        linear;        ///< velocity at O, or force

    /// Sum.
    friend SpatialT operator+(const SpatialT& a, const SpatialT& b) {
        return {a.angular + b.angular, a.linear + b.linear};
    }
    /// Difference.
    friend SpatialT operator-(const SpatialT& a, const SpatialT& b) {
        return {a.angular - b.angular, a.linear - b.linear};
    }
    /// Both parts times s.
    friend SpatialT operator*(const SpatialT& a, T s) { return {a.angular * s, a.linear * s}; }
    /// Adds b.
    SpatialT& operator+=(const SpatialT& b) { return angular += b.angular, linear += b.linear, *this; }
};

/// Power of a force on a motion.
template <class T>
T dot(const SpatialT<T>& a, const SpatialT<T>& b) {
    return dot(a.angular, b.angular) + dot(a.linear, b.linear);
}

/// Rate of change of motion b carried along by motion a.
template <class T>
SpatialT<T> cross_motion(const SpatialT<T>& a, const SpatialT<T>& b) {
    return {cross(a.angular, b.angular), cross(a.angular, b.linear) + cross(a.linear, b.angular)};
}

/// Rate of change of force f carried along by motion a.
template <class T>
SpatialT<T> cross_force(const SpatialT<T>& a, const SpatialT<T>& f) {
    return {cross(a.angular, f.angular) + cross(a.linear, f.linear), cross(a.angular, f.linear)};
}

/// Symmetric 3x3 matrix.
template <class T>
struct Sym3T {
    T xx{},    ///< row 0, column 0
        yy{},  ///< row 1, column 1
        zz{},  ///< row 2, column 2
        xy{},  ///< row 0, column 1
        xz{},  ///< row 0, column 2
        yz{};  ///< row 1, column 2

    /// Adds b.
    Sym3T& operator+=(const Sym3T& b) {
        return xx += b.xx, yy += b.yy, zz += b.zz, xy += b.xy, xz += b.xz, yz += b.yz, *this;
    }
    /// Matrix times vector.
    friend Vec3T<T> operator*(const Sym3T& m, const Vec3T<T>& v) {
        return {m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
                m.xz * v.x + m.yz * v.y + m.zz * v.z};
    }
};

/// R * inertia * R^T, upper triangle only.
template <class T>
Sym3T<T> rotated(const Mat3T<T>& R, const Mat3T<T>& inertia) {
    const Vec3T<T> a = inertia * R.r0, b = inertia * R.r1, c = inertia * R.r2;  // inertia is symmetric
    return {dot(R.r0, a), dot(R.r1, b), dot(R.r2, c), dot(R.r0, b), dot(R.r0, c), dot(R.r1, c)};
}

/// R * diag(inertia) * R^T
template <class T>
[[gnu::always_inline]] inline Sym3T<T> rotated_diagonal(const Mat3T<T>& R, const Vec3T<T>& inertia) {
    const auto scaled = [&](const Vec3T<T>& row) {
        return Vec3T<T>{inertia.x * row.x, inertia.y * row.y, inertia.z * row.z};
    };
    const Vec3T<T> a = scaled(R.r0), b = scaled(R.r1), c = scaled(R.r2);
    return {dot(R.r0, a), dot(R.r1, b), dot(R.r2, c), dot(R.r0, b), dot(R.r0, c), dot(R.r1, c)};
}

/// Inertia about O of everything rigid so far: mass, first moment (mass times centre), second moment.
template <class T>
struct SpatialInertiaT {
    T mass{};          ///< kg
    Vec3T<T> moment;   ///< kg m, mass * centre of mass, from O
    Sym3T<T> inertia;  ///< kg m^2, about O

    /// Adds another rigid body's, about the same O.
    SpatialInertiaT& operator+=(const SpatialInertiaT& b) {
        return mass += b.mass, moment += b.moment, inertia += b.inertia, *this;
    }
    /// Momentum of motion v.
    friend SpatialT<T> operator*(const SpatialInertiaT& I, const SpatialT<T>& v) {
        return {I.inertia * v.angular + cross(I.moment, v.linear),
                v.linear * I.mass + cross(v.angular, I.moment)};
    }
};

/// From mass, centre (from O) and inertia about the centre: parallel-axis theorem.
template <class T>
SpatialInertiaT<T> spatial_inertia(T mass, const Vec3T<T>& centre, const Sym3T<T>& about_centre) {
    SpatialInertiaT<T> I{mass, centre * mass, about_centre};
    const Vec3T<T>& m = I.moment;
    const T x = m.x * centre.x, y = m.y * centre.y, z = m.z * centre.z;
    I.inertia.xx += y + z, I.inertia.yy += x + z, I.inertia.zz += x + y;
    I.inertia.xy = I.inertia.xy - m.x * centre.y;
    I.inertia.xz = I.inertia.xz - m.x * centre.z;
    I.inertia.yz = I.inertia.yz - m.y * centre.z;
    return I;
}

using Spatial = SpatialT<double>;
using Sym3 = Sym3T<double>;
using SpatialInertia = SpatialInertiaT<double>;

}  // namespace roboss
