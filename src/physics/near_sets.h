// The broad phase of a tick (tick.h): which robots may meet, and which sleepers may wake.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/union_find.h"
#include "math/aabb.h"
#include "model/model.h"
#include "model/robot_state.h"
#include "physics/contact/meetings.h"
#include "physics/dynamics/robot_work.h"
#include "physics/lanes/lane_stepper.h"

namespace roboss {

/// Parts robots into sets that may meet, directly or by way of others, sleepers whom nothing wakes, and those
/// alone. Robots whose interaction bounds (place_robot) overlap are always in one set; whether others are
/// changes no bit.
class NearSets {
  public:
    /// A call of step_island, as the broad phase sees it.
    struct Robots {
        const Model& model;
        std::span<const RobotId> ids;
        std::span<RobotState* const> states;
        const std::vector<char>& ordered;  // by robot: an order changed it at this tick
    };

    /// `lanes` computes exact bounds of those whose coarse ones overlap; it may be none.
    void find(const Robots& robots, const LaneSteppers& lanes);

    /// Indices of robots that may meet others or wake, set by set.
    std::span<std::uint32_t> near() { return near_; }
    /// Act(set) for each set of them.
    template <class Act>
    void for_each_set(Act&& act) {
        joined_.for_each_set(near_, act);
    }
    std::span<const std::uint32_t> sleepers() const { return sleepers_; }
    /// False for a robot that is awake and meets nobody.
    bool is_near(std::size_t robot) const { return is_near_[robot] != 0; }

  private:
    bool join_neighbours(const Robots& robots, std::uint32_t sleeper);
    void take_bounds(const Robots& robots);
    bool sharpen_bounds(const Robots& robots, const LaneSteppers& lanes);
    void join(const Robots& robots);
    void sort(std::size_t count);

    std::vector<Aabb> bounds_;           // coarse or exact
    std::vector<std::uint32_t> active_;  // awake, or about to wake
    std::vector<std::uint32_t> near_, sleepers_;
    std::vector<char> is_near_;
    std::vector<char> is_stirred_;  // by set (UnionFind::find): one of it is active
    UnionFind joined_;              // who may meet, directly or by way of others
    Meetings meetings_;
    RobotWork holder_;  // for the bounds of those that hold others
    LaneQueue queue_;
};

}  // namespace roboss
