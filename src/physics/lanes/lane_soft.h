// soft::Kernel in the registers of one instruction set: kWidth patches side by side (lane_six.h).
#pragma once

#include <cmath>
#include <memory>

#include "core/lanes_neon.h"
#include "core/lanes_x86.h"
#include "physics/lanes/lane_soft_sides.h"
#include "physics/soft/soft_kernel.h"

namespace roboss {
namespace {

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

/// The patches of a batch from a lane on. `Sides`: what moves at both sides (lane_soft_sides.h).
template <class Sides, bool kScenery>
class PatchLanes {
  public:
    [[gnu::always_inline]] PatchLanes(soft::Problem& problem, const soft::Batch& batch, soft::Patch& patch,
                                      std::size_t lane)
        : points_(problem.points.data() + batch.first),
          count_(batch.points),
          patch_(patch),
          lane_(lane),
          sides_(problem, batch, patch, lane) {}

    [[gnu::always_inline]] void finish() { sides_.finish(); }

    [[gnu::always_inline]] void warm() {
        sides_.start_warm();
        for (int k = 0; k < count_; ++k) sides_.push_point(k, points_[k], at(points_[k].impulse, lane_));
        sides_.finish_normals();
        sides_.push_slide(at(patch_.slide_1, lane_), at(patch_.slide_2, lane_));
        sides_.push_twist(at(patch_.twist, lane_));
    }

    /// `kRecovers`: overlaps are pushed out.
    template <bool kRecovers>
    [[gnu::always_inline]] void solve_normals(const soft::Substep& substep) {
        const soft::Softness& soft = kScenery ? substep.scenery : substep.pair;
        const Part per_h = all(1.0 / substep.h), elapsed = all(substep.elapsed), zero{}, one = all(1.0),
                   rate = all(soft.rate), mass_share = all(soft.mass_share),
                   impulse_share = all(soft.impulse_share), fastest = zero - at(patch_.recovery, lane_);
        sides_.start_normals();
        total_ = bound_ = zero;
        for (int k = 0; k < count_; ++k) {
            soft::Point& p = points_[k];
            const Part own = at(p.speed, lane_);
            const Part speed = sides_.speed(k, p, own), gap = sides_.gap(k, p, own * elapsed),
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
            total_ = total_ + now;
            sides_.push_point(k, p, change);
        }
        sides_.finish_normals();
    }

    /// After solve_normals. Force and twist keep within an ellipsoid, whose size is the bound of each alone.
    /// Where the patch slides, both act against the motion: force = -u / s and twist = -w / s_w. So the next
    /// guess is the solution of (K + s) force = K (force so far) - u, with s as the present motion has it; 0,
    /// which would stop the patch, where it hardly moves.
    [[gnu::always_inline]] void solve_friction() {
        constexpr double kHardly = 2e-3;  // m/s
        const Part zero{}, one = all(1.0), bound = at(patch_.coefficient, lane_) * total_,
                           size2 = bound * bound, twist2 = bound_ * bound_;
        const Part u1 = slide_speed_1(), u2 = slide_speed_2(),
                   w = sides_.twist_speed() + at(patch_.speed_twist, lane_);
        const Part per_size2 = one / (size2 > zero ? size2 : one),
                   per_twist2 = one / (twist2 > zero ? twist2 : one);
        const Part power = root_of((u1 * u1 + u2 * u2) * size2 + w * w * twist2),
                   slides = larger_of(power - all(kHardly) * bound, zero);
        const Part left = one - solve_twist(w, slides * per_twist2, per_twist2);
        solve_slide(slides * per_size2, size2 * larger_of(left, zero));
    }

    /// Points that were hit and bounce, once more.
    [[gnu::always_inline]] void bounce() {
        const Part zero{};
        for (int k = 0; k < count_; ++k) {
            soft::Point& p = points_[k];
            const Part wanted = at(p.bounce, lane_), total = at(p.total, lane_), f = at(p.impulse, lane_);
            sides_.start_bounce();
            const Part speed = sides_.speed(k, p, at(p.speed, lane_));
            const Part target = wanted > zero ? wanted : speed,
                       change = total > zero ? at(p.mass, lane_) * (target - speed) : zero;
            const Part now = larger_of(f + change, zero);
            put(total + (now - f), lane_, p.total);
            sides_.push_point(k, p, now - f);
            sides_.finish_normals();
        }
    }

  private:
    [[gnu::always_inline]] Part slide_speed_1() const {
        return sides_.slide_speed_1() + at(patch_.speed_1, lane_);
    }
    [[gnu::always_inline]] Part slide_speed_2() const {
        return sides_.slide_speed_2() + at(patch_.speed_2, lane_);
    }

    /// The square of the share of the ellipsoid that it takes.
    [[gnu::always_inline]] Part solve_twist(const Part& w, const Part& s, const Part& per_bound2) {
        const Part zero{}, f = at(patch_.twist, lane_), k = at(patch_.k_twist, lane_), sum = k + s;
        Part now = (k * f - w) / (sum > zero ? sum : all(1.0));
        now = now > bound_ ? bound_ : now;
        now = now < zero - bound_ ? zero - bound_ : now;
        put(now, lane_, patch_.twist);
        put(at(patch_.total_twist, lane_) + now, lane_, patch_.total_twist);
        sides_.push_twist(now - f);
        return now * now * per_bound2;
    }

    [[gnu::always_inline]] void solve_slide(const Part& s, const Part& bound2) {
        const Part u1 = slide_speed_1(), u2 = slide_speed_2(), zero{};
        const Part f1 = at(patch_.slide_1, lane_), f2 = at(patch_.slide_2, lane_),
                   k11 = at(patch_.k_11, lane_), k12 = at(patch_.k_12, lane_), k22 = at(patch_.k_22, lane_);
        const Part a11 = k11 + s, a22 = k22 + s, det = a11 * a22 - k12 * k12,
                   inverse = all(1.0) / (det > zero ? det : all(1.0)), c1 = (k11 * f1 + k12 * f2) - u1,
                   c2 = (k12 * f1 + k22 * f2) - u2;
        Part g1 = (a22 * c1 - k12 * c2) * inverse, g2 = (a11 * c2 - k12 * c1) * inverse;
        const Part size2 = g1 * g1 + g2 * g2, cut = size2 > bound2 ? root_of(bound2 / size2) : all(1.0);
        g1 = g1 * cut, g2 = g2 * cut;
        put(g1, lane_, patch_.slide_1), put(g2, lane_, patch_.slide_2);
        put(at(patch_.total_1, lane_) + g1, lane_, patch_.total_1);
        put(at(patch_.total_2, lane_) + g2, lane_, patch_.total_2);
        sides_.push_slide(g1 - f1, g2 - f2);
    }

    soft::Point* points_;
    int count_;
    soft::Patch& patch_;
    std::size_t lane_;
    Sides sides_;
    Part total_, bound_;  // of the normals: their impulses; the twist that they allow
};

class LaneSoft final : public soft::Kernel {
  public:
    void run(soft::Problem& problem, std::size_t first, std::size_t last, soft::Pass pass,
             const soft::Substep& substep) const override {
        for (std::size_t k = first; k < last; ++k) {
            const soft::Batch& batch = problem.batches[k];
            for (std::size_t lane = 0; lane < static_cast<std::size_t>(batch.patches); lane += kWidth) {
                if (batch.jointed && batch.path_a.further == 1 && batch.path_b.further == 1) {
                    run_jointed<1>(problem, k, lane, pass, substep);
                } else if (batch.jointed) {
                    run_jointed<0>(problem, k, lane, pass, substep);
                } else if (batch.scenery) {
                    run_lanes<BodySides<true>, true>(problem, k, lane, pass, substep);
                } else {
                    run_lanes<BodySides<false>, false>(problem, k, lane, pass, substep);
                }
            }
        }
    }

  private:
    template <int kFurther>
    [[gnu::always_inline]] static void run_jointed(soft::Problem& problem, std::size_t batch,
                                                   std::size_t lane, soft::Pass pass,
                                                   const soft::Substep& substep) {
        if (problem.batches[batch].scenery)
            run_lanes<TreeSides<true, kFurther>, true>(problem, batch, lane, pass, substep);
        else
            run_lanes<TreeSides<false, kFurther>, false>(problem, batch, lane, pass, substep);
    }
    template <class Sides, bool kScenery>
    [[gnu::always_inline]] static void run_lanes(soft::Problem& problem, std::size_t batch, std::size_t lane,
                                                 soft::Pass pass, const soft::Substep& substep) {
        PatchLanes<Sides, kScenery> lanes(problem, problem.batches[batch], problem.patches[batch], lane);
        switch (pass) {
            case soft::Pass::kWarm:
                lanes.warm();
                break;
            case soft::Pass::kPush:
                lanes.template solve_normals<true>(substep);
                break;
            case soft::Pass::kRelax:
                lanes.template solve_normals<false>(substep);
                lanes.solve_friction();
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
