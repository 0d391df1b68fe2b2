// Along the arc d = n + t (n' - n) between two normals the separation s(d) = d . w - h(-d) has the derivative
// (a x d) . x, but for a positive factor: a = n x n' is along the edge, w goes from the edge to the body's
// centre, and x to the point of the body that is furthest along -d. Both normals separate T and the body from
// above, so s has one maximum in between. Where the body has an edge or a rim across d, x jumps: such t are
// tried first.
#include "geometry/ridge_direction.h"

#include <cmath>

namespace roboss::narrow {
namespace {

constexpr double kWide = -0.5;  // cosine between two normals: wider is left to the general search

/// The gap along a ridge, as a function of t.
class Arc {
  public:
    Arc(const ConvexBody& body, const Vec3& corner, const Vec3& n, const Vec3& beyond)
        : body_(body), w_(body.centre() - corner), n_(n), change_(beyond - n), axis_(cross(n, beyond)) {}

    Vec3 direction(double t) const { return n_ + change_ * t; }
    Vec3 touched(const Vec3& d) const { return w_ + body_.support(-d); }
    double slope(double t) const { return slope(direction(t), touched(direction(t))); }

    struct Top {
        Vec3 d;  // of the largest separation
        Vec3 x;  // where the body meets the ridge then
    };
    /// Where the slope changes its sign from + to -: it does between 0 and 1.
    Top top() const {
        Bracket bracket{0, 1, slope(0), slope(1)};
        for (const Vec3& edge : body_.kinks()) {
            const double first = dot(n_, edge), change = dot(change_, edge), t = -first / change;
            if (!(t > bracket.low + kBeside && t < bracket.high - kBeside)) continue;
            const double before = slope(t - kBeside), after = slope(t + kBeside);
            if (before > 0 && after <= 0) return at_jump(t, before, after);
            if (before > 0)
                bracket.low = t + kBeside, bracket.at_low = after;
            else
                bracket.high = t - kBeside, bracket.at_high = before;
        }
        const Vec3 d = direction(bracket.at_high >= 0  ? bracket.high
                                 : bracket.at_low <= 0 ? bracket.low
                                                       : root(bracket));
        return {d, touched(d)};
    }

  private:
    static constexpr double kBeside = 1e-9, kFine = 1e-12;

    struct Bracket {
        double low = 0, high = 1, at_low = 0, at_high = 0;
    };

    double slope(const Vec3& d, const Vec3& x) const { return dot(cross(axis_, d), x); }

    /// An edge of the body lies across the ridge: where they cross the slope is zero.
    Top at_jump(double t, double before, double after) const {
        const Vec3 first = touched(direction(t - kBeside)), last = touched(direction(t + kBeside));
        return {direction(t), first + (last - first) * (before / (before - after))};
    }

    /// Dowell and Jarratt, "A modified regula falsi method for computing the root of an equation", 1971
    /// (Illinois).
    double root(Bracket b) const {
        constexpr int kSteps = 60;
        double t = b.low;
        for (int i = 0, side = 0; i < kSteps && b.high - b.low > kFine; ++i) {
            const double last = t;
            t = b.low + (b.high - b.low) * (b.at_low / (b.at_low - b.at_high));
            const double at = slope(t);
            if (at == 0 || std::fabs(t - last) < kFine) break;
            if (at > 0) {
                b.low = t, b.at_low = at;
                if (side == 1) b.at_high *= 0.5;
                side = 1;
            } else {
                b.high = t, b.at_high = at;
                if (side == -1) b.at_low *= 0.5;
                side = -1;
            }
        }
        return t;
    }

    const ConvexBody& body_;
    Vec3 w_, n_, change_, axis_;
};

/// True if x, from the beginning of an edge, is beside the edge itself.
bool is_along(const Vec3& edge, const Vec3& x) {
    const double along = dot(edge, x);
    return along >= 0 && along <= norm_squared(edge);
}

Vec3 edge_of(const SurfaceTriangle& t, std::size_t k) {
    return t.v[(k + 1) % 3] - t.v[k];
}

Vec3 normal_beyond(const SurfaceTriangle& t, std::size_t k) {
    return normalized(cross(t.beyond[k] - t.v[k], edge_of(t, k)));
}

/// The body's lowest point is beyond edge k.
RidgeDirection across_ridge(const ConvexBody& body, const SurfaceTriangle& t, std::size_t k, double enough) {
    const Vec3 beyond = normal_beyond(t, k), edge = edge_of(t, k);
    if (dot(t.n, beyond) < kWide) return {};
    const Arc arc(body, t.v[k], t.n, beyond);
    if (arc.slope(1) >= 0) {
        const Vec3 x = arc.touched(beyond);
        return {is_along(edge, x) ? Across::kNeighbour : Across::kUnknown, {beyond, dot(beyond, x)}};
    }
    if (body.is_hull()) return {};
    const Arc::Top top = arc.top();
    const Vec3 d = normalized(top.d);
    const double s = dot(d, top.x);
    if (s > enough) return {Across::kApart, {d, s}};
    return {is_along(edge, top.x) ? Across::kRidge : Across::kUnknown, {d, s}};
}

RidgeDirection across_edge(const ConvexBody& body, const SurfaceTriangle& t, std::size_t k,
                           const Vec3& lowest, double enough) {
    if (t.fold[k] == SurfaceTriangle::kBorder) return {};
    if (t.fold[k] < kRidgeFold) return across_ridge(body, t, k, enough);
    const Vec3 x = lowest - t.v[k];
    return {is_along(edge_of(t, k), x) ? Across::kNeighbour : Across::kUnknown, {t.n, dot(t.n, x)}};
}

}  // namespace

RidgeDirection ridge_direction(const ConvexBody& body, const SurfaceTriangle& t, double enough) {
    for (std::size_t k = 0; k < 3; ++k) {  // the plane of a neighbour behind a ridge is above the triangle
        if (t.fold[k] >= kRidgeFold || t.fold[k] == SurfaceTriangle::kBorder) continue;
        const Vec3 d = normal_beyond(t, k);
        const double s = dot(d, body.centre() - t.v[k]) - body.reach(-d);
        if (s > enough) return {Across::kApart, {d, s}};
    }
    const Vec3 lowest = body.centre() + body.support(-t.n);
    RidgeDirection found;
    for (std::size_t k = 0; k < 3; ++k) {
        if (dot(cross(t.n, edge_of(t, k)), lowest - t.v[k]) >= 0) continue;
        const RidgeDirection at_edge = across_edge(body, t, k, lowest, enough);
        if (at_edge.across == Across::kApart || at_edge.across == Across::kRidge) return at_edge;
        if (at_edge.across == Across::kNeighbour) found = at_edge;
    }
    return found;
}

}  // namespace roboss::narrow
