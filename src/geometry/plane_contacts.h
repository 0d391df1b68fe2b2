// Half-space against sphere, box, cylinder and capsule, in closed form: the hot path of all that drives,
// walks and stands on the ground. Over T: one shape, or the same shape of a few robots in lanes, which vote
// on everything that decides how many points there are and what they are called.
#pragma once

#include <array>
#include <cstdint>

#include "core/lanes.h"
#include "geometry/shape.h"

namespace roboss {

template <class T>
struct PlanePoint {
    Vec3T<T> p_W;  // midway between the two surfaces
    T gap{};
    std::uint32_t feature = 0;
};

template <class T>
class PlaneContacts {
  public:
    /// A plane through p_W with outward normal n; points with a gap of more than `margin` are left out.
    PlaneContacts(const Vec3& p_W, const Vec3& n, const T& margin, Lockstep<T>& together)
        : p_(broadcast<T>(p_W)), n_(broadcast<T>(n)), margin_(margin), together_(together) {}

    /// False if it cannot tell: other shapes, a standing cylinder.
    bool add(const Shape& shape, const TransformT<T>& X_WS) {
        switch (shape.kind) {
            case ShapeKind::kSphere:
                return add_sphere(shape, X_WS);
            case ShapeKind::kBox:
                return add_box(shape, X_WS);
            case ShapeKind::kCylinder:
                return add_cylinder(shape, X_WS);
            case ShapeKind::kCapsule:
                return add_capsule(shape, X_WS);
            default:
                return false;
        }
    }

    std::size_t count() const { return count_; }
    const PlanePoint<T>& operator[](std::size_t i) const { return points_[i]; }

  private:
    void add_point(const Vec3T<T>& p_W, const T& gap, std::uint32_t feature) {
        if (together_(gap <= margin_)) points_[count_++] = {p_W - n_ * (0.5 * gap), gap, feature};
    }

    bool add_sphere(const Shape& sphere, const TransformT<T>& X) {
        const T r = sphere.radius;
        const T gap = dot(n_, X.p - p_) - r;
        add_point(X.p - n_ * r, gap, 0);
        return true;
    }

    /// The four corners of the face that looks most against the normal; the feature is the corner's number.
    bool add_box(const Shape& box, const TransformT<T>& X) {
        const Vec3T<T> along = transpose_times(X.R, n_);  // n in the box's frame
        const Vec3T<T> half = broadcast<T>(box.half);
        const T height = dot(n_, X.p - p_);
        const T ax = magnitude(along.x), ay = magnitude(along.y), az = magnitude(along.z);
        const Vec3T<T> reach{ax * half.x, ay * half.y, az * half.z};
        if (together_(height - (reach.x + reach.y + reach.z) > margin_)) return true;
        const std::size_t k = together_((az >= ax) & (az >= ay)) ? 2 : together_(ay >= ax) ? 1 : 0;
        const std::size_t i = k == 2 ? 0 : k + 1, j = k == 0 ? 2 : k - 1;
        const bool upper = together_(along[k] < T(0));  // the face at +half looks down
        const Vec3T<T> ei = X.R.col(i) * half[i], ej = X.R.col(j) * half[j];
        const Vec3T<T> centre = X.p + X.R.col(k) * (upper ? half[k] : -half[k]);
        const T gi = along[i] * half[i], gj = along[j] * half[j], g0 = height - reach[k];
        const auto face = static_cast<std::uint32_t>(upper) << k;
        for (std::uint32_t c = 0; c < 4; ++c) {
            const T si = (c & 1u) != 0 ? 1.0 : -1.0, sj = (c & 2u) != 0 ? 1.0 : -1.0;
            add_point(centre + (ei * si + ej * sj), g0 + (gi * si + gj * sj),
                      face | (c & 1u) << i | (c >> 1) << j);
        }
        return true;
    }

    /// Lying (axis within 45 degrees of the plane): the deepest point of each end, features 0 (at -z) and 1
    /// (at +z).
    bool add_cylinder(const Shape& cylinder, const TransformT<T>& X) {
        const Vec3T<T> u = X.R.col(2);
        const T r = cylinder.radius, l = cylinder.half_length;
        const T height = dot(n_, X.p - p_);
        const T rise = dot(n_, u);
        const Vec3T<T> down = u * rise - n_;
        const T length = norm(down);
        if (together_(height - l * magnitude(rise) - r * length > margin_)) return true;
        if (!together_(rise * rise <= T(0.5))) return false;
        const Vec3T<T> line = X.p + down * (r / length);
        const T g = height - r * length;
        add_point(line - u * l, g - l * rise, 0);
        add_point(line + u * l, g + l * rise, 1);
        return true;
    }

    /// The lowest points of the two end spheres, features 0 (at -z) and 1 (at +z).
    bool add_capsule(const Shape& capsule, const TransformT<T>& X) {
        const Vec3T<T> axis = X.R.col(2) * T(capsule.half_length);
        const T r = capsule.radius;
        const T gap = dot(n_, X.p - p_) - r, rise = dot(n_, axis);
        const Vec3T<T> low = X.p - n_ * r;
        add_point(low - axis, gap - rise, 0);
        add_point(low + axis, gap + rise, 1);
        return true;
    }

    Vec3T<T> p_, n_;
    T margin_;
    Lockstep<T>& together_;
    std::array<PlanePoint<T>, 4> points_;
    std::size_t count_ = 0;
};

}  // namespace roboss
