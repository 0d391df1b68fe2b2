// The motion of a chain of links on hinges, the first on the world, nothing else acting than gravity: an
// independent reference for arms and pendulums. Products of exponentials about the joints' places at zero,
// dense Jacobians, Kane's projection, long double; shares no code and no algorithm with the kernel.
#pragma once

#include <vector>

#include <support/reference/extrapolation.h>

#include "math/pose.h"
#include "world/world.h"

namespace roboss::test {

class HingeChain {
  public:
    using Vector = Vec3T<Real>;
    using Matrix = Mat3T<Real>;

    /// Links and joints of `model` in order from the world; revolute and continuous joints only.
    HingeChain(const ModelSpec& model, const Vec3& gravity) : gravity_(widened(gravity)) {
        for (std::size_t i = 0; i < model.joints.size(); ++i) {
            const JointSpec& j = model.joints[i];
            const LinkSpec& l = model.links[i];
            const Matrix R = to_matrix(widened(l.X_ML.q));
            hinges_.push_back({widened(j.X_MJ.p),
                               normalized(rotate(widened(j.X_MJ.q), widened(j.axes[0].xyz))),
                               widened(l.X_ML.p) + R * widened(l.p_LC), static_cast<Real>(l.mass),
                               R * widened(l.inertia_C) * transpose(R)});
        }
    }
    std::size_t size() const { return hinges_.size(); }

    /// d/dt of (angles, rates).
    RealVector rate(const RealVector& y) const {
        const std::size_t n = size();
        RealVector out(y.begin() + static_cast<std::ptrdiff_t>(n), y.end());
        const RealVector acceleration = accelerations(y);
        out.insert(out.end(), acceleration.begin(), acceleration.end());
        return out;
    }
    void advance(Real duration, RealVector& y, Real step_max = 0.005L) const {
        extrapolate([this](const RealVector& at) { return rate(at); }, duration, step_max, y);
    }
    /// Where a point that is at `zero` in the model frame when all angles are 0 is now, as a point of `link`.
    Vector place(std::size_t link, const Vec3& zero, const RealVector& y) const {
        const Motion m = motion(y);
        return m.R[link] * widened(zero) + m.p[link];
    }

  private:
    struct Hinge {
        Vector place, axis, centre;  // all at zero, in the model frame
        Real mass;
        Matrix inertia;
    };
    struct Motion {
        std::vector<Matrix> R;  // of link i from its place at zero: x -> R x + p
        std::vector<Vector> p, axis, hinge, centre;
    };

    static Vector widened(const Vec3& v) { return {v.x, v.y, v.z}; }
    static QuatT<Real> widened(const Quat& q) { return normalized(QuatT<Real>{q.w, q.x, q.y, q.z}); }
    static Matrix widened(const Mat3& m) { return {widened(m.r0), widened(m.r1), widened(m.r2)}; }

    static Matrix rotation(const Vector& axis, Real angle) {
        const Real s = std::sin(angle / 2);
        return to_matrix(QuatT<Real>{std::cos(angle / 2), axis.x * s, axis.y * s, axis.z * s});
    }

    Motion motion(const RealVector& y) const {
        Motion m;
        Matrix R = Matrix::identity();
        Vector p;
        for (std::size_t i = 0; i < size(); ++i) {
            const Hinge& h = hinges_[i];
            m.axis.push_back(R * h.axis);
            m.hinge.push_back(R * h.place + p);
            R = R * rotation(h.axis, y[i]);
            p = m.hinge.back() - R * h.place;
            m.R.push_back(R);
            m.p.push_back(p);
            m.centre.push_back(R * h.centre + p);
        }
        return m;
    }

    RealVector accelerations(const RealVector& y) const {
        const std::size_t n = size();
        const Motion m = motion(y);
        std::vector<RealVector> mass(n, RealVector(n));
        RealVector force(n);
        Vector w, alpha, acceleration, before;  // of the link walked to, and of its hinge
        for (std::size_t i = 0; i < n; ++i) {
            const Vector step = m.hinge[i] - before;
            acceleration += cross(alpha, step) + cross(w, cross(w, step));
            before = m.hinge[i];
            const Vector turn = m.axis[i] * y[n + i];
            alpha += cross(w, turn);
            w += turn;
            const Vector arm = m.centre[i] - m.hinge[i];
            const Vector centre = acceleration + cross(alpha, arm) + cross(w, cross(w, arm));
            const Matrix inertia = m.R[i] * hinges_[i].inertia * transpose(m.R[i]);
            const Vector pull = (gravity_ - centre) * hinges_[i].mass;
            const Vector torque = -(inertia * alpha + cross(w, inertia * w));
            for (std::size_t a = 0; a <= i; ++a) {
                const Vector va = cross(m.axis[a], m.centre[i] - m.hinge[a]);
                force[a] += dot(va, pull) + dot(m.axis[a], torque);
                for (std::size_t b = 0; b <= i; ++b)
                    mass[a][b] += hinges_[i].mass * dot(va, cross(m.axis[b], m.centre[i] - m.hinge[b])) +
                                  dot(m.axis[a], inertia * m.axis[b]);
            }
        }
        return solved(std::move(mass), std::move(force));
    }

    /// Gauss without pivots: the matrix is positive definite.
    static RealVector solved(std::vector<RealVector> a, RealVector x) {
        const std::size_t n = x.size();
        for (std::size_t k = 0; k < n; ++k)
            for (std::size_t i = k + 1; i < n; ++i) {
                const Real factor = a[i][k] / a[k][k];
                for (std::size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
                x[i] -= factor * x[k];
            }
        for (std::size_t k = n; k-- > 0;) {
            for (std::size_t j = k + 1; j < n; ++j) x[k] -= a[k][j] * x[j];
            x[k] /= a[k][k];
        }
        return x;
    }

    Vector gravity_;
    std::vector<Hinge> hinges_;
};

}  // namespace roboss::test
