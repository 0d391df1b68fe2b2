// Three-vectors and 3x3 matrices over a number T (double, or lanes: core/lanes.h). Fixed order of
// operations: a sum of three is always (x + y) + z, so the bits are the same for every compiler and every
// instruction set.
#pragma once

#include <cmath>
#include <cstddef>

#include "core/lanes.h"

namespace roboss {

/// Vector of three numbers; a new one is zero.
template <class T>
struct Vec3T {
    T x{},    ///< first
        y{},  ///< second
        z{};  ///< third

    /// Component i: 0, 1 or 2.
    T& operator[](std::size_t i) { return i == 0 ? x : i == 1 ? y : z; }
    /// Component i: 0, 1 or 2.
    const T& operator[](std::size_t i) const { return i == 0 ? x : i == 1 ? y : z; }
    /// Adds b.
    Vec3T& operator+=(const Vec3T& b) { return x += b.x, y += b.y, z += b.z, *this; }
    /// Subtracts b.
    Vec3T& operator-=(const Vec3T& b) { return x -= b.x, y -= b.y, z -= b.z, *this; }
    /// Sum.
    friend Vec3T operator+(const Vec3T& a, const Vec3T& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    /// Difference.
    friend Vec3T operator-(const Vec3T& a, const Vec3T& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    /// Opposite.
    friend Vec3T operator-(const Vec3T& a) { return {-a.x, -a.y, -a.z}; }
    /// Scaled by s.
    friend Vec3T operator*(const Vec3T& a, T s) { return {a.x * s, a.y * s, a.z * s}; }
    /// Scaled by s.
    friend Vec3T operator*(T s, const Vec3T& a) { return {a.x * s, a.y * s, a.z * s}; }
    /// Divided by s.
    friend Vec3T operator/(const Vec3T& a, T s) { return {a.x / s, a.y / s, a.z / s}; }
    /// Compares all members.
    friend bool operator==(const Vec3T&, const Vec3T&) = default;
};

/// Scalar product.
template <class T>
T dot(const Vec3T<T>& a, const Vec3T<T>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Vector product.
template <class T>
Vec3T<T> cross(const Vec3T<T>& a, const Vec3T<T>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Square of the length.
template <class T>
T norm_squared(const Vec3T<T>& a) {
    return dot(a, a);
}

/// Length.
template <class T>
T norm(const Vec3T<T>& a) {
    using std::sqrt;
    return sqrt(dot(a, a));
}

/// Unit vector along a; a must not be zero.
template <class T>
Vec3T<T> normalized(const Vec3T<T>& a) {
    return a / norm(a);
}

/// Row-major 3x3 matrix.
template <class T>
struct Mat3T {
    Vec3T<T> r0{},  ///< row 0
        r1{},       ///< row 1
        r2{};       ///< row 2

    /// Ones on the diagonal.
    static Mat3T identity() { return {{T(1), T(0), T(0)}, {T(0), T(1), T(0)}, {T(0), T(0), T(1)}}; }
    /// a, b, c on the diagonal.
    static Mat3T diagonal(T a, T b, T c) { return {{a, T(0), T(0)}, {T(0), b, T(0)}, {T(0), T(0), c}}; }

    /// Row i: 0, 1 or 2.
    Vec3T<T>& row(std::size_t i) { return i == 0 ? r0 : i == 1 ? r1 : r2; }
    /// Row i: 0, 1 or 2.
    const Vec3T<T>& row(std::size_t i) const { return i == 0 ? r0 : i == 1 ? r1 : r2; }
    /// Row i, column j.
    T& operator()(std::size_t i, std::size_t j) { return row(i)[j]; }
    /// Row i, column j.
    const T& operator()(std::size_t i, std::size_t j) const { return row(i)[j]; }
    /// Column j: 0, 1 or 2.
    Vec3T<T> col(std::size_t j) const { return {r0[j], r1[j], r2[j]}; }

    /// Matrix times vector.
    friend Vec3T<T> operator*(const Mat3T& m, const Vec3T<T>& v) {
        return {dot(m.r0, v), dot(m.r1, v), dot(m.r2, v)};
    }
    /// Sum.
    friend Mat3T operator+(const Mat3T& a, const Mat3T& b) { return {a.r0 + b.r0, a.r1 + b.r1, a.r2 + b.r2}; }
    /// Difference.
    friend Mat3T operator-(const Mat3T& a, const Mat3T& b) { return {a.r0 - b.r0, a.r1 - b.r1, a.r2 - b.r2}; }
    /// Scaled by s.
    friend Mat3T operator*(const Mat3T& a, T s) { return {a.r0 * s, a.r1 * s, a.r2 * s}; }
    /// Matrix product.
    friend Mat3T operator*(const Mat3T& a, const Mat3T& b) {
        const Vec3T<T> c0 = b.col(0), c1 = b.col(1), c2 = b.col(2);
        return {{dot(a.r0, c0), dot(a.r0, c1), dot(a.r0, c2)},
                {dot(a.r1, c0), dot(a.r1, c1), dot(a.r1, c2)},
                {dot(a.r2, c0), dot(a.r2, c1), dot(a.r2, c2)}};
    }
};

/// Transposed matrix; the inverse of a rotation.
template <class T>
Mat3T<T> transpose(const Mat3T<T>& m) {
    return {m.col(0), m.col(1), m.col(2)};
}

/// transpose(m) * v
template <class T>
Vec3T<T> transpose_times(const Mat3T<T>& m, const Vec3T<T>& v) {
    return {m.r0.x * v.x + m.r1.x * v.y + m.r2.x * v.z, m.r0.y * v.x + m.r1.y * v.y + m.r2.y * v.z,
            m.r0.z * v.x + m.r1.z * v.y + m.r2.z * v.z};
}

/// Vector of doubles.
using Vec3 = Vec3T<double>;
/// Matrix of doubles.
using Mat3 = Mat3T<double>;

/// A constant that serves all lanes; for T = double itself.
template <class T>
Vec3T<T> broadcast(const Vec3& v) {
    return {T(v.x), T(v.y), T(v.z)};
}
template <class T>
Mat3T<T> broadcast(const Mat3& m) {
    return {broadcast<T>(m.r0), broadcast<T>(m.r1), broadcast<T>(m.r2)};
}

/// Two unit vectors that complete n to a right-handed frame (Duff et al., "Building an Orthonormal Basis,
/// Revisited", 2017).
template <class T>
void tangents(const Vec3T<T>& n, Vec3T<T>& t1, Vec3T<T>& t2) {
    const T sign = select(n.z >= T(0), T(1), T(-1));
    const T a = T(-1) / (sign + n.z);
    const T b = n.x * n.y * a;
    t1 = {T(1) + sign * n.x * n.x * a, sign * b, -sign * n.x};
    t2 = {b, sign + n.y * n.y * a, -n.y};
}

/// Whether all three numbers are finite.
inline bool is_finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace roboss
