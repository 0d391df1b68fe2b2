// See time_of_impact.h.
#include "geometry/time_of_impact.h"

#include <algorithm>
#include <limits>

#include "geometry/closest_direction.h"
#include "geometry/closest_point.h"
#include "geometry/collide_general.h"
#include "geometry/over_triangle.h"

namespace roboss {
namespace {

using namespace narrow;

constexpr int kStepsMax = 2000;
constexpr double kLeastAdvance = 2e-4;  // m: no step is shorter, what sinks in less deep may be missed
constexpr double kGlide = 2e-3;         // m: from touch to touch, where nothing sinks in
constexpr int kHalvings = 10;
constexpr int kParts = 16;            // of the tick, in which bodies are proven to stay apart
constexpr double kSameNormal = 0.98;  // cosine
constexpr double kSameSlope = 0.2, kSamePlane = 1e-4;  // m

bool is_held(const Manifold& m, std::span<const TouchedPlane> held, const Transform& X_WS) {
    const Vec3 n = X_WS.R * m.n_W, p = X_WS * m.points[0].p_W;
    return std::ranges::any_of(held, [&](const TouchedPlane& plane) {
        const Vec3 d = p - plane.p;
        return dot(n, plane.n) > kSameNormal &&
               std::fabs(dot(plane.n, d)) <= kSameSlope * norm(d) + kSamePlane;
    });
}

/// Upper bound of the speed at which the shapes approach each other along n between t and dt.
double closing_speed(const Course& a, const Course& b, const Vec3& n, double t, double dt) {
    const Vec3 va = a.velocity(a.at(t).p, t), vb = b.velocity(b.at(t).p, t);
    return -dot(n, va - vb) + a.most_turning(dt) + b.most_turning(dt) +
           0.5 * (a.bend(dt) + b.bend(dt)) * (dt - t);
}

/// Upper bound of the acceleration of a shape's points until dt.
double most_acceleration(const Course& c, double dt) {
    if (c.rests()) return 0;
    const double rate = norm(c.angular_rate) + norm(c.angular_curve) * dt;
    const double speed = norm(c.angular) + rate * dt;
    return c.bend(dt) + (speed * speed + rate) * bounding_radius(*c.shape);
}

/// A shape on its course.
struct Placed {
    Transform X;
    Posed posed;
    ConvexBody body;

    Placed(const Course& c, double t) : X(c.at(t)), posed{*c.shape, X}, body(posed) {}
    Placed(const Placed&) = delete;
    Placed& operator=(const Placed&) = delete;
    ~Placed() = default;
};

/// Looks for proof that two bodies stay apart, or do not sink into each other deeper than is allowed.
/// Spinning bodies come nearer by far less than closing_speed() must assume, so most pairs are proven at
/// once.
template <class SumAt>
class Apartness {
  public:
    /// `sum_at(t, act)` calls act(sum) with the bodies' sum at time t, and returns what that does.
    /// `balls`: their radii, less the depth that is allowed. `acceleration`: of a point of one body relative
    /// to the other, at most.
    Apartness(const SumAt& sum_at, double balls, double acceleration)
        : sum_at_(sum_at), balls_(balls), acceleration_(acceleration) {}

    /// Until dt, looked at in at most `parts` parts, a power of two. `start`: where the search for a
    /// direction that separates begins.
    bool is_proven(double dt, const Vec3& start, int parts) const {
        return sum_at_(0, [&](const GeneralSum& begin) {
            return sum_at_(
                dt, [&](const GeneralSum& end) { return is_proven(begin, end, 0, dt, {start}, parts); });
        });
    }

  private:
    static constexpr double kProven = 1.5 * kImpactGap;  // more than the rounding of a manifold's gaps

    /// From one time to another. The end first: bodies that meet overlap there.
    bool is_proven(const GeneralSum& begin, const GeneralSum& end, double from, double to,
                   const Separation& start, int parts) const {
        // A point is off the chord of its course by an eighth of its acceleration.
        const double enough = kProven + balls_ + acceleration_ * (to - from) * (to - from) / 8;
        const SweptSum sum(begin, end);
        Separation best = sum.touching(start.n);
        if (best.s <= enough) best = closest_apart(sum, best, enough, enough).best;
        if (best.s > enough || parts == 1) return best.s > enough;
        const double between = 0.5 * (from + to);
        return sum_at_(between, [&](const GeneralSum& middle) {
            return is_proven(middle, end, between, to, best, parts / 2) &&
                   is_proven(begin, middle, from, between, best, parts / 2);
        });
    }

    const SumAt& sum_at_;
    double balls_, acceleration_;
};

bool stay_apart(const Course& a, const Course& b, double dt, double deep, const Vec3& n, int parts) {
    if (a.shape->kind == ShapeKind::kPlane || b.shape->kind == ShapeKind::kPlane) return false;
    const auto sum_at = [&](double t, const auto& act) {
        const Placed there_a(a, t), there_b(b, t);
        return act(GeneralSum(there_a.body, there_b.body));
    };
    const double acceleration = most_acceleration(a, dt) + most_acceleration(b, dt);
    return Apartness(sum_at, ball_of(*a.shape) + ball_of(*b.shape) - deep, acceleration)
        .is_proven(dt, n, parts);
}

/// `find(t)` gives the manifold at time t; `m` is that of the beginning, with points. stays_apart(n) looks
/// for proof that nothing is met, beginning at n: it is far cheaper than the steps of a near miss.
template <class Find, class StaysApart>
std::optional<double> advance(const Course& a, const Course& b, double dt, double deep, Manifold& m,
                              const Find& find, const StaysApart& stays_apart) {
    if (m.count == 0 || closing_speed(a, b, m.n_W, 0, dt) * dt <= least_gap(m) + deep) return {};
    if (least_gap(m) > kImpactGap && stays_apart(m.n_W)) return {};
    double t = 0;
    for (int i = 0; i < kStepsMax && m.count > 0; ++i) {
        const double gap = least_gap(m), closing = closing_speed(a, b, m.n_W, t, dt);
        if (closing * (dt - t) <= gap + deep) return {};
        double step = (gap - 0.5 * kImpactGap) / closing;
        if (gap <= kImpactGap) {
            if (sinking(a, b, m, t, dt) > deep) return t;
            step = kGlide / closing;
        }
        const double next = std::min(t + std::max(step, kLeastAdvance / closing), dt);
        Manifold there = find(next);
        if (there.count > 0 && least_gap(there) < -kImpactGap && gap > kImpactGap) {
            // The least step went too far: the impact lies between.
            double low = t, high = next;
            for (int k = 0; k < kHalvings; ++k) {
                const double middle = 0.5 * (low + high);
                const Manifold between = find(middle);
                const bool apart = between.count == 0 || least_gap(between) > 0;
                (apart ? low : high) = middle;
                if (apart && between.count > 0) m = between;
            }
            if (sinking(a, b, m, low, dt) > deep) return low;
        }
        if (next >= dt) return {};
        t = next;
        m = there;
    }
    return {};
}

/// Conservative advancement against single triangles, all in the surface's frame.
class TriangleSweep {
  public:
    TriangleSweep(const Course& course, const TriangleSurface& surface, double dt, double deep, double margin)
        : course_(course),
          surface_(surface),
          dt_(dt),
          deep_(deep),
          margin_(margin),
          acceleration_(most_acceleration(course, dt)) {}

    /// `m` becomes the manifold of the impact.
    std::optional<double> impact(std::uint32_t number, Manifold& m) const {
        SurfaceFace triangle = surface_.face(number);
        const Posed posed{*course_.shape, course_.X};
        const ConvexBody body(posed);
        double height = dot(triangle.n, body.centre() - triangle.v[0]);
        if (height < 0) {
            if (surface_.sides() == SurfaceSides::kSolid || surface_.is_ground()) return {};
            triangle.n = -triangle.n, height = -height;
            std::swap(triangle.v[1], triangle.v[2]);
        }
        const Course still{};
        const double over = height - body.reach(-triangle.n) - body.ball();
        if (over > closing_speed(course_, still, triangle.n, 0, dt_) * dt_) return {};
        const Vec3 away = body.centre() - closest_point(triangle.v, body.centre());
        const double distance = norm(away);
        const Vec3 start = distance > 0 ? away / distance : triangle.n;
        const double beside = distance - body.reach(-start) - body.ball();
        if (beside > closing_speed(course_, still, start, 0, dt_) * dt_) return {};
        if (over <= kImpactGap && points_over(body, triangle.v, triangle.n).deepest() <= kImpactGap)
            return {};
        const ConvexBody sheet(triangle.v, triangle.n);
        const auto sum_at = [&](double t, const auto& act) {
            const Placed there(course_, t);
            return act(GeneralSum(there.body, sheet));
        };
        const Apartness apartness(sum_at, body.ball(), acceleration_);
        if (apartness.is_proven(dt_, start, 1)) return {};
        const auto find = [&](double t) { return manifold(triangle, sheet, course_.at(t)); };
        m = find(0);
        if (m.count == 0 || least_gap(m) <= kImpactGap) return {};
        const auto met = advance(course_, still, dt_, deep_, m, find,
                                 [&](const Vec3& n) { return apartness.is_proven(dt_, n, kParts); });
        return met && dot(m.n_W, triangle.n) >= 0 ? met : std::nullopt;
    }

  private:
    Manifold manifold(const SurfaceFace& face, const ConvexBody& sheet, const Transform& X) const {
        const Posed posed{*course_.shape, X};
        const ConvexBody body(posed);
        const double enough = margin_ + body.ball();
        const std::optional<Separation> plain = plain_separation(body, face, enough);
        const Separation best = plain ? *plain : best_separation(body, sheet, enough);
        Manifold m;
        if (best.s <= enough) write_general(body, sheet, best, margin_, m);
        return m;
    }

    const Course& course_;
    const TriangleSurface& surface_;
    double dt_, deep_, margin_, acceleration_;
};

}  // namespace

double least_gap(const Manifold& m) {
    double gap = std::numeric_limits<double>::infinity();
    for (int i = 0; i < m.count; ++i) gap = std::min(gap, m.points[static_cast<std::size_t>(i)].gap);
    return gap;
}

double sinking(const Course& a, const Course& b, const Manifold& m, double t, double dt) {
    double deepest = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < m.count; ++i) {
        const ContactPoint& p = m.points[static_cast<std::size_t>(i)];
        const double approach = -dot(m.n_W, a.velocity(p.p_W, t) - b.velocity(p.p_W, t));
        deepest = std::max(deepest, approach * (dt - t) - p.gap);
    }
    return deepest;
}

bool surely_pass(const Course& a, const Course& b, double dt, const Vec3& n, double deep) {
    return stay_apart(a, b, dt, deep, n, 1);
}

std::optional<double> time_of_impact(const Course& a, const Course& b, double dt, double deep, double margin,
                                     Manifold& m) {
    const auto find = [&](double t) { return collide(*a.shape, a.at(t), *b.shape, b.at(t), margin); };
    return advance(a, b, dt, deep, m, find,
                   [&](const Vec3& n) { return stay_apart(a, b, dt, deep, n, kParts); });
}

std::optional<double> time_of_impact(const Course& course, const TriangleSurface& surface,
                                     const Transform& X_WS, double dt, double deep, double margin,
                                     std::span<const TouchedPlane> held,
                                     std::vector<std::uint32_t>& triangles) {
    const Course local = course.seen_from(X_WS);
    surface.query(bounds(*course.shape, local.X).inflated(margin), triangles);
    const TriangleSweep sweep(local, surface, dt, deep, margin);
    std::optional<double> first;
    for (const std::uint32_t number : triangles) {
        Manifold m;
        const auto met = sweep.impact(number, m);
        if (met && (!first || *met < *first) && !is_held(m, held, X_WS)) first = met;
    }
    return first;
}

}  // namespace roboss
