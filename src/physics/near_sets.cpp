// See near_sets.h.
#include "physics/near_sets.h"

#include <algorithm>
#include <array>

#include "physics/contact/coarse_bound.h"
#include "physics/sleep.h"

namespace roboss {
namespace {

constexpr double kFar = 1e300;
constexpr Aabb kEverywhere{{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}};

}  // namespace

/// Joins the sleeper with those on whom its sleep hangs. Whether it will wake: one of them is gone or awake.
bool NearSets::join_neighbours(const Robots& r, std::uint32_t sleeper) {
    bool wakes = false;
    for (const std::uint32_t id : r.states[sleeper]->rest.neighbours) {
        const auto found = std::lower_bound(r.ids.begin(), r.ids.end(), RobotId(id));
        if (found == r.ids.end() || found->value != id) {
            wakes = true;
            continue;
        }
        const auto i = static_cast<std::uint32_t>(found - r.ids.begin());
        joined_.unite(sleeper, i);
        wakes |= wakes_neighbours(r.model.type_of(*found), *r.states[i], r.states[i]->rest.asleep,
                                  r.ordered[i] != 0);
    }
    return wakes;
}

/// A sleeper's bound is in its state; of a robot that is awake a box that holds it will do.
void NearSets::take_bounds(const Robots& r) {
    const std::size_t count = r.ids.size();
    bounds_.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        RobotState& state = *r.states[i];
        if (state.rest.asleep) {
            bounds_[i] = state.rest.bound;
        } else if (state.bonds.empty()) {
            bounds_[i] = coarse_bound(r.model.type_of(r.ids[i]), state, r.model.dt_s);
        } else {
            place_robot(r.model, r.ids[i], state, holder_);
            bounds_[i] = holder_.box;
        }
        if (!is_finite(bounds_[i].max - bounds_[i].min)) bounds_[i] = kEverywhere;
    }
}

/// The exact bounds of those that lanes can place, if others are near; false if there are none. A robot that
/// moves fast, or a long arm that is bent, is often far smaller than its coarse bound.
bool NearSets::sharpen_bounds(const Robots& r, const LaneSteppers& lanes) {
    if (!lanes) return false;
    bool some = false;
    const auto place = [&](std::vector<std::uint32_t>& batch) {
        std::array<LaneRobot, kMostLanes> robots;
        std::array<Aabb, kMostLanes> exact;
        for (std::size_t k = 0; k < batch.size(); ++k)
            robots[k] = {r.ids[batch[k]], r.states[batch[k]], &exact[k], false, {}};
        lanes.lanes->find_bounds(r.model, std::span(robots).first(batch.size()));
        for (std::size_t k = 0; k < batch.size(); ++k)
            if (is_finite(exact[k].max - exact[k].min)) bounds_[batch[k]] = exact[k], some = true;
        batch.clear();
    };
    queue_.start(r.model.types.size());
    for (std::uint32_t i = 0; i < r.ids.size(); ++i) {
        if (!is_near_[i] || r.states[i]->rest.asleep) continue;
        const std::size_t type = r.model.like(r.ids[i]).index();
        if (fits_lanes(r.model.types[type], *r.states[i])) queue_.add(type, i, lanes.width(), place);
    }
    queue_.finish(place);
    return some;
}

/// Joins those whose bounds overlap, and sleepers with those on whom their sleep hangs.
void NearSets::join(const Robots& r) {
    const std::size_t count = r.ids.size();
    joined_.reset(count);
    active_.clear();
    for (std::uint32_t i = 0; i < count; ++i)
        if (!r.states[i]->rest.asleep)
            active_.push_back(i);
        else if (join_neighbours(r, i))
            active_.push_back(i);
    if (count > 1) meetings_.join(bounds_, active_, joined_);
    is_near_.assign(count, 0);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (r.states[i]->rest.asleep) is_near_[i] = 1;
        if (const std::uint32_t root = joined_.find(i); root != i) is_near_[i] = is_near_[root] = 1;
    }
}

void NearSets::sort(std::size_t count) {
    near_.clear(), sleepers_.clear();
    is_stirred_.assign(count, 0);
    for (const std::uint32_t i : active_) is_stirred_[joined_.find(i)] = 1;
    for (std::uint32_t i = 0; i < count; ++i)
        if (is_near_[i]) (is_stirred_[joined_.find(i)] ? near_ : sleepers_).push_back(i);
    joined_.sort_by_set(near_);
}

void NearSets::find(const Robots& robots, const LaneSteppers& lanes) {
    const std::size_t count = robots.ids.size();
    if (count > 1) take_bounds(robots);
    join(robots);
    if (count > 1 && sharpen_bounds(robots, lanes)) join(robots);
    sort(count);
}

}  // namespace roboss
