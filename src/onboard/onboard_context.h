// What an on-board controller may read and write in a tick. Its joints, links and commands are counted in the
// order in which its parameters name them.
#pragma once

#include <span>

#include "onboard/onboard.h"

namespace roboss {

/// Velocity of a link: of its origin, world axes.
struct LinkTwist {
    Vec3 angular,  ///< rad/s
        linear;    ///< m/s
};

/// Axis of a joint in the world, as the file writes it: from parent to child.
struct AxisPlace {
    Vec3 origin,    ///< m
        direction;  ///< unit
};

/// One controller of one robot at one tick.
class OnboardContext {
  public:
    OnboardContext(const Model& model, Tick tick, RobotId robot, RobotState& state, OnboardScratch& scratch)
        : model_(model),
          tick_(tick),
          robot_(robot),
          type_(type_of(model.type_of(robot), state)),
          state_(state),
          scratch_(scratch) {}
    /// The controller that runs next.
    void select(const OnboardInfo& info) { info_ = &info; }

    // --- the world
    const Model& model() const { return model_; }
    double dt() const { return model_.dt_s; }  ///< s
    Tick tick() const { return tick_; }
    double time() const { return static_cast<double>(tick_) * model_.dt_s; }  ///< s
    RobotId robot() const { return robot_; }
    const RobotType& type() const { return type_; }  ///< with the robot's own numbers
    /// As the file has it: what the makers of a controller know.
    const RobotType& type_of_file() const { return model_.type_of(robot_); }
    const OnboardInfo& info() const { return *info_; }
    RobotState& state() { return state_; }

    // --- commands
    /// Whether command number `k` has ever been given.
    bool is_commanded(std::size_t k) const { return commanded_at(k) >= 0; }
    /// The tick at which it was given last; -1: never.
    Tick commanded_at(std::size_t k) const {
        return static_cast<Tick>(state_.onboard[static_cast<std::size_t>(channel(k).index)]);
    }
    /// Its values; zeros before the first one.
    std::span<const double> command(std::size_t k) const {
        const ChannelInfo& c = channel(k);
        return std::span(state_.onboard)
            .subspan(static_cast<std::size_t>(c.index) + 1, c.channel.values.size());
    }
    /// The rows of a list, one behind the other; empty before the first one.
    std::span<const double> list(std::size_t k) const {
        return state_.lists[static_cast<std::size_t>(channel(k).list_index)];
    }
    /// Gives a command to another controller of this robot: number `k` of commands(), if it is there. It
    /// takes effect in this tick if that controller runs later, else in the next.
    void give_command(std::size_t k, std::span<const double> values);

    /// What the controller remembers from tick to tick.
    std::span<double> memory() {
        return std::span(state_.onboard)
            .subspan(static_cast<std::size_t>(info_->memory_index), info_->memory.size());
    }

    // --- joints
    std::size_t joint_count() const { return info_->axes.size(); }
    double position(std::size_t joint) const {  ///< rad or m
        return state_.q[static_cast<std::size_t>(info_->axes[joint].q_index)];
    }
    double velocity(std::size_t joint) const {  ///< rad/s or m/s
        return state_.v[static_cast<std::size_t>(info_->axes[joint].v_index)];
    }
    const Dof& dof(std::size_t joint) const {
        return type_.dofs[static_cast<std::size_t>(info_->axes[joint].motor_index)];
    }
    /// Latches a setpoint of the joint's motor: its target in rad/s, rad, N m (or m/s, m, N). The motor's
    /// bound is the joint's own, or `max_effort` if that is smaller.
    void drive(std::size_t joint, MotorMode mode, double target,
               double max_effort = std::numeric_limits<double>::infinity());
    /// Gives the joint an effort in N m or N in this tick, added to that of other controllers. It counts more
    /// than what drive() asks of the same joint.
    void push_joint(std::size_t joint, double effort);
    /// Switches all motors of the robot off for this tick.
    void cut_power();

    /// Axis of a joint in the world.
    AxisPlace axis(std::size_t joint);
    /// The two links that the file joins by it.
    LinkId child_of(std::size_t joint) const;
    LinkId parent_of(std::size_t joint) const;

    // --- links
    std::size_t link_count() const { return info_->links.size(); }
    LinkId link(std::size_t k) const { return info_->links[k]; }
    /// Pose of a link's frame in the world.
    Transform pose(LinkId link);
    LinkTwist twist(LinkId link);
    /// Centre of mass of the link in the world, m.
    Vec3 centre(LinkId link) { return centre(type_, link); }
    /// The same where type_of_file() has it.
    Vec3 centre_of_file(LinkId link) { return centre(type_of_file(), link); }
    /// Pushes the link during this tick: force in N at its centre of mass, torque in N m, world axes.
    void push(LinkId link, const Vec3& force, const Vec3& torque);
    /// The same with the force at a point p_W, m.
    void push_at(LinkId link, const Vec3& force, const Vec3& p_W);
    /// The link's surface moves so from now on, until it is set again; zero: it stands still.
    void move_surface(const SurfaceMotion& motion);
    /// The base of a kinematic robot moves so in this tick, and all that hangs on it: rad/s; m/s of the
    /// base's origin, world axes. It counts as moving also with zeros.
    void move_base(const Vec3& angular, const Vec3& linear);

    // --- air
    /// Gravity at the robot, m/s^2, world axes.
    Vec3 gravity() const { return gravity_of(model_, type_); }
    /// The wind of this tick, m/s, world axes.
    Vec3 wind() const;

  private:
    const ChannelInfo& channel(std::size_t k) const {
        return type_.channels[static_cast<std::size_t>(info_->channels[k])];
    }
    void place_bodies();
    Vec3 centre(const RobotType& type, LinkId link);
    const Transform& body_pose(int body);

    const Model& model_;
    Tick tick_;
    RobotId robot_;
    const RobotType& type_;
    RobotState& state_;
    OnboardScratch& scratch_;
    const OnboardInfo* info_ = nullptr;
    bool placed_ = false;
    Transform X_W0_;  // of the base
};

}  // namespace roboss
