// The exact motion of a rigid body that no torque acts on: Jacobi's elliptic functions give the angular
// velocity, Gauss's quadrature of their closed expression the precession (Landau, Lifshitz, Mechanics,
// section 37). Principal axes are the body's own axes. In long double.
#pragma once

#include <array>
#include <cmath>

#include "math/vec3.h"

namespace roboss::test {

using Real = long double;
using RealVec3 = Vec3T<Real>;
using RealMat3 = Mat3T<Real>;

struct JacobiFunctions {
    Real sn = 0, cn = 1, dn = 1;
};

/// Of u with modulus k in [0, 1): descending Landen transformation (Abramowitz, Stegun, 16.4).
inline JacobiFunctions jacobi(Real u, Real k) {
    constexpr std::size_t kLevels = 12;
    std::array<Real, kLevels + 1> a{1}, c{k};
    Real b = std::sqrt(1 - k * k);
    for (std::size_t n = 0; n < kLevels; ++n) {
        a[n + 1] = (a[n] + b) / 2;
        c[n + 1] = (a[n] - b) / 2;
        b = std::sqrt(a[n] * b);
    }
    Real phi = std::ldexp(a[kLevels] * u, static_cast<int>(kLevels));
    for (std::size_t n = kLevels; n > 0; --n) phi = (phi + std::asin(c[n] / a[n] * std::sin(phi))) / 2;
    const Real sn = std::sin(phi);
    return {sn, std::cos(phi), std::sqrt(1 - k * k * sn * sn)};
}

class TumblingBody {
  public:
    /// Three different principal moments; orientation (columns: body axes in space) and angular velocity in
    /// body axes at time 0.
    TumblingBody(const RealVec3& moments, const RealMat3& R_SB, const RealVec3& angular_B) : R_SB_(R_SB) {
        const RealVec3 momentum_B{moments.x * angular_B.x, moments.y * angular_B.y, moments.z * angular_B.z};
        momentum_ = norm(momentum_B);
        const Real energy_twice = dot(momentum_B, angular_B);
        sort_axes(moments, energy_twice);
        const RealVec3 w = permuted(angular_B);
        const auto [ia, ib, ic] = moments_;
        const Real from_c = energy_twice * ic - momentum_ * momentum_,
                   from_a = momentum_ * momentum_ - energy_twice * ia;
        c_ = std::copysign(std::sqrt(from_a / (ic * (ic - ia))), w.z);
        rate_ = std::sqrt((ic - ib) * (ic - ia) / (ia * ib)) * std::fabs(c_);
        a_ = std::sqrt(from_c / (ia * (ic - ia)));
        b_ = (ic - ia) * c_ * a_ / (ib * rate_);
        modulus_ = std::sqrt((ib - ia) * from_c / ((ic - ib) * from_a));
        start_ = std::ellint_1(modulus_, std::atan2(w.y / b_, w.x / a_));
        const RealMat3 frame = momentum_frame(0);  // columns: the triad about the momentum, in body axes
        triad_S_ = R_SB * frame;
    }

    /// Angular velocity in body axes.
    RealVec3 angular_B(Real t) const { return restored(sorted_angular(t)); }

    /// Orientation; `t` must not go back from call to call (the precession is summed up).
    RealMat3 orientation(Real t) {
        constexpr Real kPanel = 0.02L;
        const auto panels = static_cast<int>((t - summed_until_) / kPanel) + 1;
        const Real width = (t - summed_until_) / static_cast<Real>(panels);
        for (int i = 0; i < panels; ++i)
            precession_ += precession(summed_until_ + static_cast<Real>(i) * width, width);
        summed_until_ = t;
        const Real s = std::sin(precession_), c = std::cos(precession_);
        const RealMat3 turn{{c, -s, 0}, {s, c, 0}, {0, 0, 1}};
        return triad_S_ * turn * transpose(momentum_frame(t));
    }

    /// Time between two turnings over.
    Real flip_time() const { return 2 * std::comp_ellint_1(modulus_) / rate_; }

  private:
    /// a, b, c right-handed with c the axis that the momentum circles.
    void sort_axes(const RealVec3& moments, Real energy_twice) {
        order_ = {0, 1, 2};
        for (std::size_t pass = 0; pass < 2; ++pass)
            for (std::size_t i = 0; i < 2; ++i)
                if (moments[order_[i]] > moments[order_[i + 1]]) std::swap(order_[i], order_[i + 1]);
        if (momentum_ * momentum_ < energy_twice * moments[order_[1]]) std::swap(order_[0], order_[2]);
        moments_ = {moments[order_[0]], moments[order_[1]], moments[order_[2]]};
        sign_ = (order_[1] + 3 - order_[0]) % 3 == 1 ? 1 : -1;
    }
    RealVec3 permuted(const RealVec3& v) const { return {v[order_[0]], sign_ * v[order_[1]], v[order_[2]]}; }
    RealVec3 restored(const RealVec3& v) const {
        RealVec3 out;
        out[order_[0]] = v.x, out[order_[1]] = sign_ * v.y, out[order_[2]] = v.z;
        return out;
    }
    RealVec3 sorted_angular(Real t) const {
        const JacobiFunctions f = jacobi(rate_ * t + start_, modulus_);
        return {a_ * f.cn, b_ * f.sn, c_ * f.dn};
    }
    /// Of the axis c about the momentum, rad/s.
    Real precession_rate(Real t) const {
        const RealVec3 w = sorted_angular(t);
        const Real x = moments_[0] * w.x, y = moments_[1] * w.y;
        return momentum_ * (x * w.x + y * w.y) / (x * x + y * y);
    }
    Real precession(Real from, Real width) const {
        constexpr std::array<Real, 4> kAt{0.1834346424956498049395L, 0.5255324099163289858177L,
                                          0.7966664774136267395916L, 0.9602898564975362316836L};
        constexpr std::array<Real, 4> kWeight{0.3626837833783619829652L, 0.3137066458778872873380L,
                                              0.2223810344533744705444L, 0.1012285362903762591525L};
        Real sum = 0;
        for (std::size_t i = 0; i < 4; ++i)
            for (const Real side : {-1.0L, 1.0L})
                sum += kWeight[i] * precession_rate(from + width * (1 + side * kAt[i]) / 2);
        return sum * width / 2;
    }
    /// Columns in body axes: x from the momentum towards the axis c, z along the momentum.
    RealMat3 momentum_frame(Real t) const {
        const RealVec3 w = sorted_angular(t);
        const RealVec3 along =
            restored({moments_[0] * w.x, moments_[1] * w.y, moments_[2] * w.z}) / momentum_;
        const RealVec3 axis = restored({0, 0, 1});
        const RealVec3 x = normalized(axis - along * dot(axis, along)), y = cross(along, x);
        return transpose(RealMat3{x, y, along});
    }

    RealMat3 R_SB_, triad_S_;
    std::array<std::size_t, 3> order_{};
    std::array<Real, 3> moments_{};
    Real sign_ = 1, momentum_ = 0;
    Real a_ = 0, b_ = 0, c_ = 0, rate_ = 0, modulus_ = 0, start_ = 0;
    Real precession_ = 0, summed_until_ = 0;
};

}  // namespace roboss::test
