// Shots: small worlds in which something fast meets, or just misses, something else. Adding a kind is one
// function and one row of the table in shot.cpp.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fuzz/scene.h"
#include "geometry/shape.h"

namespace roboss::fuzz {

/// Start velocities of a robot; hinges of its joints turn at up to `spin`.
struct Launch {
    Vec3 angular, linear;
    double spin = 0;
};

/// A wall across x of its frame: nothing gets to its +x side within `half_extent` of its middle.
struct Wall {
    Pose X_WP;
    RobotId robot;  // valid: the wall is this robot, X_WP its pose at the start
    double thickness = 0, half_extent = 0;
};

struct Shot {
    World world;
    std::vector<Launch> launches;  // by RobotId
    std::vector<Shape> stand_ins;  // by index of Model::statics; see SweptDistance
    bool has_oracle = true;        // false: scenery without a convex stand-in
    std::optional<Wall> wall;
    std::optional<double> room;  // m: half the inner edge of a closed room about the origin
    double flight_s = 0;
};

struct ShotKind {
    const char* name;
    const char* what;
    Shot (*make)(Random& random, const Setting& setting);
    bool passes;  // meant to pass close by; else it is meant to hit
};

std::span<const ShotKind> shot_kinds();
/// nullptr: there is none of that name.
const ShotKind* find_shot_kind(const std::string& name);

Shot make_shot(const Setting& setting);
/// States of the whole flight if nothing collides, kFine to a tick.
std::vector<std::vector<RobotState>> unhindered_flight(const Setting& setting);

/// A shot being stepped, beside the same motion in which nothing collides.
class Flight {
  public:
    explicit Flight(const Setting& setting);

    /// One tick of the engine, from states() on.
    void step();
    /// False: a state is not finite; nothing more can be asked.
    bool finite() const;
    bool over() const { return static_cast<double>(tick_) * model_->dt_s >= shot_.flight_s; }
    Tick tick() const { return tick_; }
    const Shot& shot() const { return shot_; }
    const Model& model() const { return *model_; }
    const std::vector<RobotState>& before() const { return before_; }  // the last tick
    const std::vector<RobotState>& states() const { return states_; }
    /// Where the last tick would have led if nothing had been in the way.
    const std::vector<RobotState>& unhindered() const { return unhindered_; }
    /// The unhindered way of the last tick at kFine steps, states from before() on.
    std::vector<std::vector<RobotState>> fine_way() const;
    /// Largest change of a coordinate's velocity that contacts made in the last tick; 0 if no bit of any
    /// position or velocity differs.
    double change() const;

    /// Largest angle, rad, that any base or hinge turns in a tick at these velocities.
    double turn(const std::vector<RobotState>& states) const;

    static constexpr int kFine = 16;
    static constexpr double kTurnMost =
        1.5;  // rad in a tick: beyond it the fine way is too coarse to judge by

  private:
    Shot shot_;
    std::shared_ptr<const Model> model_, free_model_, fine_model_;
    std::vector<RobotState> before_, states_, unhindered_;
    StepScratch scratch_;
    mutable StepScratch free_scratch_;
    Tick tick_ = 0;
};

}  // namespace roboss::fuzz
