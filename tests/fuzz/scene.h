// Random worlds of several kinds, by seed: what a property is tested on. Adding a kind is one function and
// one row of the table in scene.cpp.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "fuzz/mechanism.h"
#include "model/model.h"
#include "model/robot_state.h"
#include "physics/step.h"

namespace roboss::fuzz {

/// What a seed decides and a user may set instead.
struct Setting {
    std::uint64_t seed = 0;
    std::string kind;  // of scene_kinds()
    double dt_s = 2e-3;
    double spin = 30;  // rad/s: bases and joints start with up to so much about each axis
    double speed = 0;  // m/s, of shots
};

/// A world and how it starts.
struct Scene {
    World world;
    double base_speed = 1;     // m/s, along each axis
    bool zero_effort = false;  // all motors give an effort of 0
    bool driven = false;       // motors with random targets
};

struct SceneKind {
    const char* name;
    const char* what;
    Scene (*make)(Random& random, const Setting& setting);
    bool passive;           // its energy must not grow
    bool isolated;          // nothing acts from outside: its momentum must stay
    bool overlaps = false;  // its robots start in each other or in the ground, and may sleep
};

/// The first robot with a coordinate or velocity that is not finite; not valid: none.
RobotId find_not_finite(const std::vector<RobotState>& states);

std::span<const SceneKind> scene_kinds();
/// nullptr: there is none of that name.
const SceneKind* find_scene_kind(const std::string& name);

/// A compiled scene and its start.
struct Start {
    std::shared_ptr<const Model> model;
    std::vector<RobotState> states;  // by RobotId
};
/// Aborts if the world does not compile: a generator makes valid worlds only.
/// `floats`: stepped in floats; `sleeps`: robots that the scene lets sleep do.
Start make_start(const Setting& setting, bool floats = false, bool sleeps = true);

/// A scene being stepped, all robots in one call.
class Motion {
  public:
    explicit Motion(const Setting& setting, bool sleeps = true);

    const StepReport& step();
    double time_s() const { return static_cast<double>(tick_) * model_->dt_s; }
    Tick tick() const { return tick_; }
    const Model& model() const { return *model_; }
    const std::vector<RobotState>& states() const { return states_; }
    /// Largest velocity of a base or joint, rad/s or m/s.
    double fastest() const;

  private:
    std::shared_ptr<const Model> model_;
    std::vector<RobotId> ids_;
    std::vector<RobotState> states_;
    std::vector<RobotState*> pointers_;
    std::vector<Aabb> bounds_;
    StepScratch scratch_;
    StepReport report_;
    Tick tick_ = 0;
};

/// Compiles, and aborts with the diagnostics if that fails.
std::shared_ptr<const Model> compile_scene(const World& world);
/// Random start of all robots; loops and couplings are met.
std::vector<RobotState> start_states(const Model& model, const Scene& scene, const Setting& setting,
                                     Random& random);

}  // namespace roboss::fuzz
