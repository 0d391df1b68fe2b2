// A friction disc that slips below its bound (wheel_slip.h), by another compliance along each tangent. With
// C, the sum of `compliance` and `slip`, a symmetric 2x2 matrix, its impulse t is the one in the disc |t| <=
// bound that minimizes t.u + t.C t / 2: t = -C^-1 u, or where that leaves the disc -(C + l)^-1 u with the l >
// 0 for which |t| = bound. It is the derivative of a convex potential of u, as that of a disc that does not
// slip.
#pragma once

#include <cmath>
#include <type_traits>

#include "physics/solver/rows.h"

namespace roboss::slip_disc {

/// Whether the disc slips. Discs in lanes never do.
template <class T>
[[gnu::always_inline]] inline bool slips(const FrictionDiscT<T>& disc) {
    if constexpr (std::is_same_v<T, double>)
        return disc.slip_11 != 0 || disc.slip_22 != 0;
    else
        return false;
}

struct Plane {
    double x = 0, y = 0;
};
struct Sym2 {
    double xx = 0, xy = 0, yy = 0;
};

inline Sym2 inverse(const Sym2& m) {
    const double d = 1.0 / (m.xx * m.yy - m.xy * m.xy);
    return {m.yy * d, -m.xy * d, m.xx * d};
}
inline Plane times(const Sym2& m, const Plane& v) {
    return {m.xx * v.x + m.xy * v.y, m.xy * v.x + m.yy * v.y};
}

/// C, with l on its diagonal.
inline Sym2 compliance(const FrictionDisc& disc, double l = 0) {
    const double c = disc.compliance + l;
    return {c + disc.slip_11, disc.slip_12, c + disc.slip_22};
}

/// Its impulse, and the inverse of C + l.
struct Slipping {
    Plane impulse;
    Sym2 inverse;
    bool bounded = false;  // l > 0
};

/// `u`: velocity minus target. Newton's method on 1 / |t|, which is concave in l: it comes from below and
/// does not pass the solution (More and Sorensen, Computing a trust region step, 1983).
inline Slipping solve(const FrictionDisc& disc, const Plane& u, double bound) {
    constexpr int kStepsMax = 60;
    constexpr double kClose = 1e-13;
    double l = 0;
    Slipping at;
    for (int i = 0;; ++i) {
        at.inverse = inverse(compliance(disc, l));
        const Plane t = times(at.inverse, u);
        at.impulse = {-t.x, -t.y};
        const double size2 = t.x * t.x + t.y * t.y;
        if (size2 <= bound * bound) return at;
        if (!(bound > 0)) return {{}, at.inverse, true};
        at.bounded = true;
        const double size = std::sqrt(size2);
        const Plane w = times(at.inverse, t);
        if (size - bound <= kClose * bound || i == kStepsMax) {
            at.impulse = {-t.x * (bound / size), -t.y * (bound / size)};
            return at;
        }
        l += size2 / (t.x * w.x + t.y * w.y) * ((size - bound) / bound);
    }
}

/// Minus the derivative of the impulse by the velocity.
inline Sym2 curvature(const Slipping& at) {
    if (!at.bounded) return at.inverse;
    const Plane w = times(at.inverse, at.impulse);
    const double n = at.impulse.x * w.x + at.impulse.y * w.y;
    if (!(n > 0)) return {};
    const Sym2& m = at.inverse;
    return {m.xx - w.x * w.x / n, m.xy - w.x * w.y / n, m.yy - w.y * w.y / n};
}

/// Derivative of the impulse by the bound, where that bounds it.
inline Plane by_bound(const Slipping& at, double bound) {
    const Plane w = times(at.inverse, at.impulse);
    const double n = at.impulse.x * w.x + at.impulse.y * w.y;
    return n > 0 ? Plane{w.x * bound / n, w.y * bound / n} : Plane{};
}

}  // namespace roboss::slip_disc
