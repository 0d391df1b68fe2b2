// Support functions of segments |n.g| and discs r sqrt(1 - (n.u)^2), and Newton's method for the largest gap:
// with the support point x(n), the gradient of s on the sphere is the tangential part of c - x(n), and minus
// its Hessian is the discs' curvature plus s times the identity (s is homogeneous of degree one).
#include "geometry/convex_sum.h"

#include <algorithm>

namespace roboss::narrow {
namespace {

constexpr double kNear = 0.02;  // sine of the angle within which a feature is tried
constexpr double kStep = 1e-6;  // rad
constexpr int kNewtonSteps = 12;

Vec3 radial_part(const Vec3& n, const Vec3& axis) {
    return n - axis * dot(n, axis);
}

}  // namespace

ConvexSum::ConvexSum(const Posed& first, const Posed& second) : centre_(first.X.p - second.X.p) {
    add(first);
    first_segments_ = segment_count_;
    first_discs_ = disc_count_;
    add(second);
}

void ConvexSum::add(const Posed& shape) {
    const Shape& s = shape.shape;
    double inradius = 0.0;
    if (s.kind == ShapeKind::kBox) {
        for (std::size_t i = 0; i < 3; ++i) {
            direction_[segment_count_] = shape.axis(i);
            half_[segment_count_++] = s.half[i];
        }
        inradius = std::min(s.half.x, std::min(s.half.y, s.half.z));
    } else {
        direction_[segment_count_] = shape.axis(2);
        half_[segment_count_++] = s.half_length;
    }
    if (s.kind == ShapeKind::kCylinder) {
        discs_[disc_count_++] = {shape.axis(2), s.radius};
        inradius = std::min(s.radius, s.half_length);
    }
    inradius_ = std::max(inradius_, inradius);
    scale_ = std::min(scale_, s.kind == ShapeKind::kCapsule ? s.radius : inradius);
}

double ConvexSum::reach(const Vec3& n) const {
    double h = 0.0;
    for (std::size_t i = 0; i < segment_count_; ++i) h += half_[i] * std::fabs(dot(n, direction_[i]));
    for (std::size_t i = 0; i < disc_count_; ++i)
        h += discs_[i].radius * norm(radial_part(n, discs_[i].axis));
    return h;
}

Vec3 ConvexSum::support(const Vec3& n) const {
    return touching(n).support;
}

Touching ConvexSum::touching(const Vec3& n) const {
    std::array<Vec3, 2> share;
    double h = 0.0;
    for (std::size_t i = 0; i < segment_count_; ++i) {
        const double along = dot(n, direction_[i]);
        h += half_[i] * std::fabs(along);
        share[i < first_segments_ ? 0 : 1] += direction_[i] * (along < 0.0 ? -half_[i] : half_[i]);
    }
    for (std::size_t i = 0; i < disc_count_; ++i) {
        const Vec3 radial = radial_part(n, discs_[i].axis);
        const double length = norm(radial);
        h += discs_[i].radius * length;
        if (length > 1e-12) share[i < first_discs_ ? 0 : 1] += radial * (discs_[i].radius / length);
    }
    return {{n, dot(n, centre_) - h}, share[0] + share[1], share[0]};
}

ConvexSum ConvexSum::moved(const Vec3& by) const {
    ConvexSum sum = *this;
    sum.centre_ += by;
    return sum;
}

double ConvexSum::rounding() const {
    return 2e-15 * (std::fabs(centre_.x) + std::fabs(centre_.y) + std::fabs(centre_.z) + inradius_);
}

Separation ConvexSum::best_natural(double enough) const {
    Separation best;
    const auto is_enough = [&](const Vec3& direction) {
        const double length = norm(direction);
        if (length < 1e-3) return false;
        const Vec3 n = direction * (dot(direction, centre_) < 0.0 ? -1.0 / length : 1.0 / length);
        const Separation found = separation(n);
        if (found.s > best.s) best = found;
        return best.s > enough;
    };
    for (std::size_t i = 0; i < segment_count_; ++i)
        if (is_enough(direction_[i])) return best;
    for (std::size_t i = 0; i < first_segments_; ++i)
        for (std::size_t j = first_segments_; j < segment_count_; ++j)
            if (is_enough(cross(direction_[i], direction_[j]))) return best;
    // From the point of a box that is closest to the other centre, or from centre to centre.
    Vec3 towards = centre_;
    if (first_segments_ == 3) {
        for (std::size_t i = 0; i < 3; ++i)
            towards -= direction_[i] * std::clamp(dot(centre_, direction_[i]), -half_[i], half_[i]);
        if (norm(towards) < 1e-12 * inradius_) towards = centre_;
    }
    const double distance = norm(towards);
    if (distance < 1e-12 * inradius_) return best;
    const Vec3 d = towards / distance;
    if (is_enough(d)) return best;
    for (std::size_t i = 0; i < segment_count_; ++i)
        if (is_enough(radial_part(d, direction_[i]))) return best;
    return best;
}

Separation ConvexSum::climb(const Vec3& start, const Vec3* edge) const {
    if (disc_count_ == 0) {  // overlapping polytopes: no curvature, no step
        const Separation there = separation(start);
        if (!(there.s > 0.0)) return there;
    }
    Touching best = touching(start);
    for (int step = 0; step < kNewtonSteps; ++step) {
        const Vec3& n = best.n;
        Vec3 t1, t2;
        if (edge != nullptr) {
            t1 = cross(*edge, n);
        } else {
            tangents(n, t1, t2);
        }
        const Vec3 gap = centre_ - best.support;
        const double s = best.s;
        const double g1 = dot(t1, gap), g2 = dot(t2, gap);
        double h11 = s, h22 = s, h12 = 0.0;
        for (std::size_t i = 0; i < disc_count_; ++i) {
            const Vec3 side = cross(discs_[i].axis, n);
            const double q_squared = norm_squared(side);
            if (q_squared < 1e-16) return best;
            const double curvature = discs_[i].radius / (q_squared * std::sqrt(q_squared));
            const double m1 = dot(t1, side), m2 = dot(t2, side);
            h11 += curvature * m1 * m1;
            h12 += curvature * m1 * m2;
            h22 += curvature * m2 * m2;
        }
        Vec3 move;
        if (edge != nullptr) {
            if (!(h11 > 0.0)) return best;
            move = t1 * (g1 / h11);
        } else {
            const double determinant = h11 * h22 - h12 * h12;
            if (!(h11 > 0.0 && determinant > 0.0)) return best;
            move = t1 * ((h22 * g1 - h12 * g2) / determinant) + t2 * ((h11 * g2 - h12 * g1) / determinant);
        }
        if (!(norm_squared(move) < 0.25)) return best;
        const Touching found = touching(normalized(n + move));
        if (!(found.s >= best.s - rounding())) return best;
        best = found;  // also when equal: the gap is flat at its maximum, the direction still improves
        if (norm_squared(move) < 1e-28) return best;
    }
    return best;
}

bool ConvexSum::rises(const Vec3& n, const Vec3& d) const {
    double smooth = dot(d, centre_), kinks = 0.0;
    for (std::size_t i = 0; i < segment_count_; ++i) {
        const double across = dot(n, direction_[i]), along = half_[i] * dot(d, direction_[i]);
        if (std::fabs(across) < 1e-9) {
            kinks += std::fabs(along);
        } else {
            smooth -= across < 0.0 ? -along : along;
        }
    }
    for (std::size_t i = 0; i < disc_count_; ++i) {
        const Vec3 radial = radial_part(n, discs_[i].axis);
        const double length = norm(radial);
        if (length < 1e-9) {
            kinks += discs_[i].radius * norm(radial_part(d, discs_[i].axis));
        } else {
            smooth -= discs_[i].radius * dot(d, radial) / length;
        }
    }
    return std::fabs(smooth) > kinks;
}

void ConvexSum::climb_beside(const Vec3& n, const Vec3& d, const Vec3* edge, Separation& best) const {
    if (!rises(n, d)) return;
    for (const double step : {-kStep, kStep}) best = better(best, climb(normalized(n + d * step), edge));
}

Separation ConvexSum::better(const Separation& best, const Separation& found) const {
    return found.s >= best.s - rounding() ? found : best;
}

std::size_t ConvexSum::edges_across(const Vec3& n, std::array<Vec3, 6>& edges) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < segment_count_; ++i)
        if (half_[i] > 0.0 && std::fabs(dot(n, direction_[i])) < kNear) edges[count++] = direction_[i];
    return count;
}

void ConvexSum::consider_flat(const Vec3& line, const Vec3& n, Separation& best) const {
    const double length = norm(line);
    if (length < 1e-3) return;
    const Vec3 flat = line * (dot(line, n) < 0.0 ? -1.0 / length : 1.0 / length);
    if (dot(flat, n) > 0.9) best = better(best, separation(flat));
}

Separation ConvexSum::at_kink(const Separation& start) const {
    std::array<Vec3, 6> edges;
    const std::size_t count = edges_across(start.n, edges);
    Separation best;
    if (count == 1) best = climb(normalized(radial_part(start.n, edges[0])), &edges[0]);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 1; j < count; ++j) consider_flat(cross(edges[i], edges[j]), start.n, best);
    for (std::size_t i = 0; i < disc_count_; ++i)
        if (norm(radial_part(start.n, discs_[i].axis)) < kNear) consider_flat(discs_[i].axis, start.n, best);
    return best;
}

Separation ConvexSum::polished(const Separation& start) const {
    // Flattest last, each accepted when it is at least as good to within rounding.
    const Vec3& n0 = start.n;
    Separation best = better(start, climb(n0, nullptr));
    std::array<Vec3, 6> edges;
    const std::size_t count = edges_across(n0, edges);
    // The gap has a kink where n is perpendicular to a segment: where it rises beside the kink, each side is
    // climbed.
    for (std::size_t i = 0; i < count; ++i) {
        climb_beside(normalized(radial_part(n0, edges[i])), edges[i], nullptr, best);
    }
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 n = normalized(radial_part(n0, edges[i]));
        best = better(best, climb(n, &edges[i]));
        if (count > 1) climb_beside(n, cross(edges[i], n), &edges[i], best);
    }
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 1; j < count; ++j) consider_flat(cross(edges[i], edges[j]), n0, best);
    for (std::size_t i = 0; i < disc_count_; ++i) {
        const Vec3& axis = discs_[i].axis;
        if (norm(radial_part(n0, axis)) >= kNear) continue;
        // A cap is a kink too; the gap rises beside it, if at all, towards the centre's place beyond the rim.
        const Vec3 n = dot(axis, n0) < 0.0 ? -axis : axis;
        const Vec3 aside = radial_part(centre_ - support(n), axis);
        const double length = norm(aside);
        if (length > discs_[i].radius) climb_beside(n, aside / length, nullptr, best);
        consider_flat(axis, n0, best);
    }
    return best;
}

}  // namespace roboss::narrow
