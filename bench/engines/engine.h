// One physics engine on one World, behind the same few calls: so that an accuracy case or a speed benchmark
// is written once and does the same work on RoBOSS and on every peer. A World is the library's own plain data
// (read from SDF or made in code); each adapter builds its engine's scene from it and says what it cannot
// express.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "math/pose.h"
#include "world/world.h"

namespace roboss::bench {

/// A link of an instance: indices into World::instances and its prototype's links.
struct LinkRef {
    std::size_t instance = 0, link = 0;
};

/// Axis `axis` of a joint of an instance.
struct JointRef {
    std::size_t instance = 0, joint = 0, axis = 0;
};

struct LinkState {
    Pose X_WL;           // of the link frame
    Vec3 angular, v_WC;  // rad/s; m/s of the centre of mass; world axes
};

struct JointState {
    double position = 0, velocity = 0;  // rad, rad/s (or m, m/s)
};

/// What an engine says of its own solver, over all steps.
struct SolverFigures {
    double iterations = 0;       // for an island of bodies that touch, in a step
    double residual = 0;         // worst relative residual of the momentum balance
    double friction_error = 0;   // worst of an island: how far its friction is from Coulomb's law, relative
    double friction_misses = 0;  // share of the islands whose friction misses the tolerance
};

struct EngineOptions {
    double dt_s = 0.002;
    bool fast_bodies =
        false;  // something may pass through another in a tick: continuous collision, if it has any
    bool measure = false;  // keep solver_figures; costs a little
    bool sleep = false;    // what rests may be left alone
    double accuracy = 1;   // 1: as a careful user would set the engine up; each adapter says what it does
};

class Engine {
  public:
    virtual ~Engine() = default;
    Engine() = default;
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;

    virtual std::string name() const = 0;      // with version: "MuJoCo 2.2.2"
    virtual std::string settings() const = 0;  // solver, iterations, ...: how it was tuned, for the tables
    virtual void step(int ticks) = 0;

    virtual LinkState link(LinkRef link) const = 0;
    virtual JointState joint(JointRef joint) const = 0;
    /// nullopt: it does not say.
    virtual std::optional<SolverFigures> solver_figures() const { return std::nullopt; }

    // Both before the first step. set_base: for instances with a free base; X_WM places the model frame,
    // `angular` and `linear` are the root link's (rad/s; m/s of its centre of mass; world axes).
    virtual void set_joint(JointRef joint, JointState state) = 0;
    virtual void set_base(std::size_t instance, const Pose& X_WM, const Vec3& angular,
                          const Vec3& linear) = 0;

    /// A motor with at most `max_effort` (N m, N) that holds `velocity`.
    virtual void drive_velocity(JointRef joint, double velocity, double max_effort) = 0;
    /// A servo: effort = clamp(stiffness (position - q) - damping qd, +-max_effort), implicit where the
    /// engine can.
    struct Servo {
        double position = 0, stiffness = 0, damping = 0, max_effort = 0;
    };
    virtual void drive_position(JointRef joint, const Servo& servo) = 0;
    virtual void drive_effort(JointRef joint, double effort) = 0;
};

/// The World must outlive the engine. nullptr where the engine cannot express it.
using EngineMaker = std::unique_ptr<Engine> (*)(const World&, const EngineOptions&);

struct EngineKind {
    std::string name;
    EngineMaker make = nullptr;
};

/// RoBOSS in doubles first, then the peers that were built in.
std::span<const EngineKind> engines();
/// The same with RoBOSS also in fewer lanes, and in none: for speed, as no bit depends on it. And in floats,
/// in all lanes and in eight.
std::span<const EngineKind> contestants();
/// RoBOSS in floats.
const EngineKind& floats();

}  // namespace roboss::bench
