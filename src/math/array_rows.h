// Vectors, twists and poses as rows of arrays of doubles: x y z; linear x y z, angular x y z; x y z and the
// quaternion x y z w.
#pragma once

#include "math/pose.h"

namespace roboss {

/// The three numbers of a row.
inline Vec3 vec3_at(const double* row) {
    return {row[0], row[1], row[2]};
}

/// The pose of a row of seven; its quaternion is normalised.
inline Pose pose_at(const double* row) {
    return {vec3_at(row), normalized(Quat{row[6], row[3], row[4], row[5]})};
}

/// Three numbers.
inline void put_row(const Vec3& v, double* row) {
    row[0] = v.x, row[1] = v.y, row[2] = v.z;
}
/// A twist, six numbers: m/s, rad/s.
inline void put_row(const Vec3& linear, const Vec3& angular, double* row) {
    put_row(linear, row), put_row(angular, row + 3);
}
/// A pose, seven numbers: m, quaternion.
inline void put_row(const Pose& X, double* row) {
    put_row(X.p, row);
    row[3] = X.q.x, row[4] = X.q.y, row[5] = X.q.z, row[6] = X.q.w;
}

}  // namespace roboss
