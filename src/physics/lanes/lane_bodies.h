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
        s.for_bodies([&](std::size_t b) {
            FreeBody& body = s.bodies[b];
            body.step = body.v;
            store(times(body.mass, body.v), body.mv);
        });
        s.for_points([&](std::size_t k) {
            BodyPoint& p = s.points[k];
            set_step(s, p);
            p.u_n = p.du_n, p.u_1 = p.du_1 - p.target_1, p.u_2 = p.du_2 - p.target_2;
        });
    }

    double balance(BodyIsland& s) const override {
        s.for_points([&](std::size_t k) {
            BodyPoint& p = s.points[k];
            const Impulses f = impulses_at(p, p.u_n, p.u_1, p.u_2);
            p.f_n = f.n, p.f_1 = f.t1, p.f_2 = f.t2;
        });
        return set_gradient(s);
    }

    double set_gradient(BodyIsland& s) const override {
        Row errors = zero(), scales = zero();
        if (s.team.size() == 1) {
            FreeBody* bodies = s.bodies.data();
            for (FreeBody& body : s.bodies) body.applied = {};
            for (const BodyPoint& p : s.points) {
                apply(p.n_a, p.t1_a, p.t2_a, p, bodies[p.a].applied);
                if (p.b >= 0) apply(p.n_b, p.t1_b, p.t2_b, p, bodies[p.b].applied);
            }
            for (FreeBody& body : s.bodies) {
                Row error, scale;
                set_gradient(body, error, scale);
                errors = errors + error, scales = scales + scale;
            }
        } else {
            s.body_terms.resize(2 * s.bodies.size());
            s.for_bodies([&](std::size_t b) { set_own_gradient(s, b); });
            for (std::size_t b = 0; b < s.bodies.size(); ++b) {
                errors = errors + load(s.body_terms[2 * b]);
                scales = scales + load(s.body_terms[2 * b + 1]);
            }
        }
        const double error = total(errors), scale = total(scales);
        return scale > 0 ? std::sqrt(error / scale) : error;
    }

    bool find_step(BodyIsland& s, bool coupled, double lack) const override {
        assemble(s, coupled, lack);
        if (!(s.team.size() == 1 ? factor(s) : factor_together(s))) return false;
        for (FreeBody& body : s.bodies) store(-1.0 * load(body.gradient), body.step);
        solve(s);
        s.for_bodies(
            [&](std::size_t b) { store(times(s.bodies[b].mass, s.bodies[b].step), s.bodies[b].m_step); });
        s.for_points([&](std::size_t k) { set_step(s, s.points[k]); });
        return true;
    }

    void move(BodyIsland& s, double alpha) const override {
        s.for_bodies([&](std::size_t b) {
            FreeBody& body = s.bodies[b];
            Row v = load(body.v), mv = load(body.mv);
            add(v, alpha, load(body.step)), add(mv, alpha, load(body.m_step));
            store(v, body.v), store(mv, body.mv);
        });
        s.for_points([&](std::size_t k) {
            BodyPoint& p = s.points[k];
            p.u_n += alpha * p.du_n, p.u_1 += alpha * p.du_1, p.u_2 += alpha * p.du_2;
        });
    }

    double slope(const BodyIsland& s) const override {
        Row sum = zero();
        for (const FreeBody& body : s.bodies) sum = sum + load(body.step) * load(body.gradient);
        return total(sum);
    }

    double slope_beyond(BodyIsland& s, double fraction) const override {
        Row sum = zero();
        for (const FreeBody& body : s.bodies) {
            Row g = load(body.mv);
            add(g, fraction, load(body.m_step));
            sum = sum + load(body.step) * (g - load(body.impulse));
        }
        double slope = total(sum);
        if (s.team.size() == 1) {
            for (const BodyPoint& p : s.points) slope -= slope_of(p, fraction);
            return slope;
        }
        s.point_terms.resize(s.points.size());
        s.for_points([&](std::size_t k) { s.point_terms[k] = slope_of(s.points[k], fraction); });
        for (const double term : s.point_terms) slope -= term;
        return slope;
    }

    SweepReport sweep(BodyIsland& s, const SweepPlan& plan) const override {
        set_gradient(s);
        const SweepReport report = LaneSweeps::run(s, plan);
        set_gradient(s);
        LaneSweeps::balance_momentum(s);
        return report;
    }

  private:
    static void apply(const Six& n, const Six& t1, const Six& t2, const BodyPoint& p, Six& applied) {
        Row sum = load(applied);
        add(sum, p.f_n, load(n)), add(sum, p.f_1, load(t1)), add(sum, p.f_2, load(t2));
        store(sum, applied);
    }

    /// Sets a body's gradient; what it adds to the sums of the balance.
    [[gnu::always_inline]] static void set_gradient(FreeBody& body, Row& error, Row& scale) {
        const Row mv = load(body.mv), free = load(body.impulse), applied = load(body.applied),
                  lightness = load(body.lightness), g = mv - free - applied;
        store(g, body.gradient);
        error = g * g * lightness;
        scale = (mv * mv + free * free + applied * applied) * lightness;
    }

    /// Likewise, and before it sums the impulses of its points.
    static void set_own_gradient(BodyIsland& s, std::size_t b) {
        FreeBody& body = s.bodies[b];
        body.applied = {};
        s.ends.for_each(b, [&](std::size_t k, bool is_b) {
            const BodyPoint& p = s.points[k];
            if (is_b)
                apply(p.n_b, p.t1_b, p.t2_b, p, body.applied);
            else
                apply(p.n_a, p.t1_a, p.t2_a, p, body.applied);
        });
        Row error, scale;
        set_gradient(body, error, scale);
        store(error, s.body_terms[2 * b]), store(scale, s.body_terms[2 * b + 1]);
    }

    /// What a point takes from the potential's derivative along the step, `fraction` steps beyond.
    [[gnu::always_inline]] static double slope_of(const BodyPoint& p, double fraction) {
        const Impulses f =
            impulses_at(p, p.u_n + fraction * p.du_n, p.u_1 + fraction * p.du_1, p.u_2 + fraction * p.du_2);
        return f.n * p.du_n + f.t1 * p.du_1 + f.t2 * p.du_2;
    }

    /// Velocities along a point per step of its bodies.
    [[gnu::always_inline]] static void set_step(const BodyIsland& s, BodyPoint& p) {
        const FreeBody* bodies = s.bodies.data();
        const Row a = load(bodies[p.a].step);
        Row n = load(p.n_a) * a, t1 = load(p.t1_a) * a, t2 = load(p.t2_a) * a;
        if (p.b >= 0) {
            const Row b = load(bodies[p.b].step);
            n = n + load(p.n_b) * b, t1 = t1 + load(p.t1_b) * b, t2 = t2 + load(p.t2_b) * b;
        }
        p.du_n = total(n), p.du_1 = total(t1), p.du_2 = total(t2);
    }

    [[gnu::always_inline]] static bool has_changed(const BodyPoint& p, double lack) {
        const double change =
            std::fabs(p.d_11 - p.held_11) + std::fabs(p.d_12 - p.held_12) + std::fabs(p.d_22 - p.held_22);
        return p.d_n != p.held_n || change > lack * std::max(p.held_11, p.held_22);
    }
    [[gnu::always_inline]] static void hold(BodyPoint& p) {
        p.held_n = p.d_n, p.held_11 = p.d_11, p.held_12 = p.d_12, p.held_22 = p.d_22;
    }

    /// Takes the points' curvatures into the kept matrix, as far as they changed, and copies it.
    static void assemble(BodyIsland& s, bool coupled, double lack) {
        s.symmetric = !coupled;
        if (s.team.size() > 1) {
            assemble_together(s, lack);
        } else {
            for (BodyPoint& p : s.points) {
                if (!has_changed(p, lack)) continue;
                add_own(s, p, false);
                if (p.b >= 0) add_own(s, p, true), add_between(s, p);
                hold(p);
            }
            std::copy(s.kept_diagonal.begin(), s.kept_diagonal.end(), s.diagonal.begin());
            std::copy(s.kept_upper.begin(), s.kept_upper.end(), s.upper.begin());
            if (coupled) std::copy(s.kept_upper.begin(), s.kept_upper.end(), s.lower.begin());
        }
        if (!coupled) return;
        for (const BodyPoint& p : s.points)
            if (p.d_1n != 0 || p.d_2n != 0) add_slide(s, p);
    }

    /// Likewise body by body; what is between two bodies comes with that of the lower number.
    static void assemble_together(BodyIsland& s, double lack) {
        s.for_bodies([&](std::size_t b) {
            s.ends.for_each(b, [&](std::size_t k, bool is_b) {
                const BodyPoint& p = s.points[k];
                if (!has_changed(p, lack)) return;
                add_own(s, p, is_b);
                if (p.b >= 0 && static_cast<int>(b) == std::min(p.a, p.b)) add_between(s, p);
            });
            s.diagonal[b] = s.kept_diagonal[b];
        });
        s.for_points([&](std::size_t k) {
            if (has_changed(s.points[k], lack)) hold(s.points[k]);
        });
        constexpr std::size_t kBlock = 256;  // edges
        s.team.run_blocks(s.upper.size(), kBlock, [&](std::size_t first, std::size_t last) {
            std::copy(s.kept_upper.begin() + static_cast<std::ptrdiff_t>(first),
                      s.kept_upper.begin() + static_cast<std::ptrdiff_t>(last),
                      s.upper.begin() + static_cast<std::ptrdiff_t>(first));
            if (!s.symmetric)
                std::copy(s.kept_upper.begin() + static_cast<std::ptrdiff_t>(first),
                          s.kept_upper.begin() + static_cast<std::ptrdiff_t>(last),
                          s.lower.begin() + static_cast<std::ptrdiff_t>(first));
        });
    }

    /// By how much the point's curvatures changed, times its Jacobian for one of its bodies.
    [[gnu::always_inline]] static Directions share_of(const BodyPoint& p, bool is_b) {
        const double n = p.d_n - p.held_n, d_11 = p.d_11 - p.held_11, d_12 = p.d_12 - p.held_12,
                     d_22 = p.d_22 - p.held_22;
        const Row jn = load(is_b ? p.n_b : p.n_a), t1 = load(is_b ? p.t1_b : p.t1_a),
                  t2 = load(is_b ? p.t2_b : p.t2_a);
        return {n * jn, d_11 * t1 + d_12 * t2, d_12 * t1 + d_22 * t2};
    }

    /// What the point changes in the block of one of its bodies, and in the block between them.
    static void add_own(BodyIsland& s, const BodyPoint& p, bool is_b) {
        const auto body = static_cast<std::size_t>(is_b ? p.b : p.a);
        if (is_b)
            add_product(s.kept_diagonal[body], p.n_b, p.t1_b, p.t2_b, share_of(p, true));
        else
            add_product(s.kept_diagonal[body], p.n_a, p.t1_a, p.t2_a, share_of(p, false));
    }
    static void add_between(BodyIsland& s, const BodyPoint& p) {
        SixBlock& between = s.kept_upper[static_cast<std::size_t>(p.edge)];
        if (p.b_first)
            add_product(between, p.n_b, p.t1_b, p.t2_b, share_of(p, false));
        else
            add_product(between, p.n_a, p.t1_a, p.t2_a, share_of(p, true));
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

    /// Likewise by the threads of a team, column by column (factor_tasks.h).
    static bool factor_together(BodyIsland& s) {
        s.tasks.done.clear(s.order.pivots().size());
        bool fine = true;
        s.team.run_in_order(s.tasks.count(), [&](std::size_t task, std::size_t) {
            for (const std::uint32_t pivot : s.tasks.pivots_of(task)) {
                if (!factor_column(s, pivot)) __atomic_store_n(&fine, false, __ATOMIC_RELAXED);
                s.tasks.done.set(pivot);
            }
        });
        return fine;
    }

    static bool factor_column(BodyIsland& s, std::size_t number) {
        const BodyOrder::Pivot& column = s.order.pivots()[number];
        const auto k = static_cast<std::size_t>(column.body);
        for (const FactorTasks::Update& from : s.tasks.updates_of(number)) {
            s.tasks.done.wait_for(from.pivot);
            take_update(s, s.order.pivots()[from.pivot], from.edge, s.diagonal[k]);
        }
        if (!factor_block(s.diagonal[k], s.pivot_factors[k])) return false;
        for (std::size_t e = column.first; e < column.last; ++e)
            divide(s.diagonal[k], s.pivot_factors[k], s.symmetric, s.upper[e], s.lower[e]);
        return true;
    }

    /// Subtracts what an earlier pivot takes from the column at which its edge ends.
    static void take_update(BodyIsland& s, const BodyOrder::Pivot& pivot, std::size_t own,
                            SixBlock& diagonal) {
        subtract_product(s.lower[own], s.upper[own], diagonal);
        const std::size_t edges = pivot.last - pivot.first;
        const auto subtract_pair = [&](const BodyOrder::Update& update, std::size_t other) {
            const auto edge = static_cast<std::size_t>(update.edge);
            subtract_product(s.lower[own], s.upper[other], s.upper[edge]);
            if (!s.symmetric) subtract_product(s.upper[own], s.lower[other], s.lower[edge]);
        };
        const BodyOrder::Update* updates = s.order.updates().data() + pivot.updates;
        for (std::size_t i = pivot.first; i < own; ++i) {  // updates: the row of i, from i + 1 on
            const BodyOrder::Update& update = updates[own - i - 1];
            if (update.j_first) subtract_pair(update, i);
            updates += edges - (i - pivot.first) - 1;
        }
        for (std::size_t j = own + 1; j < pivot.last; ++j)
            if (const BodyOrder::Update& update = updates[j - own - 1]; !update.j_first)
                subtract_pair(update, j);
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
