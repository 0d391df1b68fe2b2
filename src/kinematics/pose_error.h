// The error of a tool's pose, and how it changes with the tool's motion.
#pragma once

#include <array>

#include "core/fixed_math.h"
#include "kinematics/inverse_kinematics.h"
#include "math/spatial.h"

namespace roboss {

using SixNumbers = std::array<double, 6>;

/// The error is the displacement (m) and the rotation vector e (rad) that lead from the tool to its target,
/// weighted.
class PoseError {
  public:
    PoseError(const Pose& target, const InverseKinematicsOptions& options)
        : target_(to_transform(target)), weights_(options.weights) {
        turn_ = options.axes == FrameAxes::kTool ? transpose(target_.R) : Mat3::identity();
    }

    void set(const Transform& X_WT) {
        const Vec3 rotation = logarithm(to_quat(target_.R * transpose(X_WT.R)));
        displacement_ = turn_ * (target_.p - X_WT.p), rotation_ = turn_ * rotation;
        // d log(R exp(d)) = J^-1 d, J the right Jacobian of SO(3) (Chirikjian 2012, section 10.8.6)
        const double angle = norm(rotation), half = 0.5 * angle;
        const SinCos h = fixed_sincos(half);
        const double share =
            angle < 1e-4 ? 1.0 / 12 + angle * angle / 720 : (1 - half * h.cos / h.sin) / (angle * angle);
        const auto column = [&](const Vec3& d) {
            const Vec3 turned = cross(rotation, d);
            return d + turned * 0.5 + cross(rotation, turned) * share;
        };
        const Vec3 x = column({1, 0, 0}), y = column({0, 1, 0}), z = column({0, 0, 1});
        to_rotation_ = turn_ * transpose(Mat3{x, y, z});
    }

    SixNumbers weighted() const { return weigh(displacement_, rotation_); }
    /// What a motion of the tool (its origin's linear velocity) takes off the weighted error, to first order.
    SixNumbers reduction(const Spatial& motion) const {
        return weigh(turn_ * motion.linear, to_rotation_ * motion.angular);
    }
    double position() const { return norm(chosen(displacement_, 0)); }
    double orientation() const { return norm(chosen(rotation_, 3)); }

  private:
    SixNumbers weigh(const Vec3& linear, const Vec3& angular) const {
        return {weights_[0] * linear.x,  weights_[1] * linear.y,  weights_[2] * linear.z,
                weights_[3] * angular.x, weights_[4] * angular.y, weights_[5] * angular.z};
    }
    Vec3 chosen(Vec3 error, std::size_t first) const {
        for (std::size_t i = 0; i < 3; ++i)
            if (weights_[first + i] == 0) error[i] = 0;
        return error;
    }

    Transform target_;
    std::array<double, 6> weights_;
    Mat3 turn_, to_rotation_;  // world axes to those of the weights
    Vec3 displacement_, rotation_;
};

/// Solves (A + damping) x = b for a symmetric positive semidefinite A (Cholesky).
inline SixNumbers solve_damped(std::array<SixNumbers, 6> A, double damping, SixNumbers b) {
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = A[i][j] + (i == j ? damping : 0.0);
            for (std::size_t k = 0; k < j; ++k) sum -= A[i][k] * A[j][k];
            A[i][j] = i == j ? std::sqrt(std::max(sum, 1e-300)) : sum / A[j][j];
        }
        for (std::size_t k = 0; k < i; ++k) b[i] -= A[i][k] * b[k];
        b[i] /= A[i][i];
    }
    for (std::size_t i = 6; i-- > 0;) {
        for (std::size_t k = i + 1; k < 6; ++k) b[i] -= A[k][i] * b[k];
        b[i] /= A[i][i];
    }
    return b;
}

}  // namespace roboss
