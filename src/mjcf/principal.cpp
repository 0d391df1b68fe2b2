// Jacobi's method: each sweep turns away the three entries off the diagonal, one after the other.
#include "mjcf/principal.h"

#include <cmath>
#include <utility>

namespace roboss::mjcf {
namespace {

/// The turn in the plane of i and j that makes a(i, j) zero, applied to `a` and from the right to `v`.
void turn_away(Mat3& a, Mat3& v, std::size_t i, std::size_t j) {
    if (a(i, j) == 0) return;
    const double theta = (a(j, j) - a(i, i)) / (2.0 * a(i, j));
    const double t = (theta < 0 ? -1.0 : 1.0) / (std::fabs(theta) + std::sqrt(theta * theta + 1.0));
    const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
    Mat3 turn = Mat3::identity();
    turn(i, i) = c, turn(j, j) = c, turn(i, j) = s, turn(j, i) = -s;
    a = transpose(turn) * a * turn;
    v = v * turn;
}

}  // namespace

PrincipalAxes principal_axes(const Mat3& inertia) {
    constexpr int kSweeps = 30;
    Mat3 a = inertia, v = Mat3::identity();
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        turn_away(a, v, 0, 1), turn_away(a, v, 0, 2), turn_away(a, v, 1, 2);
        const double off = std::fabs(a(0, 1)) + std::fabs(a(0, 2)) + std::fabs(a(1, 2));
        if (off < 1e-18 * (std::fabs(a(0, 0)) + std::fabs(a(1, 1)) + std::fabs(a(2, 2)))) break;
    }
    std::array<std::size_t, 3> order{0, 1, 2};
    for (const auto& [first, second] : {std::pair{0, 1}, {1, 2}, {0, 1}}) {
        auto &x = order[static_cast<std::size_t>(first)], &y = order[static_cast<std::size_t>(second)];
        if (a(y, y) > a(x, x)) std::swap(x, y);
    }
    PrincipalAxes result;
    Mat3 sorted;
    for (std::size_t k = 0; k < 3; ++k) {
        result.moments[k] = a(order[k], order[k]);
        for (std::size_t i = 0; i < 3; ++i) sorted(i, k) = v(i, order[k]);
    }
    const double handed = dot(cross(transpose(sorted).r0, transpose(sorted).r1), transpose(sorted).r2);
    if (handed < 0)
        for (std::size_t i = 0; i < 3; ++i) sorted(i, 2) = -sorted(i, 2);
    result.q = to_quat(sorted);
    return result;
}

Mat3 from_principal(const Vec3& moments, const Quat& q) {
    const Mat3 R = to_matrix(q);
    return R * Mat3::diagonal(moments.x, moments.y, moments.z) * transpose(R);
}

}  // namespace roboss::mjcf
