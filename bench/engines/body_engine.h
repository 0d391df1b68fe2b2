// What adapters of engines with a body for each link share: models taken apart into bodies and joints, start
// states, joints measured from the poses of their bodies, and drives. An adapter adds what the engine is
// asked to do.
#pragma once

#include <limits>
#include <memory>

#include "engines/assembly.h"

namespace roboss::bench {

class BodyEngine : public Engine {
  public:
    /// Box, sphere, cylinder, capsule and plane; hinges, slides and balls; no rotor inertias.
    static bool can(const World& world);

    void step(int ticks) final;
    LinkState link(LinkRef ref) const final;
    JointState joint(JointRef ref) const final;
    void set_joint(JointRef ref, JointState state) final;
    void set_base(std::size_t instance, const Pose& X_WM, const Vec3& angular, const Vec3& linear) final;
    void drive_velocity(JointRef ref, double velocity, double max_effort) final;
    void drive_position(JointRef ref, const Servo& servo) final;
    void drive_effort(JointRef ref, double effort) final;

  protected:
    static constexpr std::size_t kWorld = std::numeric_limits<std::size_t>::max();  // the body of scenery

    /// A shape of a body, or of the world.
    struct Shape {
        const CollisionSpec* collision = nullptr;
        std::size_t body = kWorld;
        Pose X_BS;                // of the world: X_WS
        std::size_t instance;     // shapes of one instance do not touch each other
        Vec3 surface_velocity_W;  // m/s, of a belt
        bool filter = false;      // shapes of the instance may meet that no joint keeps apart
    };
    /// A joint between bodies, at their poses of the model with all joints at zero.
    struct Joint {
        const JointSpec* spec = nullptr;
        std::size_t parent = kWorld, child = kWorld;  // of the file's direction
        Pose X_PJ, X_CJ;                              // of the world: X_WJ
    };
    /// effort = clamp(stiffness (position - q) + damping (velocity - qd), +- max_effort)
    struct Motor {
        double stiffness = 0, position = 0, damping = 0, velocity = 0;
        double max_effort = std::numeric_limits<double>::infinity();
        bool holds_velocity = false;  // damping is as high as it gets
    };

    /// Turns `from` to `to`, both of length one.
    static Quat turning(const Vec3& from, const Vec3& to);

    BodyEngine(const World& world, const EngineOptions& options) : world_(world), dt_(options.dt_s) {}
    /// To be called by the adapter's constructor.
    void build();

    virtual std::size_t add_body(const PartBody& part) = 0;
    virtual void add_shape(const Shape& shape) = 0;
    virtual std::size_t add_joint(const Joint& joint) = 0;
    virtual void set_motor(std::size_t joint, const Motor& motor) = 0;
    virtual BodyState body_state(std::size_t body) const = 0;
    virtual void set_body_state(std::size_t body, const BodyState& state) = 0;
    /// N or N m at the centre of mass during the coming tick, world axes.
    virtual void push(std::size_t body, const Vec3& force_W, const Vec3& torque_W) = 0;
    virtual void advance() = 0;

    const World& world_;
    const double dt_;

  private:
    struct Driven {
        Joint joint;
        std::size_t id = kWorld;  // in the engine
        double effort = 0;        // applied in every tick
    };
    struct Instance {
        Assembly assembly;
        std::vector<std::size_t> bodies;
        std::vector<std::unique_ptr<Driven>> joints;  // by ModelSpec::joints
        StartState start;
    };

    void build(std::size_t i);
    void add_shapes(const std::vector<PartShape>& shapes, std::size_t i, std::size_t body);
    void start();
    Driven& driven(JointRef ref);
    JointState state_of(const Joint& joint) const;
    Vec3 centre_of(std::size_t body, const BodyState& state) const;
    void push_effort(const Driven& driven);

    std::vector<Instance> instances_;
    std::vector<Vec3> centres_;  // p_BC by body
    std::vector<Driven*> pushed_;
    bool started_ = false;
};

}  // namespace roboss::bench
