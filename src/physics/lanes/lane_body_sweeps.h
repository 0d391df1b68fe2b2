// Gauss-Seidel sweeps of BodyKernel in the registers of one instruction set (lane_six.h).
#pragma once

#include <algorithm>
#include <cmath>

#include "physics/lanes/lane_six.h"

namespace roboss {
namespace {

/// Gauss-Seidel sweeps over the points of a BodyIsland: projected impulses, one point after the other. The
/// change of a sweep is taken for a descent direction, and sweeps are accelerated as by nonlinear conjugate
/// gradients (Silcowitz-Hansen, Niebe, Erleben 2010): after each, impulses also move along the search
/// direction, which collects the changes of the sweeps. It starts anew where a sweep changes more than the
/// one before it.
class LaneSweeps {
  public:
    /// At most `most` sweeps; fewer if they converge.
    static void run(BodyIsland& s, int most) {
        constexpr double kConverged = 1e-8;  // squared change, relative to the squared impulses
        start(s);
        double last = 0, enough = 0;
        for (int i = 0; i < most; ++i) {
            const double change = sweep(s);
            if (i == 0) enough = kConverged * squared_impulses(s);
            if (i + 1 == most || change <= enough) break;
            accelerate(s, i > 0 && change <= last ? change / last : 0);
            last = change;
        }
        for (FreeBody& body : s.bodies) body.v = body.swept;
    }

  private:
    /// One sweep; returns the squared change of the impulses, each by its effective mass.
    static double sweep(BodyIsland& s) {
        FreeBody* bodies = s.bodies.data();
        for (FreeBody& body : s.bodies) body.swept_before = body.swept;
        double change = 0;
        for (BodyPoint& p : s.points) {
            p.before_n = p.swept_n, p.before_1 = p.swept_1, p.before_2 = p.swept_2;
            if (p.b >= 0)
                sweep_point<true>(p, bodies[p.a].swept, bodies[p.b].swept);
            else
                sweep_point<false>(p, bodies[p.a].swept, bodies[p.a].swept);
            const double n = p.swept_n - p.before_n, t1 = p.swept_1 - p.before_1, t2 = p.swept_2 - p.before_2;
            change += n * n / p.mass_n + (t1 * t1 + t2 * t2) / p.mass_t;
        }
        return change;
    }

    static double squared_impulses(const BodyIsland& s) {
        double sum = 0;
        for (const BodyPoint& p : s.points)
            sum +=
                p.swept_n * p.swept_n / p.mass_n + (p.swept_1 * p.swept_1 + p.swept_2 * p.swept_2) / p.mass_t;
        return sum;
    }

    /// Moves along the search direction, shortened by `share`, and adds the last sweep's change to it.
    /// Velocities are linear in the impulses, so they have a search direction of their own.
    static void accelerate(BodyIsland& s, double share) {
        for (FreeBody& body : s.bodies) {
            const Row direction = share * load(body.sweep_direction), swept = load(body.swept);
            store(direction + (swept - load(body.swept_before)), body.sweep_direction);
            store(swept + direction, body.swept);
        }
        const auto accelerate_one = [share](double before, double& swept, double& direction) {
            const double change = swept - before;
            direction *= share;
            swept += direction;
            direction += change;
        };
        for (BodyPoint& p : s.points) {
            accelerate_one(p.before_n, p.swept_n, p.direction_n);
            accelerate_one(p.before_1, p.swept_1, p.direction_1);
            accelerate_one(p.before_2, p.swept_2, p.direction_2);
        }
    }

    static void start(BodyIsland& s) {
        for (FreeBody& body : s.bodies) {
            invert(body.mass, body.mobility);
            store(times(body.mobility, body.impulse), body.swept);
            body.sweep_direction = {};
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
            p.direction_n = p.direction_1 = p.direction_2 = 0;
            Row va = load(a.swept);
            push(va, p.by_n_a, p.swept_n), push(va, p.by_t1_a, p.swept_1), push(va, p.by_t2_a, p.swept_2);
            store(va, a.swept);
            if (p.b < 0) continue;
            Row vb = load(bodies[p.b].swept);
            push(vb, p.by_n_b, p.swept_n), push(vb, p.by_t1_b, p.swept_1), push(vb, p.by_t2_b, p.swept_2);
            store(vb, bodies[p.b].swept);
        }
    }

    [[gnu::always_inline]] static void push(Row& v, const Six& by, double impulse) {
        add(v, impulse, load(by));
    }

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
    [[gnu::always_inline]] static void sweep_point(BodyPoint& p, Six& swept_a, Six& swept_b) {
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

}  // namespace
}  // namespace roboss
