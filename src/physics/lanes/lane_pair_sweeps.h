// Gauss-Seidel sweeps of BodyKernel in the registers of one instruction set (lane_six.h): eight pairs of
// bodies side by side (body_pairs.h).
#pragma once

#include <algorithm>
#include <cmath>

#include "core/lanes_neon.h"
#include "core/lanes_x86.h"
#include "physics/bodies/sweep_plan.h"
#include "physics/lanes/lane_six.h"
#include "physics/lanes/lane_transpose.h"

namespace roboss {
namespace {

/// Gauss-Seidel sweeps over the points of a BodyIsland: projected impulses, one pair after the other, where
/// pairs that share no body are one step. The change of a sweep is taken for a descent direction, and sweeps
/// are accelerated as by nonlinear conjugate gradients (Silcowitz-Hansen, Niebe, Erleben 2010): before each,
/// impulses also move along the search direction, which collects the changes of the sweeps. It starts anew
/// where a sweep changes more than the one before it.
class LaneSweeps {
  public:
    static SweepReport run(BodyIsland& s, const SweepPlan& plan) {
        start(s);
        SweepProgress progress(plan);
        double change = first_sweep(s, progress);
        while (!progress.ends(change)) {
            accelerate_bodies(s, progress.share());
            change = sweep(s, progress.share());
        }
        finish(s);
        return progress.report();
    }

    /// Velocities to match the impulses: v -= M^-1 gradient.
    static void balance_momentum(BodyIsland& s) {
        s.for_bodies([&](std::size_t b) {
            Six y;
            store(times(s.whitening[b], s.bodies[b].gradient), y);
            const Row row = load(y);
            for (std::size_t i = 0; i < 6; ++i)
                s.bodies[b].v.x[i] -= roboss::total(load(s.whitening[b].row[i]) * row);
        });
    }

  private:
#if defined(__AVX2__)
    static constexpr std::size_t kFloats = 8;
#else
    static constexpr std::size_t kFloats = 4;
#endif
    using Floats [[gnu::vector_size(kFloats * sizeof(float))]] = float;

    /// Two bodies of each pair: six velocities.
    struct Velocities {
        Floats a[6], b[6];
    };

    [[gnu::always_inline]] static Floats load_floats(const float* x) {
        using Place [[gnu::may_alias]] = Floats;
        return *reinterpret_cast<const Place*>(x);
    }
    [[gnu::always_inline]] static void store_floats(const Floats& floats, float* x) {
        using Place [[gnu::may_alias]] = Floats;
        *reinterpret_cast<Place*>(x) = floats;
    }
    [[gnu::always_inline]] static Floats at(const Eight& numbers, std::size_t lane) {
        return load_floats(numbers.x + lane);
    }
    [[gnu::always_inline]] static void put(const Floats& floats, std::size_t lane, Eight& numbers) {
        store_floats(floats, numbers.x + lane);
    }
    [[gnu::always_inline]] static Floats all_floats(float x) {
        return x - Floats{};
    }

    [[gnu::always_inline]] static Floats square_root(const Floats& x) {
#if defined(__AVX2__)
        return Avx2::sqrt(x);
#elif defined(__aarch64__)
        return Neon::sqrt(x);
#else
        Floats root{};
        for (std::size_t i = 0; i < kFloats; ++i) root[i] = std::sqrt(x[i]);
        return root;
#endif
    }

    /// Between bodies' rows of six and lanes.
    [[gnu::always_inline]] static void gather(const SixFloats* bodies, const int* chosen, Floats* columns) {
        for (std::size_t k = 0; k < 6; k += kFloats) {
            Floats block[kFloats];
            for (std::size_t i = 0; i < kFloats; ++i) block[i] = load_floats(bodies[chosen[i]].x + k);
            transpose<kFloats>(block);
            for (std::size_t i = 0; i < kFloats && k + i < 6; ++i) columns[k + i] = block[i];
        }
    }
    [[gnu::always_inline]] static void scatter(const Floats* columns, const int* chosen, SixFloats* bodies) {
        for (std::size_t k = 0; k < 6; k += kFloats) {
            Floats block[kFloats];
            for (std::size_t i = 0; i < kFloats; ++i) block[i] = k + i < 6 ? columns[k + i] : Floats{};
            transpose<kFloats>(block);
            for (std::size_t i = 0; i < kFloats; ++i) store_floats(block[i], bodies[chosen[i]].x + k);
        }
    }

    template <bool kScenery>
    [[gnu::always_inline]] static Floats along(const Eight* a, const Eight* b, const Velocities& y,
                                               std::size_t lane) {
        Floats sums[6];
        for (std::size_t i = 0; i < 6; ++i) {
            sums[i] = at(a[i], lane) * y.a[i];
            if constexpr (!kScenery) sums[i] = sums[i] + at(b[i], lane) * y.b[i];
        }
        return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + (sums[4] + sums[5]);
    }

    /// A contact point of each pair; returns the squared change of the impulses, each by its effective mass.
    template <bool kScenery>
    [[gnu::always_inline]] static Floats sweep_point(PointSlot& p, std::size_t lane, const Floats& share,
                                                     Velocities& y) {
        const auto accelerated = [&](const Eight& impulse, const Eight& last, Eight& direction) {
            const Floats old = share * at(direction, lane);
            put(old + at(last, lane), lane, direction);
            return at(impulse, lane) + old;
        };
        const Floats n_before = accelerated(p.impulse_n, p.change_n, p.direction_n),
                     t1_before = accelerated(p.impulse_1, p.change_1, p.direction_1),
                     t2_before = accelerated(p.impulse_2, p.change_2, p.direction_2);
        const Floats u_n = along<kScenery>(p.n_a, p.n_b, y, lane),
                     u_1 = along<kScenery>(p.t1_a, p.t1_b, y, lane),
                     u_2 = along<kScenery>(p.t2_a, p.t2_b, y, lane), none{};
        Floats n = n_before +
                   ((at(p.target_n, lane) - u_n) - at(p.compliance, lane) * n_before) * at(p.mass_n, lane);
        n = n > none ? n : none;
        const Floats dn = n - n_before, slip = at(p.slip, lane), mass_t = at(p.mass_t, lane);
        Floats t1 = t1_before -
                    ((u_1 + at(p.n_on_1, lane) * dn) - at(p.target_1, lane) + slip * t1_before) * mass_t,
               t2 = t2_before -
                    ((u_2 + at(p.n_on_2, lane) * dn) - at(p.target_2, lane) + slip * t2_before) * mass_t;
        const Floats bound = at(p.bound, lane) + at(p.coefficient, lane) * n, size2 = t1 * t1 + t2 * t2;
        const Floats cut = size2 > bound * bound ? bound / square_root(size2) : all_floats(1);
        t1 = t1 * cut, t2 = t2 * cut;
        const Floats d1 = t1 - t1_before, d2 = t2 - t2_before;
        for (std::size_t i = 0; i < 6; ++i) {
            y.a[i] =
                y.a[i] + ((at(p.n_a[i], lane) * dn + at(p.t1_a[i], lane) * d1) + at(p.t2_a[i], lane) * d2);
            if constexpr (kScenery) continue;
            y.b[i] =
                y.b[i] + ((at(p.n_b[i], lane) * dn + at(p.t1_b[i], lane) * d1) + at(p.t2_b[i], lane) * d2);
        }
        put(n, lane, p.impulse_n), put(t1, lane, p.impulse_1), put(t2, lane, p.impulse_2);
        put(dn, lane, p.change_n), put(d1, lane, p.change_1), put(d2, lane, p.change_2);
        return dn * dn * at(p.inverse_mass_n, lane) + (d1 * d1 + d2 * d2) * at(p.inverse_mass_t, lane);
    }

    /// The pairs of a batch from `lane` on; take(slot, change of its impulses).
    template <bool kScenery, class Take>
    [[gnu::always_inline]] static void sweep_batch(BodyIsland& s, const PairBatch& batch, std::size_t lane,
                                                   const Floats& share, const Take& take) {
        Velocities y;
        gather(s.swept.data(), batch.a + lane, y.a);
        if constexpr (!kScenery) gather(s.swept.data(), batch.b + lane, y.b);
        for (std::size_t k = batch.first; k < batch.last; ++k)
            take(k, sweep_point<kScenery>(s.slots[k], lane, share, y));
        scatter(y.a, batch.a + lane, s.swept.data());
        if constexpr (!kScenery) scatter(y.b, batch.b + lane, s.swept.data());
    }

    static void keep_velocities(BodyIsland& s) {
        std::copy_n(s.swept.begin(), s.bodies.size(), s.swept_before.begin());
    }

    static double first_sweep(BodyIsland& s, SweepProgress& progress) {
        keep_velocities(s);
        const double change = sweep(s, 0);
        progress.begin(squared_impulses(s), squared_motion(s));
        return change;
    }

    /// One sweep; returns the squared change of the impulses.
    static double sweep(BodyIsland& s, double share) {
        if (s.team.size() > 1) return sweep_together(s, share);
        Eight changes;
        const Floats shares = all_floats(static_cast<float>(share));
        for (const PairBatch& batch : s.pairs.batches())
            for (std::size_t lane = 0; lane < static_cast<std::size_t>(batch.pairs); lane += kFloats) {
                Floats change = at(changes, lane);
                const auto add = [&](std::size_t, const Floats& by) { change = change + by; };
                if (batch.scenery)
                    sweep_batch<true>(s, batch, lane, shares, add);
                else
                    sweep_batch<false>(s, batch, lane, shares, add);
                put(change, lane, changes);
            }
        return total(changes);
    }

    /// Likewise by the threads of a team, colour by colour. The changes of a colour are added, in the order
    /// of one thread, while the next one is swept.
    static double sweep_together(BodyIsland& s, double share) {
        constexpr std::size_t kBlock = 2;  // batches
        const std::vector<std::size_t>& colours = s.pairs.colours();
        Eight changes;
        for (std::size_t c = 0; c + 1 < colours.size(); ++c) {
            const std::size_t begin = colours[c], end = colours[c + 1];
            s.team.run(1 + (end - begin + kBlock - 1) / kBlock, [&](std::size_t item, std::size_t) {
                if (item == 0) {
                    if (c > 0) add_terms(s, colours[c - 1], begin, changes);
                    return;
                }
                const std::size_t first = begin + (item - 1) * kBlock, last = std::min(first + kBlock, end);
                for (std::size_t k = first; k < last; ++k) {
                    if (k + 1 < end) fetch(s, s.pairs.batches()[s.pairs.by_bodies()[k + 1]]);
                    sweep_for_team(s, s.pairs.batches()[s.pairs.by_bodies()[k]],
                                   all_floats(static_cast<float>(share)));
                }
            });
        }
        if (colours.size() > 1) add_terms(s, colours[colours.size() - 2], colours.back(), changes);
        return total(changes);
    }

    /// Fetches the velocities of the bodies, which another thread may have changed last, while something else
    /// is computed.
    static void fetch(const BodyIsland& s, const PairBatch& batch) {
        for (std::size_t i = 0; i < 8; ++i) {
            __builtin_prefetch(&s.swept[static_cast<std::size_t>(batch.a[i])], 1);
            if (!batch.scenery) __builtin_prefetch(&s.swept[static_cast<std::size_t>(batch.b[i])], 1);
        }
    }

    static void sweep_for_team(BodyIsland& s, const PairBatch& batch, const Floats& share) {
        for (std::size_t lane = 0; lane < static_cast<std::size_t>(batch.pairs); lane += kFloats) {
            const auto keep = [&](std::size_t slot, const Floats& by) { put(by, lane, s.slot_terms[slot]); };
            if (batch.scenery)
                sweep_batch<true>(s, batch, lane, share, keep);
            else
                sweep_batch<false>(s, batch, lane, share, keep);
        }
    }

    /// Adds the changes of batches.
    static void add_terms(const BodyIsland& s, std::size_t first, std::size_t last, Eight& changes) {
        for (std::size_t k = first; k < last; ++k) {
            const PairBatch& batch = s.pairs.batches()[k];
            for (std::size_t lane = 0; lane < static_cast<std::size_t>(batch.pairs); lane += kFloats) {
                Floats change = at(changes, lane);
                for (std::size_t slot = batch.first; slot < batch.last; ++slot)
                    change = change + at(s.slot_terms[slot], lane);
                put(change, lane, changes);
            }
        }
    }

    static double total(const Eight& sums) {
        double x[8];
        std::copy_n(sums.x, 8, x);
        return ((x[0] + x[1]) + (x[2] + x[3])) + ((x[4] + x[5]) + (x[6] + x[7]));
    }

    /// Of the velocities that the solve starts from along the points, each by its effective mass.
    static double squared_motion(const BodyIsland& s) {
        double sum = 0;
        for (std::size_t k = 0; k < s.points.size(); ++k) {
            const BodyPoint& p = s.points[k];
            const std::size_t lane = s.pairs.place_of(k) % 8;
            const PointSlot& slot = s.slots[s.pairs.place_of(k) / 8];
            sum += p.u_n * p.u_n * double{slot.mass_n.x[lane]} +
                   (p.u_1 * p.u_1 + p.u_2 * p.u_2) * double{slot.mass_t.x[lane]};
        }
        return sum;
    }

    static double squared_impulses(const BodyIsland& s) {
        Eight sums;
        for (const PointSlot& p : s.slots)
            for (std::size_t lane = 0; lane < 8; lane += kFloats) {
                const Floats n = at(p.impulse_n, lane), t1 = at(p.impulse_1, lane),
                             t2 = at(p.impulse_2, lane);
                put(at(sums, lane) + (n * n * at(p.inverse_mass_n, lane) +
                                      (t1 * t1 + t2 * t2) * at(p.inverse_mass_t, lane)),
                    lane, sums);
            }
        return total(sums);
    }

    /// Moves along the search direction, shortened by `share`, and adds the last sweep's change to it.
    /// Velocities are linear in the impulses, so they have a search direction of their own. Keeps them.
    static void accelerate_bodies(BodyIsland& s, double share) {
        const Floats shares = all_floats(static_cast<float>(share));
        s.for_bodies([&](std::size_t b) {
            float *direction = s.swept_direction[b].x, *swept = s.swept[b].x, *before = s.swept_before[b].x;
            for (std::size_t k = 0; k < 8; k += kFloats) {
                const Floats along = shares * load_floats(direction + k), now = load_floats(swept + k),
                             moved = now + along;
                store_floats(along + (now - load_floats(before + k)), direction + k);
                store_floats(moved, swept + k), store_floats(moved, before + k);
            }
        });
    }

    static void start(BodyIsland& s) {
        make_room_for_sweeps(s);
        s.for_bodies([&](std::size_t b) {
            invert_root(s.bodies[b].mass, s.whitening[b]);
            Six y;
            store(times(s.whitening[b], s.bodies[b].gradient), y);
            for (std::size_t i = 0; i < 6; ++i) s.swept[b].x[i] = static_cast<float>(-y.x[i]);
        });
        s.for_points([&](std::size_t k) { take_point(s, k); });
    }

    static void take_point(BodyIsland& s, std::size_t point) {
        const BodyPoint& p = s.points[point];
        const std::size_t place = s.pairs.place_of(point), lane = place % 8;
        PointSlot& slot = s.slots[place / 8];
        const auto put = [lane](double x, Eight& to) { to.x[lane] = static_cast<float>(x); };
        double n_n = 0, t_1 = 0, t_2 = 0, n_1 = 0, n_2 = 0;
        const auto side = [&](int body, const Six& n, const Six& t1, const Six& t2, Eight* to_n, Eight* to_1,
                              Eight* to_2) {
            const SixBlock& whitening = s.whitening[static_cast<std::size_t>(body)];
            const Row rows[3] = {times(whitening, n), times(whitening, t1), times(whitening, t2)};
            n_n += roboss::total(rows[0] * rows[0]);
            t_1 += roboss::total(rows[1] * rows[1]), t_2 += roboss::total(rows[2] * rows[2]);
            n_1 += roboss::total(rows[0] * rows[1]), n_2 += roboss::total(rows[0] * rows[2]);
            Eight* to[3] = {to_n, to_1, to_2};
            for (std::size_t d = 0; d < 3; ++d) {
                Six six;
                store(rows[d], six);
                for (std::size_t i = 0; i < 6; ++i) put(six.x[i], to[d][i]);
            }
        };
        side(p.a, p.n_a, p.t1_a, p.t2_a, slot.n_a, slot.t1_a, slot.t2_a);
        if (p.b >= 0) side(p.b, p.n_b, p.t1_b, p.t2_b, slot.n_b, slot.t1_b, slot.t2_b);
        const double compliance = 1.0 / p.stiffness_n, slip = 1.0 / p.stiffness_t;
        const double inverse_n = n_n + compliance, inverse_t = std::max(t_1, t_2) + slip;
        put(compliance, slot.compliance), put(slip, slot.slip);
        put(inverse_n, slot.inverse_mass_n), put(inverse_t, slot.inverse_mass_t);
        put(1.0 / inverse_n, slot.mass_n), put(1.0 / inverse_t, slot.mass_t);
        put(n_1, slot.n_on_1), put(n_2, slot.n_on_2);
        put(p.target_n - p.u_n, slot.target_n), put(-p.u_1, slot.target_1), put(-p.u_2, slot.target_2);
        if (s.bounds_stay)
            put(p.bound, slot.bound);
        else
            put(p.coefficient, slot.coefficient);
        put(p.f_n, slot.impulse_n), put(p.f_1, slot.impulse_1), put(p.f_2, slot.impulse_2);
    }

    /// L^-1 of a mass matrix L L^T (Cholesky), column by column.
    static void invert_root(const SixBlock& mass, SixBlock& columns) {
        double l[6][6] = {}, inverse[6];
        for (std::size_t c = 0; c < 6; ++c) {
            double sum = mass.row[c].x[c];
            for (std::size_t k = 0; k < c; ++k) sum -= l[c][k] * l[c][k];
            l[c][c] = std::sqrt(sum), inverse[c] = 1.0 / l[c][c];
            for (std::size_t r = c + 1; r < 6; ++r) {
                double x = mass.row[r].x[c];
                for (std::size_t k = 0; k < c; ++k) x -= l[r][k] * l[c][k];
                l[r][c] = x * inverse[c];
            }
        }
        for (std::size_t c = 0; c < 6; ++c) {
            double* x = columns.row[c].x;
            for (std::size_t r = 0; r < 8; ++r) x[r] = 0;
            x[c] = inverse[c];
            for (std::size_t r = c + 1; r < 6; ++r) {
                double sum = 0;
                for (std::size_t k = c; k < r; ++k) sum -= l[r][k] * x[k];
                x[r] = sum * inverse[r];
            }
        }
    }

    /// The impulses.
    static void finish(BodyIsland& s) {
        s.for_points([&](std::size_t k) {
            const std::size_t place = s.pairs.place_of(k), lane = place % 8;
            const PointSlot& slot = s.slots[place / 8];
            BodyPoint& p = s.points[k];
            p.f_n = p.swept_n = double{slot.impulse_n.x[lane]};
            p.f_1 = p.swept_1 = double{slot.impulse_1.x[lane]};
            p.f_2 = p.swept_2 = double{slot.impulse_2.x[lane]};
        });
    }
};

}  // namespace
}  // namespace roboss
