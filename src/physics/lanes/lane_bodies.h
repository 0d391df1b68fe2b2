// BodyKernel in the registers of one instruction set (lane_six.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "physics/bodies/body_kernel.h"
#include "physics/lanes/lane_pair_sweeps.h"

namespace roboss {
namespace {

/// Impulses at velocities along a point; those of friction relative to their targets.
struct Impulses {
    double n, t1, t2;
};
[[gnu::always_inline]] inline Impulses impulses_at(const BodyPoint& p, double u_n, double u_1, double u_2) {
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
[[gnu::always_inline]] inline void add_product(SixBlock& block, const Six& n, const Six& t1, const Six& t2,
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

    SweepReport sweep(BodyIsland& s, const SweepPlan& plan) const override {
        return LaneSweeps::run(s, plan);
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
};

}  // namespace
}  // namespace roboss
