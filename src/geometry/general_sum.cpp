// Newton's method on the sphere for curved bodies, all combinations of flat features near the start for
// polytopes.
#include "geometry/general_sum.h"

#include <algorithm>

namespace roboss::narrow {
namespace {

constexpr int kNewtonSteps = 16;
constexpr int kRounds = 6;
constexpr double kBeside = 1e-6;  // rad

}  // namespace

GeneralSum::GeneralSum(const ConvexBody& first, const ConvexBody& second)
    : a_(&first), b_(&second), centre_(first.centre() - second.centre()) {}

double GeneralSum::rounding() const {
    return 2e-15 * (std::fabs(centre_.x) + std::fabs(centre_.y) + std::fabs(centre_.z) + inradius());
}

bool GeneralSum::newton_step(const Touching& at, const Vec3* edge, Vec3& move) const {
    if (!curved() && !(at.s > 0.0)) return false;
    const Vec3& n = at.n;
    Vec3 t1, t2;
    if (edge != nullptr) {
        t1 = cross(*edge, n);
    } else {
        tangents(n, t1, t2);
    }
    const Vec3 gap = centre_ - at.support;
    const double s = at.s, g1 = dot(t1, gap), g2 = dot(t2, gap);
    double h11 = s, h12 = 0.0, h22 = s;
    if (!a_->add_curvature(-n, t1, t2, h11, h12, h22) || !b_->add_curvature(n, t1, t2, h11, h12, h22))
        return false;
    if (edge != nullptr) {
        if (!(h11 > 0.0)) return false;
        move = t1 * (g1 / h11);
    } else {
        const double determinant = h11 * h22 - h12 * h12;
        if (!(h11 > 0.0 && determinant > 0.0)) return false;
        move = t1 * ((h22 * g1 - h12 * g2) / determinant) + t2 * ((h11 * g2 - h12 * g1) / determinant);
    }
    return norm_squared(move) < 1.0;
}

Separation GeneralSum::climb(const Vec3& start, const Vec3* edge) const {
    Touching best = touching(start);
    for (int step = 0; step < kNewtonSteps; ++step) {
        Vec3 move;
        if (!newton_step(best, edge, move)) return best;
        Touching found = touching(normalized(best.n + move));
        for (int half = 0; half < 6 && !(found.s >= best.s - rounding()); ++half) {
            move = move * 0.5;
            found = touching(normalized(best.n + move));
        }
        if (!(found.s >= best.s - rounding())) return best;
        best = found;  // also when equal: the gap is flat at its maximum, the direction still improves
        if (norm_squared(move) < 1e-28) return best;
    }
    return best;
}

Separation GeneralSum::polished(const Separation& start) const {
    Separation best = polished_once(start);
    // Curved against flat: another feature may come near as the direction settles.
    for (int round = 0; curved() && round < kRounds; ++round) {
        const Separation again = polished_once(best);
        const bool settled = !(again.s > best.s + rounding()) && norm_squared(again.n - best.n) < 1e-20;
        best = again;
        if (settled) break;
    }
    // A flat candidate may have won by rounding only, with a direction good to the root of it.
    return curved() ? better(best, climb(best.n, nullptr)) : best;
}

Separation GeneralSum::polished_once(const Separation& start) const {
    const Vec3& n0 = start.n;
    const double sine = curved() ? 0.1 : 0.02;
    Separation best = better(start, climb(n0, nullptr));
    const NearFeatures of_a = a_->near(-n0, sine), of_b = b_->near(n0, sine);
    const bool climbs = curved() || start.s > 0.0;  // else the gap is piecewise flat: only corners count
    for (const NearFeatures* side : {&of_a, &of_b}) {
        if (!climbs) break;
        for (const Vec3& e : side->edges) {
            const Vec3 n = normalized(n0 - e * dot(e, n0));
            if (curved()) {
                for (const double step : {-kBeside, kBeside})
                    best = better(best, climb(normalized(n + e * step), nullptr));
            }
            best = better(best, climb(n, &e));
        }
    }
    for (const Vec3& edge_a : of_a.edges) {
        for (const Vec3& edge_b : of_b.edges) {
            const Vec3 direction = cross(edge_a, edge_b);
            const double length = norm(direction);
            if (length < 1e-3) continue;
            const Vec3 n = direction * (dot(direction, n0) < 0.0 ? -1.0 / length : 1.0 / length);
            if (dot(n, n0) > 0.9) best = better(best, separation(n));
        }
    }
    for (const Vec3& normal : of_a.normals) best = better(best, separation(-normal));
    for (const Vec3& normal : of_b.normals) best = better(best, separation(normal));
    // Beside the face of a cylinder's cap the rim may be better still.
    if (curved()) best = better(climb(normalized(best.n + n0 * kBeside), nullptr), best);
    return best;
}

}  // namespace roboss::narrow
