// One tick of one island: a pure function (ARCHITECTURE.md, "One step"). The result of a robot depends on
// (model, states, orders) only, never on which other robots happen to share the island: two robots affect
// each other only if their interaction bounds meet.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "core/team.h"
#include "math/aabb.h"
#include "math/spatial.h"
#include "model/model.h"
#include "model/order.h"
#include "model/robot_state.h"
#include "physics/step_profile.h"

namespace roboss {

/// Covers all that detection reads of the robot at this tick (shapes, contact margin, speculative reach at
/// its speed; for its bonds, where the held ones are), rounded outward. Feeds both the broad phase and the
/// swept bounds of a window. Call it after the tick's orders.
Aabb interaction_bound(const Model& model, RobotId robot, const RobotState& state);

/// What step_island() did in one tick, over all robots of the call.
struct StepReport {
    int contacts = 0;         // contact points that carried force
    int static_contacts = 0;  // of these, with static scenery other than planes (buildings, walls)
    int asleep = 0;           // robots that slept through the tick
    int placed = 0;           // robots of which any work was done: all but sleepers that nothing comes near
    int largest_group = 0;    // robots of the largest set that may meet, directly or by way of others
    int iterations = 0;       // Newton iterations, summed over contact islands
    double residual = 0;      // worst relative residual of the contact islands
    /// A robot whose state is not finite after the step, or so far that nothing can be computed of it before
    /// (`beyond_numbers`); the run must stop. Of several the lowest; those beyond numbers come first, for
    /// they keep others of the call from being stepped. So it does not depend on who shares the call.
    RobotId not_finite;
    JointId not_finite_joint;     // whose coordinate or velocity it is; not valid: the base's
    bool beyond_numbers = false;  // found before the step, so it was not made
    StepProfile profile;          // zero unless it is measured (StepScratch::measure_stages)

    /// What another thread did for the same step.
    void add_solves(const StepReport& other) {
        iterations += other.iterations;
        residual = std::max(residual, other.residual);
        profile.solver += other.profile.solver;
    }
};

inline constexpr std::size_t kMostLanes = 16;  // robots that any processor steps at once

/// The work of a robot in robots: one with many loops counts by its bodies.
inline std::size_t weight_of(const RobotType& type) {
    return type.elimination.empty() ? 1 : type.bodies.size();
}
inline std::size_t weight_of(const Model& model, std::span<const RobotId> robots) {
    std::size_t sum = 0;
    for (const RobotId robot : robots) sum += weight_of(model.type_of(robot));
    return sum;
}
/// The weight of a group of robots that may meet from which a team shares its work.
inline constexpr std::size_t kTeamFrom = 96;

/// Buffers of the step; keep one a thread, so that nothing is allocated once they have grown.
class StepScratch {
  public:
    StepScratch();
    ~StepScratch();
    StepScratch(StepScratch&&) noexcept;  ///< Takes the buffers over.
    /// Takes the buffers over.
    StepScratch& operator=(StepScratch&&) noexcept;
    /// From now on steps keep what contacts and loops bear, for read_contacts and read_loop_reactions. A
    /// robot with loops that nothing pushes is then stepped with rows, not by the Runge-Kutta method, which
    /// knows no loads: its state is off by what the orders differ.
    void keep_reactions(bool keep);
    /// From now on at most so many robots of a type are stepped at once in lanes (lane_stepper.h), as far as
    /// this processor can; 1: none. At first as many as it can. No bit depends on it.
    void use_lanes(std::size_t most);
    /// From now on each step reports how long its stages take by this clock, and what its solver did;
    /// nullptr: not. No bit depends on it.
    void measure_stages(StageNow now);
    /// From now on the team's threads share the work: groups side by side, and what one large group has to
    /// do. No bit depends on it. The team must not be running during a step.
    void use_team(const Team& team);
    /// Most robots of a type that are stepped at once in numbers of this precision.
    std::size_t lanes(Precision precision = Precision::kDouble) const;
    struct Impl;
    /// The buffers, for the files of the step.
    Impl& impl() { return *impl_; }

  private:
    std::unique_ptr<Impl> impl_;
};

/// One contact point that carried an impulse.
struct ContactReport {
    RobotId robot_a,            // robot A of the pair
        robot_b;                // robot B; not valid: static scenery
    LinkId link_a,              // of robot A, that is touched
        link_b;                 // of robot B; not valid: static scenery
    std::uint32_t shape_a = 0,  // of RobotType::shapes
        shape_b = 0;            // likewise, of robot B
    std::uint32_t scenery = 0;  // index in Model::statics, if it is that
    Vec3 p_W;                   // m, where A is pushed, at the beginning of the tick
    Vec3 shift_b;               // m, from there to where B is: not zero if they come together in the tick
    Vec3 normal;                // unit, from B towards A, world axes
    double gap = 0;             // m, negative: penetration
    double impulse = 0;         // N s along the normal, on A; divided by dt the mean force
    Vec3 friction;              // N s on A, world axes, in the tangent plane
    Vec3 moment;                // N m s on A, world axes: torsional and rolling friction
};

/// The contacts of the step made last with this scratch, for the robots that were awake, by (robot_a,
/// robot_b, shapes); empty unless it keeps them.
std::span<const ContactReport> read_contacts(StepScratch& scratch);

/// Part of what a joint that closes a loop passed on in a tick: by its conditions, its motor, its limits ...
struct LoopReaction {
    RobotId robot;    // that has the loop
    int loop = 0;     // in RobotType::loops
    Spatial impulse;  // N m s and N s on its body B, about the robot's origin at the beginning of the tick
};

/// Of the step made last with this scratch; empty unless it keeps them.
std::span<const LoopReaction> read_loop_reactions(StepScratch& scratch);

/// By robot of the last call: how much work its step was, in Newton iterations and about two for all else; in
/// lanes the mean of the batch. For sharing out measured time, never for results.
std::span<const float> read_efforts(StepScratch& scratch);

/// Whether robot number `index` of the last call moved without contact and rows, by the Runge-Kutta method.
bool moved_freely(StepScratch& scratch, std::size_t index);

/// Steps the island from `tick` to `tick` + 1. `robots` ascending, states[i] of robots[i]; `orders`: those
/// with apply_at == tick for these robots, in canonical order. bounds[i] receives the interaction bound of
/// robots[i] at this tick.
StepReport step_island(const Model& model, Tick tick, std::span<const RobotId> robots,
                       std::span<RobotState* const> states, std::span<const Order> orders,
                       std::span<Aabb> bounds, StepScratch& scratch);

}  // namespace roboss
