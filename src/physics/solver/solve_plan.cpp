// See solve_plan.h.
#include "physics/solver/solve_plan.h"

#include <array>

namespace roboss {
namespace {

constexpr std::size_t kPile = 4, kDrivenPile = 9;  // robots

/// Robots that lean on each other: coupled steps are shortened.
constexpr newton::Plan kCrowdPlan{.halvings = 3, .progress = 0.3};

constexpr std::array kFew{Attempt::kNewton, Attempt::kSweeps, Attempt::kHardened};
constexpr std::array kMany{Attempt::kSweeps, Attempt::kHardened};
constexpr std::array kFewDisplaced{Attempt::kNewton, Attempt::kHardened};
constexpr std::array kManyDisplaced{Attempt::kActiveSet, Attempt::kNewton, Attempt::kHardened};

}  // namespace

SolvePlan plan_for(const PartFacts& facts) {
    const bool is_pile = facts.touches && facts.robots >= (facts.driven ? kDrivenPile : kPile);
    if (facts.displacement) {
        if (is_pile) return {kPilePlan, kManyDisplaced};
        return {facts.robots > 1 ? kCrowdPlan : newton::Plan{}, kFewDisplaced};
    }
    if (!is_pile) return {facts.robots > 1 ? kCrowdPlan : newton::Plan{}, kFew};
    return {kPilePlan, kMany};
}

}  // namespace roboss
