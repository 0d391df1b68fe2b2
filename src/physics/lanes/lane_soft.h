// soft::Kernel in the registers of one instruction set: kWidth patches side by side (lane_six.h).
#pragma once

#include <cmath>
#include <memory>

#include "core/lanes_neon.h"
#include "core/lanes_x86.h"
#include "physics/lanes/lane_six.h"
#include "physics/lanes/lane_transpose.h"
#include "physics/soft/soft_kernel.h"

namespace roboss {
namespace {

[[gnu::always_inline]] inline Part at(const soft::Eight& numbers, std::size_t lane) {
    return load_part(numbers.x + lane);
}
[[gnu::always_inline]] inline void put(const Part& part, std::size_t lane, soft::Eight& numbers) {
    store_part(part, numbers.x + lane);
}
[[gnu::always_inline]] inline Part larger_of(const Part& a, const Part& b) {
    return a > b ? a : b;
}
[[gnu::always_inline]] inline Part root_of(const Part& x) {
#if defined(__AVX512F__)
    return Avx512::sqrt(x);
#elif defined(__AVX2__)
    return Avx2::sqrt(x);
#elif defined(__aarch64__)
    return Neon::sqrt(x);
#else
    Part root{};
    for (std::size_t i = 0; i < kWidth; ++i) root[i] = std::sqrt(x[i]);
    return root;
#endif
}

/// Six numbers of a body of each lane.
struct Columns {
    Part x[6];
};

[[gnu::always_inline]] inline Columns gather(const soft::Motion* bodies, const int* chosen) {
    Columns columns;
    for (std::size_t k = 0; k < 6; k += kWidth) {
        Part block[kWidth];
        for (std::size_t i = 0; i < kWidth; ++i) block[i] = load_part(bodies[chosen[i]].x + k);
        transpose<kWidth>(block);
        for (std::size_t i = 0; i < kWidth && k + i < 6; ++i) columns.x[k + i] = block[i];
    }
    return columns;
}
[[gnu::always_inline]] inline void scatter(const Columns& columns, const int* chosen, soft::Motion* bodies) {
    for (std::size_t k = 0; k < 6; k += kWidth) {
        Part block[kWidth];
        for (std::size_t i = 0; i < kWidth; ++i) block[i] = k + i < 6 ? columns.x[k + i] : Part{};
        transpose<kWidth>(block);
        for (std::size_t i = 0; i < kWidth; ++i) store_part(block[i], bodies[chosen[i]].x + k);
    }
}
[[gnu::always_inline]] inline Part dot3(const soft::Eight* j, const Part* x, std::size_t lane) {
    return (at(j[0], lane) * x[0] + at(j[1], lane) * x[1]) + at(j[2], lane) * x[2];
}
[[gnu::always_inline]] inline void add3(Part* x, const soft::Eight* j, const Part& f, std::size_t lane) {
    for (std::size_t i = 0; i < 3; ++i) x[i] = x[i] + at(j[i], lane) * f;
}

/// The patches of a batch from a lane on.
template <bool kScenery>
class PatchLanes {
  public:
    [[gnu::always_inline]] PatchLanes(soft::Problem& problem, const soft::Batch& batch, soft::Patch& patch,
                                      std::size_t lane)
        : problem_(problem), batch_(batch), patch_(patch), lane_(lane) {
        a_ = gather(problem.velocity.data(), batch.a + lane);
        if constexpr (!kScenery) b_ = gather(problem.velocity.data(), batch.b + lane);
        inverse_mass_a_ = at(patch.inverse_mass_a, lane), inverse_mass_b_ = at(patch.inverse_mass_b, lane);
    }

    [[gnu::always_inline]] void finish() {
        scatter(a_, batch_.a + lane_, problem_.velocity.data());
        if constexpr (!kScenery) scatter(b_, batch_.b + lane_, problem_.velocity.data());
    }

    [[gnu::always_inline]] void warm() {
        Part sum{};
        for (int k = 0; k < batch_.points; ++k) {
            const soft::Point& p = point(k);
            const Part f = at(p.impulse, lane_);
            sum = sum + f;
            turn(p.turn_a, p.turn_b, f);
        }
        push(patch_.n, sum);
        const Part f1 = at(patch_.slide_1, lane_), f2 = at(patch_.slide_2, lane_);
        push(patch_.t1, f1), push(patch_.t2, f2);
        turn(patch_.slide_1a, patch_.slide_1b, f1), turn(patch_.slide_2a, patch_.slide_2b, f2);
        turn(patch_.twist_a, patch_.twist_b, at(patch_.twist, lane_));
    }

    /// `kRecovers`: overlaps are pushed out. The relative speed along the normal is kept as one number while
    /// the points of the patch are solved.
    template <bool kRecovers>
    [[gnu::always_inline]] void solve_normals(const soft::Substep& substep) {
        const soft::Softness& soft = kScenery ? substep.scenery : substep.pair;
        const Part per_h = all(1.0 / substep.h), elapsed = all(substep.elapsed), zero{}, one = all(1.0),
                   rate = all(soft.rate), mass_share = all(soft.mass_share),
                   impulse_share = all(soft.impulse_share), fastest = zero - at(patch_.recovery, lane_);
        Columns da = gather(problem_.displacement.data(), batch_.a + lane_), db;
        if constexpr (!kScenery) db = gather(problem_.displacement.data(), batch_.b + lane_);
        const Part moved = along(patch_.n, da, db);
        Part speed_n = along(patch_.n, a_, b_), sum{};
        total_ = bound_ = zero;
        for (int k = 0; k < batch_.points; ++k) {
            soft::Point& p = point(k);
            const Part own = at(p.speed, lane_);
            const Part speed = (speed_n + own) + turning(p.turn_a, p.turn_b, a_, b_),
                       gap =
                           (at(p.gap, lane_) + moved) + (turning(p.turn_a, p.turn_b, da, db) + own * elapsed),
                       f = at(p.impulse, lane_), mass = at(p.mass, lane_);
            const auto apart = gap > zero;
            const Part closing = apart ? gap * per_h : zero;
            Part change;
            if constexpr (kRecovers) {
                const Part target = apart ? closing : larger_of(mass_share * rate * gap, fastest);
                change = zero - mass * ((apart ? one : mass_share) * speed + target) -
                         (apart ? zero : impulse_share) * f;
            } else {
                change = zero - mass * (speed + closing);
            }
            const Part now = larger_of(f + change, zero);
            change = now - f;
            put(now, lane_, p.impulse);
            if constexpr (!kRecovers) {
                put(at(p.total, lane_) + now, lane_, p.total);
                bound_ = bound_ + at(p.lever, lane_) * now;
            }
            sum = sum + change, total_ = total_ + now;
            speed_n = speed_n + inverse_mass() * change;
            turn(p.turn_a, p.turn_b, change);
        }
        push(patch_.n, sum);
    }

    /// After solve_normals.
    [[gnu::always_inline]] void solve_twist() {
        const Part zero{}, f = at(patch_.twist, lane_);
        const Part speed = turning(patch_.twist_a, patch_.twist_b, a_, b_) + at(patch_.speed_twist, lane_);
        Part now = f - at(patch_.mass_twist, lane_) * speed;
        now = now > bound_ ? bound_ : now;
        now = now < zero - bound_ ? zero - bound_ : now;
        put(now, lane_, patch_.twist);
        put(at(patch_.total_twist, lane_) + now, lane_, patch_.total_twist);
        turn(patch_.twist_a, patch_.twist_b, now - f);
    }

    [[gnu::always_inline]] void solve_slide() {
        const Part u1 = (along(patch_.t1, a_, b_) + turning(patch_.slide_1a, patch_.slide_1b, a_, b_)) +
                        at(patch_.speed_1, lane_),
                   u2 = (along(patch_.t2, a_, b_) + turning(patch_.slide_2a, patch_.slide_2b, a_, b_)) +
                        at(patch_.speed_2, lane_);
        const Part f1 = at(patch_.slide_1, lane_), f2 = at(patch_.slide_2, lane_);
        const Part m12 = at(patch_.mass_12, lane_);
        Part g1 = f1 - (at(patch_.mass_11, lane_) * u1 + m12 * u2),
             g2 = f2 - (m12 * u1 + at(patch_.mass_22, lane_) * u2);
        const Part bound = at(patch_.coefficient, lane_) * total_, size2 = g1 * g1 + g2 * g2;
        const Part cut = size2 > bound * bound ? bound / root_of(size2) : all(1.0);
        g1 = g1 * cut, g2 = g2 * cut;
        put(g1, lane_, patch_.slide_1), put(g2, lane_, patch_.slide_2);
        put(at(patch_.total_1, lane_) + g1, lane_, patch_.total_1);
        put(at(patch_.total_2, lane_) + g2, lane_, patch_.total_2);
        const Part c1 = g1 - f1, c2 = g2 - f2;
        push(patch_.t1, c1), push(patch_.t2, c2);
        turn(patch_.slide_1a, patch_.slide_1b, c1), turn(patch_.slide_2a, patch_.slide_2b, c2);
    }

    /// Points that were hit and bounce, once more.
    [[gnu::always_inline]] void bounce() {
        const Part zero{};
        for (int k = 0; k < batch_.points; ++k) {
            soft::Point& p = point(k);
            const Part wanted = at(p.bounce, lane_), total = at(p.total, lane_), f = at(p.impulse, lane_);
            const Part speed =
                (along(patch_.n, a_, b_) + at(p.speed, lane_)) + turning(p.turn_a, p.turn_b, a_, b_);
            const Part target = wanted > zero ? wanted : speed,
                       change = total > zero ? at(p.mass, lane_) * (target - speed) : zero;
            const Part now = larger_of(f + change, zero);
            put(total + (now - f), lane_, p.total);
            push(patch_.n, now - f), turn(p.turn_a, p.turn_b, now - f);
        }
    }

  private:
    [[gnu::always_inline]] soft::Point& point(int k) const {
        return problem_.points[batch_.first + static_cast<std::size_t>(k)];
    }
    [[gnu::always_inline]] Part inverse_mass() const {
        return kScenery ? inverse_mass_a_ : inverse_mass_a_ + inverse_mass_b_;
    }
    [[gnu::always_inline]] Part along(const soft::Eight* direction, const Columns& a,
                                      const Columns& b) const {
        if constexpr (kScenery) return dot3(direction, a.x, lane_);
        Part difference[3];
        for (std::size_t i = 0; i < 3; ++i) difference[i] = a.x[i] - b.x[i];
        return dot3(direction, difference, lane_);
    }
    [[gnu::always_inline]] Part turning(const soft::Eight* turn_a, const soft::Eight* turn_b,
                                        const Columns& a, const Columns& b) const {
        if constexpr (kScenery) return dot3(turn_a, a.x + 3, lane_);
        return dot3(turn_a, a.x + 3, lane_) + dot3(turn_b, b.x + 3, lane_);
    }
    [[gnu::always_inline]] void push(const soft::Eight* direction, const Part& f) {
        const Part by_a = inverse_mass_a_ * f, by_b = inverse_mass_b_ * f;
        for (std::size_t i = 0; i < 3; ++i) {
            a_.x[i] = a_.x[i] + at(direction[i], lane_) * by_a;
            if constexpr (!kScenery) b_.x[i] = b_.x[i] - at(direction[i], lane_) * by_b;
        }
    }
    [[gnu::always_inline]] void turn(const soft::Eight* turn_a, const soft::Eight* turn_b, const Part& f) {
        add3(a_.x + 3, turn_a, f, lane_);
        if constexpr (!kScenery) add3(b_.x + 3, turn_b, f, lane_);
    }

    soft::Problem& problem_;
    const soft::Batch& batch_;
    soft::Patch& patch_;
    std::size_t lane_;
    Columns a_, b_;
    Part inverse_mass_a_, inverse_mass_b_;
    Part total_, bound_;  // of the normals: their impulses; the twist that they allow
};

class LaneSoft final : public soft::Kernel {
  public:
    void run(soft::Problem& problem, std::size_t first, std::size_t last, soft::Pass pass,
             const soft::Substep& substep) const override {
        for (std::size_t k = first; k < last; ++k) {
            const soft::Batch& batch = problem.batches[k];
            for (std::size_t lane = 0; lane < static_cast<std::size_t>(batch.patches); lane += kWidth) {
                if (batch.scenery)
                    run_lanes<true>(problem, k, lane, pass, substep);
                else
                    run_lanes<false>(problem, k, lane, pass, substep);
            }
        }
    }

  private:
    template <bool kScenery>
    [[gnu::always_inline]] static void run_lanes(soft::Problem& problem, std::size_t batch, std::size_t lane,
                                                 soft::Pass pass, const soft::Substep& substep) {
        PatchLanes<kScenery> lanes(problem, problem.batches[batch], problem.patches[batch], lane);
        switch (pass) {
            case soft::Pass::kWarm:
                lanes.warm();
                break;
            case soft::Pass::kPush:
                lanes.template solve_normals<true>(substep);
                break;
            case soft::Pass::kRelax:
                lanes.template solve_normals<false>(substep);
                lanes.solve_twist();
                lanes.solve_slide();
                break;
            case soft::Pass::kBounce:
                lanes.bounce();
                break;
        }
        lanes.finish();
    }
};

}  // namespace
}  // namespace roboss
