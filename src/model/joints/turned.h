// A rotation matrix turned about an axis of its own frame.
#pragma once

#include "core/fixed_math.h"
#include "math/spatial.h"

namespace roboss {

/// R turned by `angle` about `axis`; about a coordinate axis, as joints mostly are, two columns are mixed.
template <class T>
Mat3T<T> turned(const Mat3T<T>& R, const Vec3& axis, const T& angle) {
    using Row = Vec3T<T>;
    const auto mix = [&](T Row::*component_a, T Row::*component_b, double sign) {
        const SinCosT<T> turn = fixed_sincos(angle);
        const T s = T(sign) * turn.sin, c = turn.cos;
        Mat3T<T> result = R;
        for (std::size_t i = 0; i < 3; ++i) {
            Row& row = result.row(i);
            const T a = row.*component_a, b = row.*component_b;
            row.*component_a = c * a + s * b, row.*component_b = c * b - s * a;
        }
        return result;
    };
    if (axis.y == 0 && axis.z == 0) return mix(&Row::y, &Row::z, axis.x);
    if (axis.x == 0 && axis.z == 0) return mix(&Row::z, &Row::x, axis.y);
    if (axis.x == 0 && axis.y == 0) return mix(&Row::x, &Row::y, axis.z);
    return R * to_matrix(axis_angle(broadcast<T>(axis), angle));
}

}  // namespace roboss
