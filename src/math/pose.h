// Poses: X_AB is the pose of frame B in frame A. `Pose` keeps a quaternion (compact, for storage and
// messages); `Transform` keeps the rotation matrix (fast, for computing).
#pragma once

#include "math/quat.h"
#include "math/vec3.h"

namespace roboss {

/// Position and orientation of frame B in frame A, with a quaternion.
struct Pose {
    Vec3 p;  ///< m, origin of B in A
    Quat q;  ///< unit, q_AB

    /// X_AC = X_AB * X_BC.
    friend Pose operator*(const Pose& X_AB, const Pose& X_BC) {
        return {X_AB.p + rotate(X_AB.q, X_BC.p), X_AB.q * X_BC.q};
    }
    /// p_A = X_AB * p_B.
    friend Vec3 operator*(const Pose& X_AB, const Vec3& p_B) { return X_AB.p + rotate(X_AB.q, p_B); }
    /// Compares all members.
    friend bool operator==(const Pose&, const Pose&) = default;
};

/// X_BA.
inline Pose inverse(const Pose& X_AB) {
    const Quat q_BA = conjugate(X_AB.q);
    return {-rotate(q_BA, X_AB.p), q_BA};
}

/// Position and orientation of frame B in frame A, with a rotation matrix.
template <class T>
struct TransformT {
    Mat3T<T> R = Mat3T<T>::identity();  ///< R_AB, orthonormal
    Vec3T<T> p;                         ///< m, origin of B in A

    /// X_AC = X_AB * X_BC.
    friend TransformT operator*(const TransformT& X_AB, const TransformT& X_BC) {
        return {X_AB.R * X_BC.R, X_AB.p + X_AB.R * X_BC.p};
    }
    /// p_A = X_AB * p_B.
    friend Vec3T<T> operator*(const TransformT& X_AB, const Vec3T<T>& p_B) { return X_AB.p + X_AB.R * p_B; }
};

using Transform = TransformT<double>;

/// The same transform in every lane.
template <class T>
TransformT<T> broadcast(const Transform& X) {
    return {broadcast<T>(X.R), broadcast<T>(X.p)};
}

/// The same pose with a matrix.
inline Transform to_transform(const Pose& X) {
    return {to_matrix(X.q), X.p};
}

/// The same pose with a quaternion.
inline Pose to_pose(const Transform& X) {
    return {X.p, to_quat(X.R)};
}

/// X_BA.
inline Transform inverse(const Transform& X_AB) {
    const Mat3 R_BA = transpose(X_AB.R);
    return {R_BA, -(R_BA * X_AB.p)};
}

/// Whether all seven numbers are finite.
inline bool is_finite(const Pose& X) {
    return is_finite(X.p) && std::isfinite(X.q.w) && std::isfinite(X.q.x) && std::isfinite(X.q.y) &&
           std::isfinite(X.q.z);
}

}  // namespace roboss
