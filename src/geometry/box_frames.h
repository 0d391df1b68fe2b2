// Boxes along the axes of two frames that are turned against each other: which of them may meet. For trees of
// boxes over the shapes of bodies.
#pragma once

#include <cmath>

#include "math/aabb.h"
#include "math/pose.h"

namespace roboss {

class BoxFrames {
  public:
    /// Frames A and B; boxes that are apart by no more than `margin` (m) meet.
    BoxFrames(const Transform& X_WA, const Transform& X_WB, double margin)
        : R_(transpose(X_WA.R) * X_WB.R),
          p_(transpose_times(X_WA.R, X_WB.p - X_WA.p)),
          margin_(margin + kRounding * (1.0 + norm(p_))) {
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) spread_(i, j) = std::fabs(R_(i, j));
    }

    /// False only if one of the six directions of their faces separates them.
    bool meet(const Aabb& a, const Aabb& b) const {
        const Vec3 half_a = (a.max - a.min) * 0.5, half_b = (b.max - b.min) * 0.5;
        const Vec3 d = p_ + R_ * b.centre() - a.centre();
        return !(beyond(d, half_a + spread_ * half_b) ||
                 beyond(transpose_times(R_, d), half_b + transpose_times(spread_, half_a)));
    }

  private:
    static constexpr double kRounding = 1e-9;
    bool beyond(const Vec3& d, const Vec3& reach) const {
        return std::fabs(d.x) > reach.x + margin_ || std::fabs(d.y) > reach.y + margin_ ||
               std::fabs(d.z) > reach.z + margin_;
    }

    Mat3 R_;         // R_AB
    Mat3 spread_{};  // its entries without their signs
    Vec3 p_;         // origin of B in A
    double margin_;
};

/// The box along the axes of A that holds a box along those of B.
template <class T>
AabbT<T> turned_box(const TransformT<T>& X_AB, const Aabb& box) {
    const Vec3 half = (box.max - box.min) * 0.5;
    const auto along = [&](const Vec3T<T>& row) {
        return magnitude(row.x) * T(half.x) + magnitude(row.y) * T(half.y) + magnitude(row.z) * T(half.z);
    };
    const Vec3T<T> centre = X_AB * broadcast<T>(box.centre());
    const Vec3T<T> reach{along(X_AB.R.r0), along(X_AB.R.r1), along(X_AB.R.r2)};
    return {centre - reach, centre + reach};
}

}  // namespace roboss
