// BodyKernel in the registers of one instruction set: kWidth doubles each. Every name is local to the
// translation unit that includes this, so code for one processor is never linked in place of another's.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "physics/bodies/body_kernel.h"

namespace roboss {
namespace {

#if defined(__AVX512F__)
constexpr std::size_t kWidth = 8;
#elif defined(__AVX2__)
constexpr std::size_t kWidth = 4;
#else
constexpr std::size_t kWidth = 2;
#endif
constexpr std::size_t kParts = (6 + kWidth - 1) / kWidth;
using Part [[gnu::vector_size(kWidth * sizeof(double))]] = double;

#define ROBOSS_INLINE [[gnu::always_inline]] inline

/// Six numbers in one to three registers; members, not an array, so that they stay there.
struct Row {
    Part a{}, b{}, c{};
};

ROBOSS_INLINE Part load_part(const double* x) {
    using Place [[gnu::may_alias]] = Part;
    return *reinterpret_cast<const Place*>(x);
}
ROBOSS_INLINE void store_part(const Part& part, double* x) {
    using Place [[gnu::may_alias]] = Part;
    *reinterpret_cast<Place*>(x) = part;
}
ROBOSS_INLINE Row load(const Six& six) {
    Row row;
    row.a = load_part(six.x);
    if constexpr (kParts > 1) row.b = load_part(six.x + kWidth);
    if constexpr (kParts > 2) row.c = load_part(six.x + 2 * kWidth);
    return row;
}
ROBOSS_INLINE void store(const Row& row, Six& six) {
    store_part(row.a, six.x);
    if constexpr (kParts > 1) store_part(row.b, six.x + kWidth);
    if constexpr (kParts > 2) store_part(row.c, six.x + 2 * kWidth);
}
ROBOSS_INLINE Part all(double x) {
    return x - Part{};
}
ROBOSS_INLINE Row zero() {
    return {Part{}, Part{}, Part{}};
}
ROBOSS_INLINE Row operator+(const Row& x, const Row& y) {
    Row sum;
    sum.a = x.a + y.a;
    if constexpr (kParts > 1) sum.b = x.b + y.b;
    if constexpr (kParts > 2) sum.c = x.c + y.c;
    return sum;
}
ROBOSS_INLINE Row operator-(const Row& x, const Row& y) {
    Row difference;
    difference.a = x.a - y.a;
    if constexpr (kParts > 1) difference.b = x.b - y.b;
    if constexpr (kParts > 2) difference.c = x.c - y.c;
    return difference;
}
ROBOSS_INLINE Row operator*(const Row& x, const Row& y) {
    Row product;
    product.a = x.a * y.a;
    if constexpr (kParts > 1) product.b = x.b * y.b;
    if constexpr (kParts > 2) product.c = x.c * y.c;
    return product;
}
ROBOSS_INLINE Row operator*(double factor, const Row& x) {
    const Part f = all(factor);
    Row product;
    product.a = f * x.a;
    if constexpr (kParts > 1) product.b = f * x.b;
    if constexpr (kParts > 2) product.c = f * x.c;
    return product;
}
ROBOSS_INLINE void add(Row& sum, double factor, const Row& x) {
    sum = sum + factor * x;
}
ROBOSS_INLINE void subtract(Row& sum, double factor, const Row& x) {
    sum = sum - factor * x;
}
/// A template only so that the forms for other registers are not looked at.
template <class AnyRow>
[[gnu::always_inline]] inline double total(const AnyRow& x) {
    if constexpr (kParts == 1) return ((x.a[0] + x.a[1]) + (x.a[2] + x.a[3])) + (x.a[4] + x.a[5]);
    if constexpr (kParts == 2) return ((x.a[0] + x.a[1]) + (x.a[2] + x.a[3])) + (x.b[0] + x.b[1]);
    return ((x.a[0] + x.a[1]) + (x.b[0] + x.b[1])) + (x.c[0] + x.c[1]);
}
ROBOSS_INLINE Row times(const SixBlock& block, const Six& x) {
    Row y = x.x[0] * load(block.row[0]);
    for (std::size_t i = 1; i < 6; ++i) add(y, x.x[i], load(block.row[i]));
    return y;
}

/// Impulses at velocities along a point; those of friction relative to their targets.
struct Impulses {
    double n, t1, t2;
};
ROBOSS_INLINE Impulses impulses_at(const BodyPoint& p, double u_n, double u_1, double u_2) {
    const double raw = (p.target_n - u_n) * p.stiffness_n;
    Impulses f{raw > 0 ? raw : 0, -u_1 * p.stiffness_t, -u_2 * p.stiffness_t};
    const double size2 = f.t1 * f.t1 + f.t2 * f.t2;
    if (size2 > p.bound * p.bound) {
        const double cut = p.bound / std::sqrt(size2);
        f.t1 *= cut, f.t2 *= cut;
    }
    return f;
}

/// block += x^T g over the three directions.
struct Directions {
    Row n, t1, t2;
};
ROBOSS_INLINE void add_product(SixBlock& block, const Six& n, const Six& t1, const Six& t2,
                               const Directions& g) {
    for (std::size_t i = 0; i < 6; ++i) {
        Row row = load(block.row[i]);
        add(row, n.x[i], g.n), add(row, t1.x[i], g.t1), add(row, t2.x[i], g.t2);
        store(row, block.row[i]);
    }
}

class LaneBodies final : public BodyKernel {
  public:
    void take_velocities(BodyIsland& s) const override {
        for (FreeBody& body : s.bodies) {
            body.step = body.v;
            store(times(body.mass, body.v), body.mv);
        }
        set_steps(s);
        for (BodyPoint& p : s.points)
            p.u_n = p.du_n, p.u_1 = p.du_1 - p.target_1, p.u_2 = p.du_2 - p.target_2;
    }

    double balance(BodyIsland& s) const override {
        for (BodyPoint& p : s.points) {
            const Impulses f = impulses_at(p, p.u_n, p.u_1, p.u_2);
            p.f_n = f.n, p.f_1 = f.t1, p.f_2 = f.t2;
        }
        return set_gradient(s);
    }

    double set_gradient(BodyIsland& s) const override {
        FreeBody* bodies = s.bodies.data();
        for (FreeBody& body : s.bodies) body.applied = {};
        for (const BodyPoint& p : s.points) {
            apply(p.n_a, p.t1_a, p.t2_a, p, bodies[p.a].applied);
            if (p.b >= 0) apply(p.n_b, p.t1_b, p.t2_b, p, bodies[p.b].applied);
        }
        Row errors = zero(), scales = zero();
        for (FreeBody& body : s.bodies) {
            const Row mv = load(body.mv), free = load(body.impulse), applied = load(body.applied),
                      lightness = load(body.lightness), g = mv - free - applied;
            store(g, body.gradient);
            errors = errors + g * g * lightness;
            scales = scales + (mv * mv + free * free + applied * applied) * lightness;
        }
        const double error = total(errors), scale = total(scales);
        return scale > 0 ? std::sqrt(error / scale) : error;
    }

    bool find_step(BodyIsland& s, bool coupled, double lack) const override {
        assemble(s, coupled, lack);
        if (!factor(s)) return false;
        for (FreeBody& body : s.bodies) store(-1.0 * load(body.gradient), body.step);
        solve(s);
        for (FreeBody& body : s.bodies) store(times(body.mass, body.step), body.m_step);
        set_steps(s);
        return true;
    }

    void move(BodyIsland& s, double alpha) const override {
        for (FreeBody& body : s.bodies) {
            Row v = load(body.v), mv = load(body.mv);
            add(v, alpha, load(body.step)), add(mv, alpha, load(body.m_step));
            store(v, body.v), store(mv, body.mv);
        }
        for (BodyPoint& p : s.points)
            p.u_n += alpha * p.du_n, p.u_1 += alpha * p.du_1, p.u_2 += alpha * p.du_2;
    }

    double slope(const BodyIsland& s) const override {
        Row sum = zero();
        for (const FreeBody& body : s.bodies) sum = sum + load(body.step) * load(body.gradient);
        return total(sum);
    }

    double slope_beyond(const BodyIsland& s, double fraction) const override {
        Row sum = zero();
        for (const FreeBody& body : s.bodies) {
            Row g = load(body.mv);
            add(g, fraction, load(body.m_step));
            sum = sum + load(body.step) * (g - load(body.impulse));
        }
        double slope = total(sum);
        for (const BodyPoint& p : s.points) {
            const Impulses f = impulses_at(p, p.u_n + fraction * p.du_n, p.u_1 + fraction * p.du_1,
                                           p.u_2 + fraction * p.du_2);
            slope -= f.n * p.du_n + f.t1 * p.du_1 + f.t2 * p.du_2;
        }
        return slope;
    }

    void sweep(BodyIsland& s, int sweeps) const override {
        start_sweeps(s);
        for (int i = 0; i < sweeps; ++i)
            for (BodyPoint& p : s.points) {
                if (p.b >= 0)
                    sweep_point<true>(p, s.bodies[static_cast<std::size_t>(p.a)].swept,
                                      s.bodies[static_cast<std::size_t>(p.b)].swept);
                else
                    sweep_point<false>(p, s.bodies[static_cast<std::size_t>(p.a)].swept,
                                       s.bodies[static_cast<std::size_t>(p.a)].swept);
            }
        for (FreeBody& body : s.bodies) body.v = body.swept;
    }

  private:
    static void apply(const Six& n, const Six& t1, const Six& t2, const BodyPoint& p, Six& applied) {
        Row sum = load(applied);
        add(sum, p.f_n, load(n)), add(sum, p.f_1, load(t1)), add(sum, p.f_2, load(t2));
        store(sum, applied);
    }

    /// Velocities along the points per step of the bodies.
    static void set_steps(BodyIsland& s) {
        const FreeBody* bodies = s.bodies.data();
        for (BodyPoint& p : s.points) {
            const Row a = load(bodies[p.a].step);
            Row n = load(p.n_a) * a, t1 = load(p.t1_a) * a, t2 = load(p.t2_a) * a;
            if (p.b >= 0) {
                const Row b = load(bodies[p.b].step);
                n = n + load(p.n_b) * b, t1 = t1 + load(p.t1_b) * b, t2 = t2 + load(p.t2_b) * b;
            }
            p.du_n = total(n), p.du_1 = total(t1), p.du_2 = total(t2);
        }
    }

    /// Takes the points' curvatures into the kept matrix, as far as they changed, and copies it.
    static void assemble(BodyIsland& s, bool coupled, double lack) {
        for (BodyPoint& p : s.points) {
            const double change =
                std::fabs(p.d_11 - p.held_11) + std::fabs(p.d_12 - p.held_12) + std::fabs(p.d_22 - p.held_22);
            if (p.d_n != p.held_n || change > lack * std::max(p.held_11, p.held_22)) add_point(s, p);
        }
        std::copy(s.kept_diagonal.begin(), s.kept_diagonal.end(), s.diagonal.begin());
        std::copy(s.kept_upper.begin(), s.kept_upper.end(), s.upper.begin());
        s.symmetric = !coupled;
        if (s.symmetric) return;
        std::copy(s.kept_upper.begin(), s.kept_upper.end(), s.lower.begin());
        for (const BodyPoint& p : s.points)
            if (p.d_1n != 0 || p.d_2n != 0) add_slide(s, p);
    }

    static void add_point(BodyIsland& s, BodyPoint& p) {
        const double n = p.d_n - p.held_n, d_11 = p.d_11 - p.held_11, d_12 = p.d_12 - p.held_12,
                     d_22 = p.d_22 - p.held_22;
        p.held_n = p.d_n, p.held_11 = p.d_11, p.held_12 = p.d_12, p.held_22 = p.d_22;
        const auto share = [&](const Six& jn, const Six& j1, const Six& j2) {
            const Row t1 = load(j1), t2 = load(j2);
            return Directions{n * load(jn), d_11 * t1 + d_12 * t2, d_12 * t1 + d_22 * t2};
        };
        const Directions a = share(p.n_a, p.t1_a, p.t2_a);
        add_product(s.kept_diagonal[static_cast<std::size_t>(p.a)], p.n_a, p.t1_a, p.t2_a, a);
        if (p.b < 0) return;
        const Directions b = share(p.n_b, p.t1_b, p.t2_b);
        add_product(s.kept_diagonal[static_cast<std::size_t>(p.b)], p.n_b, p.t1_b, p.t2_b, b);
        SixBlock& between = s.kept_upper[static_cast<std::size_t>(p.edge)];
        if (p.b_first)
            add_product(between, p.n_b, p.t1_b, p.t2_b, a);
        else
            add_product(between, p.n_a, p.t1_a, p.t2_a, b);
    }

    /// Friction that slides by the normal velocity: what is not symmetric.
    static void add_slide(BodyIsland& s, const BodyPoint& p) {
        const auto slide = [&](const Six& j1, const Six& j2) {
            Six sum;
            store(p.d_1n * load(j1) + p.d_2n * load(j2), sum);
            return sum;
        };
        const auto add_outer = [](SixBlock& block, const Six& x, const Six& y) {
            const Row row = load(y);
            for (std::size_t i = 0; i < 6; ++i) {
                Row sum = load(block.row[i]);
                add(sum, x.x[i], row);
                store(sum, block.row[i]);
            }
        };
        const Six a = slide(p.t1_a, p.t2_a);
        add_outer(s.diagonal[static_cast<std::size_t>(p.a)], a, p.n_a);
        if (p.b < 0) return;
        const Six b = slide(p.t1_b, p.t2_b);
        add_outer(s.diagonal[static_cast<std::size_t>(p.b)], b, p.n_b);
        SixBlock &upper = s.upper[static_cast<std::size_t>(p.edge)],
                 &lower = s.lower[static_cast<std::size_t>(p.edge)];
        if (p.b_first)
            add_outer(upper, b, p.n_a), add_outer(lower, p.n_b, a);
        else
            add_outer(upper, a, p.n_b), add_outer(lower, p.n_a, b);
    }

    /// L U (L D L^T where it is symmetric) without pivoting, block by block. Where friction moves with the
    /// normal impulse pivots may be negative; a factor that is no good shows in the balance.
    static bool factor(BodyIsland& s) {
        for (const BodyOrder::Pivot& pivot : s.order.pivots()) {
            const auto k = static_cast<std::size_t>(pivot.body);
            if (!factor_block(s.diagonal[k], s.pivot_factors[k])) return false;
            for (std::size_t e = pivot.first; e < pivot.last; ++e)
                divide(s.diagonal[k], s.pivot_factors[k], s.symmetric, s.upper[e], s.lower[e]);
            const BodyOrder::Update* update = s.order.updates().data() + pivot.updates;
            for (std::size_t i = pivot.first; i < pivot.last; ++i) {
                subtract_product(s.lower[i], s.upper[i],
                                 s.diagonal[static_cast<std::size_t>(s.order.ends()[i])]);
                for (std::size_t j = i + 1; j < pivot.last; ++j, ++update) {
                    const auto edge = static_cast<std::size_t>(update->edge);
                    const std::size_t first = update->j_first ? j : i, second = update->j_first ? i : j;
                    subtract_product(s.lower[first], s.upper[second], s.upper[edge]);
                    if (!s.symmetric) subtract_product(s.upper[first], s.lower[second], s.lower[edge]);
                }
            }
        }
        return true;
    }

    static bool factor_block(SixBlock& block, BodyIsland::PivotFactor& pivot) {
        for (std::size_t c = 0; c < 6; ++c) {
            const double diagonal = block.row[c].x[c];
            if (diagonal == 0) return false;
            pivot.inverse[c] = 1.0 / diagonal;
            const Row own = load(block.row[c]);
            for (std::size_t r = c + 1; r < 6; ++r) {
                pivot.l[r][c] = block.row[r].x[c] * pivot.inverse[c];
                Row row = load(block.row[r]);
                subtract(row, pivot.l[r][c], own);
                store(row, block.row[r]);
            }
        }
        return true;
    }

    /// upper := L^-1 upper, lower^T := lower^T U^-1
    static void divide(const SixBlock& diagonal, const BodyIsland::PivotFactor& pivot, bool symmetric,
                       SixBlock& upper, SixBlock& lower) {
        Row u[6];
        for (std::size_t r = 0; r < 6; ++r) u[r] = load(upper.row[r]);
        for (std::size_t c = 0; c < 5; ++c)
            for (std::size_t r = c + 1; r < 6; ++r) subtract(u[r], pivot.l[r][c], u[c]);
        for (std::size_t r = 0; r < 6; ++r) store(u[r], upper.row[r]);
        if (symmetric) {
            for (std::size_t r = 0; r < 6; ++r) store(pivot.inverse[r] * u[r], lower.row[r]);
            return;
        }
        for (std::size_t r = 0; r < 6; ++r) {
            Row row = load(lower.row[r]);
            for (std::size_t q = 0; q < r; ++q) subtract(row, diagonal.row[q].x[r], load(lower.row[q]));
            store(pivot.inverse[r] * row, lower.row[r]);
        }
    }

    /// to -= left^T right
    static void subtract_product(const SixBlock& left, const SixBlock& right, SixBlock& to) {
        Row r[6];
        for (std::size_t c = 0; c < 6; ++c) r[c] = load(right.row[c]);
        for (std::size_t i = 0; i < 6; ++i) {
            Row row = load(to.row[i]);
            for (std::size_t c = 0; c < 6; ++c) subtract(row, left.row[c].x[i], r[c]);
            store(row, to.row[i]);
        }
    }

    /// Steps: from right hand sides to solutions.
    static void solve(BodyIsland& s) {
        FreeBody* bodies = s.bodies.data();
        const int* ends = s.order.ends().data();
        for (const BodyOrder::Pivot& pivot : s.order.pivots()) {
            const BodyIsland::PivotFactor& p = s.pivot_factors[static_cast<std::size_t>(pivot.body)];
            Six& y = bodies[pivot.body].step;
            for (std::size_t c = 0; c < 5; ++c)
                for (std::size_t r = c + 1; r < 6; ++r) y.x[r] -= p.l[r][c] * y.x[c];
            for (std::size_t e = pivot.first; e < pivot.last; ++e) {
                Row to = load(bodies[ends[e]].step);
                for (std::size_t c = 0; c < 6; ++c) subtract(to, y.x[c], load(s.lower[e].row[c]));
                store(to, bodies[ends[e]].step);
            }
        }
        const auto& pivots = s.order.pivots();
        for (std::size_t k = pivots.size(); k-- > 0;) {
            const auto body = static_cast<std::size_t>(pivots[k].body);
            Six& x = bodies[body].step;
            for (std::size_t e = pivots[k].first; e < pivots[k].last; ++e) {
                const Row other = load(bodies[ends[e]].step);
                for (std::size_t c = 0; c < 6; ++c) x.x[c] -= total(load(s.upper[e].row[c]) * other);
            }
            for (std::size_t c = 6; c-- > 0;) {
                x.x[c] *= s.pivot_factors[body].inverse[c];
                for (std::size_t r = 0; r < c; ++r) x.x[r] -= s.diagonal[body].row[r].x[c] * x.x[c];
            }
        }
    }

    static void start_sweeps(BodyIsland& s) {
        for (FreeBody& body : s.bodies) {
            invert(body.mass, body.mobility);
            store(times(body.mobility, body.impulse), body.swept);
        }
        FreeBody* bodies = s.bodies.data();
        for (BodyPoint& p : s.points) {
            FreeBody& a = bodies[p.a];
            const auto respond = [](const FreeBody& body, const Six& j, Six& by) {
                const Row row = times(body.mobility, j);
                store(row, by);
                return row * load(j);
            };
            Row n = respond(a, p.n_a, p.by_n_a), t1 = respond(a, p.t1_a, p.by_t1_a),
                t2 = respond(a, p.t2_a, p.by_t2_a);
            if (p.b >= 0) {
                const FreeBody& b = bodies[p.b];
                n = n + respond(b, p.n_b, p.by_n_b), t1 = t1 + respond(b, p.t1_b, p.by_t1_b),
                t2 = t2 + respond(b, p.t2_b, p.by_t2_b);
            }
            p.mass_n = 1.0 / (total(n) + 1.0 / p.stiffness_n);
            p.mass_t = 1.0 / (std::max(total(t1), total(t2)) + 1.0 / p.stiffness_t);
            p.swept_n = p.f_n, p.swept_1 = p.f_1, p.swept_2 = p.f_2;
            Row va = load(a.swept);
            push(va, p.by_n_a, p.swept_n), push(va, p.by_t1_a, p.swept_1), push(va, p.by_t2_a, p.swept_2);
            store(va, a.swept);
            if (p.b < 0) continue;
            Row vb = load(bodies[p.b].swept);
            push(vb, p.by_n_b, p.swept_n), push(vb, p.by_t1_b, p.swept_1), push(vb, p.by_t2_b, p.swept_2);
            store(vb, bodies[p.b].swept);
        }
    }

    ROBOSS_INLINE static void push(Row& v, const Six& by, double impulse) { add(v, impulse, load(by)); }

    /// M^-1 by Gauss and Jordan.
    static void invert(const SixBlock& mass, SixBlock& inverse) {
        SixBlock a = mass;
        inverse = {};
        for (std::size_t r = 0; r < 6; ++r) inverse.row[r].x[r] = 1;
        for (std::size_t c = 0; c < 6; ++c) {
            const double scale = 1.0 / a.row[c].x[c];
            const Row own = scale * load(a.row[c]), found = scale * load(inverse.row[c]);
            store(own, a.row[c]), store(found, inverse.row[c]);
            for (std::size_t r = 0; r < 6; ++r) {
                if (r == c) continue;
                const double f = a.row[r].x[c];
                Row row = load(a.row[r]), x = load(inverse.row[r]);
                subtract(row, f, own), subtract(x, f, found);
                store(row, a.row[r]), store(x, inverse.row[r]);
            }
        }
    }

    template <bool kPair>
    ROBOSS_INLINE static void sweep_point(BodyPoint& p, Six& swept_a, Six& swept_b) {
        Row va = load(swept_a), vb = kPair ? load(swept_b) : zero();
        const auto along = [&](const Six& ja, const Six& jb) {
            Row u = load(ja) * va;
            if constexpr (kPair) u = u + load(jb) * vb;
            return total(u);
        };
        const double compliance = 1.0 / p.stiffness_n, slip = 1.0 / p.stiffness_t;
        double n = p.swept_n + (p.target_n - along(p.n_a, p.n_b) - compliance * p.swept_n) * p.mass_n;
        n = n > 0 ? n : 0;
        push(va, p.by_n_a, n - p.swept_n);
        if constexpr (kPair) push(vb, p.by_n_b, n - p.swept_n);
        p.swept_n = n;
        double t1 = p.swept_1 - (along(p.t1_a, p.t1_b) - p.target_1 + slip * p.swept_1) * p.mass_t,
               t2 = p.swept_2 - (along(p.t2_a, p.t2_b) - p.target_2 + slip * p.swept_2) * p.mass_t;
        const double bound = p.coefficient * n, size2 = t1 * t1 + t2 * t2;
        if (size2 > bound * bound) {
            const double cut = bound / std::sqrt(size2);
            t1 *= cut, t2 *= cut;
        }
        push(va, p.by_t1_a, t1 - p.swept_1), push(va, p.by_t2_a, t2 - p.swept_2);
        if constexpr (kPair) push(vb, p.by_t1_b, t1 - p.swept_1), push(vb, p.by_t2_b, t2 - p.swept_2);
        p.swept_1 = t1, p.swept_2 = t2;
        store(va, swept_a);
        if constexpr (kPair) store(vb, swept_b);
    }
};

#undef ROBOSS_INLINE

}  // namespace
}  // namespace roboss
